"""mcplan sip"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from mcplan import sip as engine
    from mcplan._core import PlanarTask


MotionArgument = Annotated[str, typer.Argument(metavar="MOTION", help="Built-in motion or TOML file.")]
ForcesOption = Annotated[str, typer.Option("--forces", metavar="F", help="uniform, per-body, per-point or parameters.")]
MinimiseOption = Annotated[
    str | None,
    typer.Option("--minimise", metavar="C", help="torque (default), time, or none: any motion that is possible."),
]
ContactOption = Annotated[
    str, typer.Option("--contact", metavar="M", help="How contacts are held: tube, band or strict.")
]
TubeOption = Annotated[
    float | None,
    typer.Option("--tube", metavar="M", help="Half width of tube or band [m] (0.001), and 5 rad/m times it."),
]
TrackableOption = Annotated[
    bool, typer.Option("--trackable", help="Feet at rest, loaded and off the ground in swings, for mcplan track.")
]
OrderOption = Annotated[int, typer.Option("--order", metavar="N", help="Order of the Taylor polynomials, 3 to 12.")]
NeqOption = Annotated[int, typer.Option("--neq", metavar="N", help="Highest coefficient that band and strict hold.")]
FreeFlyerOption = Annotated[
    str, typer.Option("--free-flyer", metavar="F", help="The base: computed (from the joints) or parameterised.")
]
FreeDurationsOption = Annotated[
    bool | None,
    typer.Option(
        "--free-durations/--one-duration",
        help="A duration for each phase, or one for all. Default: free if something is minimised.",
    ),
]
ContinuousOption = Annotated[
    str, typer.Option("--continuous", metavar="C", help="Constraints between knots: hull, extremum or grid.")
]
KinematicsOption = Annotated[bool, typer.Option("--kinematics", help="Without dynamics: joints and contacts alone.")]
SelfCollisionOption = Annotated[bool, typer.Option("--self-collision", help="Keep limbs apart, as the robot says.")]
WarmStartOption = Annotated[
    Path | None, typer.Option("--warm-start", metavar="PLAN", help="Start from an earlier plan (.npz, .json).")
]
HessianOption = Annotated[
    str, typer.Option("--hessian", metavar="H", help="automatic, exact, gauss-newton or limited-memory.")
]
MaxIterationsOption = Annotated[
    int | None,
    typer.Option("--max-iterations", metavar="N", help="Most iterations of each run of the solver (1000)."),
]
CertifyOption = Annotated[
    bool, typer.Option("--certify", help="Prove the constraints at every instant; exit code 0 then needs that too.")
]
TimeLimitOption = Annotated[
    float | None, typer.Option("--time-limit", metavar="S", help="Return the best motion after so many seconds.")
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="Save the plan (.npz, .json).")
]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="FILE", help="Draw the motion on a page.")]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Write plots into a folder.")]
StripOption = Annotated[
    Path | None, typer.Option("--strip", metavar="FILE", help="Draw a film strip (.png, .pdf or .svg).")
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
VerboseOption = Annotated[
    bool, typer.Option("-v", "--verbose", help="Print the iteration table on the way (to stderr).")
]
QuietOption = Annotated[bool, typer.Option("-q", "--quiet", help="Nothing on stderr on the way.")]


def sip(
    motion: MotionArgument,
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
    """Find a planar robot's whole-body motion through a sequence of contacts, within its limits at every instant.

    Exit code 0 if the motion is solved (and, with --certify, proved), 1 otherwise; what was found is saved either way.
    Ctrl-C ends the search: the best motion so far is saved (-o), nothing is drawn, and the exit code is 130.

    Example: mcplan sip walking --forces per-point --minimise torque -o walk.npz --strip walk.png

    Example: mcplan sip cartwheel --trackable -o wheel.npz && mcplan track wheel.npz
    """
    from mcplan.cli.interrupts import CODE
    from mcplan.cli.outputs import require_outputs, write_outputs
    from mcplan.cli.sip_text import summary_text
    from mcplan.planar import planning

    require_outputs("sip", output, html, plots, strip)
    given = {"forces": forces, "contact": contact, "tube_m": tube, "tube_rad": None if tube is None else 5.0 * tube}
    given |= {"order": order, "neq": neq, "free_flyer": free_flyer, "free_durations": free_durations}
    given |= {"continuous": continuous, "dynamics": not kinematics, "self_collision": self_collision}
    given |= {"hessian": hessian, "max_iterations": max_iterations, "time_limit": time_limit}
    model, options = _asked(motion, trackable, minimise, given)
    if certify:
        planning.require_provable(options)
    silent = quiet or (json and not verbose)
    result, interrupted = _search(model, options, warm_start, certify, None if silent else verbose)
    written = write_outputs(result.plan, result.report, output, html, plots, strip, drawn=not interrupted)
    print(json_module.dumps(summary(result), allow_nan=False) if json else summary_text(result, options, written))
    if interrupted:
        return CODE
    proved = result.certificate is None or result.certificate.proved()
    return 0 if str(result.report.status) == "solved" and proved else 1


def _asked(
    motion: Any, trackable: bool, minimise: str | None, given: dict[str, Any]
) -> tuple[PlanarTask, engine.Options]:
    """The motion, and the planner's options; those of --trackable give way to what was typed."""
    from mcplan.planar import planning

    model = planning.motion_of(motion)
    if trackable:
        from mcplan.planar.tracking import trackable as ask_for

        model, more = ask_for(model)
        given = more | {name: value for name, value in given.items() if value is not None}
    return model, planning.make_options(minimise, given)


def _search(
    motion: PlanarTask, options: engine.Options, warm_start: Path | None, certify: bool, verbose: bool | None
) -> tuple[engine.Result, bool]:
    """What was found, and whether Ctrl-C ended the search; `verbose` None: nothing is told on the way."""
    from mcplan import sip as engine
    from mcplan.cli.interrupts import as_far_as_it_came
    from mcplan.cli.sip_text import Progress
    from mcplan.planar import planning

    progress = None if verbose is None else Progress(motion.name, verbose)
    if progress is not None:
        options.logger = progress
    planner = engine.Planner(motion, options)
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
        "motion": plan.motion.name,
        "robot": plan.motion.robot.name,
        "status": str(report.status),
        "message": report.message,
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
