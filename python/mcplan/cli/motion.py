"""mcplan motion"""

from __future__ import annotations

import json as json_module
import logging
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.cli.given_options import named_as_typed

if TYPE_CHECKING:
    from mcplan.wb import Motion
    from mcplan.wb.result import MotionResult

PlanArgument = Annotated[Path, typer.Argument(metavar="PLAN", help="File written by mcplan plan or rhp -o.")]
JointsOption = Annotated[
    str,
    typer.Option(
        "--joints",
        metavar="WHICH",
        help="Joints that move: default (all but grippers and head), all, legs, or names with commas between.",
    ),
]
StartOption = Annotated[
    str, typer.Option("--start", metavar="S", help="Where the search begins: follow (inverse kinematics) or stand.")
]
NodeOption = Annotated[float, typer.Option("--node", metavar="S", help="Largest time between nodes [s].")]
MaxIterationsOption = Annotated[
    int, typer.Option("--max-iterations", metavar="N", help="Maximum number of iterations of the solver.")
]
TimeLimitOption = Annotated[
    float | None,
    typer.Option("--time-limit", metavar="S", help="Time [s] after which the best motion so far is certified."),
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="File for the motion (.npz).")
]
HtmlOption = Annotated[
    Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows the motion.")
]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
VerboseOption = Annotated[bool, typer.Option("-v", "--verbose", help="Print the table of iterations on stderr.")]


@named_as_typed("joints", "start", "max_iterations", node_s="--node", time_limit_s="--time-limit")
def motion(
    plan: PlanArgument,
    joints: JointsOption = "default",
    start: StartOption = "follow",
    node: NodeOption = 0.025,
    max_iterations: MaxIterationsOption = 60,
    time_limit: TimeLimitOption = None,
    output: OutputOption = None,
    html: HtmlOption = None,
    plots: PlotsOption = None,
    json: JsonOption = False,
    verbose: VerboseOption = False,
) -> int:
    """Find joints and torques that carry out a plan.

    The robot of the plan needs a URDF. What is found is certified: every constraint is worked out again at 1 kHz, as mcplan
    check does. The exit code is 0 if the motion is solved, 1 otherwise; what was found is saved either way. Ctrl-C ends the
    search: the motion so far is saved (-o), nothing is drawn, the code is 130.

    Example: mcplan motion plan.npz -o motion.npz --html motion.html
    """
    from mcplan.cli.interrupts import CODE, as_far_as_it_came
    from mcplan.cli.motion_text import report_lines, summary
    from mcplan.cli.outputs import require_outputs
    from mcplan.cli.terminal import printable
    from mcplan.extras import require
    from mcplan.files.outputs import ARCHIVE, require_target
    from mcplan.wb.solve import motion as solve

    require("mcplan motion", "view", "pinocchio", "scipy")
    require_target("--output", output, ARCHIVE, plan)
    require_outputs("motion", output, html, plots)
    if verbose:
        _log_iterations()
    limit = float("inf") if time_limit is None else time_limit
    options: dict[str, Any] = {"joints": joints, "start": start, "node_s": node, "max_iterations": max_iterations}
    result, interrupted = as_far_as_it_came(lambda: solve(plan, time_limit_s=limit, **options))
    certified, interrupted = _certified(result, interrupted)
    if json:
        print(json_module.dumps(summary(certified), allow_nan=False), flush=True)
    else:
        for line in report_lines(certified):
            print(printable(line), flush=True)
    written = _write(certified, output, *((None, None) if interrupted else (html, plots)))
    if written and not json:
        print(printable(f"Saved {', '.join(str(path) for path in written)}"))
    return CODE if interrupted else 0 if str(result.status) == "solved" else 1


def _certified(result: MotionResult, interrupted: bool) -> tuple[MotionResult, bool]:
    """The result with what the certificate says of a motion that did not converge, too, and whether Ctrl-C came by then.

    What only stands still, since there was no time for an iteration, is not worth one.
    """
    if result.certificate is not None or interrupted or (str(result.status) == "time_limit" and not result.iterations):
        return result, interrupted
    from dataclasses import replace

    try:
        return replace(result, certificate=result.motion.check()), False
    except KeyboardInterrupt:
        return result, True


def _log_iterations() -> None:
    handler = logging.StreamHandler()
    handler.setFormatter(logging.Formatter("%(message)s"))
    log = logging.getLogger("mcplan.wb")
    log.addHandler(handler)
    log.setLevel(logging.INFO)


def _write(result: MotionResult, output: Path | None, html: Path | None, plots: Path | None) -> list[Path]:
    from mcplan.showing import save_plots
    from mcplan.view.pages.show_motion import show_motion

    motion: Motion = result.motion
    if output is not None:
        motion.save(output)
    if html is not None:
        show_motion(motion, result.certificate).save_html(html)
    if plots is not None:
        save_plots(motion, None, plots)
    return [path for path in (output, html, plots) if path is not None]
