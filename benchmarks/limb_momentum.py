"""How much of the moment that a plan leaves out do swinging legs explain by a constant for each foot?

    mcplan plan flat --robot talos -o flat.npz
    python benchmarks/limb_momentum.py flat.npz ...

A plan's contacts change the angular momentum L of one rigid body. The postures that follow it have another one. Their
difference in rate, dM = dL/dt (Pinocchio, postures of `mcplan check --robot`) - sum (a_l - p) x f_l + tau_l, is compared with
c sum_l r_l x r_l'' over the feet, r_l from the CoM, c [kg] the one number that fits best. Printed for each plan: c, the rms and
the largest dM before and after, and the same where `balance` is above 0.08 of the weight.
"""

from __future__ import annotations

import argparse

import numpy as np
import pinocchio as pin

import mcplan as mp
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import knots_and_between, sample_at
from mcplan.kinematics.smooth_postures import smoothed
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking.feasibility import RATE
from mcplan.tracking.posture_torques import posture_torques

HOT = 0.08


def moments(plan: mp.Plan, robot: mp.Robot) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """dM (n, 3) [N m], sum of r x r'' over the feet (n, 3) [m^2/s^2], and `balance` (n,)."""
    urdf = load_model(robot)
    times = knots_and_between(plan, RATE)
    samples = sample_at(plan, plan.scene, plan.robot, times)
    postures = smoothed(urdf, samples, follow(urdf, samples))
    acceleration = np.array([plan.at(float(t)).com_acceleration_W for t in times])
    found = posture_torques(urdf, plan.scene, samples, postures, acceleration, 1.0)
    model, data = urdf.model, urdf.model.createData()
    feet = [frame for frame, end in zip(urdf.frames, robot.end_effectors, strict=True) if end.kind == "foot"]
    missing, swinging = np.zeros((len(times), 3)), np.zeros((len(times), 3))
    for n, q in enumerate(postures.configurations):
        v, a = found.velocities[n], found.accelerations[n]
        pin.computeCentroidalMomentumTimeVariation(model, data, q, v, a)
        missing[n] = data.dhg.angular
        for end in np.flatnonzero(samples.surfaces[n] >= 0):
            arm = samples.pressure_W[n, end] - samples.com_W[n]
            missing[n] -= np.cross(arm, samples.forces_W[n, end]) + samples.moments_W[n, end]
        pin.centerOfMass(model, data, q, v, a)
        com, com_acceleration = data.com[0].copy(), data.acom[0].copy()
        pin.forwardKinematics(model, data, q, v, a)
        pin.updateFramePlacements(model, data)
        for frame in feet:
            moved = pin.getFrameClassicalAcceleration(model, data, frame, pin.LOCAL_WORLD_ALIGNED).linear
            swinging[n] += np.cross(data.oMf[frame].translation - com, moved - com_acceleration)
    height, weight = robot.com_height, robot.mass * plan.scene.gravity
    forces, turns = found.residuals[:, :3], found.residuals[:, 3:] / height
    return missing, swinging, np.hypot(np.linalg.norm(forces, axis=1), np.linalg.norm(turns, axis=1)) / weight


def main() -> None:
    """Print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("paths", nargs="+", metavar="PLAN", help="File of a plan (.npz).")
    for path in parser.parse_args().paths:
        plan = mp.Plan.load(path)
        missing, swinging, balance = moments(plan, plan.robot)
        constant = float((missing * swinging).sum() / (swinging * swinging).sum())
        left = missing - constant * swinging
        size, rest = np.linalg.norm(missing, axis=1), np.linalg.norm(left, axis=1)
        hot = balance > HOT
        text = f"{path}: {constant:.1f} kg, rms {_rms(size):.0f} -> {_rms(rest):.0f} N m, "
        text += f"largest {size.max():.0f} -> {rest.max():.0f} N m, balance {balance.max():.2f}"
        print(
            text
            + (f", where it is above {HOT}: rms {_rms(size[hot]):.0f} -> {_rms(rest[hot]):.0f}" if hot.any() else "")
        )


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


if __name__ == "__main__":
    main()
