"""A plan of contact wrenches made without a planner: two feet push opposite ways and turn the base."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import mcplan as mp
from standing import standing_scene

DURATION_S = 0.4


def turning_plan(moment_Nm: float = 3.0, tilt_m: float = 0.004) -> mp.Plan:
    """Four phases on two feet under a CoM at rest: pushes along x, `moment_Nm` about the vertical, turn the base to the
    left and stop it; then centres of pressure `tilt_m` ahead of the line of force, and behind it, tilt it and stop it.

    Lines of force are moved against each other by as much as leaves their sum as it was. Knots are integrated with SciPy.
    """
    scene, robot = standing_scene(), mp.load_robot("humanoid44")
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    com_W = np.array([0.0, 0.0, robot.com_height])
    ends_W = np.array([com_W + end.nominal_B for end in robot.end_effectors])
    stiffness = scene.gravity / robot.com_height / 2
    apart = ends_W[feet[0], 1] - ends_W[feet[1], 1]
    phases = []
    for turn, tilt in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        contacts = [mp.model.Contact() for _ in ends_W]
        for foot, side in zip(feet, (1, -1), strict=True):
            push = [side * turn * moment_Nm / (robot.mass * stiffness * apart), 0.0, 0.0]
            contacts[foot] = mp.model.Contact(
                surface=0,
                stiffness=stiffness,
                anchor_W=ends_W[foot] + push,
                center_of_pressure_W=ends_W[foot] + [tilt * tilt_m, 0.0, 0.0],
            )
        phases.append(mp.model.Phase(duration=DURATION_S, contacts=contacts, law=mp.model.ForceLaw.wrench))
    knots = [
        mp.model.Knot(
            com_W=com_W,
            end_effectors_W=ends_W,
            end_effector_velocities_W=np.zeros((4, 3)),
            end_effector_yaw=[0.0] * 4,
        )
        for _ in range(len(phases) + 1)
    ]
    plan = mp.Plan(
        scene=scene,
        robot=robot,
        planner="by hand",
        knots=knots,
        phases=phases,
        final_contacts=[0 if i in feet else -1 for i in range(4)],
        swings=[
            mp.model.Swing(end_effector=i, first_phase=0, end_phase=len(phases)) for i in range(4) if i not in feet
        ],
        open_end=True,
    )
    for k in range(len(phases)):
        com, velocity, momentum, turned = integrate(plan, k, DURATION_S)
        knot = plan.knots[k + 1]
        knot.com_W, knot.com_velocity_W, knot.angular_momentum_W = com, velocity, momentum
        knot.base_rpy = turned.as_euler("ZYX")[::-1]
        knot.base_rpy_rate = np.linalg.solve(turning_axes(knot.base_rpy), spin(robot, turned, momentum))
    return plan


def spin(robot: mp.Robot, turned: Rotation, momentum: np.ndarray) -> np.ndarray:
    """Angular velocity [rad/s] of the base, as a rigid body."""
    return turned.apply(turned.inv().apply(np.array(momentum)) / robot.inertia)


def turning_axes(rpy: np.ndarray) -> np.ndarray:
    """Columns: the world's axes about which rates of roll, pitch and yaw turn."""
    _, pitch, yaw = rpy
    heading = Rotation.from_euler("Z", yaw)
    return np.column_stack(
        [(heading * Rotation.from_euler("Y", pitch)).apply([1, 0, 0]), heading.apply([0, 1, 0]), [0, 0, 1]]
    )


def integrate(plan: mp.Plan, phase: int, until: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, Rotation]:
    """CoM, its velocity, angular momentum and orientation `until` [s] into a phase, from forces and moments alone."""
    robot, knot = plan.robot, plan.knots[phase]
    contacts = [contact for contact in plan.phases[phase].contacts if contact.surface >= 0]

    def rate(_: float, state: np.ndarray) -> np.ndarray:
        com, velocity, momentum, rotation = state[:3], state[3:6], state[6:9], state[9:].reshape(3, 3)
        force, moment = np.array([0.0, 0.0, -robot.mass * plan.scene.gravity]), np.zeros(3)
        for contact in contacts:
            push = robot.mass * contact.stiffness * (com - contact.anchor_W)
            force = force + push
            moment = moment + np.cross(contact.center_of_pressure_W - com, push) + contact.moment_W
        omega = rotation @ (rotation.T @ momentum / robot.inertia)
        turning = np.cross(omega, rotation, axisb=0, axisc=0)
        return np.concatenate([velocity, force / robot.mass, moment, turning.ravel()])

    begin = Rotation.from_euler("ZYX", knot.base_rpy[::-1]).as_matrix().ravel()
    state = np.concatenate([knot.com_W, knot.com_velocity_W, knot.angular_momentum_W, begin])
    if until > 0.0:
        state = solve_ivp(rate, (0.0, until), state, method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    return state[:3], state[3:6], state[6:9], Rotation.from_matrix(state[9:].reshape(3, 3))
