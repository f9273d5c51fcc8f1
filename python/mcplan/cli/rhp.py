"""mcplan rhp"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from mcplan import rhp as engine
    from mcplan._core import Plan, Robot, Scene


TerrainArgument = Annotated[str, typer.Argument(metavar="TERRAIN", help="Built-in scene or TOML file.")]
RobotOption = Annotated[
    str | None,
    typer.Option("--robot", metavar="R", help="Default: the sequence's robot, else talos_wang."),
]
FidelityOption = Annotated[
    str,
    typer.Option("--fidelity", metavar="F", help="Model of predicted steps: single, com, rectangle or point."),
]
LookaheadOption = Annotated[
    int, typer.Option("--lookahead", metavar="N", help="Steps in a horizon, the executed one included.")
]
ScaleOption = Annotated[float, typer.Option("--scale", metavar="X", help="Factor on all lengths of the terrain.")]
CyclesOption = Annotated[int, typer.Option("--cycles", metavar="N", help="Steps to execute.")]
TranscriptionOption = Annotated[str, typer.Option("--transcription", metavar="T", help="trapezoidal or euler.")]
PaperOption = Annotated[bool, typer.Option("--paper", help="CoM box and friction pyramid as published.")]
LiftedPsiOption = Annotated[bool, typer.Option("--lifted-psi", help="Keep the relaxation's bounds as variables.")]
SequenceOption = Annotated[
    Path | None,
    typer.Option("--sequence", metavar="PLAN", help="Take start and contact sequence of a plan (.npz, .json)."),
]
TimeLimitOption = Annotated[
    float | None, typer.Option("--time-limit", metavar="S", help="Longest time of each cycle; none by default.")
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="Save the plan (.npz, .json).")
]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="FILE", help="Draw the plan on a page.")]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Write plots into a folder.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
VerboseOption = Annotated[
    bool, typer.Option("-v", "--verbose", help="Print sizes, drift and where the time goes, too.")
]
QuietOption = Annotated[bool, typer.Option("-q", "--quiet", help="No line per cycle (to stderr) on the way.")]


def rhp(
    terrain: TerrainArgument,
    robot: RobotOption = None,
    fidelity: FidelityOption = "point",
    lookahead: LookaheadOption = 3,
    scale: ScaleOption = 1.0,
    cycles: CyclesOption = 14,
    transcription: TranscriptionOption = "trapezoidal",
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
    """Walk over given surfaces, planning a few steps ahead and executing one, again and again.

    Exit code 0 if every cycle found a step within its constraints, 1 otherwise; what was found is saved either way.
    Ctrl-C ends the walk: what was walked is saved (-o), nothing is drawn, and the exit code is 130.

    Example: mcplan rhp rubbles --fidelity point --lookahead 3 -o walk.npz --html walk.html
    """
    from mcplan import walking
    from mcplan.cli.interrupts import CODE
    from mcplan.cli.outputs import require_outputs, write_outputs
    from mcplan.cli.rhp_text import Progress, summary_text
    from mcplan.files.scenes import scaled

    require_outputs("rhp", output, html, plots)
    given = {"fidelity": fidelity, "lookahead": lookahead, "cycles": cycles, "transcription": transcription}
    options = walking.make_options({**given, "paper": paper, "lifted_psi": lifted_psi, "time_limit": time_limit})
    scene, model, steps = walking.parts_of(terrain, robot, sequence)
    scene = scaled(scene, scale)
    planner = _planner(terrain, scene, model, steps, options)
    progress = None if json or quiet else Progress(verbose)
    interrupted = False
    try:
        for cycle in walking.cycles_of(planner, cycles):
            if progress is not None:
                progress.row(cycle)
    except KeyboardInterrupt:  # also between two cycles: what was walked until then is there
        interrupted = True
    walk = planner.result()
    written = write_outputs(walk.plan, walk.report, output, html, plots, drawn=not interrupted)
    if json:
        print(json_module.dumps(summary(walk, scene, model, options), allow_nan=False))
    else:
        files = written if interrupted else [path for path in (output, html, plots) if path is not None]
        print(summary_text(walk, scene.name, model.name, options, files, interrupted))
    if interrupted:
        return CODE
    return 0 if walk.success else 1


def summary(walk: engine.Walk, scene: Scene, robot: Robot, options: engine.Options) -> dict[str, Any]:
    """What ``--json`` prints."""
    from mcplan.cli.check import finite, violation_dict

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
    return {"index": cycle.index, "status": str(cycle.status), **data, **done}


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
        raise InvalidScene("steps", f"scene {scene.name} has none; take them from a plan: {instead}") from None
