"""Pictures that no option of `mcplan` writes:

python -m pages.drawings page WALK.npz PICTURE.png SECONDS    the page of a plan at an instant, by Chromium
python -m pages.drawings postures RUN.npz PICTURE.png T,T,...  postures of a run at these instants [s] in one scene
"""

from __future__ import annotations

import sys

PAGE_SIZE, POSTURES_SIZE = (1400, 800), (800, 652)


def main(kind: str, source: str, picture: str, argument: str) -> None:
    """Draw one of the pictures above."""
    if kind == "page":
        import mcplan

        mcplan.show(mcplan.Plan.load(source)).save_png(picture, float(argument), PAGE_SIZE)
    elif kind == "postures":
        from mcplan.tracking import TrackingResult
        from mcplan.view import save_run_postures

        times_s = [float(time_s) for time_s in argument.split(",")]
        save_run_postures(TrackingResult.load(source), picture, times_s, POSTURES_SIZE)
    else:
        raise SystemExit(f"no kind of picture {kind!r}; there are: page, postures")


if __name__ == "__main__":
    main(*sys.argv[1:])
