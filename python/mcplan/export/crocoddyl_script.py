"""A shooting problem of Crocoddyl along a motion planned by mcplan, which made this file.

It runs where crocoddyl is installed: pip install crocoddyl==3.2.1 pin==4.0.0 (that wheel crashes with Pinocchio 4.1).

    python problem.py --iterations 100 --save solution.npz

At each node the end-effectors that the plan has in contact are held there, soles by six rows, points by three (contact dynamics
forward, semi-implicit Euler). Costs draw the state to the reference, the CoM to the plan's, free feet along the planned swings,
torques to those of rest, and contact forces into friction cones. The warm start is the reference with quasi-static torques.
"""

from __future__ import annotations

import argparse
import base64
import io
import json
from typing import Any

import numpy as np

DATA = ""

#: Weights of the costs.
STATE, COM, SWING, TORQUE, CONE = 10.0, 1e3, 1e3, 1e-3, 1e-1
#: Gains of the contacts (Baumgarte) [1/s^2, 1/s].
GAINS = np.array([100.0, 20.0])


def load() -> dict[str, Any]:
    """The arrays that this file carries."""
    return dict(np.load(io.BytesIO(base64.b64decode(DATA))))


def build_model(data: dict[str, Any], urdf: str | None = None) -> Any:
    """Pinocchio's model on a free-flyer, with a frame for each end-effector's contact."""
    import pinocchio as pin

    model = pin.buildModelFromUrdf(urdf or str(data["urdf"]), pin.JointModelFreeFlyer())
    if list(model.names)[2:] != [str(name) for name in data["joints"]]:
        raise SystemExit(f"the URDF must have the joints {', '.join(data['joints'])}, in this order")
    model.gravity.linear = np.array([0.0, 0.0, -float(data["gravity"])])
    model.armature = np.concatenate([np.zeros(6), data["armature"]])
    for e, name in enumerate(data["end_effectors"]):
        placement = pin.SE3(data["frame_rotations"][e], data["frame_positions"][e])
        joint = model.getJointId(str(data["parents"][e]))
        model.addFrame(pin.Frame(f"mcplan/{name}", joint, placement, pin.FrameType.OP_FRAME), False)
    return model


def add_contacts(state: Any, actuation: Any, data: dict[str, Any], n: int, costs: Any) -> Any:
    """Contacts of a node, their friction cones, and the swings of free feet."""
    import crocoddyl as croc
    import pinocchio as pin

    contacts = croc.ContactModelMultiple(state, actuation.nu)
    for e, name in enumerate(str(name) for name in data["end_effectors"]):
        frame = state.pinocchio.getFrameId(f"mcplan/{name}")
        position, rotation = data["positions_W"][n, e], data["rotations_W"][n, e]
        half, axes = data["half_sizes"][e], pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        if not data["contacts"][n, e]:
            if data["feet"][e]:
                residual = croc.ResidualModelFrameTranslation(state, frame, position, actuation.nu)
                costs.addCost(f"swing {name}", croc.CostModelResidual(state, residual), SWING)
            continue
        if half.all():
            placement = pin.SE3(rotation, position)
            contact = croc.ContactModel6D(state, frame, placement, axes, actuation.nu, GAINS)
            cone = croc.WrenchCone(rotation, float(data["frictions"][n, e]), 2.0 * half)
            residual = croc.ResidualModelContactWrenchCone(state, frame, cone, actuation.nu)
        else:
            contact = croc.ContactModel3D(state, frame, position, axes, actuation.nu, GAINS)
            cone = croc.FrictionCone(rotation, float(data["frictions"][n, e]))
            residual = croc.ResidualModelContactFrictionCone(state, frame, cone, actuation.nu)
        contacts.addContact(name, contact)
        barrier = croc.ActivationModelQuadraticBarrier(croc.ActivationBounds(cone.lb, cone.ub))
        costs.addCost(f"cone {name}", croc.CostModelResidual(state, barrier, residual), CONE)
    return contacts


def build_problem(data: dict[str, Any], urdf: str | None = None) -> tuple[Any, list[Any], list[Any]]:
    """The crocoddyl.ShootingProblem, and the warm start: states xs and controls us."""
    import crocoddyl as croc

    model = build_model(data, urdf)
    state = croc.StateMultibody(model)
    actuation = croc.ActuationModelFloatingBase(state)
    xs = [np.concatenate([q, v]) for q, v in zip(data["q"], data["v"], strict=True)]
    nodes, efforts, dt = [], [], 1.0 / float(data["rate_hz"])
    for n, x in enumerate(xs):
        last = n == len(xs) - 1
        costs = croc.CostModelSum(state, actuation.nu)
        near = croc.ResidualModelState(state, x, actuation.nu)
        costs.addCost("state", croc.CostModelResidual(state, near), STATE)
        com = croc.ResidualModelCoMPosition(state, data["com_W"][n], actuation.nu)
        costs.addCost("com", croc.CostModelResidual(state, com), COM)
        if not last:
            efforts.append(croc.ResidualModelControl(state, actuation.nu))
            costs.addCost("torque", croc.CostModelResidual(state, efforts[-1]), TORQUE)
        contacts = add_contacts(state, actuation, data, n, costs)
        dynamics = croc.DifferentialActionModelContactFwdDynamics(state, actuation, contacts, costs, 1e-9, True)
        nodes.append(croc.IntegratedActionModelEuler(dynamics, 0.0 if last else dt))
    problem = croc.ShootingProblem(xs[0], nodes[:-1], nodes[-1])
    us = list(problem.quasiStatic(xs[:-1]))
    for effort, torques in zip(efforts, us, strict=True):
        effort.reference = torques
    return problem, xs, us


def main() -> None:
    """Solve the problem from its warm start, and print one JSON object about it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--urdf", help="URDF of the robot; default: where it was when this file was made")
    parser.add_argument("--iterations", type=int, default=100, help="largest number of iterations")
    parser.add_argument("--save", metavar="FILE", help=".npz file for states xs and controls us")
    chosen = parser.parse_args()
    import crocoddyl as croc

    data = load()
    problem, xs, us = build_problem(data, chosen.urdf)
    solver = croc.SolverFDDP(problem)
    solver.setCandidate(xs, us, False)
    start = float(problem.calc(xs, us))
    converged = bool(solver.solve(xs, us, chosen.iterations, False))
    found = {"nodes": problem.T, "iterations": solver.iter, "converged": converged, "cost": solver.cost}
    print(json.dumps({**found, "cost_at_start": start, "stop": solver.stop}))
    if chosen.save:
        np.savez(chosen.save, xs=np.array(solver.xs), us=np.array(solver.us))


if __name__ == "__main__":
    main()
