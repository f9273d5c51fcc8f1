"""The closed loop of a robot whose steps are given, and planned anew by rhp at each touchdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .horizon_planner import LEAST_S, HorizonPlanner
from .loop import Loop, Pending
from .pacing import TouchdownPace

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .options import OnlineOptions

Array = NDArray[np.float64]

#: Wall clock of a horizon without a fixed latency [s]: less than any swing lasts.
TIME_LIMIT_S = 0.25
#: Most iterations of a horizon with one: most that converge take 30 to 110, and another is asked for where one does not.
ITERATIONS = 150


def _limit_s(online: OnlineOptions) -> float:
    if np.isnan(online.time_limit_s) and not online.fixed_latency:
        return TIME_LIMIT_S
    return online.time_limit_s


def limits(online: OnlineOptions) -> dict[str, float]:
    """Of a horizon, by the names of options of rhp. With a fixed latency runs are the same on every machine."""
    limit_s = _limit_s(online)
    return {"max_iterations": ITERATIONS} if np.isnan(limit_s) else {"time_limit": limit_s}


def computing_s(online: OnlineOptions) -> float:
    """Time that is left for a horizon [s]."""
    return online.latency_s if online.fixed_latency else _limit_s(online)


class HorizonLoop(Loop):
    """One run with rhp. Between touchdowns the plan under way goes on: a horizon of rhp begins on both feet."""

    def _planning(self, plan: Plan, online: OnlineOptions) -> tuple[HorizonPlanner, TouchdownPace]:
        self.horizons = HorizonPlanner(plan, 0.0, computing_s=computing_s(online), **limits(online))
        self.touchdowns = TouchdownPace(online)
        self.feet = [i for i, end in enumerate(plan.robot.end_effectors) if end.kind == "foot"]
        self.reader.of_joints = True
        return self.horizons, self.touchdowns

    def _ask(self, now_s: float, read: tuple[Array, Array], standing: NDArray[np.bool_], touchdown: bool) -> None:
        """Plan a horizon if one is due. The simulation waits, its clock goes on by the latency."""
        under_way = self.plan
        t = now_s - under_way.begins_s
        told = self._for_planner(standing)
        reason = self.touchdowns.due_standing(now_s, touchdown, all(told[foot] for foot in self.feet))
        first = self.horizons.first_step_at(t)
        made = first > self.horizons.first_step  # a foot that lands twice has made one step
        if reason is None or first >= self.horizons.steps or not (made or self.touchdowns.failed):
            return
        state = self.reader.read(now_s, *read, told, under_way.plan, t)
        if self.ground.told(now_s) | self.ground.feel_heights(state, self.controller.speeds_m_s()):
            self._plan_on(self.ground.scene)
        self.horizons.submit(state)
        update = self.horizons.wait()
        assert update is not None
        self.touchdowns.asked(now_s)
        ready_s = now_s + (self.online.latency_s if self.online.fixed_latency else update.took_s)
        ready_s = max(ready_s, update.begins_s) if update.usable else ready_s
        self.tally.computed(update, ready_s - now_s, reason)
        self.pending = Pending(update, ready_s, False)

    def _take_over(self, now_s: float) -> None:
        """Follow the horizon that waits, if its computation is over, in its first phase and while both feet stand.

        Later the weight would have to be where it is not; the plan under way goes on to the next touchdown.
        """
        from mcplan.tracking.contacts import Mode

        pending = self.pending
        if pending is not None and now_s >= pending.ready_s - 1e-9 and pending.update.plan is not None:
            shifts_s = pending.update.plan.knot_times()[1] - LEAST_S
            late = now_s - pending.update.begins_s > shifts_s
            if late or any(self.controller.contacts[foot].mode is Mode.FREE for foot in self.feet):
                self.pending, self.touchdowns.failed = None, True
                return
        before = self.plan
        super()._take_over(now_s)
        if pending is not None and self.pending is None:
            self.touchdowns.failed = self.plan is before
            self.stopping = self.stopping and self.touchdowns.failed
        self._count_stop(now_s)

    def _count_stop(self, now_s: float) -> None:
        """The plan under way is over and steps are left: the robot stands where it is."""
        t = now_s - self.plan.begins_s
        if not self.stopping and t > self.plan.plan.duration() and self.touchdowns.failed:
            if self.horizons.first_step_at(t) < self.horizons.steps:
                self.stopping = True
                self.tally.stops += 1
