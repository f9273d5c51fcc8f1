"""The files that a plan is written to: -o, --html, --plots."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan import Plan, Report


def require_outputs(verb: str, output: Path | None, html: Path | None, plots: Path | None) -> None:
    """Say what cannot be written before planning, not after.

    Raises:
        InvalidInput: A folder does not exist, or a file stands where a folder should be, or the other way round.
        MissingExtra: What draws is not installed.
    """
    from mcplan.errors import InvalidInput
    from mcplan.extras import require

    for option, path in (("--output", output), ("--html", html)):
        if path is not None and not path.parent.is_dir():
            raise InvalidInput(option, "must lie in a folder that exists", str(path))
        if path is not None and path.is_dir():
            raise InvalidInput(option, "must be a file", str(path))
    if plots is not None and plots.exists() and not plots.is_dir():
        raise InvalidInput("--plots", "must be a folder, or a name for a new one", str(plots))
    if html is not None:
        require(f"mcplan {verb} --html", "view", "meshcat")
    if plots is not None:
        require(f"mcplan {verb} --plots", "view", "matplotlib")


def write_outputs(plan: Plan, report: Report, output: Path | None, html: Path | None, plots: Path | None) -> None:
    """Save and draw a plan as far as files are named."""
    import mcplan

    if output is not None:
        plan.save(output)
    if html is not None:
        mcplan.show(plan, report=report).save_html(html)
    if plots is not None:
        from mcplan.view.plots import save_plots

        save_plots(plan, report, plots)
