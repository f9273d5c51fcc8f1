"""A run at a frame rate, in the form in which plans are drawn: what the simulator did, not what was planned."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.rotations import polygon_normal, with_axis_z
from mcplan.kinematics.samples import Interval, Samples

if TYPE_CHECKING:
    from mcplan._core import Scene
    from mcplan.kinematics.urdf_model import UrdfModel
    from mcplan.tracking import Recording

Array = NDArray[np.float64]

#: [s] contacts that are lost for no longer are drawn as kept: a foot that rocks is not a step.
SHORT = 0.04
#: Changes of a force that acts, up to which each is drawn as a push of its own.
MOST_PUSHES = 8


@dataclass(frozen=True)
class RunFrames:
    """Instants of a run that are drawn.

    Attributes:
        samples: What the robot did there; contacts are the simulator's, and last as long as they did.
        configurations: (n, nq) in Pinocchio's order.
        base_W: (n, 3) [m] origin of the base.
        pushes_W: (n, 3) [N].
        assist_W: (n, 3) [N] force of the assistance on the base.
    """

    samples: Samples
    configurations: Array
    base_W: Array
    pushes_W: Array
    assist_W: Array


def frame_indices(times_s: Array, rate_hz: float) -> NDArray[np.int64]:
    """Instants of a recording nearest to equally spaced ones, first and last included, each once."""
    if len(times_s) == 1:
        return np.zeros(1, dtype=np.int64)
    count = max(2, round(float(times_s[-1] - times_s[0]) * rate_hz) + 1)
    desired = np.linspace(times_s[0], times_s[-1], count)
    after = np.clip(np.searchsorted(times_s, desired), 1, len(times_s) - 1)
    nearer = desired - times_s[after - 1] < times_s[after] - desired
    return np.unique(after - nearer)


def frames_of(recording: Recording, urdf_model: UrdfModel, rate_hz: float) -> RunFrames:
    """Pick the frames of a recording.

    Args:
        recording: The run.
        urdf_model: Model of its robot; soles are rotated as its configurations say.
        rate_hz: Frames in a second.
    """
    scene = recording.scene_by_plan
    chosen = frame_indices(recording.times_s, rate_hz)
    configurations = recording.configurations[chosen]
    rotation_WB, soles_W = _rotations(urdf_model, configurations)
    times = recording.times_s[chosen]
    positions = recording.end_effectors_W[chosen]
    count, end_effector_count = positions.shape[:2]
    intervals = simulated_intervals(recording, scene)
    for n, interval in enumerate(intervals):
        middle = int(np.argmin(np.abs(times - 0.5 * (interval.start_s + interval.end_s))))
        normal = polygon_normal(np.asarray(scene.surfaces[interval.surface].vertices_W))
        rotation = with_axis_z(normal, soles_W[middle, interval.end_effector][:, 0])
        intervals[n] = Interval(
            interval.end_effector, interval.surface, interval.start_s, interval.end_s, interval.position_W, rotation
        )
    surfaces = np.full((count, end_effector_count), -1)
    for interval in intervals:
        lasts = (times >= interval.start_s) & (times <= interval.end_s)
        surfaces[lasts, interval.end_effector] = interval.surface
    com_velocity_W = _rate(recording.com_W, recording.times_s)
    samples = Samples(
        times_s=times,
        com_W=recording.com_W[chosen],
        com_velocity_W=com_velocity_W[chosen],
        com_acceleration_W=_rate(com_velocity_W, recording.times_s)[chosen],
        rotation_WB=rotation_WB,
        positions_W=positions,
        velocities_W=_rate(recording.end_effectors_W, recording.times_s)[chosen],
        rotations_W=soles_W,
        forces_W=recording.forces_W[chosen],
        pressure_W=positions,
        moments_W=np.zeros((count, end_effector_count, 3)),
        points_W=np.zeros((count, end_effector_count, 0, 3)),
        point_forces_W=np.zeros((count, end_effector_count, 0, 3)),
        angular_momentum_W=recording.angular_momentum_W[chosen],
        surfaces=surfaces,
        intervals=intervals,
    )
    return RunFrames(
        samples, configurations, configurations[:, :3], recording.pushes_W[chosen], recording.assist[chosen, :3]
    )


def _rate(values: Array, times_s: Array) -> Array:
    """Derivatives (n, ...) with respect to time; of a single instant zero."""
    return np.gradient(values, times_s, axis=0) if len(times_s) > 1 else np.zeros_like(values)


def simulated_intervals(recording: Recording, scene: Scene) -> list[Interval]:
    """Contacts as they were in the simulation, by end-effector and time; gaps of up to 40 ms are closed.

    Their soles are level; where they lie is the mean over the contact.
    """
    times = recording.times_s
    intervals = []
    for end in range(recording.contacts.shape[1]):
        for start, stop in joined_stretches(recording.contacts[:, end], times):
            position = recording.end_effectors_W[start:stop, end].mean(axis=0)
            planned = recording.contacts_plan[start:stop, end]
            planned = planned[planned >= 0]
            surface = int(np.bincount(planned).argmax()) if len(planned) else _nearest_surface(scene, position)
            until = float(times[min(stop, len(times) - 1)])
            intervals.append(Interval(end, surface, float(times[start]), until, position, np.eye(3)))
    return intervals


def stretches_of(active: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """First index and the one past the last of every stretch of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], active.astype(int), [0]])))
    return [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def pushes_of(recording: Recording) -> list[tuple[int, int]]:
    """As stretches_of, of samples in which the same push acts, or the same several."""
    force = recording.pushes_W
    found: list[tuple[int, int]] = []
    for start, stop in stretches_of(np.linalg.norm(force, axis=1) > 0.0):
        changes = np.linalg.norm(np.diff(force[start:stop], axis=0), axis=1) > 1e-6
        edges = [start, *(start + 1 + int(i) for i in np.flatnonzero(changes)), stop]
        parts = list(zip(edges[:-1], edges[1:], strict=True))
        if len(parts) > MOST_PUSHES:  # a force that varies
            found.append((start, stop))
            continue
        # Single samples are those in which pushes begin and end.
        longer = [part for part in parts if part[1] - part[0] > 1] or parts[:1]
        begins = [start, *(part[0] for part in longer[1:])]
        found += list(zip(begins, [*begins[1:], stop], strict=True))
    return found


def push_text(recording: Recording, start: int, stop: int) -> str:
    """ "push of 250 N", of one of pushes_of(): half of the samples have as much."""
    return f"push of {np.median(np.linalg.norm(recording.pushes_W[start:stop], axis=1)):.0f} N"


def joined_stretches(active: NDArray[np.bool_], times_s: Array) -> list[tuple[int, int]]:
    """As stretches_of, with gaps of up to SHORT closed."""
    joined: list[tuple[int, int]] = []
    for start, stop in stretches_of(active):
        if joined and times_s[start] - times_s[joined[-1][1]] <= SHORT + 1e-9:
            joined[-1] = (joined[-1][0], stop)
        else:
            joined.append((start, stop))
    return joined


def _nearest_surface(scene: Scene, position_W: Array) -> int:
    """Of contacts that nobody planned: the surface whose plane is nearest."""
    away = []
    for surface in scene.surfaces:
        outline = np.asarray(surface.vertices_W, float)
        away.append(abs(float((position_W - outline[0]) @ polygon_normal(outline))))
    return int(np.argmin(away))


def _rotations(urdf_model: UrdfModel, configurations: Array) -> tuple[Array, Array]:
    """Of the base (n, 3, 3) and of the contact frames (n, e, 3, 3)."""
    import pinocchio as pin  # type: ignore[import-untyped]

    data = urdf_model.model.createData()
    base, soles = [], []
    for q in configurations:
        pin.framesForwardKinematics(urdf_model.model, data, q)
        base.append(data.oMi[1].rotation.copy())
        soles.append([data.oMf[frame].rotation.copy() for frame in urdf_model.frames])
    return np.array(base), np.array(soles)
