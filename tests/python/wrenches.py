"""Plans of contact wrenches made without a planner, their knots replayed from the forces alone."""

from __future__ import annotations

import numpy as np

import mcplan as mp
import plans_by_hand as by_hand
from standing import standing_plan


def standing_wrenches(
    robot: mp.Robot | None = None, phases: int = 2, duration_s: float = 0.4, squeeze_m: float = 0.02
) -> mp.Plan:
    """A robot at rest whose centres of pressure lie off the middle of its soles, and whose feet push against each other.

    Each foot bears half of the weight. The lines of force are moved by +-squeeze along x: their yawing moment about the
    CoM, m mu squeeze (distance of the centres of pressure), is what the moments about the normals take up.
    """
    plan = standing_plan(phases, duration_s, robot)
    robot = plan.robot
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    ends, half = plan.knots[0].end_effectors_W, robot.end_effectors[feet[0]].half_size
    stiffness = plan.scene.gravity / robot.com_height / 2.0
    contacts = [mp.model.Contact() for _ in robot.end_effectors]
    apart = abs(ends[feet[0]][1] - ends[feet[1]][1])
    for i in feet:
        side = np.sign(ends[i][1])
        # Both centres of pressure are moved so that their mean stays below the CoM.
        pressure = ends[i] + [0.4 * side * half[0] - ends[i][0], 0.5 * side * half[1], 0.0]
        contacts[i] = mp.model.Contact(
            surface=0,
            stiffness=stiffness,
            center_of_pressure_W=pressure,
            anchor_W=pressure + [side * squeeze_m, 0.0, 0.0],
            moment_W=[0.0, 0.0, -0.5 * robot.mass * stiffness * squeeze_m * (apart + half[1])],
        )
    plan.phases = [mp.model.Phase(duration=duration_s, contacts=contacts, law=mp.model.ForceLaw.wrench)] * phases
    plan.knots = [_with_yaws(knot, [0.0] * len(ends)) for knot in plan.knots]
    plan.validate()
    return plan


def leaning(robot: mp.Robot | None = None, yaw: float = 1.5, phases: int = 3, duration_s: float = 0.15) -> mp.Plan:
    """A robot that heads along `yaw` and, on soles that do not, builds up angular momentum about all three axes."""
    plan = standing_wrenches(robot, phases, duration_s)
    robot, start = plan.robot, plan.knots[0]
    rng = np.random.default_rng(11)
    changed = []
    for phase in plan.phases:
        contacts = list(phase.contacts)
        for i, contact in enumerate(phase.contacts):
            if contact.surface >= 0:
                contacts[i] = mp.model.Contact(
                    surface=contact.surface,
                    stiffness=contact.stiffness * rng.uniform(0.9, 1.1),
                    center_of_pressure_W=contact.center_of_pressure_W,
                    anchor_W=contact.anchor_W + [*rng.uniform(-0.05, 0.05, 2), 0.0],
                    moment_W=[0.0, 0.0, rng.uniform(-4.0, 4.0)],
                )
        changed.append(mp.model.Phase(duration=phase.duration, contacts=contacts, law=mp.model.ForceLaw.wrench))
    plan.phases = changed
    momentum, rpy = np.array([0.3, -0.4, 0.2]), np.array([0.10, -0.15, yaw])
    yaws = [0.2] * len(robot.end_effectors)
    plan.knots = replayed(plan, start.com_W, np.array([0.05, -0.02, 0.0]), momentum, rpy, yaws)
    plan.validate()
    return plan


def turning(robot: mp.Robot, angle: float = 0.5 * np.pi, pairs: int = 3) -> mp.Plan:
    """A turn on the spot: feet are planted anew in turn, each by angle / pairs, while the base turns at a steady rate.

    The CoM is that of a pendulum (plans_by_hand). What turns the base are moments about the normals in the first and the
    last phase: L_z = I_z yaw' between them, all else is zero.
    """
    scene = by_hand.flat()
    scene.goal = mp.model.Stance(position_W=[0.0, 0.0, 0.0], yaw=angle, contacts={"foot": "ground"})
    yaws, feet = [0.0, 0.0], [_foothold(robot, foot, 0.0) for foot in (0, 1)]
    steps, headings = [([0, 0], list(feet), 0.6)], [list(yaws)]
    for pair in range(pairs):
        for foot in (by_hand.LEFT, by_hand.RIGHT):
            steps.append(([-1 if i == foot else 0 for i in (0, 1)], list(feet), 0.6))
            headings.append(list(yaws))
            yaws[foot] = angle * (pair + 1) / pairs
            feet[foot] = _foothold(robot, foot, yaws[foot])
            steps.append(([0, 0], list(feet), 0.4))
            headings.append(list(yaws))
    steps[-1] = (*steps[-1][:2], 0.6)
    plan = by_hand.balanced(scene, robot, steps)

    durations = np.array([phase.duration for phase in plan.phases])
    rate = angle / (durations.sum() - 0.5 * (durations[0] + durations[-1]))
    inertia = float(robot.inertia[2])
    momentum = np.full(len(plan.knots), inertia * rate)
    momentum[[0, -1]] = 0.0
    yaw = np.concatenate([[0.0], np.cumsum(0.5 * (momentum[1:] + momentum[:-1]) / inertia * durations)])
    phases, knots = [], []
    for k, phase in enumerate(plan.phases):
        down = sum(contact.surface >= 0 for contact in phase.contacts)
        moment = [0.0, 0.0, (momentum[k + 1] - momentum[k]) / durations[k] / down]
        contacts = [_as_wrench(contact, moment) for contact in phase.contacts]
        phases.append(mp.model.Phase(duration=phase.duration, contacts=contacts, law=mp.model.ForceLaw.wrench))
    for k, knot in enumerate(plan.knots):
        ends = [np.array(end) for end in knot.end_effectors_W]
        for i, end in enumerate(robot.end_effectors):
            if end.kind == "hand":
                ends[i] = knot.com_W + _about_z(yaw[k]) @ end.nominal_B
        hands = [yaw[k]] * (len(ends) - 2)
        knots.append(
            mp.model.Knot(
                com_W=knot.com_W,
                com_velocity_W=knot.com_velocity_W,
                angular_momentum_W=[0.0, 0.0, momentum[k]],
                base_rpy=[0.0, 0.0, yaw[k]],
                base_rpy_rate=[0.0, 0.0, momentum[k] / inertia],
                end_effectors_W=ends,
                end_effector_velocities_W=np.zeros((len(ends), 3)),
                end_effector_yaw=[*headings[min(k, len(headings) - 1)], *hands],
            )
        )
    plan.phases, plan.knots = phases, knots
    plan.validate()
    return plan


def replayed(plan: mp.Plan, com, velocity, momentum, rpy, yaws, cuts: int = 400) -> list[mp.model.Knot]:
    """Knots of the plan's phases from a state at the start, by Runge-Kutta steps on the forces and moments.

    The base by small rotations R <- exp(dt omega) R, omega = R I^-1 R^T L: no rates of angles.
    """
    from scipy.spatial.transform import Rotation

    state, knots = [np.array(com), np.array(velocity), np.array(momentum)], []
    turned = Rotation.from_euler("xyz", rpy)
    last = np.array(rpy)

    def knot() -> mp.model.Knot:
        euler = turned.as_euler("xyz")
        euler = last + (euler - last + np.pi) % (2.0 * np.pi) - np.pi
        return mp.model.Knot(
            com_W=state[0],
            com_velocity_W=state[1],
            angular_momentum_W=state[2],
            base_rpy=euler,
            end_effectors_W=plan.knots[0].end_effectors_W,
            end_effector_velocities_W=plan.knots[0].end_effector_velocities_W,
            end_effector_yaw=yaws,
        )

    def omega(momentum, rotation):
        r = rotation.as_matrix()
        return r @ ((r.T @ momentum) / plan.robot.inertia)

    knots.append(knot())
    for phase in plan.phases:
        h = phase.duration / cuts
        for _ in range(cuts):
            middle = _advanced(plan, phase, state, 0.5 * h)
            after = _advanced(plan, phase, state, h)
            half = Rotation.from_rotvec(0.5 * h * omega(state[2], turned)) * turned
            turned = Rotation.from_rotvec(h * omega(middle[2], half)) * turned
            state = after
        knots.append(knot())
        last = np.asarray(knots[-1].base_rpy)
    return knots


def _advanced(plan: mp.Plan, phase: mp.model.Phase, state, h: float):
    def rate(s):
        force, moment = np.array([0.0, 0.0, -plan.robot.mass * plan.scene.gravity]), np.zeros(3)
        for contact in phase.contacts:
            if contact.surface >= 0:
                own = plan.robot.mass * contact.stiffness * (s[0] - contact.anchor_W)
                force = force + own
                moment = moment + np.cross(contact.center_of_pressure_W - s[0], own) + contact.moment_W
        return [s[1], force / plan.robot.mass, moment]

    def moved(s, slope, t):
        return [a + t * b for a, b in zip(s, slope, strict=True)]

    a = rate(state)
    b = rate(moved(state, a, 0.5 * h))
    c = rate(moved(state, b, 0.5 * h))
    d = rate(moved(state, c, h))
    return [s + h / 6.0 * (w + 2 * x + 2 * y + z) for s, w, x, y, z in zip(state, a, b, c, d, strict=True)]


def _as_wrench(contact: mp.model.Contact, moment) -> mp.model.Contact:
    if contact.surface < 0:
        return contact
    return mp.model.Contact(
        surface=contact.surface,
        stiffness=contact.stiffness,
        anchor_W=contact.anchor_W,
        center_of_pressure_W=contact.anchor_W,
        moment_W=moment,
    )


def _with_yaws(knot: mp.model.Knot, yaws) -> mp.model.Knot:
    return mp.model.Knot(
        com_W=knot.com_W,
        com_velocity_W=knot.com_velocity_W,
        end_effectors_W=knot.end_effectors_W,
        end_effector_velocities_W=knot.end_effector_velocities_W,
        end_effector_yaw=yaws,
    )


def _foothold(robot: mp.Robot, foot: int, yaw: float) -> np.ndarray:
    x, y, _ = robot.end_effectors[foot].nominal_B
    return np.array([*(_about_z(yaw) @ [x, y, 0.0])[:2], 0.0])


def _about_z(yaw: float) -> np.ndarray:
    return np.array([[np.cos(yaw), -np.sin(yaw), 0.0], [np.sin(yaw), np.cos(yaw), 0.0], [0.0, 0.0, 1.0]])
