"""Plans whose forces, momenta and turns are known in closed form, made without a planner."""

from __future__ import annotations

import numpy as np

import mcplan as mp
from standing import standing_plan, standing_scene

RIGHT, LEFT, RIGHT_HAND, LEFT_HAND = range(4)


def plan_of(
    robot: mp.Robot, phases: list[mp.model.Phase], knots: list[mp.model.Knot], scene: mp.Scene | None = None
) -> mp.Plan:
    """A plan of these phases and knots; who is free swings by itself."""
    swings = []
    for e in range(len(robot.end_effectors)):
        free = [phase.contacts[e].surface < 0 for phase in phases]
        first = None
        for k, flag in enumerate([*free, False]):
            if flag and first is None:
                first = k
            elif not flag and first is not None:
                swings.append(mp.model.Swing(end_effector=e, first_phase=first, end_phase=k))
                first = None
    plan = mp.Plan(scene=scene or standing_scene(), robot=robot, planner="by hand", knots=knots, phases=phases)
    plan.final_contacts = [contact.surface for contact in phases[-1].contacts]
    plan.swings = swings
    plan.validate()
    return plan


def knot(robot: mp.Robot, com_W: np.ndarray, ends_W: np.ndarray | None = None, **fields: object) -> mp.model.Knot:
    """A knot with the end-effectors at rest, where they nominally are unless said otherwise."""
    com_W = np.asarray(com_W, float)
    ends_W = ends_W if ends_W is not None else np.array([com_W + end.nominal_B for end in robot.end_effectors])
    return mp.model.Knot(
        com_W=com_W, end_effectors_W=ends_W, end_effector_velocities_W=np.zeros((len(ends_W), 3)), **fields
    )


def leaning_plan(duration_s: float = 0.4) -> mp.Plan:
    """On the right foot alone, whose force is vertical and below nobody: it acts at a = (0, -0.1, 0) and its line passes
    s = (0, 0, 0), right below the CoM, which therefore rests. L_x = -0.1 m m g t, roll = L_x t / (2 I_x).
    """
    robot = mp.load_robot("humanoid44")
    com = np.array([0.0, 0.0, robot.com_height])
    ends = np.array([com + end.nominal_B for end in robot.end_effectors])
    scene = standing_scene()
    contacts = [mp.model.Contact() for _ in ends]
    contacts[RIGHT] = mp.model.Contact(
        surface=0, stiffness=scene.gravity / robot.com_height, center_of_pressure_W=[0.0, -0.1, 0.0]
    )
    rate = -0.1 * robot.mass * scene.gravity
    momentum = np.array([rate * duration_s, 0.0, 0.0])
    roll = 0.5 * rate * duration_s**2 / robot.inertia[0]
    end = knot(
        robot,
        com,
        ends,
        angular_momentum_W=momentum,
        base_rpy=[roll, 0.0, 0.0],
        base_rpy_rate=momentum / robot.inertia,
    )
    phase = mp.model.Phase(duration=duration_s, contacts=contacts, law=mp.model.ForceLaw.wrench)
    return plan_of(robot, [phase], [knot(robot, com, ends), end], scene)


def spinning_plan(momentum_W: np.ndarray, inertia: np.ndarray, phases: int = 2, duration_s: float = 0.3) -> mp.Plan:
    """In flight, thrown up at 2 m/s. A body with I_x = I_y turns by exp(t L / I_x) exp(t (1/I_z - 1/I_x) L_z e_z): it
    precesses about L and spins about its own axis.
    """
    robot = mp.load_robot("humanoid44")
    robot.inertia = inertia
    scene = standing_scene()
    assert inertia[0] == inertia[1]
    knots = []
    for k in range(phases + 1):
        t = k * duration_s
        com = np.array([0.1 * t, 0.0, robot.com_height + 2.0 * t - 0.5 * scene.gravity * t**2])
        precession = rotation(t * np.asarray(momentum_W) / inertia[0])
        spin = rotation(t * (1.0 / inertia[2] - 1.0 / inertia[0]) * momentum_W[2] * np.array([0.0, 0.0, 1.0]))
        fields = {"angular_momentum_W": momentum_W, "base_rpy": rpy(precession @ spin)}
        knots.append(knot(robot, com, com_velocity_W=[0.1, 0.0, 2.0 - scene.gravity * t], **fields))
    free = [mp.model.Contact() for _ in robot.end_effectors]
    return plan_of(
        robot, [mp.model.Phase(duration=duration_s, contacts=free, law=mp.model.ForceLaw.wrench)] * phases, knots, scene
    )


def tipping_plan(ahead_m: float = 0.05, duration_s: float = 0.5) -> mp.Plan:
    """The paper's pendulum on the right foot, the CoM ahead of it at constant height: x(t) = ahead cosh(omega t)."""
    robot = mp.load_robot("humanoid44")
    scene = standing_scene()
    omega = float(np.sqrt(scene.gravity / robot.com_height))
    foot = np.array([0.0, 0.0, 0.0])
    contacts = [mp.model.Contact() for _ in robot.end_effectors]
    contacts[RIGHT] = mp.model.Contact(surface=0, stiffness=omega**2, anchor_W=foot)
    knots = []
    for t in (0.0, duration_s):
        com = np.array([ahead_m * np.cosh(omega * t), 0.0, robot.com_height])
        ends = np.array([com + end.nominal_B for end in robot.end_effectors])
        ends[RIGHT] = foot
        knots.append(knot(robot, com, ends, com_velocity_W=[ahead_m * omega * np.sinh(omega * t), 0.0, 0.0]))
    return plan_of(robot, [mp.model.Phase(duration=duration_s, contacts=contacts)], knots, scene)


def hanging_plan(duration_s: float = 0.4, phases: int = 1) -> mp.Plan:
    """Between two pads at the height of the CoM, on the hands alone: each bears half the weight straight up, through the
    line from s, one CoM height below the CoM, to it. The moments of the two about the CoM cancel.
    """
    robot = mp.load_robot("humanoid44")
    scene = standing_scene()
    com = np.array([0.0, 0.0, robot.com_height])
    ends = np.array([com + end.nominal_B for end in robot.end_effectors])
    pads = []
    for name, e in (("right_pad", RIGHT_HAND), ("left_pad", LEFT_HAND)):
        square = np.array([[-0.05, -0.05, 0.0], [0.05, -0.05, 0.0], [0.05, 0.05, 0.0], [-0.05, 0.05, 0.0]])
        pads.append(mp.model.Surface(name=name, vertices_W=ends[e] + square))
    scene.surfaces = [*scene.surfaces, *pads]
    contacts = [mp.model.Contact() for _ in ends]
    for surface, e in ((1, RIGHT_HAND), (2, LEFT_HAND)):
        stiffness = 0.5 * scene.gravity / robot.com_height
        contacts[e] = mp.model.Contact(surface=surface, stiffness=stiffness, center_of_pressure_W=ends[e])
    phase = mp.model.Phase(duration=duration_s, contacts=contacts, law=mp.model.ForceLaw.wrench)
    return plan_of(robot, [phase] * phases, [knot(robot, com, ends)] * (phases + 1), scene)


def standing_on_wrenches(phases: int = 2) -> mp.Plan:
    """standing_plan with forces that act at the soles' middles and pass there on their way to the CoM."""
    plan = standing_plan(phases=phases)
    out = []
    for phase in plan.phases:
        contacts = []
        for contact in phase.contacts:
            own = contact.__copy__()
            own.center_of_pressure_W = own.anchor_W
            contacts.append(own)
        out.append(mp.model.Phase(duration=phase.duration, contacts=contacts, law=mp.model.ForceLaw.wrench))
    plan.phases = out
    return plan


def with_contact(plan: mp.Plan, k: int, e: int, **fields: object) -> mp.Plan:
    """The same plan with fields of one contact changed."""
    phases = list(plan.phases)
    contacts = list(phases[k].contacts)
    contacts[e] = contacts[e].__copy__()
    for name, value in fields.items():
        setattr(contacts[e], name, value)
    phases[k] = mp.model.Phase(duration=phases[k].duration, contacts=contacts, law=phases[k].law)
    plan.phases = phases
    return plan


def with_knot(plan: mp.Plan, k: int, **fields: object) -> mp.Plan:
    """The same plan with fields of one knot changed."""
    knots = list(plan.knots)
    knots[k] = knots[k].__copy__()
    for name, value in fields.items():
        setattr(knots[k], name, value)
    plan.knots = knots
    return plan


def rotation(vector: np.ndarray) -> np.ndarray:
    """exp([vector]x) by Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * skew + (1.0 - np.cos(angle)) * skew @ skew


def rpy(r: np.ndarray) -> np.ndarray:
    """Roll, pitch, yaw of a rotation, R = Rz Ry Rx."""
    return np.array([np.arctan2(r[2, 1], r[2, 2]), -np.arcsin(r[2, 0]), np.arctan2(r[1, 0], r[0, 0])])
