"""Pictures that no option of `mcplan` writes:

python -m pages.drawings page WALK.npz PICTURE.png SECONDS    the page of a plan at an instant, by Chromium
python -m pages.drawings postures RUN.npz PICTURE.png T,T,...  postures of a run at these instants [s] in one scene
python -m pages.drawings unlimited CASE PICTURE.png            strip of a case of `bench tracking`, full torque at every speed
python -m pages.drawings swing_up EXAMPLE.py PICTURE.png       the swing-up of examples/cart_pole.py
python -m pages.drawings look_ahead TERRAIN PICTURE.png        CPU time of a cycle with each solver, over the look-ahead
"""

from __future__ import annotations

import sys

PAGE_SIZE, POSTURES_SIZE = (1400, 800), (800, 652)


def main(kind: str, source: str, picture: str, argument: str = "") -> None:
    """Draw one of the pictures above."""
    if kind == "page":
        import mcplan

        mcplan.show(mcplan.Plan.load(source)).save_png(picture, float(argument), PAGE_SIZE)
    elif kind == "postures":
        from mcplan.tracking import TrackingResult
        from mcplan.view import save_run_postures

        times_s = [float(time_s) for time_s in argument.split(",")]
        save_run_postures(TrackingResult.load(source), picture, times_s, POSTURES_SIZE)
    elif kind == "unlimited":
        from mcplan.showing import save_strip
        from mcplan.tracking import Options
        from mcplan_bench.tracking import plan_of, track_plan
        from mcplan_bench.tracking_cases import named

        case = named(source)
        save_strip(track_plan(case, plan_of(case).plan, Options(speed_limits=False)), picture)
    elif kind == "swing_up":
        from pages.swing_up import save

        save(source, picture)
    elif kind == "look_ahead":
        from pages.look_ahead import save as save_look_ahead

        save_look_ahead(source, picture)
    else:
        raise SystemExit(f"no kind of picture {kind!r}; there are: page, postures, unlimited, swing_up, look_ahead")


if __name__ == "__main__":
    main(*sys.argv[1:])
