"""What ``mcplan bench contacts`` plans, and the demands on each plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any

#: Coefficient of all surfaces, pads included, on the paper's four scenes.
FRICTION = 0.7
#: Limits of every plan on them: lengths [m], angular momentum [N m s], stiffness of swinging end-effectors in g / com_height.
TANGENT, PRESSURE_M, SLIP_M, REACH_M, SWING_STIFFNESS, MOMENTUM_NMS = 0.70, 1e-3, 2e-4, 5e-3, 5e-4, 10.0
#: Largest force of a hand over the weight; mean vertical force per hand of the hands-only phase, and how far off it may be.
HAND_PEAK, HAND_MEAN, HAND_MEAN_OFF = 0.75, 0.5, 0.05
#: Integrated plan against its knots.
COM_REPLAY_M, MOMENTUM_REPLAY_NMS, ORIENTATION_DEG = 1e-9, 1e-9, 1.0
#: The hands must be found in so many settings, and the best of these plans cost so little.
RAIL_GOOD, RAIL_COST = 14, 0.25
#: Time of an iteration: over that of the paper's model, and [ms].
RATIO, ITERATION_MS = 1.6, 3.0
#: Ratio of the largest force of an arm of Talos to the weight of the robot.
TALOS_HAND = 0.15
#: A weight on the offsets of the lines of force that leaves none: the paper's forces through the CoM.
NO_OFFSET = 1e4


@dataclass(frozen=True)
class Demand:
    """Demands on a plan. Infinite limits and None: no demand.

    Attributes:
        solved: It must be, or (False) must not be.
        cost: Largest J, see ``comparable_cost``.
        tangent: Largest tangential over normal force, by tangent.
        pressure_m: The centre of pressure beyond the sole and beyond the surface.
        slip_m, reach_m, swing_stiffness, momentum_Nms: Largest values, see ContactMeasures.
        hand_peak: Largest force of a hand over the weight.
        hand_mean_off: How far the mean vertical force of a hand may be from half the weight while both hands support all of
            it, as a ratio to half the weight.
        com_replay_m, momentum_replay_Nms, orientation_deg: Largest differences between knots and replay.
        flights: Exact number.
        alternate: Whether feet have to alternate.
        every_surface: A foot on each.
        hands_only: There must be a phase on hands alone, or (False) no plan that is called solved or acceptable may
            have one.
    """

    solved: bool | None = True
    cost: float = inf
    tangent: float = inf
    pressure_m: float = inf
    slip_m: float = inf
    reach_m: float = inf
    swing_stiffness: float = inf
    momentum_Nms: float = inf
    hand_peak: float = inf
    hand_mean_off: float = inf
    com_replay_m: float = inf
    momentum_replay_Nms: float = inf
    orientation_deg: float = inf
    flights: int | None = None
    alternate: bool = False
    every_surface: bool = False
    hands_only: bool | None = None


REPLAYED = Demand(com_replay_m=COM_REPLAY_M, momentum_replay_Nms=MOMENTUM_REPLAY_NMS, orientation_deg=ORIENTATION_DEG)
REAL = replace(
    REPLAYED,
    tangent=TANGENT,
    pressure_m=PRESSURE_M,
    slip_m=SLIP_M,
    reach_m=REACH_M,
    swing_stiffness=SWING_STIFFNESS,
    momentum_Nms=MOMENTUM_NMS,
)


@dataclass(frozen=True)
class Case:
    """A plan to make.

    Attributes:
        name: Of the row.
        scene: Built-in.
        demand: The demands on it.
        robot: Built-in.
        friction: Coefficient that all surfaces get; None: their own.
        grasp: Whether surfaces that allow a grasp may be grasped; else they have a cone as the others.
        rules: Whether the scene's rules apply.
        hand_cap: Largest force of a hand over the weight, where the robot's own is not less; None: the robot's own.
        model: Of the contact forces; "": the planner's default.
        planning: Options of the planner.
    """

    name: str
    scene: str
    demand: Demand = REPLAYED
    robot: str = "humanoid44"
    friction: float | None = None
    grasp: bool = True
    rules: bool = True
    hand_cap: float | None = None
    model: str = "wrench"
    planning: Mapping[str, Any] = field(default_factory=dict)


def _paper(scene: str, demand: Demand) -> Case:
    return Case(scene, scene, demand, friction=FRICTION, grasp=False)


RAIL = _paper(
    "gap_with_rail", replace(REAL, hands_only=True, flights=0, hand_peak=HAND_PEAK, hand_mean_off=HAND_MEAN_OFF)
)

CASES: tuple[Case, ...] = (
    _paper("flat", replace(REAL, cost=0.05, alternate=True, flights=0)),
    _paper("stairs", replace(REAL, cost=0.03, every_surface=True, flights=0)),
    _paper("gap", replace(REAL, cost=0.95, flights=1)),
    RAIL,
    replace(
        RAIL,
        name="gap_with_rail, no offset",
        demand=Demand(solved=False),
        planning={"weights": {"force_line": NO_OFFSET}},
    ),
    *(Case(name, name) for name in ("slope", "stepping_stones", "gap_with_wall", "chimney", "turn", "turn_jump")),
    Case("flat/anymal", "flat", robot="anymal"),
    Case(
        "gap_with_rail/talos",
        "gap_with_rail",
        Demand(solved=None, hands_only=False),
        robot="talos",
        friction=FRICTION,
        grasp=False,
        hand_cap=TALOS_HAND,
    ),
    Case(
        "gap_with_rail/talos, no rule",
        "gap_with_rail",
        Demand(solved=None, hands_only=False),
        robot="talos",
        friction=FRICTION,
        grasp=False,
        rules=False,
        hand_cap=TALOS_HAND,
    ),
)

#: First weight on the change of the inputs x first guess of the phase durations [s] x how the stiffness enters. Its default, a
#: proximal weight of 30, lies among them; the default durations are shorter, and are those of the plan among the cases.
SETTINGS: tuple[tuple[float, float, str], ...] = tuple(
    (proximal, duration, stiffness)
    for stiffness in ("mu", "lambda_")
    for proximal in (10.0, 30.0, 60.0, 100.0)
    for duration in (0.40, 0.45)
)


def setting_cases(case: Case = RAIL) -> list[Case]:
    """A case with each of the settings."""
    return [
        replace(
            case,
            name=f"{case.name}, proximal_weight {proximal:g}, duration_initial_s {duration:g}, stiffness_input {stiffness}",
            planning={
                "proximal_weight": proximal,
                "duration_initial_s": duration,
                "stiffness_input": stiffness,
            },
        )
        for proximal, duration, stiffness in SETTINGS
    ]
