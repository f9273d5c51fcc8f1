"""What a limb bears: the largest force at its end that the torque limits of its joints allow.

Statics, with the robot at rest: tau = g(q) + J^T F d, |tau| <= limit in every joint, where F d is the force that the limb
exerts on its surroundings and g(q) bears the limb's own weight.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.files.reach import Limb

Array = NDArray[np.float64]

#: Direction of a push on what lies below.
DOWN = (0.0, 0.0, -1.0)
POINTS = 300  # of a reach box that are drawn
POSTURES = 5  # that are tried at each: an arm reaches a point with its elbow at many places
_NO_ARM = 1e-9  # [m] joints with a shorter lever arm bear nothing of the force


def largest_force_N(
    model: Any, data: Any, frame: int, configuration: Array, push_W: Array, update: bool = True
) -> tuple[float, str]:
    """Largest force that a limb can exert in a direction with the robot at rest.

    The joints between base and contact bear it. The base is held by the rest of the robot.

    Args:
        model: Pinocchio model with a free base.
        data: Of the model.
        frame: Index of the contact's frame.
        configuration: (nq,) base upright, or as it is.
        push_W: (3,) direction of the force on the surroundings, of any length but 0.
        update: False if data already belong to this configuration.

    Returns:
        Force [N], 0 if there is none with which the limb bears itself, infinite if no joint bears it; and the joint that
        gives way first.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    if update:
        pin.computeGeneralizedGravity(model, data, configuration)
        pin.computeJointJacobians(model, data, configuration)
        pin.updateFramePlacements(model, data)
    jacobian = pin.getFrameJacobian(model, data, frame, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)[:3, 6:]
    per_newton = jacobian.T @ (np.asarray(push_W, float) / np.linalg.norm(push_W))
    least, most, gives_way = 0.0, np.inf, ""
    for joint in range(2, model.njoints):
        v = model.joints[joint].idx_v
        slope, gravity, limit = per_newton[v - 6], data.g[v], model.effortLimit[v]
        if abs(slope) < _NO_ARM:
            continue
        ends = sorted([(-limit - gravity) / slope, (limit - gravity) / slope])
        least = max(least, ends[0])
        if ends[1] < most:
            most, gives_way = ends[1], model.names[joint]
    # Where gravity alone is too much for a joint, a force may hold the limb up: then it must not be too small either.
    return (float(most), gives_way) if most >= least else (0.0, gives_way)


def strengths_in_box(
    limb: Limb, low: Array, high: Array, points: int = POINTS, seed: int = 0, through_com: bool = False
) -> Array:
    """Largest forces [N] that a limb pushes with at random points of a box, in every posture that is found there, ascending.

    Args:
        limb: On its upright base.
        low: Corner of the box, relative to the CoM [m].
        high: The opposite one.
        points: How many are drawn.
        seed: Of the points, and of the postures that inverse kinematics starts from.
        through_com: Push down, or away from the CoM if it can push harder so; else only down.

    Returns:
        One for each posture; empty if no point is reached.
    """
    rng, data, forces = np.random.default_rng(seed), limb.model.createData(), []
    for _ in range(points):
        target = rng.uniform(low, high)
        pushes = [np.array(DOWN), target] if through_com else [np.array(DOWN)]
        for start in [limb.nominal, *(rng.uniform(limb.lower, limb.upper) for _ in range(POSTURES - 1))]:
            joints = limb.solve(target, start)
            if joints is not None:
                q = np.concatenate([limb.base, joints])
                forces.append(max(largest_force_N(limb.model, data, limb.frame, q, push)[0] for push in pushes))
    return np.sort(forces)


def sole_torsion(half_size: tuple[float, float], force: float, friction: float) -> float:
    """Moment about its normal [N m] that friction gives the largest disc in a sole, (2/3) friction force radius.

    A disc pressed down evenly: integral of friction x pressure x distance from the middle.

    Args:
        half_size: Of the sole [m].
        force: Along the normal [N].
        friction: Coefficient [-].
    """
    return 2.0 / 3.0 * friction * force * min(half_size)


def rounded_down(force: float) -> float:
    """To two digits [N], 1 N at least: a cap is above 0."""
    if not np.isfinite(force):
        return force
    digit = 10.0 ** max(0, np.floor(np.log10(max(force, 1.0))) - 1)
    return float(max(1.0, digit * np.floor(force / digit)))
