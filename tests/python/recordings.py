"""Recordings of runs made without a simulator: postures that follow a plan, off by a known amount."""

from __future__ import annotations

import functools

import numpy as np

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import sample
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking import Measures, Recording

#: [m] by which the whole robot is off the plan.
OFFSET_W = np.array([0.004, -0.006, -0.003])
#: [s] by which the simulated forces and contacts come late.
LATE = 0.02
#: [N], [s] push to the left.
PUSH, PUSH_AT, PUSH_FOR = 40.0, 0.8, 0.2


def recorded(plan: mp.Plan, rate_hz: float = 100.0, until_s: float = np.inf) -> Recording:
    """A run in which the robot follows the plan's postures, moved by OFFSET_W; torques are those of rest."""
    import pinocchio as pin

    robot = plan.robot
    urdf_model = load_model(robot)
    model, data = urdf_model.model, urdf_model.model.createData()
    coarse = sample(plan, plan.scene, robot, 20.0)
    postures = follow(urdf_model, coarse).configurations
    fine = sample(plan, plan.scene, robot, rate_hz)
    n = int(np.sum(fine.times_s <= until_s))
    times = fine.times_s[:n]
    late = np.maximum(np.arange(n) - round(LATE * rate_hz), 0)

    configurations = np.zeros((n, model.nq))
    com_W, momentum_W, end_effectors_W = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, len(urdf_model.frames), 3))
    torques = np.zeros((n, model.nv - 6))
    forces_W = fine.forces_W[late] * 1.03
    for i, t in enumerate(times):
        k = min(int(np.searchsorted(coarse.times_s, t, "right")) - 1, coarse.count - 2)
        span = coarse.times_s[k + 1] - coarse.times_s[k]
        q = pin.interpolate(model, postures[k], postures[k + 1], float(np.clip((t - coarse.times_s[k]) / span, 0, 1)))
        q[:3] += OFFSET_W
        configurations[i] = q
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        com_W[i] = pin.centerOfMass(model, data, q)
        end_effectors_W[i] = [data.oMf[frame].translation for frame in urdf_model.frames]
        load = pin.computeGeneralizedGravity(model, data, q)
        for end, frame in enumerate(urdf_model.frames):
            jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
            load = load - jacobian[:3].T @ forces_W[i, end]
        torques[i] = load[6:]
    velocities = np.zeros((n, model.nv))
    for i in range(n - 1):
        velocities[i] = pin.difference(model, configurations[i], configurations[i + 1]) / (times[i + 1] - times[i])
        momentum_W[i] = pin.computeCentroidalMomentum(model, data, configurations[i], velocities[i]).angular
    pushes_W = np.zeros((n, 3))
    pushes_W[(times >= PUSH_AT) & (times < PUSH_AT + PUSH_FOR), 1] = PUSH
    quats = np.array([pin.Quaternion(r).coeffs() for r in fine.rotation_WB[:n]])
    return Recording(
        plan=plan,
        joints=tuple(model.names[2:]),
        times_s=times,
        configurations=configurations,
        velocities=velocities,
        torques=torques,
        torque_limits=model.upperEffortLimit[6:].copy(),
        com_W=com_W,
        com_plan_W=fine.com_W[:n],
        angular_momentum_W=momentum_W,
        angular_momentum_plan_W=fine.angular_momentum_W[:n],
        base_quat_xyzw_plan=quats,
        end_effectors_W=end_effectors_W,
        end_effectors_plan_W=fine.positions_W[:n],
        forces_W=forces_W,
        forces_plan_W=fine.forces_W[:n],
        contacts=np.linalg.norm(forces_W, axis=2) > 5.0,
        contacts_plan=fine.surfaces[:n],
        assist=np.zeros((n, 6)),
        pushes_W=pushes_W,
        fell_at_s=np.inf,
        velocity_limits=model.velocityLimit[6:].copy(),
    )


def measures(**changes: float) -> Measures:
    """Measures of such a run."""
    values = {
        "fell": False,
        "completed_s": 8.43,
        "com_rms_m": 0.0078,
        "com_max_m": 0.012,
        "orientation_rms_deg": 0.4,
        "swing_rms_m": 0.009,
        "slip_m": 0.001,
        "torque_use": 0.61,
        "assist_force_rms_N": 0.0,
        "assist_moment_rms_Nm": 0.0,
        "final_base_error_m": 0.0072,
        "qp_failures": 0,
        "simulator_warnings": 0,
        "realtime_factor": 2.1,
        "control_ms": 0.55,
    }
    return Measures(**(values | changes))


@functools.cache
def walking() -> Recording:
    """Talos walks on flat ground for three seconds."""
    return recorded(by_hand.walk(by_hand.flat(), by_hand.talos()), until_s=3.0)
