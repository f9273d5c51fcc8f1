"""mcplan track"""

from __future__ import annotations

import json as json_module
import sys
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.cli.given_options import named_as_typed
from mcplan.cli.live import LiveOption, watching

if TYPE_CHECKING:
    from mcplan._core import Plan, PlanarPlan, Robot
    from mcplan.planar.tracking import Suitability
    from mcplan.tracking.findings import Feasibility
    from mcplan.tracking.options import Watch
    from mcplan.wb import Motion, MotionCheckResult


PlanArgument = Annotated[
    Path, typer.Argument(metavar="PLAN", help="File written by mcplan plan, rhp, sip or motion -o.")
]
RobotOption = Annotated[
    str | None,
    typer.Option("--robot", metavar="R", help="Robot with a URDF; default: the plan's own."),
]
AssistOption = Annotated[
    bool, typer.Option("--assist", help="Assist the base with a bounded wrench, which is reported.")
]
PushOption = Annotated[
    list[str] | None,
    typer.Option(
        "--push",
        metavar="newtons,seconds,at,direction",
        help="Push of the base: force [N], duration [s], instant [s], direction [deg] (0 forward, 90 left); may be repeated.",
    ),
]
MassScaleOption = Annotated[float, typer.Option("--mass-scale", metavar="X", help="Factor on all masses and inertias.")]
FrictionOption = Annotated[float, typer.Option("--friction", metavar="X", help="Factor on all friction coefficients.")]
GroundShiftOption = Annotated[
    float, typer.Option("--ground-shift", metavar="M", help="Height of the ground above the planned one [m].")
]
SeedOption = Annotated[
    int,
    typer.Option(
        "--seed",
        metavar="K",
        help="Seed of random changes of mass, friction, ground, motors and sensors and of a random push; 0: none.",
    ),
]
SpeedLimitsOption = Annotated[
    bool,
    typer.Option(
        "--speed-limits/--no-speed-limits",
        help="Motors lose torque towards the URDF's velocity limits; off: full torque at every speed.",
    ),
]
SelfContactsOption = Annotated[
    bool,
    typer.Option(
        "--self-contacts/--no-self-contacts",
        help="Links make contact with each other and the terrain; off: only end-effectors do, with the terrain.",
    ),
]
BandwidthOption = Annotated[
    float, typer.Option("--torque-bandwidth", metavar="HZ", help="Bandwidth of the motors' torques [Hz]; 0: no limit.")
]
DelayOption = Annotated[
    float, typer.Option("--torque-delay", metavar="S", help="Time from the measured state to its torques [s].")
]
NoiseOption = Annotated[
    float, typer.Option("--sensor-noise", metavar="X", help="Noise of the measured state, over that of usual sensors.")
]
CheckOption = Annotated[
    bool,
    typer.Option(
        "--check/--no-check",
        help="Warn before the run if the robot cannot follow the plan, or a motion is not certified.",
    ),
]
VideoOption = Annotated[
    Path | None, typer.Option("--video", metavar="FILE", help="File for a video of the run (.mp4, .webp, .gif).")
]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="FILE", help="File for a page that shows the run.")]
StripOption = Annotated[
    Path | None, typer.Option("--strip", metavar="FILE", help="File for snapshots side by side (.png).")
]
PlotsOption = Annotated[Path | None, typer.Option("--plots", metavar="DIR", help="Folder for plots.")]
SaveOption = Annotated[Path | None, typer.Option("--save", metavar="FILE", help="File for the run (.npz).")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
QuietOption = Annotated[
    bool, typer.Option("-q", "--quiet", help="Print no progress on stderr, nor the warning of --check.")
]


@named_as_typed(
    "robot",
    "assist",
    "mass_scale",
    "sensor_noise",
    "seed",
    pushes="--push",
    friction_scale="--friction",
    ground_shift_m="--ground-shift",
    torque_bandwidth_hz="--torque-bandwidth",
    torque_delay_s="--torque-delay",
)
def track(
    plan: PlanArgument,
    robot: RobotOption = None,
    assist: AssistOption = False,
    push: PushOption = None,
    mass_scale: MassScaleOption = 1.0,
    friction: FrictionOption = 1.0,
    ground_shift: GroundShiftOption = 0.0,
    speed_limits: SpeedLimitsOption = True,
    self_contacts: SelfContactsOption = True,
    torque_bandwidth: BandwidthOption = 0.0,
    torque_delay: DelayOption = 0.0,
    sensor_noise: NoiseOption = 0.0,
    seed: SeedOption = 0,
    check: CheckOption = True,
    live: LiveOption = False,
    video: VideoOption = None,
    html: HtmlOption = None,
    strip: StripOption = None,
    plots: PlotsOption = None,
    save: SaveOption = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> int:
    """Simulate a robot that follows a plan or motion.

    Its joint torques alone drive it, and errors are measured. The controller does not know of changed mass, friction and
    ground, pushes, lags and noise. Whole-body plans are followed by their planar robots, without the latter three and seeds;
    of a motion all joints are followed. The exit code is 0 if the robot came to the end, 1 if it fell, left the plan, or
    followed a whole-body plan by contact forces that are over a quarter off. Ctrl-C ends the run: what was simulated is
    saved (--save), nothing is drawn, the code is 130.

    Example: mcplan plan flat --robot talos --sole-inside 0.9 -o plan.npz

    Example: mcplan track plan.npz --video run.mp4 --push 40,0.2,3,90 --mass-scale 1.1 --json
    """
    from mcplan.cli.interrupts import CODE, as_far_as_it_came
    from mcplan.cli.pushes import parse_pushes
    from mcplan.cli.terminal import printable
    from mcplan.cli.track_outputs import RunOutputs
    from mcplan.cli.track_text import Progress, summary
    from mcplan.extras import require
    from mcplan.following import track_any

    require("mcplan track", "sim", "mujoco", "pinocchio", "proxsuite")
    (outputs := RunOutputs(video, html, strip, plots, save)).require(plan)
    values: dict[str, Any] = {"assist": assist, "pushes": parse_pushes(push or []), "seed": seed}
    values |= {"mass_scale": mass_scale, "friction_scale": friction, "ground_shift_m": ground_shift}
    values |= {"speed_limits": speed_limits, "self_contacts": self_contacts, "sensor_noise": sensor_noise}
    values |= {"torque_bandwidth_hz": torque_bandwidth, "torque_delay_s": torque_delay}
    chosen, own_robot = _chosen(plan, robot, values)
    feasibility = _feasibility(chosen, own_robot, quiet or json) if check else None
    progress = Progress(quiet or json)
    with _watching(live, chosen, own_robot) as watch:
        result, interrupted = as_far_as_it_came(lambda: track_any(chosen, own_robot, values, progress.simulated, watch))
    progress.end()
    print(json_module.dumps(summary(result, plan, feasibility), allow_nan=False) if json else result, flush=True)
    if (written := (RunOutputs(save=save) if interrupted else outputs).write(result, progress)) and not json:
        print(printable(f"Saved {', '.join(written)}"))
    return CODE if interrupted else 0 if result.followed else 1


def _chosen(plan: Path, robot: str | None, values: dict[str, Any]) -> tuple[Plan | PlanarPlan | Motion, Robot | None]:
    """The plan or motion and the robot, if one is named.

    Raises:
        InvalidInput, InvalidOptions: An option out of range, or one that does not go with the plan.
    """
    from mcplan._core import PlanarPlan
    from mcplan.cli.pushes import require_within
    from mcplan.files.robots import load_robot
    from mcplan.tracking.choice import make_options
    from mcplan.wb.loading import load_any

    options = make_options(values)
    chosen = load_any(plan)
    require_within(values["pushes"], chosen.duration() + options.hold_s)
    if isinstance(chosen, PlanarPlan):
        _require_planar(robot, values)
    return chosen, None if robot is None else load_robot(robot)


def _watching(
    live: bool, plan: Plan | PlanarPlan | Motion, robot: Robot | None
) -> AbstractContextManager[Watch | None]:
    from mcplan._core import Plan, PlanarPlan
    from mcplan.errors import InvalidInput

    if isinstance(plan, PlanarPlan):
        if live:
            raise InvalidInput(
                "--live", "needs a plan of mcplan plan or rhp, or a motion: planar robots are not shown so"
            )
        return nullcontext()
    return watching(live, plan if isinstance(plan, Plan) else plan.plan, robot)


def _feasibility(
    plan: Plan | PlanarPlan | Motion, robot: Robot | None, silent: bool
) -> Feasibility | Suitability | MotionCheckResult:
    """What is known of a plan and a robot before simulating them; a warning where the one cannot follow the other."""
    from mcplan._core import Plan, PlanarPlan
    from mcplan.cli.terminal import printable
    from mcplan.planar.tracking.suitability import suitability
    from mcplan.tracking.feasibility import assess
    from mcplan.tracking.runner import robot_for

    found: Feasibility | Suitability | MotionCheckResult
    if isinstance(plan, Plan):
        found = assess(plan, robot_for(plan, robot))
    else:
        found = suitability(plan) if isinstance(plan, PlanarPlan) else plan.check()
    if not (found.ok() or silent):
        print(printable(f"warning: {found.verdict}"), file=sys.stderr)
    return found


def _require_planar(robot: str | None, values: dict[str, Any]) -> None:
    """Raises InvalidInput for what planar robots have not."""
    from mcplan.errors import InvalidInput

    given = {"--robot": robot is not None, "--assist": values["assist"], "--push": bool(values["pushes"])}
    given |= {"--torque-bandwidth": values["torque_bandwidth_hz"] != 0, "--torque-delay": values["torque_delay_s"] != 0}
    given |= {"--sensor-noise": values["sensor_noise"] != 0, "--seed": values["seed"] != 0}
    for option, present in given.items():
        if present:
            raise InvalidInput(
                option,
                "needs a plan of mcplan plan or mcplan rhp; whole-body plans are tracked without, by their own robot",
            )
