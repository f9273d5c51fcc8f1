"""What the tests of exports share: a plan and a run of the G1, and MuJoCo's view of a file."""

from __future__ import annotations

import functools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import mcplan as mp

pin = pytest.importorskip("pinocchio")

#: Unitree's 29 motors of the G1, in the order of its data sets.
SIDES = ("left", "right")
LEG = ("hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll")
ARM = ("shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_roll", "wrist_pitch", "wrist_yaw")
WAIST = tuple(f"waist_{axis}_joint" for axis in ("yaw", "roll", "pitch"))
G1_JOINTS = [f"{side}_{part}_joint" for side in SIDES for part in LEG]
G1_JOINTS += [*WAIST, *(f"{side}_{part}_joint" for side in SIDES for part in ARM)]


@functools.cache
def plan() -> mp.Plan:
    """The G1 takes two steps on the flat."""
    scene = mp.load_scene("flat")
    scene.goal.position_W = [0.4, 0.0, 0.0]
    result = mp.plan(scene, "g1", phases=10, time_limit=60.0)
    assert result.report.status == mp.Status.solved
    return result.plan


@functools.cache
def run() -> Any:
    """A recording of it, 0.01 s from one instant to the next."""
    from recordings import recorded

    made = recorded(plan(), until_s=2.0)
    times = np.arange(len(made.times_s)) * 0.01
    return replace(made, times_s=times, velocities=made.velocities * made.times_s[1] / times[1])


@functools.cache
def simulation(robot: str = "g1") -> Any:
    """MuJoCo's model of a robot, made of the URDF without the exporter."""
    pytest.importorskip("mujoco")
    from mcplan.tracking.mujoco_model import build

    return build(mp.load_robot(robot), mp.load_scene("flat")).mj


def mujoco_states(model: Any, qpos: np.ndarray, qvel: np.ndarray, at_com: bool) -> dict[str, tuple[np.ndarray, ...]]:
    """By body: position and quaternion wxyz of its frame, linear velocity there or at its CoM, angular velocity, world."""
    import mujoco

    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = qpos, qvel
    mujoco.mj_forward(model, data)
    states = {}
    for body in range(1, model.nbody):
        velocity, kind = np.zeros(6), mujoco.mjtObj.mjOBJ_BODY if at_com else mujoco.mjtObj.mjOBJ_XBODY
        mujoco.mj_objectVelocity(model, data, kind, body, velocity, 0)
        states[model.body(body).name] = (data.xpos[body].copy(), data.xquat[body].copy(), velocity[3:], velocity[:3])
    return states


def qpos_of(model: Any, base: np.ndarray, quat_wxyz: np.ndarray, joints: dict[str, float]) -> np.ndarray:
    """MuJoCo's qpos of joints by name."""
    qpos = np.concatenate([base, quat_wxyz, np.zeros(len(joints))])
    for name, angle in joints.items():
        qpos[model.joint(name).qposadr[0]] = angle
    return qpos
