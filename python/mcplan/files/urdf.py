"""A Robot from a URDF: mass, inertia, CoM height, and the reach of each limb from its kinematics.

    mcplan robots --from-urdf talos -o talos.toml
    mcplan robots --from-urdf anymal -o anymal.toml
    mcplan robots --from-urdf g1 -o g1.toml

How each number comes about is written in the file's header; see also ``mcplan.files.reach``.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mcplan._core import EndEffector, Robot
from mcplan.errors import InvalidInput
from mcplan.extras import require
from mcplan.files.reach import Limb, explore, largest_box

GRAVITY = 9.81
FOOT_FORCE = 2.5  # of the robot's weight
STANCE_TANGENT = 0.6  # largest horizontal over vertical distance of a foot to the CoM in the nominal stance
HAND_INSET_M = 0.03  # of a hand's nominal position in its box: an arm hanging down is at the edge of what it reaches
SOLE_MOMENT = 0.0033  # of weight x CoM height: 1 N m on humanoid44
PHASE_DURATION = (0.3, 0.6)  # [s] of robots with soles: legs of such a weight follow no shorter swing
_CONTINUOUS = 2.0 * np.pi  # a joint with limits wider than this turns freely
_FREE_RANGE = 1.2  # [rad] about the nominal posture, kept on joints that turn freely, so that no knee flips

HEADER = (
    "Mass, inertia (its diagonal, about the CoM) and com_height are those of the URDF in {posture}. Reach "
    "boxes: the largest box around the nominal position whose every grid point ({step} m apart) is reached by inverse "
    "kinematics within the joint limits: base upright, other limbs nominal, soles level, feet on their own side of the "
    "body. Left and right are given the same box. max_force of feet: {foot} times the weight; of hands: the upward "
    "force that the arm's torque limits bear in the nominal posture (tau = J^T f plus gravity). Feet stand at most "
    "{tangent} x com_height off the CoM, since forces point at it. A hand's nominal position is moved {inset} m into "
    "its box. max_moment of soles: {moment} x weight x com_height, vertical. phase_duration and sole_support: "
    "what legs can follow and whole soles stand on."
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
    """End-effectors, swing height [m], description and nominal posture of a robot of example-robot-data.

    `posture` [rad] by joint is set on top of that of the package, which for some robots has straight legs.
    """

    ends: tuple[End, ...]
    swing_height: float
    description: str
    posture: Mapping[str, float] = field(default_factory=dict)


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
    posture = {}
    for side, sign in (("left", 1.0), ("right", -1.0)):
        legs = {"hip_pitch": -0.3122, "knee": 0.7, "ankle_pitch": -0.3878}
        arms = {"shoulder_pitch": 0.25, "shoulder_roll": sign * 0.25, "elbow": 0.9}
        posture |= {f"{side}_{name}_joint": angle for name, angle in (legs | arms).items()}
    return posture


def _anymal_foot(leg: str) -> End:
    twin = {"RF": "lf", "LF": "rf", "RH": "lh", "LH": "rh"}[leg]
    return End(f"{leg.lower()}_foot", f"{leg}_FOOT", twin=f"{twin}_foot")


SETUPS = {
    "talos": Setup(_pairs(_talos_foot, _talos_hand), 0.10, "PAL Robotics TALOS: two feet, two hands"),
    "anymal": Setup(
        tuple(_anymal_foot(leg) for leg in ("RF", "LF", "RH", "LH")), 0.07, "ANYbotics ANYmal B: four point feet"
    ),
    "g1": Setup(_pairs(_g1_foot, _g1_hand), 0.08, "Unitree G1: two feet, two hands", _g1_posture()),
}


def robot_from_urdf(
    source: str,
    ends: tuple[End, ...] = (),
    srdf: str | None = None,
    posture: Mapping[str, float] | None = None,
    swing_height: float = 0.10,
    step: float = 0.02,
    seed: int = 0,
) -> Robot:
    """Work out a robot from its URDF.

    Args:
        source: A name of example-robot-data ("talos", "anymal"), or the path of a URDF file.
        ends: End-effectors; may be empty for the names in SETUPS.
        srdf: SRDF file with the nominal posture (its first one), for a URDF file; None: the neutral one.
        posture: Angles [rad] by joint, set on top of that.
        swing_height: For a URDF file [m].
        step: Grid of the reach boxes [m].
        seed: Of the random starts of inverse kinematics.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidInput: No such URDF, frame, joint or setup.
    """
    require("mcplan robots --from-urdf", "view", "pinocchio", "example_robot_data")
    import pinocchio as pin

    setup = SETUPS.get(source)
    ends = ends_of(source, ends)
    model, nominal, urdf = load_model(source, ends, srdf, posture)
    if not any(end.kind == "foot" for end in ends):
        raise InvalidInput("ends", "needs one of kind foot at least, whose height is the ground's")

    frames = [contact_frame(model, end) for end in ends]
    data = model.createData()
    pin.ccrba(model, data, nominal, np.zeros(model.nv))
    mass, com = float(pin.computeTotalMass(model)), data.com[0].copy()
    pin.framesForwardKinematics(model, data, nominal)
    soles = [data.oMf[f].translation[2] for f, end in zip(frames, ends, strict=True) if end.kind == "foot"]
    com_height = float(com[2] - np.mean(soles))

    made = {}
    for end in ends:
        limb = limb_of(model, nominal, end, ends)
        position = limb.position(limb.nominal)
        if end.kind == "foot":
            # Forces point at the CoM: a stance wider than the friction cone cannot stand, so it is drawn in.
            position[:2] *= min(1.0, STANCE_TANGENT * com_height / np.hypot(*position[:2]))
        low, high = _search_box(position, end, com_height)
        made[end.name] = (position, *largest_box(explore(limb, low, high, step, seed)))
    weight = mass * GRAVITY
    return Robot(
        name=Path(source).stem,
        description=setup.description if setup else "",
        mass=round(mass, 3),
        inertia=np.diag(data.Ig.inertia).round(3),
        com_height=round(com_height, 3),
        swing_height=setup.swing_height if setup else swing_height,
        phase_duration=PHASE_DURATION if any(any(end.half_size) for end in ends) else Robot().phase_duration,
        sole_support=1.0,
        end_effectors=[
            _end_effector(end, *_both_sides(made, end, com_height), weight, com_height, model, nominal) for end in ends
        ],
        urdf=urdf,
        posture={
            model.names[j]: round(float(nominal[model.idx_qs[j]]), 4)
            for j in range(2, model.njoints)
            if model.nqs[j] == 1
        },
    )


def header(command: str, step: float = 0.02, own_posture: bool = False) -> str:
    """Comment on top of a file made from a URDF: the command, and where each number comes from.

    Args:
        command: That made it.
        step: Grid of the reach boxes [m].
        own_posture: The nominal posture is not the SRDF's.
    """
    text = HEADER.format(
        posture="the posture below" if own_posture else "the SRDF's posture",
        tangent=STANCE_TANGENT,
        step=step,
        foot=FOOT_FORCE,
        inset=HAND_INSET_M,
        moment=SOLE_MOMENT,
    )
    return f"Made by: {command}\n{textwrap.fill(text, 116)}"


def ends_of(source: str, ends: tuple[End, ...] = ()) -> tuple[End, ...]:
    """The end-effectors given, or those in SETUPS.

    Raises:
        InvalidInput: None are given and there are none in SETUPS.
    """
    if not ends and source not in SETUPS:
        raise InvalidInput("ends", f"must be given for a robot other than {', '.join(SETUPS)}", repr(source))
    return ends or SETUPS[source].ends


def contact_frame(model: Any, end: End) -> int:
    """Index of the frame at an end-effector's contact point, with the axes of its link; added if it is not the link's."""
    import pinocchio as pin

    link = model.getBodyId(end.frame)  # joints, which have frames too, may bear the same name
    if not any(end.frame_offset):
        return link
    name = f"mcplan/{end.name}"
    if not model.existFrame(name):
        joint, placement = model.frames[link].parentJoint, model.frames[link].placement
        placement = placement * pin.SE3(np.eye(3), np.asarray(end.frame_offset, float))
        model.addFrame(pin.Frame(name, joint, link, placement, pin.FrameType.OP_FRAME), False)
    return model.getFrameId(name)


def limb_of(model: Any, posture: np.ndarray, end: End, ends: tuple[End, ...]) -> Limb:
    """The limb that carries an end-effector: the joints on the way to it that carry no other one."""
    import pinocchio as pin

    def carriers(frame: str) -> list[int]:
        return [j for j in model.supports[model.frames[model.getBodyId(frame)].parentJoint] if j > 1]

    shared = {j for other in ends if other.name != end.name for j in carriers(other.frame)}
    own = [j for j in carriers(end.frame) if j not in shared]
    locked = [j for j in range(2, model.njoints) if j not in own]  # joint 1 is the free base: its mass counts
    reduced = pin.buildReducedModel(model, locked, posture)
    nominal = np.array([posture[model.idx_qs[j]] for j in own])
    lower, upper = reduced.lowerPositionLimit[7:].copy(), reduced.upperPositionLimit[7:].copy()
    free = upper - lower > _CONTINUOUS
    lower[free], upper[free] = (nominal - _FREE_RANGE)[free], (nominal + _FREE_RANGE)[free]
    return Limb(
        reduced,
        posture[:7].copy(),
        contact_frame(reduced, end),
        nominal,
        lower,
        upper,
        flat=any(end.half_size),
    )


def load_model(
    source: str, ends: tuple[End, ...], srdf: str | None = None, posture: Mapping[str, float] | None = None
) -> tuple[Any, np.ndarray, str]:
    """Pinocchio model with a free base, nominal posture, and what to write as `urdf` of the robot.

    Args:
        source: A name of example-robot-data, or the path of a URDF file.
        ends: Whose links must exist.
        srdf: With the nominal posture, for a URDF file.
        posture: Angles [rad] by joint, set on top of that; None: those in SETUPS.

    Raises:
        InvalidInput: No such file and no such name in example-robot-data, or no such link or joint.
    """
    model, nominal, urdf = _read(source, srdf)
    for end in ends:
        if not model.existBodyName(end.frame):
            raise InvalidInput(f"ends.{end.name}", "must name a link of the URDF", repr(end.frame))
    if posture is None:
        posture = SETUPS[source].posture if source in SETUPS else {}
    for joint, angle in posture.items():
        if not model.existJointName(joint) or model.nqs[model.getJointId(joint)] != 1:
            raise InvalidInput(f"posture.{joint}", "must name a joint of the URDF that has one angle")
        nominal[model.idx_qs[model.getJointId(joint)]] = angle
    return model, nominal, urdf


def _read(source: str, srdf: str | None) -> tuple[Any, np.ndarray, str]:
    import pinocchio as pin

    if Path(source).is_file():
        model = pin.buildModelFromUrdf(source, pin.JointModelFreeFlyer())
        if srdf is None:
            return model, pin.neutral(model), source
        pin.loadReferenceConfigurations(model, srdf)
        return model, np.array(next(iter(model.referenceConfigurations)).data()), source
    import example_robot_data

    try:
        loaded = example_robot_data.load(source)
    except Exception as found:  # its loaders raise what the file system or the parser happen to raise
        raise InvalidInput(
            "--from-urdf", "must be a URDF file or a name of example-robot-data", repr(source)
        ) from found
    return loaded.model, loaded.q0.copy(), f"example-robot-data:{source}"


def _search_box(nominal: np.ndarray, end: End, com_height: float) -> tuple[np.ndarray, np.ndarray]:
    """Where to look for reachable positions [m]: feet stay on their side and below, hands on their side."""
    side = np.sign(nominal[1])
    if end.kind == "foot":
        inner = min(max(end.half_size[1], 0.25 * abs(nominal[1])), abs(nominal[1]))
        outer = abs(nominal[1]) + 0.15 * com_height
        ahead = 0.5 * com_height
        low, high = nominal[2] - 0.15 * com_height, nominal[2] + 0.4 * com_height
    else:
        inner, outer, ahead, low, high = 0.15, 1.0, 0.6, -0.5, 0.9
    y = sorted((side * inner, side * outer))
    return np.array([nominal[0] - ahead, y[0], low]), np.array([nominal[0] + ahead, y[1], high])


def _both_sides(made: dict[str, Any], end: End, com_height: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nominal position and box shared with the twin: the mean position, the intersection of the boxes."""
    nominal, low, high = (value.copy() for value in made[end.name])
    if end.twin in made:
        flip = np.array([1.0, -1.0, 1.0])
        other, other_low, other_high = (flip * value for value in made[end.twin])
        other_low[1], other_high[1] = other_high[1], other_low[1]
        nominal = 0.5 * (nominal + other)
        low, high = np.maximum(low, other_low), np.minimum(high, other_high)
    if end.kind == "foot":
        nominal[2] = -round(com_height, 3)  # all soles on the ground
    inset = 0.0 if end.kind == "foot" else HAND_INSET_M
    low, high = low.round(3), high.round(3)
    return np.clip(nominal, low + inset, high - inset).round(3), low, high


def _end_effector(
    end: End,
    nominal: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    weight: float,
    com_height: float,
    model: Any,
    posture: np.ndarray,
) -> EndEffector:
    force = FOOT_FORCE * weight if end.kind == "foot" else _arm_force(model, posture, end)
    moment = SOLE_MOMENT * weight * com_height if any(end.half_size) else 0.0
    return EndEffector(
        name=end.name,
        kind=end.kind,
        frame=end.frame,
        frame_offset=end.frame_offset,
        half_size=end.half_size,
        nominal_B=nominal,
        reach_min_B=low,
        reach_max_B=high,
        max_force=round(force, -1),
        max_moment=[0, 0, round(moment, 2)],
    )


def _arm_force(model: Any, posture: np.ndarray, end: End) -> float:
    """Largest upward contact force [N] that the joints' torque limits bear in the nominal posture."""
    import pinocchio as pin

    frame = contact_frame(model, end)
    data = model.createData()
    per_newton = pin.computeFrameJacobian(model, data, posture, frame, pin.LOCAL_WORLD_ALIGNED)[2, 6:]
    gravity = pin.computeGeneralizedGravity(model, data, posture)[6:]
    limits = model.effortLimit[6:]
    moved = np.abs(per_newton) > 1e-9
    # |gravity - force * per_newton| <= limit in every joint
    bearable = (limits[moved] + np.sign(per_newton[moved]) * gravity[moved]) / np.abs(per_newton[moved])
    return float(max(bearable.min(), 1.0))
