"""Planning by rhp beside a controller: one horizon for each touchdown, from the measured state."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan, Polytope, Status, rhp
from mcplan.arguments import require, require_number
from mcplan.errors import InvalidArgument, InvalidInput, InvalidPlan
from mcplan.kinematics.rotations import from_rpy
from mcplan.options import fill

from .planner import MeasuredState, Planner, UnderWay, Update

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene

Array = NDArray[np.float64]

#: Phases of a step: on both feet, on one, on both.
PHASES = 3
#: Options of rhp for walks that are planned while they are walked, unless others are named. Of ``single`` what is predicted
#: can be followed, too, when no horizon comes.
ONLINE: Mapping[str, Any] = {"fidelity": "single", "lookahead": 3, "solver": "ipm"}
#: Range of the duration on both feet, at least [s].
DOUBLE_SUPPORT_S = 0.1
#: A horizon begins at least so long before a foot is lifted [s].
LEAST_S = 0.05
#: By so much a measured start may be beyond a limit that the horizon then keeps: of the CoM's height as a ratio, of angular
#: momentum as a factor.
HEIGHT_SLACK, MOMENTUM_SLACK = 0.005, 1.05
#: And of the reach of the feet [m].
REACH_SLACK_M = 0.005


def online_options(computing_s: float, named: Mapping[str, Any]) -> rhp.Options:
    """Options of walks that are planned while they are walked, a horizon taking so long [s]."""
    options = fill(rhp.Options(), ONLINE)
    low, high = options.double_support_s
    options.double_support_s = (low + computing_s, max(high, low + computing_s + DOUBLE_SUPPORT_S))
    chosen: rhp.Options = fill(options, named)
    return chosen


def steps_of(plan: Plan, first: int, end: int) -> Plan:
    """Steps `first` up to `end` of a plan that rhp has made; it begins at rest or on the way, and time 0."""
    low, high = PHASES * first, PHASES * end
    part = plan.__copy__()
    phases, swings = list(plan.phases), []
    for swing in plan.swings:
        begins, ends = max(swing.first_phase, low), min(swing.end_phase, high)
        if begins < ends:  # hands are free throughout, feet within a step
            moved = swing.__copy__()
            moved.first_phase, moved.end_phase = begins - low, ends - low
            swings.append(moved)
    part.phases, part.knots, part.swings = phases[low:high], list(plan.knots)[low : high + 1], swings
    if high < len(phases):
        part.final_contacts = [contact.surface for contact in phases[high - 1].contacts]
        part.open_end = True
    part.measured_start = plan.measured_start or first > 0
    return part


def steps_made(plan: Plan, t: float) -> int:
    """How many steps of a plan of rhp are made at a time [s] at which both feet stand.

    A foot that is down in the second half of its swing has landed early; in the first half it has not left yet.
    """
    now = int(plan.at(min(max(t, 0.0), float(plan.duration()))).phase)
    step, kind = divmod(now, PHASES)
    times = plan.knot_times()
    landed = kind == 2 or (kind == 1 and t > 0.5 * (times[now] + times[now + 1]))
    return step + int(landed)


def require_steps(plan: Plan) -> None:
    """Raise InvalidPlan where a plan is malformed, or not made of steps as rhp makes them."""
    require("plan", plan, Plan)
    plan.validate()
    if plan.planner != "rhp" or len(plan.phases) % PHASES:
        rule = "must be one of rhp: engine 'rhp' follows its steps; take mcplan.walk(scene, sequence=plan).plan"
        raise InvalidPlan("planner", rule, plan.planner or "none")


class HorizonPlanner(Planner):
    """Plans horizons of rhp in a thread of its own; the order of feet and their surfaces are those of the first plan.

    A horizon of rhp begins on both feet. States with a foot in the air are refused (an update of status ``error``): submit
    one at each touchdown, and follow the plan under way meanwhile.

    Args:
        plan: The plan under way, of rhp; its steps are those that are planned.
        begins_s: Time of the clock at which it began.
        computing_s: Time that a horizon takes: it begins at the state that is predicted for then, as far off the plan under
            way as the measured one, and phases on both feet are longer by as much.
        **named: Options of mcplan.walk by name, among them ``time_limit`` [s].

    Raises:
        InvalidArgument: ``plan`` is no plan, or ``computing_s`` no time.
        InvalidPlan: The plan is malformed, or not made of steps as rhp makes them.
        InvalidOptions: An option of rhp is unknown or out of range.

    Attributes:
        first_step: Which step of the sequence the plan under way begins with.
    """

    def __init__(self, plan: Plan, begins_s: float = 0.0, *, computing_s: float = 0.0, **named: Any) -> None:
        require_steps(plan)
        computing_s = require_number("computing_s", computing_s)
        if not 0.0 <= computing_s < np.inf:
            raise InvalidArgument("computing_s", "must be finite and at least 0", str(computing_s))
        self.sequence, self.first_step = plan, 0
        self._options, self._computing_s = online_options(computing_s, named), computing_s
        self._first_steps: dict[int, int] = {}
        super().__init__(plan, begins_s)

    @property
    def steps(self) -> int:
        """How many steps the sequence has."""
        return len(self.sequence.phases) // PHASES

    def first_step_at(self, t: float) -> int:
        """Which step of the sequence is next at a time [s] of the plan under way at which both feet stand."""
        return self.first_step + steps_made(self.plan, t)

    def take_over(self, update: Update) -> None:
        super().take_over(update)
        self.first_step = self._first_steps.pop(update.ticket, self.first_step)

    def _computed(self, ticket: int, state: MeasuredState, under_way: UnderWay, named: Mapping[str, Any]) -> Update:
        plan, begins_s, _ = under_way
        began = time.perf_counter()
        scene, robot, first = self.scene or self.sequence.scene, self.sequence.robot, self.first_step
        try:
            first += steps_made(plan, state.time_s - begins_s)
            if first >= self.steps:
                raise InvalidInput("state", "must be measured before the last step is made", str(first))
            options = fill(self._options.__copy__(), named)
            state = predicted(state, plan, begins_s, self._computing_s)
            start = start_state(scene, robot, state)
            robot = reaching(robot, start, float(scene.start.yaw))
            planner = rhp.RecedingHorizon(
                scene, robot, steps_of(self.sequence, first, self.steps), within_reach(options, robot, start)
            )
            cycle = planner.step(start)
            new = self._followed(planner.horizon(), first) if cycle.executed else None
        except BaseException as error:  # neither a refused state nor a logger that raises ends the thread
            took_s, text = time.perf_counter() - began, f"{type(error).__name__}: {error}"
            return Update(None, state.time_s, took_s, "error", False, state.time_s, text, "previous_plan", ticket)
        self._first_steps = {ticket: first}
        update = Update(
            plan=new,
            begins_s=state.time_s,
            took_s=time.perf_counter() - began,
            status=cycle.status.name,
            usable=cycle.executed,
            kept_until_s=state.time_s + (float(cycle.duration_s) if cycle.status == Status.solved else 0.0),
            message=cycle.message,
            plan_from=cycle.step_from.name,
            ticket=ticket,
        )
        return update if new is not None else replace(update, plan_from="previous_plan")

    def _followed(self, horizon: Plan, first: int) -> Plan:
        """What of a horizon may be followed: all where it ends at rest, else all but its last step."""
        steps = len(horizon.phases) // PHASES
        whole = first + steps >= self.steps or steps == 1
        return with_bases_of(horizon if whole else steps_of(horizon, 0, steps - 1), self.sequence, first)


def with_bases_of(plan: Plan, sequence: Plan, first: int) -> Plan:
    """The plan with its base turned at its knots as at those of the sequence from step `first` on."""
    turned, knots = plan.__copy__(), []
    for knot, known in zip(plan.knots, list(sequence.knots)[PHASES * first :], strict=False):
        own = knot.__copy__()
        own.base_rpy, own.base_rpy_rate = known.base_rpy, known.base_rpy_rate
        knots.append(own)
    turned.knots = knots
    return turned


def predicted(state: MeasuredState, plan: Plan, begins_s: float, ahead_s: float) -> MeasuredState:
    """The state after a horizon's computation: as far from the plan under way as it is now.

    No later than shortly before a foot leaves the ground, as a horizon begins on both feet.
    """
    t = min(max(state.time_s - begins_s, 0.0), float(plan.duration()))
    until = min(t + ahead_s, max(t, _lifts_s(plan, t) - LEAST_S))
    now, then = plan.at(t), plan.at(until)
    knot = state.knot.__copy__()
    knot.com_W = knot.com_W + then.com_W - now.com_W
    knot.com_velocity_W = knot.com_velocity_W + then.com_velocity_W - now.com_velocity_W
    knot.angular_momentum_W = knot.angular_momentum_W + then.angular_momentum_W - now.angular_momentum_W
    return MeasuredState(state.time_s + until - t, knot, state.contacts)


def _lifts_s(plan: Plan, t: float) -> float:
    """When a foot leaves the ground next after a time of a plan at which both stand, or have landed early [s]."""
    phase = int(plan.at(t).phase)
    step, kind = divmod(phase, PHASES)
    swings = PHASES * (step if kind == 0 else step + 1) + 1
    times = plan.knot_times()
    return float(times[min(swings, len(times) - 1)])


def start_state(scene: Scene, robot: Robot, state: MeasuredState) -> rhp.State:
    """The measured state as rhp takes it; feet lie on the planes of their surfaces.

    Raises:
        InvalidInput: A foot is in the air.
    """
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    knot, places, surfaces = state.knot, [], []
    if len(state.contacts) != len(robot.end_effectors) or len(knot.end_effectors_W) != len(robot.end_effectors):
        raise InvalidInput("state", "must have a place and a contact for each end-effector", str(len(state.contacts)))
    for foot in feet:
        surface = int(state.contacts[foot])
        if surface < 0:
            name = robot.end_effectors[foot].name
            raise InvalidInput("state.contacts", "must have both feet on surfaces: horizons of rhp begin so", name)
        if surface >= len(scene.surfaces):
            raise InvalidInput("state.contacts", "must be indices of surfaces of the scene, or -1", str(surface))
        outline_W = np.asarray(scene.surfaces[surface].vertices_W, float)
        normal = np.cross(outline_W[1] - outline_W[0], outline_W[2] - outline_W[1])
        normal /= np.linalg.norm(normal)
        place = np.asarray(knot.end_effectors_W[foot], float)
        places.append(place - normal * (normal @ (place - outline_W[0])))
        surfaces.append(surface)
    return rhp.State(
        com_W=knot.com_W,
        com_velocity_W=knot.com_velocity_W,
        angular_momentum_W=knot.angular_momentum_W,
        feet_W=places,
        surfaces=surfaces,
    )


def within_reach(options: rhp.Options, robot: Robot, start: rhp.State) -> rhp.Options:
    """Options with a CoM's height and an angular momentum that a measured start does not violate already.

    The first phase may last as long as the landing and the next phase on both feet do in a horizon that is under way.
    """
    chosen = options.__copy__()
    heights = [float(start.com_W[2] - foot[2]) / float(robot.com_height) for foot in start.feet_W]
    low, high = options.com_height
    chosen.com_height = (min(low, min(heights) - HEIGHT_SLACK), max(high, max(heights) + HEIGHT_SLACK))
    largest = float(np.abs(start.angular_momentum_W).max())
    chosen.momentum_max = max(options.momentum_max, MOMENTUM_SLACK * largest)
    chosen.landing_s = max(options.landing_s, options.double_support_s[1])
    return chosen


def reaching(robot: Robot, start: rhp.State, yaw: float) -> Robot:
    """The robot with reach that a measured start is within: sides of boxes and faces of polytopes give way by as much."""
    feet = [i for i, end in enumerate(robot.end_effectors) if end.kind == "foot"]
    level = from_rpy(np.array([0.0, 0.0, yaw]))
    ends = [end.__copy__() for end in robot.end_effectors]
    for foot, partner, place, other in zip(feet, feet[::-1], start.feet_W, list(start.feet_W)[::-1], strict=True):
        end, from_com = ends[foot], level.T @ (np.asarray(place) - start.com_W)
        if end.com_reach.given:
            end.com_reach = _holding(end.com_reach, -from_com)
        else:
            low, high = end.usual_box()
            end.usual_reach = [-np.inf, np.inf]
            end.reach_min_B = np.where(from_com < low, from_com - REACH_SLACK_M, low)
            end.reach_max_B = np.where(from_com > high, from_com + REACH_SLACK_M, high)
            if end.reach_cut.given:
                end.reach_cut = _holding(end.reach_cut, from_com)
        name = ends[partner].name
        if name in end.partner_reach:
            between = level.T @ (np.asarray(other) - np.asarray(place))
            end.partner_reach = {**end.partner_reach, name: _holding(end.partner_reach[name], between)}
    wide = robot.__copy__()
    wide.end_effectors = ends
    return wide


def _holding(polytope: Polytope, point: Array) -> Polytope:
    """The polytope with the faces moved outward that the point is beyond."""
    A, b = np.asarray(polytope.A, float), np.asarray(polytope.b, float)
    return Polytope(A=A, b=np.where(A @ point > b, A @ point + REACH_SLACK_M, b))
