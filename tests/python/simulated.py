"""Robots, scenes and states that several tests of the simulation share."""

from __future__ import annotations

import numpy as np

import mcplan as mp
from mcplan.tracking.mujoco_model import SimulationModel


def level(half_size: float = 1.0, **changes: object) -> mp.Scene:
    """Level ground at z = 0."""
    corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
    return tilted(0.0, half_size, corners=corners, **changes)


def tilted(angle: float, half_size: float = 1.0, corners: object = None, **changes: object) -> mp.Scene:
    """A plane through the origin that rises along x by an angle [rad]."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]])
    square = half_size * np.array(corners or [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], float)
    surface = mp.model.Surface(name="ground", vertices_W=square @ turn.T, **changes)
    stance = mp.model.Stance(contacts={"foot": "ground"})
    return mp.Scene(surfaces=[surface], start=stance, goal=stance)


def standing(model: SimulationModel, lift_m: float = 0.0) -> np.ndarray:
    """Configuration in the nominal posture, soles at z = lift_m and their middle above x = 0."""
    import pinocchio as pin

    pin_model, frames = model.urdf_model.model, model.urdf_model.frames
    configuration = model.urdf_model.neutral.copy()
    data = pin_model.createData()
    pin.framesForwardKinematics(pin_model, data, configuration)
    feet = [f for f, e in zip(frames, model.urdf_model.robot.end_effectors, strict=True) if e.kind == "foot"]
    middle = np.mean([data.oMf[frame].translation for frame in feet], axis=0)
    configuration[:3] += [0.0, 0.0, lift_m] - middle
    return configuration


def stiffen(model: SimulationModel, configuration: np.ndarray) -> None:
    """Hold the joints by springs and dampers of MuJoCo's own, which it integrates implicitly."""
    joints = [model.mj.joint(name).id for name in model.joints]
    model.mj.jnt_stiffness[joints] = 5000.0
    model.mj.qpos_spring[model.qpos_index] = configuration[7:]
    model.mj.dof_damping[model.dof_index] = 200.0


def random_state(model: SimulationModel, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Configuration, velocity and acceleration as Pinocchio has them, far from the nominal posture."""
    import pinocchio as pin

    pin_model = model.urdf_model.model
    turned = pin.integrate(pin_model, model.urdf_model.neutral, 0.7 * rng.normal(size=pin_model.nv))
    return turned, rng.normal(size=pin_model.nv), 3.0 * rng.normal(size=pin_model.nv)


def block() -> str:
    """URDF of a single body, a block of 5 kg with its sole 0.1 m below its middle."""
    return """<robot name="block"><link name="base"><inertial><mass value="5"/>
        <inertia ixx="0.02" iyy="0.03" izz="0.03" ixy="0" ixz="0" iyz="0"/></inertial></link>
        <link name="flag"><inertial><mass value="0.01"/>
        <inertia ixx="1e-5" iyy="1e-5" izz="1e-5" ixy="0" ixz="0" iyz="0"/></inertial></link>
        <joint name="pole" type="revolute"><parent link="base"/><child link="flag"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
