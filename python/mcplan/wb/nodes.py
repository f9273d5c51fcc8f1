"""What a plan asks of a motion at its nodes: contacts, swings, CoM, and how the base is rotated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.kinematics.samples import Interval, Samples, knots_and_between, sample_at

if TYPE_CHECKING:
    from mcplan._core import Plan

Array = NDArray[np.float64]

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
    """

    samples: Samples
    base_zyx: Array
    contacts: NDArray[np.int32]
    intervals: list[list[Interval | None]]
    first: NDArray[np.bool_]
    last: NDArray[np.bool_]

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

    def flies(self, k: int) -> bool:
        """Whether nothing is in contact at a node."""
        return all(interval is None for interval in self.intervals[k])


def nodes_of(plan: Plan, step_s: float) -> Nodes:
    """Nodes at all knots of a plan and in equal steps of at most step_s between them."""
    times = knots_and_between(plan, 1.0 / step_s)
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
    return Nodes(samples, np.unwrap(rpy[:, ::-1], axis=0), contacts, intervals, first, last)
