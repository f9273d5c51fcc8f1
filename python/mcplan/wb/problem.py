"""A plan and a robot as the solver of motions takes them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import wb as _core

from .contact_points import corners_S, points_S
from .dynamics import SplineModel, add_links
from .flights import Flights
from .ground import Ground
from .nodes import SAME_S

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .nodes import Nodes

Array = NDArray[np.float64]

#: Time in which a contact that is made takes up its planned force, and one that is broken gives it up [s].
RAMP_S = 0.06
#: Of the friction that the scene has.
FRICTION_RATIO = 0.95
#: More of the normal force than in the plan that tangential forces may be where forces have a limit.
SLIDING = 0.1
#: Of the weight that a contact may always carry: the solver asks for half of it where one carries at all.
MIN_CAP = 0.02


def load_cap(max_force: float, friction: float, planned_S: Array) -> float:
    """The largest normal force [N] with which an end-effector's force is at most its max_force.

    Tangential forces are taken to be at most SLIDING of the normal one more than in the planned wrench (6,), in the sole's frame.
    """
    tangential, normal = float(np.hypot(*planned_S[:2])), float(planned_S[2])
    ratio = min(friction, tangential / normal + SLIDING) if normal > 0.0 else friction
    return max_force / float(np.hypot(1.0, ratio))


def build_problem(
    plan: Plan, spline: SplineModel, nodes: Nodes, posture: Array, in_time: Callable[[], None] = lambda: None
) -> _core.Problem:
    """The problem of a motion along a plan: rows, limits and costs at all nodes. What `in_time` raises ends this."""
    problem = _core.Problem()
    add_links(problem, spline)
    for end, joint, placement in zip(plan.robot.end_effectors, spline.joints, spline.placements, strict=True):
        problem.add_end_effector(end.name, joint - 1, placement.rotation, placement.translation, corners_S(end, 1.0))
    problem.posture = posture
    mass = sum(inertia.mass for inertia in spline.model.inertias)
    problem.weight_N = mass * plan.scene.gravity
    flights = Flights.of(nodes)
    flights.set_weights(problem)
    wrenches = ramped(nodes, planned_wrenches_S(nodes) * (mass / plan.robot.mass))
    samples = nodes.samples
    touches = np.asarray((nodes.contacts >= 0).any(axis=0))
    ground = Ground(plan)
    tubes = {end: ground.tubes_W(plan, nodes, end, in_time) for end in np.flatnonzero(touches).tolist()}
    caps = [float(end.max_force) for end in plan.robot.end_effectors]
    points = {id(interval): points_S(plan, interval) for interval in samples.intervals}
    for k in range(nodes.count):
        in_time()
        time_s = float(samples.times_s[k])
        problem.add_node(time_s, samples.com_W[k], nodes.base_zyx[k], *flights.factors(time_s))
        for end, interval in enumerate(nodes.intervals[k]):
            if interval is not None:
                friction = FRICTION_RATIO * plan.scene.surfaces[interval.surface].friction
                rests = bool(nodes.first[k, end] or nodes.last[k, end])
                pose = (interval.position_W, interval.rotation_W)
                own = points[id(interval)]
                cap = max(load_cap(caps[end], friction, wrenches[k, end]), MIN_CAP * problem.weight_N)
                load_max = min(problem.weight_N * flights.load_max(interval, time_s), cap)
                problem.add_contact(end, nodes.carries(k, end), rests, friction, *pose, wrenches[k, end], own, load_max)
            elif touches[end]:
                foot = plan.robot.end_effectors[end].kind == "foot"
                low, high = tubes[end][k]
                pose, weight = (nodes.swings_W[k, end], samples.rotations_W[k, end]), nodes.middle(k, end)
                problem.add_swing(end, *pose, weight, foot, low, high)
    return problem


def planned_wrenches_S(nodes: Nodes) -> Array:
    """(n + 1, e, 6) the plan's force and moment about each end-effector in contact, in the frame of its sole."""
    samples = nodes.samples
    arms = samples.pressure_W - samples.positions_W
    moments = samples.moments_W + np.cross(arms, samples.forces_W)
    turned = [np.einsum("neji,nej->nei", samples.rotations_W, part) for part in (samples.forces_W, moments)]
    return np.concatenate(turned, axis=2)


def ramped(nodes: Nodes, wrenches_S: Array) -> Array:
    """Wrenches that grow from nothing when a contact is made, and fade before it is broken, so that torques do not jump."""
    out = wrenches_S.copy()
    for interval in nodes.samples.intervals:
        times, end = nodes.times_s, interval.end_effector
        inside = np.array([at[end] is interval for at in nodes.intervals])
        ramp = np.ones(len(times))
        if interval.start_s > times[0] + SAME_S:
            ramp = np.minimum(ramp, (times - interval.start_s) / RAMP_S)
        if interval.end_s < times[-1] - SAME_S:
            ramp = np.minimum(ramp, (interval.end_s - times) / RAMP_S)
        out[inside, end] *= np.clip(ramp[inside], 0.0, 1.0)[:, None]
    return out
