"""A plan sampled: states at a frame rate, and the intervals of contact."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .rotations import about_z, between, from_rpy, polygon_normal, sole_frame

if TYPE_CHECKING:
    from mcplan._core import Plan, PlanState, ResolvedStance, Robot, Scene

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Interval:
    """A stretch of time in which one end-effector keeps one contact."""

    end_effector: int
    surface: int
    start_s: float
    end_s: float
    position_W: Array  # (3,) [m]
    rotation_W: Array  # (3, 3) sole: z along the surface normal, x along its own heading


@dataclass(frozen=True)
class Samples:
    """States of a plan at ascending times.

    n times, e end-effectors, at most p points of a contact (0 without forces at points); lengths in [m], forces in [N],
    world frame W.
    """

    times_s: Array  # (n,)
    com_W: Array  # (n, 3)
    com_velocity_W: Array  # (n, 3)
    com_acceleration_W: Array  # (n, 3)
    rotation_WB: Array  # (n, 3, 3)
    positions_W: Array  # (n, e, 3)
    velocities_W: Array  # (n, e, 3)
    rotations_W: Array  # (n, e, 3, 3) soles and palms
    forces_W: Array  # (n, e, 3)
    pressure_W: Array  # (n, e, 3) where they act: the plan's centre of pressure, else the end-effector itself
    moments_W: Array  # (n, e, 3) about there [N m]
    points_W: Array  # (n, e, p, 3), NaN where there are fewer
    point_forces_W: Array  # (n, e, p, 3) [N], NaN likewise
    angular_momentum_W: Array  # (n, 3) about the CoM [kg m^2/s]
    surfaces: NDArray[np.int64]  # (n, e), -1: free
    intervals: list[Interval]
    has_wrenches: bool = False  # centre of pressure and moment are the plan's own

    @property
    def has_points(self) -> bool:
        return self.points_W.shape[2] > 0

    @property
    def count(self) -> int:
        return len(self.times_s)

    def nearest(self, time_s: float) -> int:
        """Index of the sample nearest to a time."""
        return int(np.argmin(np.abs(self.times_s - time_s)))


def sample(plan: Plan, scene: Scene, robot: Robot, rate_hz: float = 30.0) -> Samples:
    """Sample a plan at about `rate_hz`, start and end included."""
    duration = float(plan.duration())
    return sample_at(plan, scene, robot, np.linspace(0.0, duration, max(2, round(duration * rate_hz) + 1)))


def knots_and_between(plan: Plan, rate_hz: float) -> Array:
    """Times of a plan's knots [s], and equally spaced ones between them at `rate_hz` or more."""
    times = [np.zeros(1)]
    for start, end in zip(plan.knot_times()[:-1], plan.knot_times()[1:], strict=True):
        times.append(np.linspace(start, end, max(1, int(np.ceil((end - start) * rate_hz))) + 1)[1:])
    # The sum of the durations may be larger than the last knot's time by a rounding.
    return np.minimum(np.concatenate(times), plan.duration())


def sample_at(plan: Plan, scene: Scene, robot: Robot, times: Array) -> Samples:
    """Sample a plan at ascending times [s] within its duration; at a knot the phase that begins there is meant."""
    states = [plan.at(float(t)) for t in times]
    rotation_WB = from_rpy(np.array([s.base_rpy for s in states]))
    end_effectors = [s.end_effectors for s in states]
    intervals = contact_intervals(plan, scene, robot)
    positions_W = np.array([[e.position_W for e in row] for row in end_effectors], float)
    forces_W = np.array([[e.force_W for e in row] for row in end_effectors], float)
    surfaces = np.array([[e.surface for e in row] for row in end_effectors], int)
    points_W, point_forces_W = _padded(end_effectors, "points_W"), _padded(end_effectors, "point_forces_W")
    pressure_W = _centres_of_pressure(scene, positions_W, surfaces, points_W, point_forces_W)
    wrenches = np.array([plan.phases[s.phase].has_wrenches for s in states])
    planned_W = np.array([[e.center_of_pressure_W for e in row] for row in end_effectors], float)
    pressure_W = np.where(wrenches[:, None, None], planned_W, pressure_W)
    moments_W = np.array([[e.moment_W for e in row] for row in end_effectors], float)
    return Samples(
        times_s=times,
        com_W=np.array([s.com_W for s in states], float),
        com_velocity_W=np.array([s.com_velocity_W for s in states], float),
        com_acceleration_W=np.array([s.com_acceleration_W for s in states], float),
        rotation_WB=rotation_WB,
        positions_W=positions_W,
        velocities_W=np.array([[e.velocity_W for e in row] for row in end_effectors], float),
        rotations_W=_sole_rotations(plan, times, states, rotation_WB, intervals),
        forces_W=forces_W,
        pressure_W=pressure_W,
        moments_W=moments_W - np.cross(pressure_W - positions_W, forces_W),
        points_W=points_W,
        point_forces_W=point_forces_W,
        angular_momentum_W=np.array([s.angular_momentum_W for s in states], float),
        surfaces=surfaces,
        intervals=intervals,
        has_wrenches=bool(wrenches.all()),
    )


def stance_samples(scene: Scene, robot: Robot, stance: ResolvedStance) -> Samples:
    """A stance of the robot, as a single sample."""
    yaw = float(stance.yaw)
    rotation = about_z(np.array(yaw))
    rotations = []
    for surface in stance.contacts:
        ground = scene.surfaces[surface] if surface >= 0 else None
        rotations.append(sole_frame(polygon_normal(np.array(ground.vertices_W)), yaw) if ground else rotation)
    count = len(robot.end_effectors)
    return Samples(
        times_s=np.zeros(1),
        com_W=np.array([stance.com_W], float),
        com_velocity_W=np.zeros((1, 3)),
        com_acceleration_W=np.zeros((1, 3)),
        rotation_WB=from_rpy(np.asarray(stance.base_rpy))[None],
        positions_W=np.array([stance.end_effectors_W], float),
        velocities_W=np.zeros((1, count, 3)),
        rotations_W=np.array([rotations]),
        forces_W=np.zeros((1, count, 3)),
        pressure_W=np.array([stance.end_effectors_W], float),
        moments_W=np.zeros((1, count, 3)),
        points_W=np.zeros((1, count, 0, 3)),
        point_forces_W=np.zeros((1, count, 0, 3)),
        angular_momentum_W=np.zeros((1, 3)),
        surfaces=np.array([stance.contacts], int),
        intervals=[],
    )


def contact_intervals(plan: Plan, scene: Scene, robot: Robot) -> list[Interval]:
    """Contacts of a plan, phases with the same contact joined, by end-effector and time."""
    sequence = plan.contact_sequence()
    times = list(plan.knot_times())
    normals = [polygon_normal(np.array(s.vertices_W)) for s in scene.surfaces]
    intervals = []
    for end in range(len(robot.end_effectors)):
        k = 0
        while k < len(sequence):
            surface = sequence[k][end]
            until = k
            while until < len(sequence) and sequence[until][end] == surface:
                until += 1
            if surface >= 0:
                middle = plan.at(0.5 * (times[k] + times[until]))
                intervals.append(
                    Interval(
                        end_effector=end,
                        surface=int(surface),
                        start_s=float(times[k]),
                        end_s=float(times[until]),
                        position_W=np.array(plan.knots[k].end_effectors_W[end], float),
                        rotation_W=sole_frame(normals[surface], float(middle.end_effectors[end].yaw)),
                    )
                )
            k = until
    return intervals


def _padded(end_effectors: list[Any], attribute: str) -> Array:
    rows = [[getattr(end, attribute) for end in row] for row in end_effectors]
    max_points = max(len(points) for row in rows for points in row)
    result = np.full((len(rows), len(rows[0]), max_points, 3), np.nan)
    for n, row in enumerate(rows if max_points else []):
        for end, points in enumerate(row):
            result[n, end, : len(points)] = points
    return result


def _centres_of_pressure(
    scene: Scene, positions_W: Array, surfaces: NDArray[np.int64], points_W: Array, point_forces_W: Array
) -> Array:
    """sum (n . f_i) p_i / sum n . f_i; the end-effector itself where it has no points or next to no force."""
    if points_W.shape[2] == 0:
        return positions_W
    normals = np.array([polygon_normal(np.asarray(s.vertices_W)) for s in scene.surfaces])[np.maximum(surfaces, 0)]
    weights = np.nan_to_num(np.einsum("nei,nepi->nep", normals, point_forces_W))
    total = weights.sum(axis=2, keepdims=True)
    carries = (surfaces[..., None] >= 0) & (total > 1e-3)
    centres = (weights[..., None] * np.nan_to_num(points_W)).sum(axis=2) / np.where(carries, total, 1.0)
    return np.where(carries, centres, positions_W)


def _sole_rotations(
    plan: Plan, times: Array, states: list[PlanState], rotation_WB: Array, intervals: list[Interval]
) -> Array:
    """Soles in contact as they lie; a free one blends from the contact before to the one after.

    Where a plan says how soles head, only the tilt against that heading is blended, the base's where there is no
    contact.
    """
    count = len(plan.robot.end_effectors)
    result = np.repeat(rotation_WB[:, None], count, axis=1)
    for end in range(count):
        own = [i for i in intervals if i.end_effector == end]
        if not own:
            continue
        headings = _headings(plan, states, end)
        for n, t in enumerate(times):
            inside = [i for i in own if i.start_s <= t <= i.end_s]
            if inside:
                result[n, end] = inside[0].rotation_W
                continue
            before = [i for i in own if i.end_s < t]
            after = [i for i in own if i.start_s > t]
            start = before[-1].rotation_W if before else rotation_WB[n]
            goal = after[0].rotation_W if after else rotation_WB[n]
            since = before[-1].end_s if before else times[0]
            until = after[0].start_s if after else times[-1]
            fraction = (t - since) / max(until - since, 1e-9)
            fraction = fraction * fraction * (3.0 - 2.0 * fraction)
            if headings is None:
                result[n, end] = between(start, goal, fraction)
                continue
            own_yaw, base_yaw = headings[n], float(states[n].base_rpy[2])
            lifted = float(plan.at(since).end_effectors[end].yaw) if before else base_yaw
            lands = float(plan.at(until).end_effectors[end].yaw) if after else base_yaw
            tilt = between(about_z(np.array(-lifted)) @ start, about_z(np.array(-lands)) @ goal, fraction)
            result[n, end] = about_z(np.array(own_yaw)) @ tilt
    return result


def _headings(plan: Plan, states: list[PlanState], end: int) -> list[float] | None:
    """Of a sole at each state [rad]; None where the plan leaves it to the base."""
    if any(len(knot.end_effector_yaw) <= end for knot in plan.knots):
        return None
    return [float(state.end_effectors[end].yaw) for state in states]
