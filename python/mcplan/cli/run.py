"""mcplan run"""

from __future__ import annotations

import json as json_module
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

import typer

from mcplan.cli import track
from mcplan.cli.given_options import named_as_typed
from mcplan.cli.live import LiveOption, watching

if TYPE_CHECKING:
    from mcplan._core import Plan
    from mcplan.cli.track_outputs import RunOutputs
    from mcplan.cli.track_text import Progress
    from mcplan.online.result import RunResult
    from mcplan.online.steering import Steer


class Telling(NamedTuple):
    """What of a run is told while and after it, and whether keys steer it."""

    json: bool
    quiet: bool
    live: bool
    steer: bool


SceneArgument = Annotated[
    str, typer.Argument(metavar="SCENE", help="Scene: built-in name or TOML file; or a plan to begin with (.npz).")
]
RobotOption = Annotated[
    str | None, typer.Option("--robot", metavar="R", help="Robot with a URDF: built-in name or TOML file.")
]
EngineOption = Annotated[
    str,
    typer.Option(
        "--engine", metavar="E", help="ddp, free in its steps, or rhp: at touchdowns, surfaces and order of feet given."
    ),
]
CommandOption = Annotated[
    list[str] | None,
    typer.Option(
        "--command",
        metavar="[at,]ahead,left,turn",
        help="Velocity to walk at [m/s, m/s, rad/s], from an instant on [s]; may be repeated. Default: to the scene's goal.",
    ),
]
GoalOption = Annotated[
    list[str] | None,
    typer.Option(
        "--goal",
        metavar="x,y[,yaw[,at]]",
        help="Goal instead of the scene's [m, m, rad], from an instant on [s]; may be repeated.",
    ),
]
LatencyOption = Annotated[
    float | None,
    typer.Option(
        "--latency",
        metavar="S",
        help="Time from a measured state to its plan [s]; default: what the computation takes.",
    ),
]
PeriodOption = Annotated[float, typer.Option("--period", metavar="S", help="Time between two replans [s].")]
DurationOption = Annotated[
    float | None, typer.Option("--duration", metavar="S", help="Length of the run [s]; default: to the goal.")
]
TrueSceneOption = Annotated[
    str | None,
    typer.Option(
        "--true-scene",
        metavar="SCENE",
        help="Ground that is simulated where it is not as planned: its surfaces by name, moved, slippery, or left out.",
    ),
]
ToldAtOption = Annotated[
    float | None,
    typer.Option(
        "--told-at", metavar="S", help="Time from which on the planner knows the true scene [s]; default: never."
    ),
]
KeepOption = Annotated[
    float | None,
    typer.Option(
        "--keep", metavar="S", help="Length of what is recorded, the end of the run [s]; default: all. For long runs."
    ),
]
SteerOption = Annotated[
    bool, typer.Option("--steer", help="Walk as the keys of the terminal say, which it names; at real time at most.")
]
QuietOption = Annotated[
    bool,
    typer.Option("-q", "--quiet", help="Print no progress on stderr, nor that another robot cannot follow the plan."),
]
ReplanningOption = Annotated[
    bool, typer.Option("--replanning/--no-replanning", help="Replan while walking; off: follow the first plan.")
]


@named_as_typed(
    "robot",
    "engine",
    "command",
    "goal",
    "mass_scale",
    "sensor_noise",
    "seed",
    pushes="--push",
    latency_s="--latency",
    period_s="--period",
    duration_s="--duration",
    told_at_s="--told-at",
    keep_s="--keep",
    true_scene="--true-scene",
    replanning="--replanning",
    friction_scale="--friction",
    ground_shift_m="--ground-shift",
    torque_bandwidth_hz="--torque-bandwidth",
    torque_delay_s="--torque-delay",
    **{"pushes.at_s": "--push: at"},
)
def run(
    scene: SceneArgument,
    robot: RobotOption = None,
    engine: EngineOption = "ddp",
    push: track.PushOption = None,
    command: CommandOption = None,
    goal: GoalOption = None,
    latency: LatencyOption = None,
    period: PeriodOption = 0.1,
    duration: DurationOption = None,
    replanning: ReplanningOption = True,
    true_scene: TrueSceneOption = None,
    told_at: ToldAtOption = None,
    keep: KeepOption = None,
    mass_scale: track.MassScaleOption = 1.0,
    friction: track.FrictionOption = 1.0,
    ground_shift: track.GroundShiftOption = 0.0,
    torque_bandwidth: track.BandwidthOption = 0.0,
    torque_delay: track.DelayOption = 0.0,
    sensor_noise: track.NoiseOption = 0.0,
    seed: track.SeedOption = 0,
    live: LiveOption = False,
    steer: SteerOption = False,
    video: track.VideoOption = None,
    html: track.HtmlOption = None,
    strip: track.StripOption = None,
    plots: track.PlotsOption = None,
    save: track.SaveOption = None,
    json: track.JsonOption = False,
    quiet: QuietOption = False,
) -> int:
    """Simulate a robot that is planned for while it walks.

    A plan leads to the scene's goal, or on at a velocity (--command). While the robot follows it, a planner makes the next
    one from the measured state: every --period, at touchdowns, and when the robot has left the plan, as after a push. The
    simulated clock goes on while the planner computes; with --latency the same run is the same on every machine. The exit
    code is 0 if the robot came to its goal or through --duration without a fall, 1 if not. Ctrl-C ends the run, the code is 130.

    Example: mcplan run flat --robot talos --push 250,0.2,1.4,90 --latency 0.02 --html run.html

    Example: mcplan run flat --robot talos --command 0.15,0,0.1 --duration 8 --json

    Example: mcplan run flat --robot talos --live --steer

    Example: mcplan run stairs_up --robot talos --engine rhp --latency 0.1
    """
    from mcplan.cli.pushes import parse_pushes
    from mcplan.cli.track_outputs import RunOutputs

    values: dict[str, Any] = {"pushes": parse_pushes(push or []), "seed": seed, "replanning": replanning}
    values |= {"mass_scale": mass_scale, "friction_scale": friction, "ground_shift_m": ground_shift}
    values |= {"torque_bandwidth_hz": torque_bandwidth, "torque_delay_s": torque_delay, "sensor_noise": sensor_noise}
    values |= {"latency_s": latency, "period_s": period, "duration_s": duration, "told_at_s": told_at, "keep_s": keep}
    values["engine"] = engine
    values["command"] = [_numbers(text) for text in command or []]
    values["goal"] = [_numbers(text, "--goal", (2, 3, 4), "x,y[,yaw[,at]], such as 1.5,0.3") for text in goal or []]
    outputs = RunOutputs(video, html, strip, plots, save, verb="run")
    return _run((scene, robot, true_scene), values, outputs, Telling(json, quiet, live, steer))


def _run(
    walk: tuple[str, str | None, str | None], values: dict[str, Any], outputs: RunOutputs, telling: Telling
) -> int:
    """Scene, robot and true scene, options by name, and what is to be written; the exit code."""
    from dataclasses import replace

    from mcplan.cli.interrupts import CODE, as_far_as_it_came
    from mcplan.cli.keyboard import require_terminal
    from mcplan.cli.terminal import printable
    from mcplan.cli.track_text import Progress
    from mcplan.extras import require
    from mcplan.online.steering import Beside, require_undecided
    from mcplan.running import chosen_options, first_plan, names_plan, run_any

    if telling.steer:
        require_terminal(sys.stdin)
    require("mcplan run", "sim", "mujoco", "pinocchio", "proxsuite")
    outputs.require()
    _, online = chosen_options(values)
    if telling.steer:
        require_undecided(online)
    progress = Progress(telling.quiet or telling.json)
    progress.working("planning")
    scene, robot, true_scene = walk
    try:
        plan = first_plan(scene, robot, online, in_pieces=true_scene is not None)
    finally:
        progress.end()
    if robot is not None and names_plan(scene) and not (telling.quiet or telling.json):
        _warn_of_another(plan, robot)
    with watching(telling.live, plan, None) as watch, _steering(telling, plan, progress) as (steer, simulated):
        beside = Beside(simulated, watch, steer)
        result, interrupted = as_far_as_it_came(lambda: run_any(plan, robot, values, beside, true_scene))
    progress.end()
    begun_with = Path(scene) if names_plan(scene) else None
    print(json_module.dumps(summary(result, begun_with), allow_nan=False) if telling.json else result, flush=True)
    written = (replace(outputs, video=None, html=None, strip=None, plots=None) if interrupted else outputs).write(
        result, progress
    )
    if written and not telling.json:
        print(printable(f"Saved {', '.join(written)}"))
    return CODE if interrupted else 0 if result.followed else 1


def _warn_of_another(plan: Plan, robot: str) -> None:
    """Warn where the robot that is named cannot follow the plan, which may be that of another one."""
    from mcplan.cli.terminal import printable
    from mcplan.tracking.feasibility import assess
    from mcplan.tracking.runner import robot_for

    found = assess(plan, robot_for(plan, robot))
    if not found.ok():
        print(printable(f"warning: {found.verdict}"), file=sys.stderr)


@contextmanager
def _steering(
    telling: Telling, plan: Plan, progress: Progress
) -> Iterator[tuple[Steer | None, Callable[[float, float], None]]]:
    """Who steers, and who is told how far the run is."""
    if not telling.steer:
        yield None, progress.simulated
        return
    from mcplan.cli.keyboard import KEYS, Keyboard

    with Keyboard(plan.robot.com_height, plan.robot.mass) as keyboard:
        print(KEYS, file=sys.stderr, flush=True)
        yield keyboard, lambda now_s, _: progress.working(f"{now_s:.1f} s: {keyboard}")


def summary(result: RunResult, plan: Path | None = None) -> dict[str, Any]:
    """What ``--json`` prints: the keys of ``mcplan track --json``, and those of replanning; `plan`: what it began with."""
    from dataclasses import asdict

    from mcplan.cli.track_text import finite_items
    from mcplan.cli.track_text import summary as track_summary

    data = track_summary(result, plan, None)
    last = result.plans[-1]
    data["duration_s"] = last.begins_s + last.plan.duration()
    return {
        **data,
        **finite_items(result.online.as_dict()),
        "command_reached": [asdict(each) for each in result.command_reached],
        "online_options": finite_items(asdict(result.online_options)),
    }


def _numbers(
    text: str,
    option: str = "--command",
    counts: tuple[int, ...] = (3, 4),
    form: str = "[at,]ahead,left,turn, such as 0.15,0,0.1",
) -> tuple[float, ...]:
    """Numbers of --command or --goal.

    Raises:
        InvalidOptions: Not so many numbers, or one that is not finite.
    """
    import math

    from mcplan.errors import InvalidOptions, shown

    words = text.split(",")
    try:
        numbers = tuple(float(word) for word in words)
    except ValueError:
        numbers = ()
    if len(numbers) not in counts or not all(map(math.isfinite, numbers)):
        raise InvalidOptions(option, f"must be {form}", shown(text))
    return numbers
