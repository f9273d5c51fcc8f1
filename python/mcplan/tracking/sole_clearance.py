"""Soles and hands of postures against the solids below a scene's surfaces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .findings import Finding
from .solids import Solids

if TYPE_CHECKING:
    from mcplan._core import Scene
    from mcplan.kinematics.inverse_kinematics import Postures
    from mcplan.kinematics.samples import Interval, Samples
    from mcplan.kinematics.urdf_model import UrdfModel

Array = NDArray[np.float64]

#: Depth in a solid that is accepted [m]: 5 mm as in the check of plans, and what postures may add to it.
DEPTH = 0.006
#: Between two postures, to see edges that a sole passes.
CUTS = 5
#: Part of a swing at its begin and end in which a sole is near to what it leaves and reaches.
NEAR_GROUND = 0.1
#: Solids farther than this are looked at only where none is nearer [m].
NEAR_M = 0.5
#: Points of a sole along each side: an edge may come up between its corners.
GRID = (7, 3)


def clearance_findings(
    scene: Scene, urdf_model: UrdfModel, samples: Samples, postures: Postures, final_contacts: list[int]
) -> list[Finding]:
    """How deep each end-effector enters a solid, in the air ("clearance") and at rest ("foothold"); negative: above.

    In the air, what a foot leaves and reaches counts between 10 % and 90 % of the swing, other solids always. At rest,
    the surface in contact does not count.

    Args:
        scene: Its surfaces are the tops of the solids.
        urdf_model: The robot's model; its end-effectors are those of the samples.
        samples: The plan.
        postures: That follow it.
        final_contacts: Surface with which each end-effector is in contact after the last sample, -1: none.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    solids, findings = Solids(scene), []
    data = urdf_model.model.createData()
    times, placements = _placements(pin, urdf_model, data, samples, postures)
    for end, end_effector in enumerate(urdf_model.robot.end_effectors):
        half = np.asarray(end_effector.half_size, float)
        sole = np.array(
            [[x, y, 0.0] for x in half[0] * np.linspace(-1, 1, GRID[0]) for y in half[1] * np.linspace(-1, 1, GRID[1])]
        )
        own = [i for i in samples.intervals if i.end_effector == end]
        deepest: dict[str, tuple[float, float, str]] = {}
        for time, row in zip(times, placements, strict=True):
            name, ignored = _ignored(own, float(time), float(times[-1]), final_contacts[end])
            rotation, position = row[end]
            points = position + sole @ rotation.T
            clearances = solids.clearances(points, solids.near(points, NEAR_M)).min(axis=0)
            clearances[ignored] = np.inf
            nearest = int(np.argmin(clearances))
            depth = -float(clearances[nearest])
            if name not in deepest or depth > deepest[name][0]:
                deepest[name] = (depth, float(time), solids.names[nearest])
        for name, (depth, time, surface) in deepest.items():
            if end_effector.kind == "foot" or name == "clearance":
                if np.isfinite(depth):
                    findings.append(Finding(name, depth, DEPTH, "m", end_effector.name, time, f"surface {surface}"))
    return findings


def _placements(
    pin: Any, urdf_model: UrdfModel, data: Any, samples: Samples, postures: Postures
) -> tuple[Array, list[Any]]:
    """Rotation and position of every end-effector, at the postures and between them."""
    times, placements = [], []
    for n, q in enumerate(postures.configurations):
        last = n + 1 == samples.count
        for cut in range(1 if last else CUTS):
            fraction = cut / CUTS
            between = q if cut == 0 else pin.interpolate(urdf_model.model, q, postures.configurations[n + 1], fraction)
            pin.framesForwardKinematics(urdf_model.model, data, between)
            placements.append(
                [(data.oMf[f].rotation.copy(), data.oMf[f].translation.copy()) for f in urdf_model.frames]
            )
            times.append(
                samples.times_s[n] + (0.0 if last else fraction * (samples.times_s[n + 1] - samples.times_s[n]))
            )
    return np.array(times), placements


def _ignored(own: list[Interval], time: float, end: float, final: int) -> tuple[str, list[int]]:
    """ "foothold" or "clearance" at a time, and the surfaces that do not count then."""
    for interval in own:
        if interval.start_s - 1e-9 <= time <= interval.end_s + 1e-9:
            return "foothold", [interval.surface]
    before = [i for i in own if i.end_s < time]
    after = [i for i in own if i.start_s > time]
    start, until = before[-1].end_s if before else 0.0, after[0].start_s if after else end
    margin = NEAR_GROUND * (until - start)
    ignored = [before[-1].surface] if before and time < start + margin else []
    reached = after[0].surface if after else final
    return "clearance", ignored + ([reached] if reached >= 0 and time > until - margin else [])
