"""mcplan sip"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.cli.given_options import named_as_typed

if TYPE_CHECKING:
    from mcplan import sip as engine
    from mcplan._core import PlanarTask


TaskArgument = Annotated[str, typer.Argument(metavar="TASK", help="Planar task: built-in name or TOML file.")]
ForcesOption = Annotated[
    str, typer.Option("--forces", metavar="F", help="Contact force law: uniform, per-body, per-point or parameters.")
]
MinimiseOption = Annotated[
    str | None,
    typer.Option("--minimise", metavar="C", help="Cost: torque (default), time, or none for any feasible motion."),
]
ContactOption = Annotated[
    str, typer.Option("--contact", metavar="M", help="Form of the contact constraints: tube, band or strict.")
]
TubeOption = Annotated[
    float | None,
    typer.Option("--tube", metavar="M", help="Half width of tube or band [m] (0.001); in angle 5 rad/m times it."),
]
TrackableOption = Annotated[
    bool,
    typer.Option(
        "--trackable",
        help="Ask for a motion that mcplan track can follow: feet at rest, under load, and clear of the ground in swings.",
    ),
]
OrderOption = Annotated[int, typer.Option("--order", metavar="N", help="Order of the Taylor polynomials, 3 to 12.")]
NeqOption = Annotated[
    int, typer.Option("--neq", metavar="N", help="Highest coefficient that band and strict constrain.")
]
FreeFlyerOption = Annotated[
    str,
    typer.Option("--free-flyer", metavar="F", help="Motion of the base: computed (from the joints) or parameterised."),
]
FreeDurationsOption = Annotated[
    bool | None,
    typer.Option(
        "--free-durations/--one-duration",
        help="Optimise a duration for each phase, or one for all; default: each if there is a cost.",
    ),
]
ContinuousOption = Annotated[
    str, typer.Option("--continuous", metavar="C", help="Form of constraints between knots: hull, extremum or grid.")
]
KinematicsOption = Annotated[
    bool, typer.Option("--kinematics", help="Leave out dynamics: constrain joints and contacts alone.")
]
SelfCollisionOption = Annotated[bool, typer.Option("--self-collision", help="Constrain the robot's collision pairs.")]
WarmStartOption = Annotated[
    Path | None, typer.Option("--warm-start", metavar="PLAN", help="Plan to start the search from (.npz, .json).")
]
SolverOption = Annotated[str, typer.Option("--solver", metavar="S", help="Solver of the programs: ipopt, ipm or auto.")]
HessianOption = Annotated[
    str,
    typer.Option(
        "--hessian", metavar="H", help="Second derivatives: automatic, exact, gauss-newton or limited-memory."
    ),
]
MaxIterationsOption = Annotated[
    int | None,
    typer.Option(
        "--max-iterations", metavar="N", help="Maximum number of iterations of each run of the solver (1000)."
    ),
]
CertifyOption = Annotated[
    bool,
    typer.Option("--certify", help="Prove the constraints at every instant; exit code 0 then needs the proof, too."),
]
TimeLimitOption = Annotated[
    float | None,
    typer.Option("--time-limit", metavar="S", help="Time [s] after which the best motion so far is returned."),
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="File for the plan (.npz, .json).")
]
HtmlOption = Annotated[
    Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows the motion.")
]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")]
StripOption = Annotated[
    Path | None, typer.Option("--strip", metavar="FILE", help="File for a film strip (.png, .pdf or .svg).")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
VerboseOption = Annotated[bool, typer.Option("-v", "--verbose", help="Print the table of iterations on stderr.")]
QuietOption = Annotated[bool, typer.Option("-q", "--quiet", help="Print no progress on stderr.")]


@named_as_typed(
    *("forces", "minimise", "contact", "order", "neq", "free_flyer", "free_durations", "continuous", "self_collision"),
    *("warm_start", "solver", "hessian", "max_iterations", "certify"),
    dynamics="--kinematics",
    tube_m="--tube",
    tube_rad="--tube",
    time_limit_s="--time-limit",
)
def sip(
    task: TaskArgument,
    forces: ForcesOption = "per-point",
    minimise: MinimiseOption = None,
    contact: ContactOption = "tube",
    tube: TubeOption = None,
    trackable: TrackableOption = False,
    order: OrderOption = 8,
    neq: NeqOption = 2,
    free_flyer: FreeFlyerOption = "computed",
    free_durations: FreeDurationsOption = None,
    continuous: ContinuousOption = "hull",
    kinematics: KinematicsOption = False,
    self_collision: SelfCollisionOption = False,
    warm_start: WarmStartOption = None,
    solver: SolverOption = "ipopt",
    hessian: HessianOption = "automatic",
    max_iterations: MaxIterationsOption = None,
    certify: CertifyOption = False,
    time_limit: TimeLimitOption = None,
    output: OutputOption = None,
    html: HtmlOption = None,
    plots: PlotsOption = None,
    strip: StripOption = None,
    json: JsonOption = False,
    verbose: VerboseOption = False,
    quiet: QuietOption = False,
) -> int:
    """Plan a planar robot's whole-body motion for given stances.

    The robot's limits hold at every instant. The exit code is 0 if the motion is solved (and, with --certify, proved),
    1 otherwise; what was found is saved either way. Ctrl-C ends the search: the best motion so far is saved (-o),
    nothing is drawn, and the exit code is 130.

    Example: mcplan sip walking --forces per-point --minimise torque -o walk.npz --strip walk.png

    Example: mcplan sip cartwheel --trackable -o wheel.npz && mcplan track wheel.npz
    """
    from mcplan.cli.interrupts import CODE
    from mcplan.cli.outputs import Outputs, require_outputs, write_outputs
    from mcplan.cli.sip_text import summary_text
    from mcplan.planar import planning

    require_outputs("sip", output, html, plots, strip)
    given = {"forces": forces, "contact": contact, "tube_m": tube, "tube_rad": None if tube is None else 5.0 * tube}
    given |= {"order": order, "neq": neq, "free_flyer": free_flyer, "free_durations": free_durations}
    given |= {"continuous": continuous, "dynamics": not kinematics, "self_collision": self_collision}
    given |= {"solver": solver, "hessian": hessian, "max_iterations": max_iterations, "time_limit": time_limit}
    model, options = _asked(task, trackable, minimise, given)
    if certify:
        planning.require_provable(options)
    silent = quiet or (json and not verbose)
    result, interrupted = _search(model, options, warm_start, certify, None if silent else verbose)
    written = write_outputs(result.plan, result.report, Outputs(output, html, plots, strip), drawn=not interrupted)
    print(json_module.dumps(summary(result), allow_nan=False) if json else summary_text(result, options, written))
    if interrupted:
        return CODE
    proved = result.certificate is None or result.certificate.proved()
    return 0 if str(result.report.status) == "solved" and proved else 1


def _asked(
    task: Any, trackable: bool, minimise: str | None, given: dict[str, Any]
) -> tuple[PlanarTask, engine.Options]:
    """The task, and the planner's options; those of --trackable give way to what was typed."""
    from mcplan.planar import planning

    model = planning.task_of(task)
    if trackable:
        from mcplan.planar.tracking import trackable as ask_for

        model, more = ask_for(model)
        given = more | {name: value for name, value in given.items() if value is not None}
    return model, planning.make_options(minimise, given)


def _search(
    task: PlanarTask, options: engine.Options, warm_start: Path | None, certify: bool, verbose: bool | None
) -> tuple[engine.Result, bool]:
    """What was found, and whether Ctrl-C ended the search; `verbose` None: no progress is printed."""
    from mcplan import sip as engine
    from mcplan.arguments import named_by_file
    from mcplan.cli.interrupts import as_far_as_it_came
    from mcplan.cli.sip_text import Progress
    from mcplan.planar import planning

    progress = None if verbose is None else Progress(task.name, verbose)
    if progress is not None:
        options.logger = progress
    planner = engine.Planner(task, options)
    with named_by_file(plan=warm_start, plan_option="--warm-start"):
        found = as_far_as_it_came(
            lambda: planning.solve(planner, warm_start, certify=certify, self_collision=options.self_collision)
        )
    if progress is not None:
        progress.end()
    return found


def summary(result: engine.Result) -> dict[str, Any]:
    """What ``--json`` prints."""
    from mcplan.cli.check import finite, violation_dict

    plan, report, certificate = result.plan, result.report, result.certificate
    worst = violation_dict(report.worst_violation)
    return {
        "task": plan.task.name,
        "motion": plan.task.name,  # as the task was called until 0.1, for one more release
        "robot": plan.task.robot.name,
        "status": str(report.status),
        "message": report.message,
        "solver": result.solver.name,
        "iterations": report.iterations,
        "time_s": report.time_s,
        "evaluation_s": report.timing_s.get("evaluation", 0.0),
        "linear_solver_s": report.timing_s.get("linear_solver", 0.0),
        "parameters": result.parameters,
        "constraints": result.constraints,
        "cost": finite(report.cost),
        "cost_terms": {name: finite(value) for name, value in report.cost_terms.items()},
        "durations_s": list(plan.durations),
        "drift_m": finite(result.drift_m),
        "drift_rad": finite(result.drift_rad),
        "worst_violation": worst,
        "certified": None if certificate is None else certificate.proved(),
        "version": report.version,
    }
