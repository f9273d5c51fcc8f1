"""Whether a robot can follow a plan, told before any simulation: reach, torques, velocities, clearance of all links."""

from __future__ import annotations

import copy
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput, InvalidRobot
from mcplan.extras import require
from mcplan.files.robots import list_robots_with
from mcplan.files.whole_ground import on_whole_ground
from mcplan.kinematics.inverse_kinematics import Postures, follow, has_sole
from mcplan.kinematics.samples import Samples, knots_and_between, sample_at
from mcplan.kinematics.smooth_postures import nearest, smoothed

from .arm_strength import largest_force_N
from .findings import Feasibility, Finding
from .link_clearance import link_findings
from .posture_torques import PostureTorques, posture_torques
from .sole_clearance import clearance_findings

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot
    from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: Postures are sought at the knots and at least so often between them [Hz].
RATE = 40.0
#: What postures may miss the plan by: CoM and end-effectors [m], soles on the ground [deg].
REACH, TILT = 0.01, 3.0
#: Wrench on the base that contacts do not balance, as a ratio to the weight (moments over the height of the CoM).
BALANCE = 0.10
#: Difference of the plan's mass from the model's, as a ratio to it.
MASS = 0.10
#: A joint so near to its limit is named [rad].
NEAR = 0.05


@dataclass(frozen=True)
class _Case:
    plan: Plan
    urdf_model: UrdfModel
    samples: Samples
    postures: Postures
    torques: PostureTorques


def assess(plan: Plan, robot: Robot | None = None, payload_kg: float = 0.0) -> Feasibility:
    """Check whether the joints of a robot can follow a plan, without simulating it.

    Postures by inverse kinematics at the knots and every 25 ms between say what is out of reach; inverse dynamics of
    these postures, with contact forces as near to the plan's as balance allows, what torques it takes.

    Args:
        plan: A plan of the contact-sequence search or the receding horizon.
        robot: A robot with a URDF; None: the plan's own. End-effectors are matched by name.
        payload_kg: Mass that the base carries in addition, at the base's own centre of mass.

    Raises:
        MissingExtra: Pinocchio or SciPy is not installed.
        InvalidRobot: The robot has no URDF, or not an end-effector that the plan has in contact.
        InvalidInput: payload_kg is negative or not finite, or the plan, its scene or its robot is malformed.
    """
    from mcplan.kinematics.urdf_model import load_model

    if not (np.isfinite(payload_kg) and payload_kg >= 0.0):
        raise InvalidInput("payload_kg", "must be 0 or more", str(payload_kg))
    plan = on_whole_ground(plan)
    robot = plan.robot if robot is None else robot
    require("telling whether a robot can follow a plan", "view", "pinocchio", "scipy")
    urdf_model = load_model(robot)
    if payload_kg:
        urdf_model.model.inertias[1].mass += payload_kg
    times = knots_and_between(plan, RATE)
    urdf_model, samples = _matched(plan, urdf_model, sample_at(plan, plan.scene, plan.robot, times))
    postures = follow(urdf_model, samples)
    moving = smoothed(urdf_model, samples, postures)
    acceleration = np.array([plan.at(float(t)).com_acceleration_W for t in times])
    mass = sum(inertia.mass for inertia in urdf_model.model.inertias)
    torques = posture_torques(urdf_model, plan.scene, samples, moving, acceleration, mass / plan.robot.mass)
    postures = nearest(urdf_model, samples, postures, moving)
    case = _Case(plan, urdf_model, samples, postures, torques)
    findings = [
        *_reach(case),
        *_balance(case, mass),
        *_torques(case),
        *_velocities(case),
        *_hands(case),
        *clearance_findings(plan.scene, urdf_model, samples, postures, _final_contacts(plan, urdf_model)),
        *link_findings(plan.scene, urdf_model, samples, postures),
        _mass(case, mass),
    ]
    return Feasibility(robot.name, tuple(findings))


def _matched(plan: Plan, urdf_model: UrdfModel, samples: Samples) -> tuple[UrdfModel, Samples]:
    """The model with the end-effectors that both plan and robot have, and the plan's samples in that order."""
    names = [end.name for end in plan.robot.end_effectors]
    robot = urdf_model.robot
    kept = [i for i, end in enumerate(robot.end_effectors) if end.name in names]
    mine = [robot.end_effectors[i].name for i in kept]
    for i, name in enumerate(names):
        if name not in mine and (samples.surfaces[:, i] >= 0).any():
            others = list_robots_with([end.name for end in plan.robot.end_effectors], joints=True)
            take = f", as {', '.join(others)} have" if others else ""
            own = ", ".join(end.name for end in robot.end_effectors)
            raise InvalidRobot("end_effectors", f"must have {name!r}, which the plan puts down{take}", own, robot.name)
    order = [names.index(name) for name in mine]
    reduced = copy.copy(robot)
    reduced.end_effectors = [robot.end_effectors[i] for i in kept]
    per_end = (
        *("positions_W", "rotations_W", "forces_W", "pressure_W", "moments_W"),
        *("points_W", "point_forces_W", "surfaces"),
    )
    chosen = {field: getattr(samples, field)[:, order] for field in per_end}
    intervals = [
        replace(i, end_effector=order.index(i.end_effector)) for i in samples.intervals if i.end_effector in order
    ]
    return (
        replace(urdf_model, robot=reduced, frames=[urdf_model.frames[i] for i in kept]),
        replace(samples, intervals=intervals, **chosen),
    )


def _final_contacts(plan: Plan, urdf_model: UrdfModel) -> list[int]:
    """Surface under each of the model's end-effectors after the last phase, -1: none."""
    end_effectors = urdf_model.robot.end_effectors
    return [plan.final_contacts[plan.robot.end_effector_index(end.name)] for end in end_effectors]


def _reach(case: _Case) -> list[Finding]:
    """Misses of the CoM, of end-effectors in contact and of feet in the air; tilts of soles on the ground."""
    samples, postures = case.samples, case.postures
    n = int(np.argmax(postures.com_misses))
    misses = postures.com_misses
    findings = [Finding("reach", float(misses[n]), REACH, "m", "com", float(samples.times_s[n]), _at_limits(case, n))]
    for end, end_effector in enumerate(case.urdf_model.robot.end_effectors):
        in_contact = samples.surfaces[:, end] >= 0
        counts = np.ones_like(in_contact) if end_effector.kind == "foot" else in_contact
        if counts.any():
            misses = np.where(counts, postures.end_misses[:, end], -1.0)
            n = int(np.argmax(misses))
            time = float(samples.times_s[n])
            findings.append(
                Finding("reach", float(misses[n]), REACH, "m", end_effector.name, time, _at_limits(case, n, end))
            )
    for end, end_effector in enumerate(case.urdf_model.robot.end_effectors):
        in_contact = samples.surfaces[:, end] >= 0
        if has_sole(end_effector) and in_contact.any():
            tilts = np.degrees(np.where(in_contact, postures.tilts[:, end], 0.0))
            n = int(np.argmax(tilts))
            time = float(samples.times_s[n])
            findings.append(
                Finding("sole", float(tilts[n]), TILT, "deg", end_effector.name, time, _at_limits(case, n, end))
            )
    return findings


def _at_limits(case: _Case, n: int, end: int | None = None) -> str:
    """Joints at their limits in a posture: of the limb of an end-effector, or of all limbs in contact."""
    model, q = case.urdf_model.model, case.postures.configurations[n]
    end_effectors = np.flatnonzero(case.samples.surfaces[n] >= 0) if end is None else [end]
    frames = [case.urdf_model.frames[i] for i in end_effectors]
    chain = {joint for frame in frames for joint in model.supports[model.frames[frame].parentJoint]}
    names = []
    for joint in sorted(joint for joint in chain if joint > 1):
        i = model.joints[joint].idx_q
        if q[i] < model.lowerPositionLimit[i] + NEAR or q[i] > model.upperPositionLimit[i] - NEAR:
            names.append(model.names[joint])
    return f"at their limits: {', '.join(names)}" if names else ""


def _torques(case: _Case) -> list[Finding]:
    return _per_joint(case, "torque", case.torques.torques, case.urdf_model.model.effortLimit[6:], "N m")


def _velocities(case: _Case) -> list[Finding]:
    return _per_joint(
        case, "joint_velocity", case.torques.velocities[:, 6:], case.urdf_model.model.velocityLimit[6:], "rad/s"
    )


def _per_joint(case: _Case, name: str, values: Array, limits: Array, unit: str) -> list[Finding]:
    """The largest value of each joint that has a limit."""
    findings, model = [], case.urdf_model.model
    for joint in range(2, model.njoints):
        v = model.joints[joint].idx_v - 6
        if limits[v] > 0.0 and np.isfinite(limits[v]):  # URDFs write 0 where they know none
            n = int(np.argmax(np.abs(values[:, v])))
            value, time = float(abs(values[n, v])), float(case.samples.times_s[n])
            findings.append(Finding(name, value, float(limits[v]), unit, model.names[joint], time))
    return findings


def _balance(case: _Case, mass: float) -> list[Finding]:
    """The part of the base's wrench that no contact balances."""
    weight = mass * float(case.plan.scene.gravity)
    height = float(case.urdf_model.robot.com_height)
    residual = case.torques.residuals
    parts = np.hypot(np.linalg.norm(residual[:, :3], axis=1), np.linalg.norm(residual[:, 3:], axis=1) / height) / weight
    n = int(np.argmax(parts))
    return [Finding("balance", float(parts[n]), BALANCE, "", "", float(case.samples.times_s[n]))]


def _hands(case: _Case) -> list[Finding]:
    """The plan's force on a hand against the capacity of its arm in that posture and direction."""
    findings, samples = [], case.samples
    for end, end_effector in enumerate(case.urdf_model.robot.end_effectors):
        forces = np.linalg.norm(samples.forces_W[:, end], axis=1)
        best: Finding | None = None
        for n in np.flatnonzero((samples.surfaces[:, end] >= 0) & (forces > 1.0) & (end_effector.kind != "foot")):
            push = -samples.forces_W[n, end]
            capacity_N, joint = largest_force_N(case.urdf_model, end, case.postures.configurations[n], push)
            found = Finding(
                "hand_force",
                float(forces[n]),
                capacity_N,
                "N",
                end_effector.name,
                float(samples.times_s[n]),
                f"{joint} reaches its limit first",
            )
            best = found if best is None or found.use > best.use else best
        findings += [best] if best else []
    return findings


def _mass(case: _Case, mass: float) -> Finding:
    difference = abs(case.plan.robot.mass / mass - 1.0)
    return Finding("mass", difference, MASS, "", note=f"plan {case.plan.robot.mass:.1f} kg, model {mass:.1f} kg")
