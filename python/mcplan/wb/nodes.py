"""What a plan asks of a motion at its nodes: contacts, swings, CoM, and how the base is rotated."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidPlan
from mcplan.kinematics.samples import Interval, Samples, sample_at

from .motion_fields import MAX_NODES

if TYPE_CHECKING:
    from mcplan._core import Plan

Array = NDArray[np.float64]

#: Steps in flights and in the phases beside them [s].
FLIGHT_S = 0.01
#: Between two nodes of a motion that is found, at most [s].
FINEST_S = 0.005
#: Parts of a swing at its begin and end in which feet go up and down alone.
UPRIGHT = 0.06
#: Where the middle of a swing begins.
MIDDLE = 0.4
#: Instants so near to each other are one [s].
SAME_S = 1e-9


@dataclass(frozen=True)
class Nodes:
    """A plan at the nodes of a motion, n + 1 instants, e end-effectors.

    Attributes:
        samples: The plan there.
        base_zyx: (n + 1, 3) angles of the base about z, y, x [rad], without jumps.
        contacts: (n, e) surface in contact between nodes, -1: none.
        intervals: Of each end-effector and node the contact that it is in, both ends included; None: free.
        first: (n + 1, e) whether the contact is made there, and last whether it is broken.
        begun_s: (e,) for how long swings have been under way where the plan starts, 0: none is, as far as the plan says.
        swings_W: (n + 1, e, 3) where feet in the air are to be: as high as in the plan, but they go sideways a little
            later and are there a little earlier, so that they pass edges near their footholds from above.
    """

    samples: Samples
    base_zyx: Array
    contacts: NDArray[np.int32]
    intervals: list[list[Interval | None]]
    first: NDArray[np.bool_]
    last: NDArray[np.bool_]
    begun_s: Array
    swings_W: Array

    @property
    def count(self) -> int:
        return self.samples.count

    @property
    def times_s(self) -> Array:
        return self.samples.times_s

    def carries(self, k: int, end: int) -> bool:
        """Whether a force acts on an end-effector at a node: not where its contact is made or broken."""
        if self.intervals[k][end] is None:
            return False
        return (not self.first[k, end] or k == 0) and (not self.last[k, end] or k == self.count - 1)

    def swung(self, k: int, end: int) -> float:
        """How far a swing has got at a node, 0 to 1; of one whose begin or end the plan does not say 0."""
        start, stop = self.swing(k, end)
        return (float(self.times_s[k]) - start) / (stop - start) if stop > start else 0.0

    def swing(self, k: int, end: int) -> tuple[float, float]:
        """When a swing begins and ends [s]; the same time twice: it does not, as far as the plan says.

        One that is under way where the plan starts has begun before, at a negative time.
        """
        before, after = (int(at[k, end]) for at in self._contacts_beside)
        if after == self.count or (before < 0 and self.begun_s[end] == 0.0):
            return 0.0, 0.0
        return -float(self.begun_s[end]) if before < 0 else float(self.times_s[before]), float(self.times_s[after])

    @cached_property
    def _contacts_beside(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """(n + 1, e) the last node up to each that an end-effector is in contact at, -1: none, and the first from it on."""
        standing = np.array([[interval is not None for interval in own] for own in self.intervals])
        at = np.arange(self.count)[:, None]
        before = np.maximum.accumulate(np.where(standing, at, -1), axis=0)
        after = np.minimum.accumulate(np.where(standing, at, self.count)[::-1], axis=0)[::-1]
        return before, after

    def middle(self, k: int, end: int) -> float:
        """1 in the middle of a swing, and nothing at its ends, where plans accelerate as no joint can follow."""
        ratio = self.swung(k, end)
        return float(min(1.0, min(ratio, 1.0 - ratio) / MIDDLE) ** 2)

    def flies(self, k: int) -> bool:
        """Whether nothing is in contact at a node."""
        return all(interval is None for interval in self.intervals[k])


def require_few(plan: Plan, step_s: float) -> None:
    """Raise InvalidPlan for a plan so long that its motion would have too many nodes, before there are any."""
    durations = np.diff(np.array(plan.knot_times(), float))
    count = float(np.ceil(durations / min(step_s, FINEST_S)).sum()) + 1.0
    if not count <= MAX_NODES:
        rule = f"must be short enough for a motion of {MAX_NODES} nodes, which are {min(step_s, FINEST_S):g} s apart"
        raise InvalidPlan("plan", rule, f"{plan.duration():.6g} s")


def nodes_of(plan: Plan, step_s: float, in_time: Callable[[], None] = lambda: None) -> Nodes:
    """Nodes at all knots of a plan and in equal steps of at most step_s between them, in and beside flights of FLIGHT_S.

    Args:
        plan: The plan.
        step_s: Largest time between two nodes [s].
        in_time: Called now and then; what it raises ends this.
    """
    times = _times(plan, step_s)
    times = times[np.concatenate([[True], np.diff(times) > SAME_S])]
    times[-1] = plan.duration()
    samples = sample_at(plan, plan.scene, plan.robot, times)
    ends = len(plan.robot.end_effectors)
    intervals: list[list[Interval | None]] = [[None] * ends for _ in times]
    contacts = np.full((len(times) - 1, ends), -1, np.int32)
    first, last = np.zeros((len(times), ends), bool), np.zeros((len(times), ends), bool)
    for interval in samples.intervals:
        inside = np.flatnonzero((times >= interval.start_s - SAME_S) & (times <= interval.end_s + SAME_S))
        end = interval.end_effector
        for k in inside:
            intervals[k][end] = interval
        contacts[inside[:-1], end] = interval.surface
        first[inside[0], end] = last[inside[-1], end] = True
    rpy = np.array([plan.at(float(t)).base_rpy for t in times])
    zyx = np.unwrap(rpy[:, ::-1], axis=0)
    begun = np.zeros(ends)
    for swing in plan.swings:
        if swing.first_phase == 0:
            begun[swing.end_effector] = swing.elapsed_s
    nodes = Nodes(samples, zyx, contacts, intervals, first, last, begun, samples.positions_W.copy())
    _go_upright(plan, nodes, in_time)
    return nodes


def _times(plan: Plan, step_s: float) -> Array:
    knots = np.array(plan.knot_times(), float)
    flies = np.array([all(contact.surface < 0 for contact in phase.contacts) for phase in plan.phases])
    beside = flies.copy()
    beside[1:] |= flies[:-1]
    beside[:-1] |= flies[1:]
    parts = [knots[:1]]
    for start, end, fine in zip(knots[:-1], knots[1:], beside, strict=True):
        step = min(step_s, FLIGHT_S) if fine else step_s
        parts.append(np.linspace(start, end, max(1, int(np.ceil((end - start) / step - SAME_S))) + 1)[1:])
    return np.concatenate(parts)


def _go_upright(plan: Plan, nodes: Nodes, in_time: Callable[[], None]) -> None:
    """Let feet move sideways only between the parts UPRIGHT and 1 - UPRIGHT of their swings."""
    for k in range(nodes.count):
        in_time()
        for end, interval in enumerate(nodes.intervals[k]):
            start, stop = (0.0, 0.0) if interval is not None else nodes.swing(k, end)
            if stop > start and plan.robot.end_effectors[end].kind == "foot":
                ratio = np.clip(
                    (nodes.times_s[k] - start - UPRIGHT * (stop - start)) / (1.0 - 2.0 * UPRIGHT), 0.0, stop - start
                )
                at = plan.at(max(0.0, start + float(ratio))).end_effectors[end].position_W
                nodes.swings_W[k, end, :2] = at[:2]
