"""What to make of a URDF: its end-effectors, and the setups of robots of example-robot-data."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

#: Comment on top of a file made from a URDF: where each number comes from.
HEADER = (
    "Mass, inertia (its diagonal, about the CoM) and com_height are those of the URDF in {posture}. max_com_speed: a "
    "fast run, {fast} sqrt(g com_height). Reach boxes: the largest box around the nominal position whose every grid "
    "point ({step} m apart) is reached by inverse kinematics within the joint limits: base upright, other limbs "
    "nominal, soles level, feet on their own side of the body. reach_cut: the face, as high as any in the middle of "
    "the box, below which it is lifted higher ahead than behind, and up to which every grid point is reached as well."
    " Left and right are given the same box, force and turn. max_force: the largest contact force that the limb's "
    "torque limits bear beside its own weight (tau = g(q) - J^T f), the median over postures at {points} random "
    "points, rounded down: of hands, upward and all over the box; of feet, upward or towards the CoM, whichever is "
    "more, at the height of standing. yaw_range: how far inverse kinematics turns the sole about the vertical, at the"
    " nominal position and half way to every corner of the box, at most {heading}. A hand's nominal position is moved"
    " {inset} m into its box. max_moment of soles: 2/3 x {friction} x half the weight x the shorter half side, the "
    "torsion of a disc by half the friction of {full}. phase_duration, sole_support and pressure_ratio: what legs can"
    " follow, whole soles on their surface, and room under them for what swinging limbs ask of a controller. trunk: "
    "capsules along the visual shapes of what turns with the base, as thick as three quarters of them the thinner way, "
    "and from shoulder to shoulder."
)


@dataclass(frozen=True)
class End:
    """What to make an end-effector of.

    Attributes:
        name: Of the end-effector.
        frame: URDF link.
        kind: "foot" or "hand".
        half_size: Of the sole [m]; zeros: point contact.
        twin: Name of the end-effector on the other side.
        frame_offset: Contact point in the axes of the link [m].
    """

    name: str
    frame: str
    kind: str = "foot"
    half_size: tuple[float, float] = (0.0, 0.0)
    twin: str = ""
    frame_offset: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Setup:
    """What to make of a robot of example-robot-data.

    Attributes:
        ends: End-effectors.
        swing_height: [m]
        description: One line.
        posture: Angles [rad] by joint, set on top of those of the package, which for some robots has straight legs.
        lift: Highest top of the feet's reach boxes above the ground, in CoM heights. The box of largest volume may be
            high and short: where ankles cannot bend far, a lifted sole stays level only ahead.
    """

    ends: tuple[End, ...]
    swing_height: float
    description: str
    posture: Mapping[str, float] = field(default_factory=dict)
    lift: float = 0.4


def _pairs(*makers: Callable[[str], End]) -> tuple[End, ...]:
    """Ends of both sides, right before left, each made by a function that is given the side."""
    return tuple(make(side) for make in makers for side in ("right", "left"))


def _other(side: str) -> str:
    return "left" if side == "right" else "right"


def _talos_foot(side: str) -> End:
    return End(f"{side}_foot", f"{side}_sole_link", "foot", (0.10, 0.06), f"{_other(side)}_foot")


def _talos_hand(side: str) -> End:
    return End(f"{side}_hand", f"gripper_{side}_base_link", "hand", twin=f"{_other(side)}_hand")


def _g1_foot(side: str) -> End:
    """The rectangle among the four balls that the URDF gives the sole to touch with."""
    return End(
        f"{side}_foot", f"{side}_ankle_roll_link", "foot", (0.085, 0.025), f"{_other(side)}_foot", (0.035, 0.0, -0.035)
    )


def _g1_hand(side: str) -> End:
    """The middle of the rubber hand."""
    return End(
        f"{side}_hand", f"{side}_rubber_hand", "hand", twin=f"{_other(side)}_hand", frame_offset=(0.09, 0.0, 0.0)
    )


def _g1_posture() -> dict[str, float]:
    """Knees bent, soles level and below the upright base, their middle below the CoM; arms bent and off the body."""
    posture: dict[str, float] = {}
    for side, sign in (("left", 1.0), ("right", -1.0)):
        legs = {"hip_pitch": -0.4167, "knee": 0.9, "ankle_pitch": -0.4833}
        arms = {"shoulder_pitch": 0.25, "shoulder_roll": sign * 0.25, "elbow": 0.9}
        posture |= {f"{side}_{name}_joint": angle for name, angle in (legs | arms).items()}
    return posture


def _anymal_foot(leg: str) -> End:
    twin = {"RF": "lf", "LF": "rf", "RH": "lh", "LH": "rh"}[leg]
    return End(f"{leg.lower()}_foot", f"{leg}_FOOT", twin=f"{twin}_foot")


def _go2_foot(leg: str) -> End:
    """The frame that the URDF calls the foot, taken as a point on the ground."""
    ours = {"FR": "rf", "FL": "lf", "RR": "rh", "RL": "lh"}
    twin = {"FR": "lf", "FL": "rf", "RR": "lh", "RL": "rh"}[leg]
    return End(f"{ours[leg]}_foot", f"{leg}_foot", twin=f"{twin}_foot")


SETUPS = {
    "talos": Setup(_pairs(_talos_foot, _talos_hand), 0.10, "PAL Robotics TALOS: two feet, two hands"),
    "anymal": Setup(
        tuple(_anymal_foot(leg) for leg in ("RF", "LF", "RH", "LH")), 0.07, "ANYbotics ANYmal B: four point feet"
    ),
    "go2": Setup(tuple(_go2_foot(leg) for leg in ("FR", "FL", "RR", "RL")), 0.06, "Unitree Go2: four point feet"),
    # Measured: up to 0.14 the box is 0.10 m high, risers of 0.08 m are climbed, and it ends 0.06 m behind the CoM instead
    # of 0.10, with which the walk over stepping stones falls in simulation.
    "g1": Setup(_pairs(_g1_foot, _g1_hand), 0.08, "Unitree G1: two feet, two hands", _g1_posture(), lift=0.12),
}


def search_box(nominal: np.ndarray, end: End, com_height: float, lift: float) -> tuple[np.ndarray, np.ndarray]:
    """Corners [m] of where to look for reachable positions: feet stay on their side and below, hands on their side.

    Args:
        nominal: (3,) position relative to the CoM [m].
        end: The end-effector.
        com_height: [m]
        lift: Highest top above the ground, of feet, in CoM heights.
    """
    side = np.sign(nominal[1])
    if end.kind == "foot":
        inner = min(max(end.half_size[1], 0.25 * abs(nominal[1])), abs(nominal[1]))
        outer = abs(nominal[1]) + 0.15 * com_height
        ahead = 0.5 * com_height
        low, high = nominal[2] - 0.15 * com_height, nominal[2] + lift * com_height
    else:
        inner, outer, ahead, low, high = 0.15, 1.0, 0.6, -0.5, 0.9
    y = sorted((side * inner, side * outer))
    return np.array([nominal[0] - ahead, y[0], low]), np.array([nominal[0] + ahead, y[1], high])
