"""The files that a plan is written to: -o, --html, --plots, --strip."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan import Plan, Report, WholeBodyPlan


#: What --strip can be, by the ending of its name.
PICTURES = (".png", ".pdf", ".svg")


def require_outputs(
    verb: str, output: Path | None, html: Path | None, plots: Path | None, strip: Path | None = None
) -> None:
    """Say what cannot be written before planning, not after.

    Raises:
        InvalidInput: A folder does not exist, or a file stands where a folder should be, or the other way round.
        MissingExtra: What draws is not installed.
    """
    from mcplan.errors import InvalidInput
    from mcplan.extras import require

    for option, path in (("--output", output), ("--html", html), ("--strip", strip)):
        if path is not None and not path.parent.is_dir():
            raise InvalidInput(option, "must lie in a folder that exists", str(path))
        if path is not None and path.is_dir():
            raise InvalidInput(option, "must be a file", str(path))
    if plots is not None and plots.exists() and not plots.is_dir():
        raise InvalidInput("--plots", "must be a folder, or a name for a new one", str(plots))
    if strip is not None and strip.suffix.lower() not in PICTURES:
        raise InvalidInput("--strip", f"must end in {', '.join(PICTURES)}", str(strip))
    if html is not None:
        require(f"mcplan {verb} --html", "view", "meshcat")
    for option, path in (("--plots", plots), ("--strip", strip)):
        if path is not None:
            require(f"mcplan {verb} {option}", "view", "matplotlib")


def write_outputs(
    plan: Plan | WholeBodyPlan,
    report: Report,
    output: Path | None,
    html: Path | None,
    plots: Path | None,
    strip: Path | None = None,
) -> None:
    """Save and draw a plan as far as files are named; a film strip is one of a whole-body plan."""
    import mcplan

    if output is not None:
        plan.save(output)
    if html is not None:
        mcplan.show(plan, report=report).save_html(html)
    if plots is not None:
        from mcplan.view.plots import save_plots

        save_plots(plan, report, plots)
    if strip is not None:
        from mcplan._core import WholeBodyPlan
        from mcplan.view.film_strip import film_strip

        assert isinstance(plan, WholeBodyPlan)
        film_strip(plan).savefig(strip, metadata={"Software": None} if strip.suffix.lower() == ".png" else None)
