"""mcplan rhp"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.cli.given_options import named_as_typed

if TYPE_CHECKING:
    from mcplan import rhp as engine
    from mcplan._core import Plan, Robot, Scene
    from mcplan.cli.rhp_text import Progress


TerrainArgument = Annotated[str, typer.Argument(metavar="TERRAIN", help="Scene: built-in name or TOML file.")]
RobotOption = Annotated[
    str | None,
    typer.Option("--robot", metavar="R", help="Robot; default: that of --sequence, else talos_wang."),
]
FidelityOption = Annotated[
    str,
    typer.Option("--fidelity", metavar="F", help="Model of predicted steps: single, com, rectangle or point."),
]
LookaheadOption = Annotated[
    int, typer.Option("--lookahead", metavar="N", help="Number of steps in a horizon, the executed one included.")
]
ScaleOption = Annotated[float, typer.Option("--scale", metavar="X", help="Factor on all lengths of the terrain.")]
CyclesOption = Annotated[int, typer.Option("--cycles", metavar="N", help="Number of steps to execute.")]
TranscriptionOption = Annotated[
    str, typer.Option("--transcription", metavar="T", help="Integration rule: trapezoidal or euler.")
]
SolverOption = Annotated[str, typer.Option("--solver", metavar="S", help="Solver of the programs: ipopt, ipm or auto.")]
PaperOption = Annotated[bool, typer.Option("--paper", help="Use the CoM box and the friction pyramid as published.")]
LiftedPsiOption = Annotated[bool, typer.Option("--lifted-psi", help="Keep the relaxation's bounds as variables.")]
SequenceOption = Annotated[
    Path | None,
    typer.Option("--sequence", metavar="PLAN", help="Plan whose start and contact sequence are taken (.npz, .json)."),
]
TimeLimitOption = Annotated[
    float | None, typer.Option("--time-limit", metavar="S", help="Maximum time of each cycle [s]; default: none.")
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="File for the plan (.npz, .json).")
]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows the plan.")]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
VerboseOption = Annotated[
    bool, typer.Option("-v", "--verbose", help="Print sizes, drift and the parts of the time, too.")
]
QuietOption = Annotated[bool, typer.Option("-q", "--quiet", help="Print no line per cycle on stderr.")]


@named_as_typed(
    "scale",
    "fidelity",
    "lookahead",
    "cycles",
    "transcription",
    "solver",
    "paper",
    "lifted_psi",
    time_limit_s="--time-limit",
)
def rhp(
    terrain: TerrainArgument,
    robot: RobotOption = None,
    fidelity: FidelityOption = "point",
    lookahead: LookaheadOption = 3,
    scale: ScaleOption = 1.0,
    cycles: CyclesOption = 14,
    transcription: TranscriptionOption = "trapezoidal",
    solver: SolverOption = "auto",
    paper: PaperOption = False,
    lifted_psi: LiftedPsiOption = False,
    sequence: SequenceOption = None,
    time_limit: TimeLimitOption = None,
    output: OutputOption = None,
    html: HtmlOption = None,
    plots: PlotsOption = None,
    json: JsonOption = False,
    verbose: VerboseOption = False,
    quiet: QuietOption = False,
) -> int:
    """Plan a walk over given surfaces by a receding horizon.

    Each cycle plans a few steps ahead and executes one. The exit code is 0 if every cycle found a step within its
    constraints, 1 otherwise; what was found is saved either way. Ctrl-C ends the walk: what was walked is saved (-o),
    nothing is drawn, and the exit code is 130.

    Example: mcplan rhp rubbles --fidelity point --lookahead 3 -o walk.npz --html walk.html
    """
    from mcplan import walking
    from mcplan.arguments import named_by_file
    from mcplan.cli.interrupts import CODE
    from mcplan.cli.outputs import Outputs, require_outputs, write_outputs
    from mcplan.cli.rhp_text import Progress, summary_text
    from mcplan.files.scenes import scaled

    require_outputs("rhp", output, html, plots)
    given = {"fidelity": fidelity, "lookahead": lookahead, "cycles": cycles, "transcription": transcription}
    options = walking.make_options(
        {**given, "solver": solver, "paper": paper, "lifted_psi": lifted_psi, "time_limit": time_limit}
    )
    with named_by_file(terrain, robot, sequence, "--sequence"):
        scene, model, steps = walking.parts_of(terrain, robot, sequence)
        scene = scaled(scene, scale)
        planner = _planner(terrain, scene, model, steps, options)
    progress = None if json or quiet else Progress(verbose)
    interrupted = _interrupted(planner, cycles, progress)
    walk = planner.result()
    written = write_outputs(walk.plan, walk.report, Outputs(output, html, plots), drawn=not interrupted)
    if json:
        print(json_module.dumps(summary(walk, scene, model, options), allow_nan=False))
    else:
        files = written if interrupted else [path for path in (output, html, plots) if path is not None]
        print(summary_text(walk, scene.name, model.name, options, files, interrupted))
    if interrupted:
        return CODE
    return 0 if walk.success else 1


def _interrupted(planner: engine.RecedingHorizon, cycles: int, progress: Progress | None) -> bool:
    """Walk; whether Ctrl-C ended it."""
    from mcplan import walking

    try:
        for cycle in walking.cycles_of(planner, cycles):
            if progress is not None:
                progress.row(cycle)
    except KeyboardInterrupt:  # also between two cycles: what was walked until then is there
        return True
    return False


def summary(walk: engine.Walk, scene: Scene, robot: Robot, options: engine.Options) -> dict[str, Any]:
    """What ``--json`` prints."""
    from mcplan.cli.check import finite, violation_dict, warning_dict

    totals = ("distance_m", "acc_per_m", "momentum_per_m", "drift_com_m", "drift_momentum")
    worst = violation_dict(walk.report.worst_violation)
    return {
        "scene": scene.name,
        "robot": robot.name,
        "fidelity": options.fidelity.name,
        "lookahead": options.lookahead,
        "transcription": options.transcription.name,
        "success": walk.success,
        "status": str(walk.report.status),
        "message": walk.report.message,
        "cycles_done": sum(cycle.executed for cycle in walk.cycles),
        "time_s": walk.report.time_s,
        **{name: finite(getattr(walk, name)()) for name in totals},
        "worst_violation": {key: worst[key] for key in ("name", "phase", "time_s", "value", "tolerance", "unit")},
        "warnings": [warning_dict(warning) for warning in walk.report.warnings],
        "cycles": [cycle_dict(cycle) for cycle in walk.cycles],
        "version": walk.report.version,
    }


def cycle_dict(cycle: engine.Cycle) -> dict[str, Any]:
    """A cycle as plain data; of one that failed, what its step would have cost is null."""
    from mcplan.cli.check import finite

    solve = ("message", "executed", "iterations", "time_s", "evaluation_s", "linear_solver_s")
    sizes = ("variables", "constraints", "cost")
    step = ("duration_s", "distance_m", "acceleration_cost", "momentum_cost", "drift_com_m", "drift_momentum")
    data = {name: finite(getattr(cycle, name)) for name in (*solve, *sizes)}
    done = {name: finite(getattr(cycle, name)) if cycle.executed else None for name in step}
    names = {"solver": cycle.solver.name, "step_from": cycle.step_from.name}
    return {"index": cycle.index, "status": str(cycle.status), **names, **data, **done}


def _planner(
    terrain: str, scene: Scene, robot: Robot, steps: Plan | None, options: engine.Options
) -> engine.RecedingHorizon:
    """The planner; a scene without steps is told what to do instead."""
    from mcplan import walking
    from mcplan.errors import InvalidScene

    try:
        return walking.planner_of(scene, robot, steps, options)
    except InvalidScene as error:
        if error.field != "steps":
            raise
        instead = f"mcplan plan {terrain} -o plan.npz, then mcplan rhp {terrain} --sequence plan.npz"
        raise InvalidScene("steps", f"must be in the scene, or taken from a plan: {instead}") from None
