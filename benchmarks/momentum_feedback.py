"""What would a motion gain from a plan that knows the momentum of its limbs?

    python benchmarks/momentum_feedback.py flat/talos stairs_broad/talos flat/g1 flat/go2

Solved along the plan as it is; with the wrenches that balance the limbs' momentum along the plan's CoM (those of a motion that
is held to it with WEIGHT) in place of the plan's; and twice with the CoM of the motion before in place of the plan's. That is
what a search would give that knew the momentum exactly: to bear it along the same CoM, or to go where the motion goes. Printed
for each: iterations, distance of the motion's CoM from the plan's and from what it was given, largest torque, cost.
"""

from __future__ import annotations

import argparse
from typing import Any
from unittest import mock

import numpy as np
from numpy.typing import NDArray

import mcplan as mp
from mcplan.wb import problem, solve
from mcplan.wb.nodes import Nodes

WEIGHT = 1e6


def solved(plan: mp.Plan, weight: float | None = None, com: Any = None, wrenches: Any = None) -> Any:
    """mp.motion with another weight of the CoM, or with the CoM or the wrenches of a motion instead of the plan's."""

    def build(plan: mp.Plan, spline: Any, nodes: Nodes, posture: NDArray[np.float64]) -> Any:
        if com is not None:
            nodes.samples.com_W[:] = com.sample(nodes.times_s).com_W
        made = problem.build_problem(plan, spline, nodes, posture)
        if weight is not None:
            weights = made.weights
            weights.com = weight
            made.weights = weights
        return made

    def ramped(nodes: Nodes, planned_S: NDArray[np.float64]) -> NDArray[np.float64]:
        if wrenches is None:
            return kept(nodes, planned_S)
        of, turn = wrenches.sample(nodes.times_s).wrenches_W, nodes.samples.rotations_W
        parts = [np.einsum("neji,nej->nei", turn, part) for part in (of[..., :3], of[..., 3:])]
        return np.concatenate(parts, axis=2)

    kept = problem.ramped
    with mock.patch.object(solve, "build_problem", build), mock.patch.object(problem, "ramped", ramped):
        return mp.motion(plan)


def tell(name: str, plan: mp.Plan, result: Any, given: Any) -> None:
    """A line about a result; `given` is what had the CoM that it was to follow."""
    times = np.linspace(0.0, plan.duration(), int(plan.duration() / 0.005) + 1)
    com = result.motion.sample(times).com_W
    planned = np.array([plan.at(float(t)).com_W for t in times])
    text = f"{name}: {result.status}, {result.iterations} iterations"
    references = {"the plan": planned} | ({"what is given": given.sample(times).com_W} if given else {})
    for what, reference in references.items():
        off = 1e3 * np.linalg.norm(com - reference, axis=1)
        text += f", {np.sqrt(np.mean(off**2)):.1f} mm rms, {off.max():.1f} max from {what}"
    print(f"{text}, torque {result.certificate.measures['torque_use']:.3f}, cost {result.report.cost:.0f}", flush=True)


def main() -> None:
    """Print a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", nargs="+", metavar="SCENE/ROBOT", help="Built-in names or files.")
    for case in parser.parse_args().cases:
        plan = mp.plan(*case.split("/"), time_limit=12.0).plan
        first = solved(plan)
        tell(f"{case}, as it is", plan, first, None)
        held = solved(plan, weight=WEIGHT).motion
        tell(f"{case}, wrenches with momentum", plan, solved(plan, wrenches=held), None)
        last = first.motion
        for n in (1, 2):
            found = solved(plan, com=last)
            tell(f"{case}, along the motion, {n}", plan, found, last)
            last = found.motion


if __name__ == "__main__":
    main()
