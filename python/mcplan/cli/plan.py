"""mcplan plan"""

from __future__ import annotations

import json as json_module
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.cli.contacts_text import contact_rows
from mcplan.cli.given_options import named_as_typed
from mcplan.cli.live import LivePlanningOption

if TYPE_CHECKING:
    from mcplan._core import PlanResult, Scene
    from mcplan.cli.outputs import Outputs
    from mcplan.wb import PlannedMotion


SceneArgument = Annotated[str, typer.Argument(metavar="SCENE", help="Scene: built-in name or TOML file.")]
RobotOption = Annotated[str, typer.Option("--robot", metavar="R", help="Robot: built-in name or TOML file.")]
ScaleOption = Annotated[float, typer.Option("--scale", metavar="X", help="Factor on all lengths of the scene.")]
SoleInsideOption = Annotated[
    float | None,
    typer.Option(
        "--sole-inside",
        metavar="X",
        help="Fraction of each sole that stays within its surface, 2 at most; 1: all of it. Default: the robot's.",
    ),
]
MinFlightOption = Annotated[
    float | None, typer.Option("--min-flight", metavar="S", help="Minimum duration of a phase without contacts [s].")
]
NoFlightOption = Annotated[
    bool, typer.Option("--no-flight", help="Plan no phase without contacts, not even where steps do not lead.")
]
NoJointLimitsOption = Annotated[
    bool, typer.Option("--no-joint-limits", help="Plan as if the robot's legs had no joint limits.")
]
PhasesOption = Annotated[
    int | None,
    typer.Option("--phases", metavar="N", help="Number of phases; default: by the distance to the goal, at least 18."),
]
ModelOption = Annotated[
    str | None,
    typer.Option("--model", metavar="M", help="Model of contacts: wrench (default) or lipm, the paper's."),
]
MethodOption = Annotated[
    str | None, typer.Option("--method", metavar="M", help="Method of the search: standard (default) or paper.")
]
PolishOption = Annotated[
    str | None,
    typer.Option(
        "--polish",
        metavar="P",
        help="What finds the motion of a given contact sequence: interior_point (default) or penalty.",
    ),
]
TimeLimitOption = Annotated[
    float | None,
    typer.Option("--time-limit", metavar="S", help="Time [s] after which the best plan so far is returned."),
]
ThreadsOption = Annotated[
    int | None,
    typer.Option("--threads", metavar="N", help="Number of threads for pricing; the plan does not depend on it."),
]
SeedOption = Annotated[
    int | None, typer.Option("--seed", metavar="K", help="Seed of the random order in which restarts are tried.")
]
OutputOption = Annotated[
    Path | None, typer.Option("-o", "--output", metavar="FILE", help="File for the plan (.npz, .json).")
]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows the plan.")]
MotionOption = Annotated[
    Path | None,
    typer.Option(
        "--motion",
        metavar="FILE",
        help="Find joints and torques too, search again where the robot lacks something; file for the motion (.npz).",
    ),
]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
VerboseOption = Annotated[bool, typer.Option("-v", "--verbose", help="Print the table of iterations on stderr.")]


@named_as_typed(
    *("scale", "sole_inside", "phases", "model", "method", "polish", "time_limit", "threads", "seed"),
    time_limit_s="--time-limit",
    flight_duration_min_s="--min-flight",
)
def plan(
    scene: SceneArgument,
    robot: RobotOption = "humanoid44",
    scale: ScaleOption = 1.0,
    sole_inside: SoleInsideOption = None,
    min_flight: MinFlightOption = None,
    no_flight: NoFlightOption = False,
    no_joint_limits: NoJointLimitsOption = False,
    phases: PhasesOption = None,
    model: ModelOption = None,
    method: MethodOption = None,
    polish: PolishOption = None,
    time_limit: TimeLimitOption = None,
    threads: ThreadsOption = None,
    seed: SeedOption = None,
    output: OutputOption = None,
    motion: MotionOption = None,
    html: HtmlOption = None,
    plots: PlotsOption = None,
    live: LivePlanningOption = False,
    json: JsonOption = False,
    verbose: VerboseOption = False,
) -> int:
    """Plan a contact sequence and a motion through a scene.

    The exit code is 0 only if the plan is solved (and its motion, with --motion), 1 otherwise. Ctrl-C ends the search: the
    best plan so far is saved (-o), nothing is drawn, and the exit code is 130.

    Example: mcplan plan stepping_stones --robot g1 --scale 0.8 -o plan.npz --html plan.html
    """
    from mcplan.arguments import named_by_file
    from mcplan.cli.interrupts import CODE
    from mcplan.cli.outputs import Outputs, require_outputs
    from mcplan.cli.terminal import printable
    from mcplan.errors import InvalidInput
    from mcplan.files.outputs import ARCHIVE, require_target

    require_target("--motion", motion, ARCHIVE)
    require_outputs("plan", output, html, plots)
    if no_flight and min_flight is not None:
        raise InvalidInput("--min-flight", "must not be given with --no-flight, which plans none", f"{min_flight:g}")
    given: dict[str, Any] = {"phases": phases, "method": method, "time_limit": time_limit, "threads": threads}
    given |= {"seed": seed, "model": model, "polish": polish}
    given |= {"sole_inside": sole_inside, "flight_duration_min_s": min_flight}
    given |= {"allow_flight": False if no_flight else None, "joint_limits": False if no_joint_limits else None}
    given |= {"record_history": None if plots is None else True, "motion": None if motion is None else True}
    options: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if verbose:
        options["logger"] = lambda level, line: print(printable(line), file=sys.stderr)

    import mcplan
    from mcplan.files.scenes import scaled

    ground = scene if scale == 1.0 else scaled(mcplan.load_scene(scene), scale)
    with named_by_file(scene, robot):
        result, interrupted = _search(ground, robot, options, live)
    _tell(result, Outputs(output, html, plots), motion, json, interrupted)
    if interrupted:
        return CODE
    return 0 if (str(result.report.status) == "solved" if motion is None else result.solved) else 1


def _search(ground: str | Scene, robot: str, options: dict[str, Any], live: bool) -> tuple[Any, bool]:
    """What was found, and whether Ctrl-C ended it."""
    import mcplan
    from mcplan.cli.interrupts import as_far_as_it_came
    from mcplan.cli.live import watching_search

    with watching_search(live, ground, robot) as view:
        watched = options if view is None else {**options, "watch": view}
        result, interrupted = as_far_as_it_came(lambda: mcplan.plan(ground, robot, **watched))
        if view is not None and not interrupted:
            view.show(result.plan)
    return result, interrupted


def _tell(result: Any, outputs: Outputs, motion: Path | None, json: bool, interrupted: bool) -> None:
    """Write what was asked for, and print what was found."""
    from mcplan.cli.outputs import write_outputs
    from mcplan.cli.terminal import say

    written = write_outputs(result.plan, result.report, outputs, drawn=not interrupted)
    if motion is not None and result.motion is not None:
        result.motion.save(motion)
        written.append(motion)
    print(json_module.dumps(summary(result)) if json else report_text(result, written))
    asked = [path for path in (outputs.output, outputs.html, outputs.plots, motion) if path is not None]
    if asked and not written and not (json or interrupted):
        say(f"Not written, since there is no plan: {', '.join(map(str, asked))}")


def summary(result: PlanResult | PlannedMotion) -> dict[str, Any]:
    """What ``--json`` prints."""
    from mcplan.cli.check import finite, violation_dict, warning_dict
    from mcplan.cli.loads_text import load_dict

    plan, report = result.plan, result.report
    names = [surface.name for surface in plan.scene.surfaces]
    sequence = plan.contact_sequence()
    worst = violation_dict(report.worst_violation)
    return {
        "scene": plan.scene.name,
        "robot": plan.robot.name,
        "status": str(report.status),
        "message": report.message,
        "cost": finite(report.cost),
        "cost_terms": {name: finite(value) for name, value in report.cost_terms.items()},
        "iterations": report.iterations,
        "time_s": report.time_s,
        "iteration_ms": 1e3 * report.time_s / max(report.iterations, 1),
        "switches": report.switches,
        "phases": len(plan.phases),
        "end_effectors": [end.name for end in plan.robot.end_effectors],
        "contact_sequence": [[names[i] if i >= 0 else None for i in row] for row in sequence],
        "durations_s": [phase.duration for phase in plan.phases],
        "final_contacts": [names[i] if i >= 0 else None for i in plan.final_contacts],
        "flight_phases": flight_phases(sequence),
        "friction_use": {name: finite(value) for name, value in report.friction_use.items()},
        **load_dict(plan),
        "worst_violation": {
            key: worst[key] for key in ("name", "phase", "end_effector", "time_s", "value", "tolerance", "unit")
        },
        "warnings": [warning_dict(warning) for warning in report.warnings],
        "paper_cost": finite(report.paper_cost) if report.paper_verdict else None,
        "paper_verdict": report.paper_verdict or None,
        "seed": report.seed,
        "threads": report.threads,
        "parallel_loops": report.parallel_loops,
        "version": report.version,
        **_motion_dict(result),
    }


def _motion_dict(result: PlanResult | PlannedMotion) -> dict[str, Any]:
    """The motion and the rounds of ``--motion``; nothing without it."""
    rounds = getattr(result, "rounds", None)
    if rounds is None:
        return {}
    from mcplan.cli.motion_text import summary as motion_summary

    found = getattr(result, "motion_result", None)
    return {"motion": found and motion_summary(found), "rounds": [str(one) for one in rounds]}


def _motion_lines(result: PlanResult | PlannedMotion) -> list[str]:
    """The motion and the rounds of ``--motion``, in lines; none without it."""
    rounds = getattr(result, "rounds", None)
    if rounds is None:
        return []
    from mcplan.cli.motion_text import report_lines

    lines = [f"round {number}: {one}" for number, one in enumerate(rounds, 1)] if len(rounds) > 1 else []
    found = getattr(result, "motion_result", None)
    return [*lines, *(report_lines(found) if found is not None else [])]


def flight_phases(sequence: list[list[int]]) -> int:
    """Phases in which nothing is in contact."""
    return sum(all(surface < 0 for surface in row) for row in sequence)


def report_text(result: PlanResult | PlannedMotion, written: list[Path]) -> str:
    """What is printed without ``--json``: how it ended, the steps, what was saved."""
    from mcplan.cli.check import warning_lines
    from mcplan.cli.loads_text import friction_lines, load_lines
    from mcplan.cli.terminal import printable

    plan, report = result.plan, result.report
    lead = f"{plan.scene.name}  {plan.robot.name}  "
    took = f"{report.time_s:.3f} s ({report.iterations} iterations)"
    solved = str(report.status) == "solved"
    if solved:
        flights = flight_phases(plan.contact_sequence())
        flight = "no flight" if flights == 0 else f"{flights} flight phase{'s' if flights > 1 else ''}"
        lines = [f"{lead}solved in {took}: {len(plan.phases)} phases, {plan.duration():.2f} s long, {flight}"]
    else:
        lines = [f"{lead}{report.status} after {took}: {report.message or 'no plan that the checker accepts'}"]
    worst = str(report.worst_violation)
    # The message of a plan that is not solved tells the worst violation already; without a plan there is none.
    if plan.phases and report.worst_violation.name and worst not in report.message:
        label = "closest to its limit" if solved else "worst"
        lines.append(f"{' ' * len(lead)}{label}: {worst}")
    if report.paper_verdict and solved:  # else the message tells it
        lines.append(f"{' ' * len(lead)}the published algorithm: {report.paper_verdict}; cost {report.paper_cost:.3g}")
    lines += warning_lines(report.warnings)
    lines += contact_rows(plan)
    if report.friction_use:
        lines += friction_lines(report.friction_use)
    lines += load_lines(plan)
    lines += _motion_lines(result)
    if written:
        lines.append(f"Saved {', '.join(map(str, written))}" + ("" if solved else f", with status {report.status}"))
    return "\n".join(printable(line) for line in lines)
