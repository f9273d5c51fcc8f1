"""mcplan motion"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from collections.abc import Callable

PlanArgument = Annotated[Path, typer.Argument(metavar="PLAN", help="File written by mcplan plan or rhp -o.")]
JointsOption = Annotated[
    str,
    typer.Option(
        "--joints",
        metavar="WHICH",
        help="Joints that move: all, legs, default (all but grippers and head), or names with commas between.",
    ),
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="File for the motion (.npz).")
]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows it.")]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def motion(
    plan: PlanArgument,
    joints: JointsOption = "default",
    output: OutputOption = None,
    html: HtmlOption = None,
    plots: PlotsOption = None,
    json: JsonOption = False,
) -> int:
    """Find joints, torques and contact forces that carry out a plan of contacts and CoM.

    The robot of the plan needs a URDF. The exit code is 0 if the motion was found and certified: every constraint is
    worked out again at 1 kHz, as mcplan check does.

    Example: mcplan motion plan.npz -o motion.npz --html motion.html
    """
    from mcplan.cli.motion_text import certificate_lines, motion_summary
    from mcplan.cli.outputs import require_outputs
    from mcplan.cli.terminal import printable
    from mcplan.extras import require
    from mcplan.files.outputs import ARCHIVE, require_target
    from mcplan.files.plans import load_plan
    from mcplan.wb.certificate import certify

    require("mcplan motion", "view", "pinocchio", "scipy")
    require_outputs("motion", None, html, plots)
    require_target("--output", output, ARCHIVE)
    result = _solver()(load_plan(plan), joints=joints)
    found = certify(result.motion)
    report = result.report
    if json:
        head = {"status": str(report.status), "time_s": report.time_s, "iterations": report.iterations}
        print(json_module.dumps({**head, **motion_summary(result.motion, found)}))
    else:
        print(printable(str(report)))
        for line in certificate_lines("motion", found):
            print(printable(line))
    written = _write(result.motion, output, html, plots)
    if written and not json:
        print(printable(f"Saved {', '.join(str(path) for path in written)}"))
    return 0 if found.ok() and str(report.status) == "solved" else 1


def _solver() -> Callable[..., Any]:
    """What makes a motion of a plan: it has a `motion` and a `report`.

    Raises:
        MissingExtra: This installation has none.
    """
    import importlib.util

    from mcplan.errors import MissingExtra

    if importlib.util.find_spec("mcplan.wb.solve") is None:
        raise MissingExtra("mcplan motion needs mcplan.wb.solve, which this installation does not have")
    solver: Callable[..., Any] = importlib.import_module("mcplan.wb.solve").motion
    return solver


def _write(motion: Any, output: Path | None, html: Path | None, plots: Path | None) -> list[Path]:
    from mcplan import showing

    if output is not None:
        motion.save(output)
    if html is not None:
        showing.show(motion).save_html(html)
    if plots is not None:
        showing.save_plots(motion, None, plots)
    return [path for path in (output, html, plots) if path is not None]
