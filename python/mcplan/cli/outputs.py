"""The files that a plan is written to: -o, --html, --plots, --strip."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan._core import Plan, PlanarPlan, Report


#: What --strip can be, by the ending of its name.
PICTURES = (".png", ".pdf", ".svg")


def require_outputs(
    verb: str, output: Path | None, html: Path | None, plots: Path | None, strip: Path | None = None
) -> None:
    """Say what cannot be written before planning, not after.

    Raises:
        InvalidInput: A folder does not exist or cannot be written to, a file stands where a folder should be or the
            other way round, or a name has the wrong ending.
        MissingExtra: What draws is not installed.
    """
    from mcplan.extras import require
    from mcplan.files.outputs import ARCHIVE, JSON, PAGE, require_folder, require_target

    require_target("--output", output, (*ARCHIVE, *JSON))
    require_target("--html", html, PAGE)
    require_target("--strip", strip, PICTURES)
    require_folder("--plots", plots)
    if html is not None:
        require(f"mcplan {verb} --html", "view", "meshcat")
    for option, path in (("--plots", plots), ("--strip", strip)):
        if path is not None:
            require(f"mcplan {verb} {option}", "view", "matplotlib")


@dataclass(frozen=True)
class Outputs:
    """Files that a plan is written to, and the folder of its plots; None: not asked for."""

    output: Path | None = None
    html: Path | None = None
    plots: Path | None = None
    strip: Path | None = None


def write_outputs(plan: Plan | PlanarPlan, report: Report, files: Outputs, drawn: bool = True) -> list[Path]:
    """Save and draw a plan as far as files are named; a film strip is one of a whole-body plan.

    Args:
        drawn: Off where Ctrl-C ended the search: who wants to leave does not wait for pictures, but keeps the plan.

    Returns:
        What was written: nothing of a plan that has no phases.
    """
    import mcplan

    if not drawn:
        files = Outputs(files.output)
    output, html, plots, strip = files.output, files.html, files.plots, files.strip
    if isinstance(plan, mcplan.Plan) and not plan.phases:
        return []
    if output is not None:
        plan.save(output)
    if html is not None:
        mcplan.show(plan, report=report).save_html(html)
    if plots is not None:
        from mcplan.showing import save_plots

        save_plots(plan, report, plots)
    if strip is not None:
        from mcplan.showing import save_picture

        save_picture(plan, strip)
    return [path for path in (output, html, plots, strip) if path is not None]


def require_rendering(what: str) -> None:
    """Say before a run is loaded or simulated, not after, that it cannot be rendered.

    Raises:
        MissingExtra: Packages or a graphics context are missing; the message begins with what asks for them.
    """
    from mcplan.errors import MissingExtra
    from mcplan.extras import require
    from mcplan.view.pictures.rendering import NoGraphics, require_graphics

    require(what, "sim", "mujoco", "pinocchio", "PIL")
    try:
        require_graphics()
    except NoGraphics as found:
        raise MissingExtra(f"{what}: {found}") from None
