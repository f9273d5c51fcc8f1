"""mcplan show"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from mcplan.cli.track_text import Progress
    from mcplan.showing import Shown


def show(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE", help="Plan (mcplan plan, rhp or sip -o), motion (motion -o) or run (track --save)."
        ),
    ],
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="File for a page (.html), a picture (.png; of a plan also .pdf or .svg), or a video of a run "
            "(.mp4, .webp, .gif); may be repeated.",
        ),
    ] = None,
    plots: Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")] = None,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print no progress on stderr.")] = False,
) -> int:
    """Draw a saved plan, motion or run: page, picture, video, plots.

    The picture of a plan or motion shows the robot's postures along its path, that of a whole-body plan is a film strip, and
    that of a run are snapshots side by side. The page of a motion has maps of its joints' torques and speeds.

    Example: mcplan show plan.npz -o plan.html -o plan.png

    Example: mcplan show run.npz --plots run
    """
    from mcplan import showing
    from mcplan.cli.terminal import printable
    from mcplan.cli.track_text import Progress

    outputs = output or []
    require(outputs, plots)
    what = showing.load(file)
    require_kind(outputs, what)
    progress = Progress(quiet)
    for path in outputs:
        write(what, path, progress)
    if plots is not None:
        progress.working("plotting")
        showing.save_plots(what, None, plots)
    progress.end()
    print(printable(f"Saved {', '.join(str(path) for path in [*outputs, *([plots] if plots is not None else [])])}"))
    return 0


def endings() -> dict[str, tuple[str, ...]]:
    """What -o writes, by the ending of the name."""
    from mcplan.cli.outputs import PICTURES
    from mcplan.files.outputs import PAGE
    from mcplan.view.video.files import SUFFIXES

    return {"page": PAGE, "picture": PICTURES, "video": SUFFIXES}


def kind_of(path: Path) -> str:
    """What is to be written there: "page", "picture" or "video"."""
    return next((kind for kind, suffixes in endings().items() if path.suffix.lower() in suffixes), "picture")


def require(outputs: list[Path], plots: Path | None) -> None:
    """Say what cannot be written before anything is loaded.

    Raises:
        InvalidInput: Nothing is asked for; a folder does not exist or cannot be written to, or a name has the wrong
            ending.
        MissingExtra: What draws is not installed.
    """
    from mcplan.cli.outputs import require_outputs
    from mcplan.errors import InvalidInput
    from mcplan.extras import require as require_extra
    from mcplan.files.outputs import require_target

    if not outputs and plots is None:
        raise InvalidInput("--output or --plots", "must say what to draw")
    require_outputs("show", None, None, plots)
    for path in outputs:
        require_target("--output", path, [suffix for suffixes in endings().values() for suffix in suffixes])
        if kind_of(path) == "page":
            require_extra(f"mcplan show -o {path}", "view", "meshcat")


def require_kind(outputs: list[Path], what: Shown) -> None:
    """Say what cannot be drawn of this plan or run before anything is drawn.

    Raises:
        InvalidInput: A video of a plan, or a picture of a run in vectors.
        MissingExtra: What draws is not installed.
    """
    from mcplan.cli.outputs import require_rendering
    from mcplan.errors import InvalidInput, shown_path
    from mcplan.extras import require as require_extra
    from mcplan.showing import is_run
    from mcplan.view.video.files import check_target

    for path in outputs:
        kind = kind_of(path)
        if kind == "page":
            continue
        if is_run(what):
            if kind == "video":
                check_target(path)
            elif path.suffix.lower() != ".png":
                raise InvalidInput("--output", "must end in .png: a run is rendered", shown_path(path))
            require_rendering(f"mcplan show -o {path}")
        elif kind == "video":
            rule = "must be a page or a picture: a plan is filmed once mcplan track has made a run of it"
            raise InvalidInput("--output", rule, shown_path(path))
        else:
            require_extra(f"mcplan show -o {path}", "view", "matplotlib")


def write(what: Shown, path: Path, progress: Progress) -> None:
    """Write the page, picture or video that the ending of a path asks for."""
    from mcplan import showing

    kind = kind_of(path)
    if kind == "page":
        progress.working("drawing the page")
        showing.show(what).save_html(path)
    elif kind == "video" and showing.is_run(what):
        showing.save_video(what, path, progress=progress.drawn)
    else:
        progress.working("drawing the picture")
        showing.save_picture(what, path)
