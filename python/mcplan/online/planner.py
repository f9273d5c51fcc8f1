"""A planner beside a controller: measured states go in, plans come out, in a thread of its own."""

from __future__ import annotations

import atexit
import threading
import time
import weakref
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import partial
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import Knot, Plan, PlanFrom, Status
from mcplan._core.online import (
    HEIGHT_MARGIN_M,
    TURN_MARGIN_RAD_S,
    FeltPush,
    com_shift_W,
    follows,
    with_feet_kept_up,
    with_planned_height,
    with_planned_turn,
)
from mcplan.arguments import require, require_number
from mcplan.errors import InvalidInput, InvalidOptions, shown
from mcplan.solve import command_of, replan, replan_options

from .mailbox import Mailbox

if TYPE_CHECKING:
    from mcplan._core import PlanResult, Robot, Scene


@dataclass(frozen=True)
class MeasuredState:
    """What a state estimator says at an instant.

    Attributes:
        time_s: On the clock of the controller.
        knot: CoM, base, momentum and end-effectors.
        contacts: Surface that each end-effector touches, -1: none; indices into the plan's scene.
        push: What pushes the robot, felt by a PushObserver; None: nothing is known to.
    """

    time_s: float
    knot: Knot
    contacts: tuple[int, ...]
    push: FeltPush | None = None


def _require_state(state: MeasuredState) -> None:
    """What the planner says of numbers in it is in the update: here is what is no state at all."""
    if not isinstance(state, MeasuredState):
        raise InvalidInput("state", "must be a MeasuredState", shown(state))
    if not isinstance(state.knot, Knot):
        raise InvalidInput("state.knot", "must be a Knot", shown(state.knot))
    if not isinstance(state.time_s, (int, float, np.number)) or not np.isfinite(state.time_s):
        raise InvalidInput("state.time_s", "must be a finite number", shown(state.time_s))
    if isinstance(state.contacts, (str, bytes)) or not isinstance(state.contacts, Sequence | np.ndarray):
        raise InvalidInput("state.contacts", "must be a surface, or -1, for each end-effector", shown(state.contacts))
    if state.push is not None and not isinstance(state.push, FeltPush):
        raise InvalidInput("state.push", "must be a FeltPush or None", shown(state.push))


@dataclass(frozen=True)
class Update:
    """What came of a replan.

    Attributes:
        plan: The new plan; its time begins when the state was measured. None: there is none, `message` says why.
        begins_s: Time of the clock at which the plan begins: that of the measured state.
        took_s: Wall clock of the computation.
        status: The planner's.
        usable: Whether it is better to follow it than to stay with the plan under way.
        kept_until_s: Time of the clock until which all limits are kept.
        message: What the planner says.
        plan_from: Where the plan comes from.
        ticket: Number of the submitted state, counted from 1.
        com_shift_W: What the plan's CoM is beside the robot's [m], while it is pushed: references of the CoM are the plan's
            less this.
    """

    plan: Plan | None
    begins_s: float
    took_s: float
    status: str
    usable: bool
    kept_until_s: float
    message: str
    plan_from: str
    ticket: int
    com_shift_W: tuple[float, float, float] = (0.0, 0.0, 0.0)


#: The plan under way, when it began [s], and whether the checker has accepted it to its end.
UnderWay = tuple[Plan, float, bool]
#: A state, and options for this time only.
Request = tuple[MeasuredState, Mapping[str, Any]]


class Planner:
    """Replans from measured states in a thread of its own; the GIL is released meanwhile.

    A state that is submitted while the planner computes waits, and replaces one that waits already. Plans are made from
    the plan under way, which is what ``take_over`` said last.

    Args:
        plan: The plan under way.
        begins_s: Time of the clock at which it began.
        command: Velocity to walk at, ahead, to the left [m/s] and turning [rad/s]; None: to the scene's goal.
        period_s: How often states are submitted: a plan that was cut short is worth following if it is good for twice
            that.
        height_margin_m: Where the CoM's height is off the planned one by less than this [m], new plans begin at the latter: a
            controller holds it with a small error, a robot with a payload for example hangs lower, and plan after plan
            that begins there sinks. 0: as measured.
        **named: Options of mcplan.replan by name, among them ``time_limit`` [s]. ``recovery_first`` is on here;
            ``previous_accepted`` is about ``plan`` alone, what is taken over says by its status whether it was accepted. And
            ``turn_margin_rad_s``: what the base turns otherwise than planned counts in new plans less this [rad/s], or not at
            all, since a controller turns back what a landing or a swing does to it. 0: as measured.

    Attributes:
        command: May be changed at any time; it holds for what is computed from then on.
        scene: Instead of the plan's own, for ground that was measured anew; None: the plan's own.
        robots: Robots to plan for, one after the other until a plan is usable: after the plan's own, one with wider limits,
            whose feet may step across each other.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidInput: ``begins_s`` is not finite.
        InvalidOptions: No such option, or its value is out of range.
    """

    def __init__(
        self,
        plan: Plan,
        begins_s: float = 0.0,
        *,
        command: tuple[float, float, float] | None = None,
        period_s: float = 0.1,
        height_margin_m: float = HEIGHT_MARGIN_M,
        **named: Any,
    ) -> None:
        require("plan", plan, Plan)
        if not np.isfinite(require_number("begins_s", begins_s)):
            raise InvalidInput("begins_s", "must be finite", shown(begins_s))
        if not 0.0 < require_number("period_s", period_s) < np.inf:
            raise InvalidOptions("period_s", "must be positive", shown(period_s))
        if not require_number("height_margin_m", height_margin_m) >= 0.0:
            raise InvalidOptions("height_margin_m", "must be 0 at least", shown(height_margin_m))
        turn_margin_rad_s = named.pop("turn_margin_rad_s", TURN_MARGIN_RAD_S)
        if not require_number("turn_margin_rad_s", turn_margin_rad_s) >= 0.0:
            raise InvalidOptions("turn_margin_rad_s", "must be 0 at least", shown(turn_margin_rad_s))
        command_of(command)
        replan_options(named)
        # One object, as all of it changes at once beside the thread.
        self._under_way: UnderWay = plan, float(begins_s), bool(named.get("previous_accepted", False))
        self.command, self.period_s = command, period_s
        self._height_margin_m, self._turn_margin_rad_s = float(height_margin_m), float(turn_margin_rad_s)
        self.scene: Scene | None = None
        self.robots: list[Robot] = [plan.robot]
        self._named: Mapping[str, Any] = named
        self._mailbox: Mailbox[Request, Update] = Mailbox()
        work = partial(_work, weakref.ref(self), self._mailbox)
        self._thread = threading.Thread(target=work, name="mcplan.online", daemon=True)
        _running[self._thread] = self._mailbox
        self._thread.start()
        # A planner that nobody uses any more ends its thread, closed or not.
        weakref.finalize(self, self._mailbox.close).atexit = False

    @property
    def plan(self) -> Plan:
        """The plan under way."""
        return self._under_way[0]

    @property
    def begins_s(self) -> float:
        """Time of the clock at which it began [s]."""
        return self._under_way[1]

    @property
    def busy(self) -> bool:
        """Whether a state waits or is computed from."""
        return self._mailbox.busy

    def submit(self, state: MeasuredState, **named: Any) -> int:
        """Ask for a plan from a measured state.

        Args:
            state: The state.
            **named: Options of mcplan.replan by name, for this time only.

        Returns:
            The number that the update will have, unless a later state replaces this one.

        Raises:
            InvalidInput: The planner is closed, or the state is none.
            InvalidOptions: No such option, or its value is out of range.
        """
        _require_state(state)
        replan_options(named)
        if state.push is not None:  # an observer's goes on
            state = replace(state, push=copy(state.push))
        return self._mailbox.submit((state, named))

    def poll(self) -> Update | None:
        """The latest update that has not been handed out yet; None: there is none. Returns at once."""
        return self._mailbox.poll()

    def wait(self, timeout_s: float | None = None) -> Update | None:
        """The same, after whatever was submitted is computed, or the time is over."""
        return self._mailbox.wait(timeout_s)

    def take_over(self, update: Update) -> None:
        """The controller follows this update from now on: the next plans are made from it.

        What was solved is not looked at again (``previous_accepted`` of mcplan.replan).

        Raises:
            InvalidArgument: It is no Update, or what it has for a plan and its begin is none.
            InvalidInput: It has no plan, or begins at no finite time.
        """
        require("update", update, Update)
        if update.plan is None:
            raise InvalidInput("update", "must have a plan", update.message)
        require("update.plan", update.plan, Plan)
        if not np.isfinite(require_number("update.begins_s", update.begins_s)):
            raise InvalidInput("update.begins_s", "must be finite", shown(update.begins_s))
        self._under_way = update.plan, float(update.begins_s), update.status == Status.solved.name

    def close(self) -> None:
        """End the thread after what it computes now."""
        self._mailbox.close()
        self._thread.join()

    def __enter__(self) -> Planner:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        self.close()

    def _update(self, ticket: int, request: Request) -> Update:
        state, named = request
        return self._computed(ticket, state, self._under_way, {**self._named, **named})

    def _computed(self, ticket: int, state: MeasuredState, under_way: UnderWay, named: Mapping[str, Any]) -> Update:
        plan, begins_s, accepted = under_way
        began = time.perf_counter()
        found: PlanResult | None = None
        try:
            t_now = state.time_s - begins_s
            if t_now < -self.period_s:
                raise InvalidInput(
                    "state.time_s", f"must be no earlier than the plan under way, {begins_s:.6g}", shown(state.time_s)
                )
            t = min(max(t_now, 0.0), float(plan.duration()))
            knot, shift_W = self._beside(state, plan)
            knot = with_planned_height(knot, plan, t_now, self._height_margin_m)
            knot = with_planned_turn(knot, plan, t_now, self._turn_margin_rad_s)
            for i, robot in enumerate(self.robots):
                # While it is pushed, every new plan takes the push for over. Robots after the first are for emergencies.
                told = {"recovery_first": True, "crossing": i > 0, **named, "previous_accepted": accepted}
                result = replan(plan, t, knot, state.contacts, self.command, self.scene, robot, told)
                usable = follows(result.report, self.period_s)
                if found is None or (usable and not follows(found.report, self.period_s)):
                    found = result
                # One that keeps all limits for a while only, that stops, or that does not quite catch the robot is second
                # to one that leads on to the end within wider limits.
                second = result.report.plan_from == PlanFrom.stop or (
                    result.report.plan_from == PlanFrom.recovery and result.report.status != Status.solved
                )
                if usable and result.report.status != Status.infeasible and not second:
                    found = result
                    break
            if found is None:
                raise InvalidInput("robots", "must be one at least", "none")
            new = with_feet_kept_up(found.plan) if found.plan.phases else None
        except BaseException as error:  # neither a refused state nor a logger that raises ends the thread
            took_s, text = time.perf_counter() - began, f"{type(error).__name__}: {error}"
            return Update(None, state.time_s, took_s, "error", False, state.time_s, text, "previous_plan", ticket)
        took_s, report = time.perf_counter() - began, found.report
        return Update(
            plan=new,
            begins_s=state.time_s,
            took_s=took_s,
            status=report.status.name,
            usable=follows(report, self.period_s),
            kept_until_s=state.time_s + float(report.kept_until_s),
            message=report.message,
            plan_from=report.plan_from.name,
            ticket=ticket,
            com_shift_W=shift_W,
        )

    def _beside(self, state: MeasuredState, plan: Plan) -> tuple[Knot, tuple[float, float, float]]:
        """The state to plan from while a push is felt, and how far its CoM is beside the measured one (3,) [m]."""
        gravity = plan.scene.gravity if self.scene is None else self.scene.gravity
        shift_W = com_shift_W(state.push or FeltPush(), plan.robot.com_height, gravity)
        knot = state.knot.__copy__()
        knot.com_W = knot.com_W + shift_W
        return knot, (float(shift_W[0]), float(shift_W[1]), float(shift_W[2]))


#: Threads of planners and what ends them.
_running: weakref.WeakKeyDictionary[threading.Thread, Mailbox[Request, Update]] = weakref.WeakKeyDictionary()


@atexit.register
def _end_all() -> None:
    """When Python ends, what computes without the GIL must have ended: it could not take it any more."""
    running = list(_running.items())
    for _, mailbox in running:
        mailbox.close()
    for thread, _ in running:
        if thread.is_alive():
            thread.join()


def _work(planner: weakref.ref[Planner], mailbox: Mailbox[Request, Update]) -> None:
    """What the thread of a planner does: it knows the planner only while it computes."""

    def update(ticket: int, request: Request) -> Update | None:
        at_work = planner()
        return None if at_work is None else at_work._update(ticket, request)

    mailbox.serve(update)
