"""What is tracked by ``mcplan bench tracking``, and the demands on each run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any

from mcplan.planar.tracking import PLANNING

#: Limits for walks of humanoids [m].
COM_RMS_M, FINAL_BASE_M = 0.015, 0.05
#: Limits of planar robots: ratio of the rms of the contact forces' error to that of the forces; displacement of contact points
#: [m].
FORCE_RMS, DRIFT_M = 0.10, 0.01
#: Limits on one core: time of a control step [ms], simulated time with control over wall clock.
CONTROL_MS, REALTIME_FACTOR = 1.0, 1.5
#: Share of disturbed runs that have to stay upright.
SURVIVING = 0.9
#: Steps of the walk on level ground, at least.
FLAT_STEPS = 6

#: Factor on the built-in scenes, which have the size of a grown human, for Unitree's G1; on stairs, where its ankles are
#: at their limits.
G1_SCALE, G1_STAIRS_SCALE = 0.8, 0.65
#: Jumps of TALOS: shortest flight [s], and wider gaps than that of the scene [m] that are tried with nothing demanded. G1 finds
#: no jump: its reach boxes end 3 to 9 cm short of every take-off.
FLIGHT_S = 0.3
WIDER_GAPS_M = (0.35, 0.40, 0.45, 0.50)
#: How firmly plans keep to the pendulum there: landings and leaning on hands leave a controller less margin than walking.
FIRM_JUMP = {"force_line": 3.0, "momentum": 3.0}
FIRM_HANDS = {"force_line": 1.0, "momentum": 1.0, "center_of_pressure": 1.0}

CYCLES = 14


@dataclass(frozen=True)
class Demand:
    """Demands on a run, besides that it is planned and comes to its end. Infinite limits: no demand.

    Attributes:
        com_rms_m, final_base_error_m, qp_failures, simulator_warnings, force_rms, drift_m: Largest values.
        steps, flights: Least numbers in the plan.
        refusable: It is enough that the planner says that it finds no plan.
    """

    com_rms_m: float = inf
    final_base_error_m: float = inf
    qp_failures: float = inf
    simulator_warnings: float = inf
    force_rms: float = inf
    drift_m: float = inf
    steps: int = 0
    flights: int = 0
    refusable: bool = False


WALKS = Demand(COM_RMS_M, FINAL_BASE_M, qp_failures=0, simulator_warnings=0)
STAYS_UP = Demand()
JUMPS = Demand(flights=1)
FORCES_AS_PLANNED = Demand(force_rms=FORCE_RMS, drift_m=DRIFT_M, simulator_warnings=0)


@dataclass(frozen=True)
class Case:
    """A plan to make and to track.

    Attributes:
        name: Of the row.
        planner: ddp, rhp or sip.
        scene: Built-in scene or planar task.
        robot: That tracks the plan.
        demand: None: the run is reported and nothing is demanded of it.
        scale: Factor on the lengths of the scene.
        assist: Hold the base with a clipped wrench.
        planned_for: Robot that the plan is made for, if it is not the one that tracks it.
        clearances: Keep the feet of a planar task above the ground (``with_clearances``).
        strong_hands: Plan as if hands bore any force: what a plan then asks of arms is what their robot lacks.
        gap_m: Width of the gap between the surfaces `before` and `after`; 0: the scene's.
        planning: Options of the planner.
    """

    name: str
    planner: str
    scene: str
    robot: str
    demand: Demand | None
    scale: float = 1.0
    assist: bool = False
    planned_for: str = ""
    clearances: bool = False
    strong_hands: bool = False
    gap_m: float = 0.0
    planning: Mapping[str, Any] = field(default_factory=dict)


def _sequence(scene: str, robot: str, demand: Demand | None, scale: float = 1.0, assist: bool = False) -> Case:
    name = f"{scene}/{robot}" + ("/assisted" if assist else "")
    return Case(name, "ddp", scene, robot, demand, scale, assist)


def _jump(demand: Demand | None, assist: bool = False, gap_m: float = 0.0) -> Case:
    case = _sequence("short_gap", "talos", demand, assist=assist)
    name = f"{case.name}/{gap_m:.2f} m" if gap_m else case.name
    planning = {"flight_duration_min_s": FLIGHT_S, "weights": FIRM_JUMP, "joint_limits": False}
    return replace(case, name=name, gap_m=gap_m, planning=planning)


def _walk(scene: str, fidelity: str) -> Case:
    demand = replace(WALKS, refusable=fidelity == "com")
    planning = {"fidelity": fidelity, "cycles": CYCLES}
    return Case(f"{scene}/{fidelity}", "rhp", scene, "talos", demand, planned_for="talos_wang", planning=planning)


def _planar(task: str, robot: str, clearances: bool = False, **planning: Any) -> Case:
    options = {**PLANNING, **planning}
    return Case(task, "sip", task, robot, FORCES_AS_PLANNED, clearances=clearances, planning=options)


#: Shortest and longest phase of planar tasks of many steps [s].
PHASES_S = (0.3, 5.0)

CASES: tuple[Case, ...] = (
    *(
        _sequence(scene, robot, replace(WALKS, steps=FLAT_STEPS if scene == "flat" else 0), scale)
        for scene in ("flat", "ramp", "stairs_broad", "stepping_stones")
        for robot, scale in (("talos", 1.0), ("g1", G1_STAIRS_SCALE if scene == "stairs_broad" else G1_SCALE))
    ),
    _sequence("slope", "talos", None),
    *(
        _walk(scene, fidelity)
        for scene in ("up_and_down", "v_shape", "rubbles")
        for fidelity in ("single", "point", "com")
    ),
    _jump(JUMPS),
    _jump(JUMPS, assist=True),
    *(_jump(None, gap_m=width) for width in WIDER_GAPS_M),
    *(
        replace(
            _sequence("short_gap_with_rail", "talos", STAYS_UP if assist else None, assist=assist),
            strong_hands=True,
            planning={"weights": FIRM_HANDS, "joint_limits": False},
        )
        for assist in (True, False)
    ),
    _planar("cartwheel", "climber9"),
    _planar("climbing", "climber9", clearances=True, phase_duration_s=PHASES_S),
    _planar("walking", "walker9", phase_duration_s=PHASES_S),
)


def named(name: str) -> Case:
    """The case of this name in the full table."""
    return next(case for case in CASES if case.name == name)


#: For continuous integration: a walk of fewer cycles, and a planar motion for which nothing is minimised, found in seconds.
SHORT: tuple[Case, ...] = (
    named("flat/talos"),
    replace(named("rubbles/point"), planning={"fidelity": "point", "cycles": 5}),
    replace(named("walking"), planning={**PLANNING, "minimise": "none"}),
)

#: Plans that are tracked under disturbances.
#: Slopes of 13.5 degrees take 0.24 of a friction of 0.3: whoever has to do with 0.24 to 0.36 must not plan with all of it.
DISTURBED: tuple[Case, ...] = (
    named("flat/talos"),
    named("stairs_broad/talos"),
    replace(
        named("rubbles/single"),
        name="rubbles/single, 0.88 of the friction",
        planning={"fidelity": "single", "cycles": CYCLES, "friction_ratio": 0.88},
    ),
)
