"""Joint limits of legs as functions of where foot and hip are: the virtual leg of ``LimbLimits``, from a URDF.

The knee is the joint that lengthens the leg most; the pitch axes of hip and ankle are those parallel to its own. Lengths are
the distances of these axes. Where the hip is in relation to the CoM depends on where the feet are, which a straight line
through random postures says; its residual is the margin. Limits of torque and speed are the URDF's, lowered until random
postures with the largest forces and speeds that they allow ask no more of a joint than it has.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import EndEffector, LimbLimits, Robot
from mcplan.files.leg_geometry import (
    Leg,
    LegModel,
    Posture,
    hip_place,
    leg_torques,
    limits_of,
    max_length,
    postures,
    virtual_leg,
)
from mcplan.files.urdf_setups import End

Array = NDArray[np.float64]

#: Random postures for the hip's place and for the limits.
POSTURES = 1500
#: Directions of forces are drawn in a cone of this friction coefficient about the vertical.
FRICTION = 0.7
#: Of residuals of the hip's place along the leg, the one that is the margin.
MARGIN_QUANTILE = 0.9
#: A limit that would have to be lowered below this ratio says nothing of the joint: it is left out.
LOWEST_RATIO = 0.4
#: Use of a joint that random postures may come to, so that others do not go beyond 1.05.
TARGET = 0.99
_ROUNDS = 4
#: [m/s] speeds of the CoM across a leg, which its knee does not feel, are drawn up to this.
MAX_SPEED = 4.0


@dataclass(frozen=True)
class Draw:
    """The largest force, or the largest speed of the CoM, that a posture's limits allow.

    Attributes:
        torques: (5,) of the joints at that force, over the URDF's limits; NaN without such a joint.
        force_ratio: That force over the largest with which no joint is beyond its own limit.
        speed: Of the knee at the largest speed, over the URDF's limit.
    """

    torques: Array
    force_ratio: float
    speed: float


def draw(urdf: LegModel, data: Any, robot: Robot, name: str, posture: Posture, rng: np.random.Generator) -> Draw | None:
    """A force of random direction and place under a sole and a random direction of the CoM's speed, both as large as the
    limits allow, with what Pinocchio says of the joints; None where the leg is longer than its limits allow.

    Args:
        urdf: The legs.
        data: Of their model.
        robot: With limits of limbs.
        name: Of the end-effector.
        posture: The posture.
        rng: What the directions are drawn from.
    """
    import pinocchio as pin

    model, legs = urdf.model, urdf.legs
    end = next(e for e in robot.end_effectors if e.name == name)
    limb, leg, names = end.limb, legs[name], list(legs)
    number = names.index(name)
    feet = dict(zip(names, posture.feet, strict=True))
    angle = posture.headings[number]
    heading = np.array([np.cos(angle), np.sin(angle), 0.0])
    sole = np.column_stack([heading, [-heading[1], heading[0], 0.0], [0.0, 0.0, 1.0]])
    hip = hip_place(robot, end, posture.com, feet)
    ankle = feet[name] + sole @ limb.ankle
    length, lever, _, _ = virtual_leg(limb, hip, ankle, heading, limb.margin)
    if length + limb.margin > max_length(limb):
        return None
    half = robot.pressure_ratio * np.asarray(end.half_size, float)
    acting = feet[name] + sole[:, :2] @ (rng.uniform(-1.0, 1.0, 2) * half)
    turn, lean = rng.uniform(0.0, 2.0 * np.pi), FRICTION * np.sqrt(rng.uniform())
    direction = np.array([lean * np.cos(turn), lean * np.sin(turn), 1.0])
    direction /= np.linalg.norm(direction)
    with np.errstate(divide="ignore"):
        allowed = min(
            end.max_force,
            float((limits_of(limb) / np.abs(leg_torques(limb, hip, ankle, heading, acting, direction))).min()),
        )

    pin.computeGeneralizedGravity(model, data, posture.configuration)
    pin.computeJointJacobians(model, data, posture.configuration)
    pin.updateFramePlacements(model, data)
    jacobian = pin.getFrameJacobian(model, data, leg.frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
    wrench = np.concatenate([direction, np.cross(acting - feet[name], direction)])
    torques, most = np.full(len(leg.joints), np.nan), end.max_force
    for i, joint in enumerate(leg.joints):
        if joint < 0:
            continue
        v = model.joints[joint].idx_v
        gravity, slope, limit = data.g[v], -float(jacobian[:, v] @ wrench), model.effortLimit[v]
        torques[i] = abs(gravity + allowed * slope) / limit
        if abs(slope) > 1e-9 and np.isfinite(limits_of(limb)[i]):
            most = min(most, max((limit - gravity) / slope, (-limit - gravity) / slope))
    along = rng.normal(size=3)
    along /= np.linalg.norm(along)
    closing = (1.0 - limb.hip_shift * len(legs)) * abs(float(along @ (hip - ankle))) / length
    speed = min(lever * limb.knee_speed / max(closing, 1e-9), MAX_SPEED)
    knee = model.joints[leg.joints[0]].idx_v
    turned = joint_speeds(urdf, data, posture, speed * along)[knee]
    return Draw(torques, allowed / most, float(abs(turned) / model.velocityLimit[knee]))


def joint_speeds(urdf: LegModel, data: Any, posture: Posture, velocity: Array) -> Array:
    """(nv,) speeds with which legs on soles that stand still give the CoM a velocity, the base not turning.

    Args:
        urdf: The legs, all on the ground.
        data: Of their model.
        posture: The posture.
        velocity: (3,) of the CoM [m/s].
    """
    import pinocchio as pin

    model, legs = urdf.model, urdf.legs
    columns = [0, 1, 2, *(model.joints[j].idx_v for leg in legs.values() for j in leg.own)]
    com = pin.jacobianCenterOfMass(model, data, posture.configuration)
    pin.computeJointJacobians(model, data, posture.configuration)
    pin.updateFramePlacements(model, data)
    rows = [com[:, columns]]
    for leg in legs.values():
        size = 6 if len(leg.own) >= 6 else 3
        jacobian = pin.getFrameJacobian(model, data, leg.frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        rows.append(jacobian[:size, columns])
    matrix = np.vstack(rows)
    desired = np.concatenate([velocity, np.zeros(len(matrix) - 3)])
    out = np.zeros(model.nv)
    out[columns] = np.linalg.lstsq(matrix, desired, rcond=None)[0]
    return out


def add_limb_limits(robot: Robot, urdf: LegModel, ends: tuple[End, ...], seed: int = 0) -> None:
    """Set `limb` of the feet of a robot that has its reach, left and right alike.

    Args:
        robot: Made from the same URDF.
        urdf: Its legs.
        ends: Its end-effectors.
        seed: Of the random postures.
    """
    drawn = postures(urdf, robot, POSTURES, seed)
    if len(drawn) < POSTURES // 4:
        return
    feet = [end for end in ends if end.kind == "foot"]
    listed = list(robot.end_effectors)
    by_name = {end.name: end for end in listed}
    shift = _hip_shift(urdf.legs, by_name, drawn)
    for end in feet:
        by_name[end.name].limb = _links(urdf, by_name, end.name, drawn, shift)
    _share(feet, by_name)
    robot.end_effectors = listed
    data, ratios, speed = urdf.model.createData(), np.ones(5), 1.0
    for _ in range(_ROUNDS):
        rng = np.random.default_rng(seed + 1)
        draws = [d for p in drawn for name in urdf.legs if (d := draw(urdf, data, robot, name, p, rng)) is not None]
        worst = np.nanmax([np.where(np.isnan(d.torques), 0.0, d.torques) for d in draws], axis=0)
        ratios /= np.maximum(worst / TARGET, 1.0)
        ratios[ratios < LOWEST_RATIO] = np.inf
        speed /= max(1.0, max(d.speed for d in draws) / TARGET)
        for end in feet:
            limb = by_name[end.name].limb
            for key, value in _limits(urdf.model, urdf.legs[end.name], ratios, speed).items():
                setattr(limb, key, value)
            by_name[end.name].limb = limb
        robot.end_effectors = listed
    _round_down(feet, by_name)
    robot.end_effectors = listed


def _links(urdf: LegModel, ends: dict[str, EndEffector], name: str, drawn: list[Posture], shift: float) -> LimbLimits:
    """The virtual leg of an end-effector, with the limits of the URDF."""
    leg = urdf.legs[name]
    moved = np.array([sum(p.feet[i] - p.com - ends[n].nominal_B for i, n in enumerate(urdf.legs)) for p in drawn])
    hips = np.array([leg.hip - p.com for p in drawn])
    place = (hips - shift * moved).mean(axis=0)
    residuals = hips - shift * moved - place
    along = hips - np.array([p.feet[list(urdf.legs).index(name)] - p.com + leg.ankle for p in drawn])
    along /= np.linalg.norm(along, axis=1)[:, None]
    return LimbLimits(
        hip_B=place.round(4),
        hip_shift=round(shift, 3),
        upper=round(leg.upper, 4),
        lower=round(leg.lower, 4),
        ankle=leg.ankle.round(4) + 0.0,
        bends_backward=leg.backward,
        margin=round(float(np.quantile(np.abs((residuals * along).sum(axis=1)), MARGIN_QUANTILE)), 3),
        **_limits(urdf.model, leg, np.ones(5), 1.0),
    )


def _hip_shift(legs: dict[str, Leg], ends: dict[str, EndEffector], drawn: list[Posture]) -> float:
    """Motion of the hips against the CoM over the sum of those of the feet, by least squares."""
    moved = np.array([sum(p.feet[i] - p.com - ends[n].nominal_B for i, n in enumerate(legs)) for p in drawn])
    hips = np.array([-p.com for p in drawn])
    moved, hips = moved - moved.mean(axis=0), hips - hips.mean(axis=0)
    return float(min(0.0, (moved * hips).sum() / (moved * moved).sum()))


def _limits(model: Any, leg: Leg, ratios: Array, speed: float) -> dict[str, Any]:
    torques = [
        float(model.effortLimit[model.joints[j].idx_v] * r) if j >= 0 else np.inf
        for j, r in zip(leg.joints, ratios, strict=True)
    ]
    torques = [t if t > 0.0 else np.inf for t in torques]  # URDFs write 0 where they know none
    knee_speed = float(model.velocityLimit[model.joints[leg.joints[0]].idx_v]) * speed
    return {
        "knee_torque": torques[0],
        "hip_torque": torques[1:3],
        "ankle_torque": torques[3:5],
        "knee_speed": knee_speed if knee_speed > 0.0 else np.inf,
    }


def _share(feet: list[End], ends: dict[str, EndEffector]) -> None:
    """Left and right alike: the mean of the places, mirrored, and the larger margin."""
    flip = np.array([1.0, -1.0, 1.0])
    done = set()
    for end in feet:
        if end.twin not in ends or end.name in done or not ends[end.twin].limb.given:
            continue
        a, b = ends[end.name].limb, ends[end.twin].limb
        a.hip_B = (0.5 * (a.hip_B + flip * b.hip_B)).round(4)
        a.ankle = (0.5 * (a.ankle + flip * b.ankle)).round(4) + 0.0
        a.margin = max(a.margin, b.margin)
        b.hip_B, b.ankle, b.margin, b.upper, b.lower = flip * a.hip_B, flip * a.ankle + 0.0, a.margin, a.upper, a.lower
        ends[end.name].limb, ends[end.twin].limb = a, b
        done |= {end.name, end.twin}


def _round_down(feet: list[End], ends: dict[str, EndEffector]) -> None:
    """Torques to whole [N m] where that is 1 % or less, speeds to 0.01 rad/s."""

    def down(value: float) -> float:
        if not np.isfinite(value):
            return value
        digit = 1.0 if value >= 50.0 else 0.1
        return float(np.round(np.floor(value / digit + 1e-9) * digit, 6))

    for end in feet:
        limb = ends[end.name].limb
        limb.knee_torque = down(limb.knee_torque)
        limb.hip_torque = [down(t) for t in limb.hip_torque]
        limb.ankle_torque = [down(t) for t in limb.ankle_torque]
        limb.knee_speed = float(np.floor(100.0 * limb.knee_speed) / 100.0) if np.isfinite(limb.knee_speed) else np.inf
        ends[end.name].limb = limb
