"""A leg of a URDF as the virtual leg of ``LimbLimits``: which joint does what, random postures, torques and levers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import EndEffector, LimbLimits, Robot
from mcplan.files.reach import Limb
from mcplan.files.reach_cut import below_cut
from mcplan.files.urdf_setups import End

Array = NDArray[np.float64]

#: The lever of a stretched knee over the shorter link: mcplan's own constant.
MIN_LEVER_RATIO = 0.15
_PARALLEL = 0.9  # cosine between axes


@dataclass(frozen=True)
class Leg:
    """Which joints of a URDF do what in a leg; indices into Pinocchio's joints, -1: there is none.

    Attributes:
        own: All of them, from the base outwards.
        joints: Knee, hip roll, hip pitch, ankle roll, ankle pitch.
        hip: (3,) point on the hip's pitch axis beside the knee, in the joint's parent frame's coordinates of the base [m].
        ankle: (3,) from the contact to the ankle, base axes in the nominal posture [m].
        upper, lower: Distances of the axes [m].
        backward: Whether the knee is behind the line from hip to ankle.
        frame: Index of the contact's frame.
    """

    own: list[int]
    joints: tuple[int, ...]
    hip: Array
    ankle: Array
    upper: float
    lower: float
    backward: bool
    frame: int


@dataclass(frozen=True)
class Posture:
    """A robot on soles that are level, base upright at the origin.

    Attributes:
        configuration: (nq,)
        com: (3,) [m]
        feet: (f, 3) contact points [m].
        headings: (f,) of the soles [rad].
    """

    configuration: Array
    com: Array
    feet: Array
    headings: Array


@dataclass(frozen=True)
class LegModel:
    """The URDF of a robot that stands on legs with knees.

    Attributes:
        model: Pinocchio model with a free base and a frame for each contact.
        nominal: (nq,) nominal posture.
        legs: By end-effector.
        limbs: Likewise, for inverse kinematics.
    """

    model: Any
    nominal: Array
    legs: dict[str, Leg]
    limbs: dict[str, Limb]


def leg_of(model: Any, nominal: Array, end: End, limb: Limb) -> Leg | None:
    """What the joints of a leg do; None: it has no knee between a hip and a foot.

    Args:
        model: Pinocchio model with a free base.
        nominal: (nq,) nominal posture.
        end: The end-effector.
        limb: The limb that carries it.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    contact = limb.model.frames[limb.frame].name
    frame = model.getFrameId(contact) if any(end.frame_offset) else model.getBodyId(end.frame)
    data = model.createData()
    pin.computeJointJacobians(model, data, nominal)
    pin.updateFramePlacements(model, data)
    own = [model.getJointId(name) for name in list(limb.model.names)[2:]]
    axes = {j: _axis(model, data, j) for j in own}
    origins = {j: data.oMi[j].translation.copy() for j in own}
    foot = data.oMf[frame].translation.copy()
    away = foot - origins[own[0]]
    jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)[:3]
    slopes = {j: abs(float(jacobian[:, model.joints[j].idx_v] @ away)) for j in own}
    knee = max(own, key=lambda j: slopes[j])
    before, after = own[: own.index(knee)], own[own.index(knee) + 1 :]
    pitch = [j for j in before if abs(axes[j] @ axes[knee]) > _PARALLEL]
    ankle_pitch = [j for j in after if abs(axes[j] @ axes[knee]) > _PARALLEL]
    if not pitch:
        return None

    def beside_knee(joint: int) -> Array:
        along = axes[joint]
        return np.asarray(origins[joint] + along * float(along @ (origins[knee] - origins[joint])))

    hip = beside_knee(pitch[-1])
    ankle = beside_knee(ankle_pitch[0]) if ankle_pitch else foot
    line, knee_at = hip - ankle, origins[knee] - ankle
    ahead = knee_at - line * float(line @ knee_at) / float(line @ line)
    level = {
        "hip_roll": [j for j in before if abs(axes[j][0]) > 0.5 and j not in pitch],
        "ankle_roll": [j for j in after if abs(axes[j][0]) > _PARALLEL],
    }
    first = {name: (found[0] if found else -1) for name, found in level.items()}
    joints = (knee, first["hip_roll"], pitch[-1], first["ankle_roll"], ankle_pitch[0] if ankle_pitch else -1)
    return Leg(
        own,
        joints if any(end.half_size) else (*joints[:3], -1, -1),
        hip,
        ankle - foot if any(end.half_size) else np.zeros(3),
        float(np.linalg.norm(origins[knee] - hip)),
        float(np.linalg.norm(ankle - origins[knee])),
        bool(ahead[0] < 0.0),
        frame,
    )


def legs_of(model: Any, nominal: Array, ends: tuple[End, ...], limbs: dict[str, Limb]) -> LegModel | None:
    """The legs that carry feet with soles; None where a foot has no sole or its leg no knee.

    Args:
        model: Pinocchio model with a free base and a frame for each contact.
        nominal: (nq,) nominal posture.
        ends: End-effectors.
        limbs: By end-effector.
    """
    feet = [end for end in ends if end.kind == "foot"]
    found = {end.name: leg_of(model, nominal, end, limbs[end.name]) for end in feet if any(end.half_size)}
    legs = {name: leg for name, leg in found.items() if leg is not None}
    return LegModel(model, nominal, legs, limbs) if len(legs) == len(feet) else None


def _axis(model: Any, data: Any, joint: int) -> Array:
    column = data.J[3:, model.joints[joint].idx_v]
    return np.asarray(column / np.linalg.norm(column))


def postures(urdf: LegModel, robot: Robot, count: int, seed: int) -> list[Posture]:
    """Random postures: feet anywhere in their reach boxes, turned anywhere in their ranges, arms nominal.

    Args:
        urdf: The legs.
        robot: Whose reach boxes and yaw ranges they are.
        count: Of the postures.
        seed: Of what is drawn.
    """
    import pinocchio as pin

    model, legs, limbs = urdf.model, urdf.legs, urdf.limbs
    rng, data = np.random.default_rng(seed), model.createData()
    found: list[Posture] = []
    ends = {end.name: end for end in robot.end_effectors}
    for _ in range(20 * count):
        if len(found) == count:
            break
        q, headings = urdf.nominal.copy(), []
        for name, leg in legs.items():
            end = ends[name]
            target = rng.uniform(end.reach_min_B, end.reach_max_B)
            while not below_cut(end, target):
                target = rng.uniform(end.reach_min_B, end.reach_max_B)
            heading = float(rng.uniform(*end.yaw_range)) if np.isfinite(end.yaw_range).all() else 0.0
            joints = limbs[name].solve(target, limbs[name].nominal, heading)
            if joints is None:
                break
            headings.append(heading)
            q[[model.idx_qs[j] for j in leg.own]] = joints
        else:
            com = pin.centerOfMass(model, data, q).copy()
            pin.updateFramePlacements(model, data)
            feet = np.array([data.oMf[leg.frame].translation for leg in legs.values()])
            found.append(Posture(q, com, feet, np.array(headings)))
    return found


def virtual_leg(
    limb: LimbLimits, hip: Array, ankle: Array, heading: Array, longer: float
) -> tuple[float, float, Array, Array]:
    """Length, lever and axis of the knee, and the knee's place from the ankle, of the leg as if it were `longer` [m].

    Args:
        limb: With the lengths of the links.
        hip: (3,) [m]
        ankle: (3,) [m]
        heading: (3,) direction in which the sole heads, or the base of a leg without a sole.
        longer: [m]
    """
    u = hip - ankle
    length = float(np.linalg.norm(u))
    along = u / length
    axis = np.cross(along, heading)
    axis /= np.linalg.norm(axis)
    d = length + longer
    least = MIN_LEVER_RATIO * min(limb.upper, limb.lower)
    beside = (d * d + limb.lower**2 - limb.upper**2) / (2.0 * d)
    lever = float(np.sqrt(max(limb.lower**2 - beside**2, least**2)))
    ahead = (-1.0 if limb.bends_backward else 1.0) * np.cross(axis, along)
    return length, lever, axis, beside * along + lever * ahead


def hip_place(robot: Robot, end: EndEffector, com: Array, feet: dict[str, Array]) -> Array:
    """(3,) where the virtual leg's hip is, base upright [m]; `feet` by the names of all end-effectors with limits."""
    place = np.array(end.limb.hip_B, float)
    for other in robot.end_effectors:
        if other.limb.given:
            place += end.limb.hip_shift * (feet[other.name] - com - other.nominal_B)
    return np.asarray(com + place)


def leg_torques(limb: LimbLimits, hip: Array, ankle: Array, heading: Array, acting: Array, force: Array) -> Array:
    """(5,) torques [N m] that a contact force asks of knee, hip roll and pitch, ankle roll and pitch; base upright.

    Args:
        limb: The virtual leg.
        hip: (3,) [m]
        ankle: (3,) [m]
        heading: (3,) of the sole.
        acting: (3,) where the force acts [m].
        force: (3,) on the robot [N].
    """
    _, _, pitch, knee = virtual_leg(limb, hip, ankle, heading, -limb.margin)
    roll = np.cross(pitch, [0.0, 0.0, 1.0])
    roll /= np.linalg.norm(roll)
    about = ((pitch, ankle + knee), (roll, hip), (pitch, hip), (heading, ankle), (pitch, ankle))
    return np.array([float(axis @ np.cross(acting - joint, force)) for axis, joint in about])


def limits_of(limb: LimbLimits) -> Array:
    """(5,) torque limits in the order of leg_torques [N m]."""
    return np.array([limb.knee_torque, *limb.hip_torque, *limb.ankle_torque])


def max_length(limb: LimbLimits) -> float:
    """Length [m] of a leg whose knee has the least lever."""
    least = MIN_LEVER_RATIO * min(limb.upper, limb.lower)
    return float(np.sqrt(limb.upper**2 - least**2) + np.sqrt(limb.lower**2 - least**2))
