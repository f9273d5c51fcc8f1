"""Solve an exported problem by Crocoddyl and measure the motion; runs in Crocoddyl's own environment.

    python crocoddyl_inside.py problem.py ITERATIONS

One JSON line: iterations, times, and what the solution breaks at its nodes, where Crocoddyl looks, and between them.
"""

from __future__ import annotations

import importlib.util
import json
import sys
import time
from typing import Any

import crocoddyl as croc
import numpy as np
import pinocchio as pin

#: Instants between two nodes at which positions and speeds are looked at.
BETWEEN = 20
#: Normal force from which on a centre of pressure counts [N].
LOADED_N = 10.0


def load(path: str) -> Any:
    """The exported script as a module."""
    spec = importlib.util.spec_from_file_location("exported_problem", path)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def drift(model: Any, data: dict[str, Any], xs: list[Any]) -> tuple[float, float]:
    """Largest distance of a sole in contact from its place at the nodes, and between them [m].

    Between nodes the state moves along the tangent from one to the next, as the integrator does.
    """
    kinematics = model.createData()
    frames = [model.getFrameId(f"mcplan/{name}") for name in data["end_effectors"]]
    at_nodes = between = 0.0
    for n, (x, after) in enumerate(zip(xs, xs[1:], strict=False)):
        step = pin.difference(model, x[: model.nq], after[: model.nq])
        for k in range(BETWEEN):
            q = pin.integrate(model, x[: model.nq], step * (k / BETWEEN))
            pin.framesForwardKinematics(model, kinematics, q)
            for e, frame in enumerate(frames):
                if data["contacts"][n, e] and data["contacts"][min(n + 1, len(xs) - 1), e]:
                    apart = float(np.linalg.norm(kinematics.oMf[frame].translation - data["positions_W"][n, e]))
                    at_nodes, between = max(at_nodes, apart if k == 0 else 0.0), max(between, apart)
    return at_nodes, between


def residual(model: Any, xs: list[Any], problem: Any) -> tuple[float, float]:
    """Largest residual of the base's six rows between nodes with the forces of the node held [N, N m].

    The motion is the one that the integrator describes: constant acceleration, positions along the velocity at the end of the
    step.
    """
    rnea, worst_N, worst_Nm = model.createData(), 0.0, 0.0
    for x, after, node in zip(xs, xs[1:], problem.runningDatas, strict=False):
        dt = problem.runningModels[0].dt
        v, v_after = x[model.nq :], after[model.nq :]
        forces = node.differential.multibody.contacts.fext
        for ratio in np.arange(1, BETWEEN) / BETWEEN:
            q = pin.integrate(model, x[: model.nq], ratio * dt * v_after)
            tau = pin.rnea(model, rnea, q, v + ratio * (v_after - v), (v_after - v) / dt, forces)
            worst_N = max(worst_N, float(np.linalg.norm(tau[:3])))
            worst_Nm = max(worst_Nm, float(np.linalg.norm(tau[3:6])))
    return worst_N, worst_Nm


def contact_forces(data: dict[str, Any], problem: Any) -> tuple[float, float]:
    """Largest force beyond a friction cone [N], and distance of a centre of pressure beyond its sole [m].

    They are held from node to node. Centres of pressure count from LOADED_N on.
    """
    cone_N = beyond_m = 0.0
    names = [str(name) for name in data["end_effectors"]]
    for n, node in enumerate(problem.runningDatas):
        contacts = node.differential.multibody.contacts.contacts.todict()
        for name, contact in contacts.items():
            e = names.index(name)
            wrench = contact.jMf.actInv(contact.fext)  # in the frame of the sole
            normal = wrench.linear[2]
            over = float(np.hypot(*wrench.linear[:2]) - float(data["frictions"][n, e]) * normal)
            cone_N = max(cone_N, over)
            if data["half_sizes"][e].all() and normal > LOADED_N:
                pressure = np.array([-wrench.angular[1], wrench.angular[0]]) / normal
                beyond_m = max(beyond_m, float((np.abs(pressure) - data["half_sizes"][e]).max()))
    return cone_N, beyond_m


def main() -> None:
    module, iterations = load(sys.argv[1]), int(sys.argv[2])
    data = module.load()
    began = time.process_time()
    problem, xs, us = module.build_problem(data)
    built = time.process_time()
    solver = croc.SolverFDDP(problem)
    solver.setCandidate(xs, us, False)
    converged = bool(solver.solve(xs, us, iterations, False))
    solved = time.process_time()
    model = problem.runningModels[0].differential.state.pinocchio
    found_xs, found_us = list(solver.xs), list(solver.us)
    problem.calc(found_xs, found_us)
    torques, states = np.array(found_us), np.array(found_xs)
    q, v = states[:, 7 : model.nq], states[:, model.nq + 6 :]
    over = np.maximum(model.lowerPositionLimit[7:] - q, q - model.upperPositionLimit[7:])
    at_nodes, between = drift(model, data, found_xs)
    force_N, moment_Nm = residual(model, found_xs, problem)
    cone_N, beyond_m = contact_forces(data, problem)
    report = {
        "converged": converged,
        "iterations": solver.iter,
        "nodes": problem.T,
        "duration_s": problem.T / float(data["rate_hz"]),
        "build_s": built - began,
        "cpu_s": solved - built,
        "torque_use": float((np.abs(torques) / model.effortLimit[6:]).max()),
        "velocity_use": float((np.abs(v) / model.velocityLimit[6:]).max()),
        "position_over_mrad": 1e3 * max(0.0, float(over.max())),
        "cone_N": cone_N,
        "pressure_mm": 1e3 * beyond_m,
        "drift_nodes_mm": 1e3 * at_nodes,
        "drift_mm": 1e3 * between,
        "base_residual_N": force_N,
        "base_residual_Nm": moment_Nm,
    }
    print(json.dumps(report))


if __name__ == "__main__":
    main()
