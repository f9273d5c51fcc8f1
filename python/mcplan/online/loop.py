"""The steps of a closed loop: what is measured, when it is planned from, what is followed."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan, Scene
from mcplan._core.online import com_shift_W
from mcplan.errors import InvalidInput
from mcplan.tracking.interruption import Interruption
from mcplan.tracking.measures import at_torque_limit, measure, with_touches
from mcplan.tracking.options import Options, Push
from mcplan.tracking.recorder import Acting
from mcplan.tracking.references import references
from mcplan.tracking.robot_dynamics import RobotDynamics
from mcplan.tracking.runner import CONTACT_RATIO, posture_at
from mcplan.tracking.sensors import Sensors
from mcplan.tracking.separation import Separation

from .choice import longer, misses_at_once
from .contacts import ContactFilter
from .ending import fallen, length_of
from .goals import Aim
from .kept import Kept
from .known_ground import KnownGround
from .measures import Tally
from .options import OnlineOptions
from .pacing import Pace, distances, steps_left
from .planner import Planner, Update
from .reach import lifting, widened
from .result import FollowedPlan, RunResult
from .state import StateReader
from .steering import ALONE, Beside, as_it_was, steered

if TYPE_CHECKING:
    from mcplan.tracking.controller import Controller
    from mcplan.tracking.simulation import Simulation

Array = NDArray[np.float64]

#: For so long at most a late end-effector comes down before there is another plan [s].
SEARCH_S = 0.25
#: Force over the weight from which on a contact says how slippery its surface is.
PRESSES_RATIO = 0.05
#: Velocity to a side from which on wide reach is planned with first, for a robot of human size [m/s].
ASIDE_M_S = 0.055
#: Velocity of a robot that is to stand.
STAND = (0.0, 0.0, 0.0)
#: Height of the CoM of a robot of human size [m].
HUMAN_M = 0.88
#: A contact is one that the first plan had if it is within this distance of it [m].
SAME_PLACE_M = 0.05


@dataclass
class Pending:
    """An update, when it may be taken over, which is when its computation is over, and whether it is better not followed."""

    update: Update
    ready_s: float
    needless: bool


class Loop:
    """One run."""

    def __init__(
        self,
        plan: Plan,
        simulation: Simulation,
        options: Options,
        online: OnlineOptions,
        true_scene: Scene | None,
        beside: Beside = ALONE,
    ) -> None:
        from mcplan.tracking.controller import Controller, Restraints

        self.first_plan, self.simulation, self.options, self.online = plan, simulation, options, online
        self.urdf_model = simulation.model.urdf_model
        self.robot, self.dt_s, self.length_s = (
            self.urdf_model.robot,
            options.control_step_s,
            length_of(plan, options, online, beside.steer is not None),
        )
        start = posture_at(self.urdf_model, plan, 0.0)
        on_ground = start.copy()
        on_ground[2] += options.ground_shift_m
        simulation.reset(on_ground, np.zeros(self.urdf_model.model.nv))
        separation = Separation(simulation.model, true_scene is None) if options.self_contacts else None
        restraints = Restraints(simulation.model.motors, separation)
        desired = references(plan, self.robot, self.dt_s, options.hold_s)
        self.controller: Controller = Controller(self.urdf_model, plan.scene, desired, start, options.gains, restraints)
        self.actual = RobotDynamics(self.urdf_model)
        weight_N = self.actual.mass * plan.scene.gravity
        self.contact_N = CONTACT_RATIO * weight_N
        standing = desired.surfaces[0] >= 0
        self.true_scene = true_scene
        self.ground = KnownGround(plan.scene, true_scene, online, len(standing), PRESSES_RATIO * weight_N)
        self.in_contact = standing  # by the forces of this control step
        self.contacts = ContactFilter(standing, 2.0 * self.contact_N, self.contact_N)
        self.reader = StateReader(self.robot, self.urdf_model)
        self.sensors = Sensors(options.sensor_noise, options.noise_seed)
        self.planner, self.pace = self._planning(plan, online)
        self.tally = Tally(online.latency_s)
        self.pending: Pending | None = None
        self.failing_s, self.stopping = (
            np.inf,
            False,
        )  # since when no plan could be followed; whether to come to a stand
        self.aim = Aim(plan.scene, self.robot)
        self.late_s = np.inf  # since when an end-effector is late
        self.other_ground = False  # what the plan under way does not know yet
        self.steps = int(np.ceil(self.length_s / self.dt_s - 1e-9)) + 1
        self.kept = Kept(plan, self.urdf_model, simulation.model.joints, desired, self.steps, online.keep_s)
        self.failures, self.control_s = 0, 0.0
        self.beside, self.ends = beside, False
        self.pushes: list[Push] = []
        self.pushes_known = 0

    def _planning(self, plan: Plan, online: OnlineOptions) -> tuple[Planner, Pace]:
        """Who replans, and when."""
        limit_s = online.time_limit_s
        if np.isnan(limit_s) and not online.fixed_latency:
            limit_s = online.period_s
        named = {"start_slack_s": online.start_slack_s * np.sqrt(plan.robot.com_height / HUMAN_M)}
        if not np.isnan(limit_s):
            named["time_limit"] = limit_s
        planner = Planner(plan, 0.0, command=None, period_s=online.period_s, **named)
        self.reaches = self.known_reaches = [plan.robot, *([widened(plan.robot)] if online.wide_reach else [])]
        return planner, Pace(online)

    @property
    def plan(self) -> FollowedPlan:
        """The one under way."""
        return self.kept.plans[-1]

    def run(self, stop: Interruption) -> RunResult:
        """Go on until the end, a fall, or Ctrl-C."""
        fell_at, began, n = np.inf, time.perf_counter(), 0
        for n in range(self.steps):
            now_s = n * self.dt_s
            dynamics = self._step(n, now_s)
            if self.simulation.broke or fallen(dynamics, self.robot):
                fell_at = now_s
                break
            if stop.asked or self._over(now_s):
                break
            if self.beside.progress is not None and n % 50 == 0:
                planned_s = self.plan.begins_s + self.plan.plan.duration() + self.options.hold_s
                self.beside.progress(now_s, min(self.length_s, planned_s))
        return self._result(n, fell_at, time.perf_counter() - began, stop.asked)

    def _step(self, n: int, now_s: float) -> RobotDynamics:
        """One control step."""
        if self.beside.steer is not None:
            self.options, self.online, self.ends = steered(self.beside.steer, now_s, self.options, self.online)
        simulation, options = self.simulation, self.options
        state = simulation.state()
        forces, touches = simulation.contact_forces_W(), simulation.touches()
        read = self.sensors.read(*state)
        before = self.contacts.in_contact
        standing = self.contacts.update(now_s, forces)
        self._take_over(now_s)
        tick = time.perf_counter()
        in_contact = self.in_contact = np.linalg.norm(forces, axis=1) > self.contact_N
        command = self.controller.step(n, *read, in_contact)
        self.control_s += time.perf_counter() - tick
        self.failures += not command.solved
        dynamics = self.controller.dynamics
        self._touchdowns(before, standing, dynamics)
        self._feel_slips(forces)
        if self.online.replanning and self.pending is None and not self._searching(now_s):
            self._ask(now_s, read, standing, bool((standing & ~before).any()))
        if options.sensor_noise > 0.0:  # what is recorded is what the robot does, not what the controller reads
            dynamics = self.actual
            dynamics.update(*state)
        if self.beside.watch is not None:
            self.beside.watch(now_s, state[0], self.plan.plan)
        push = sum((p.force_W(now_s, self.dt_s) for p in self._acting(now_s)), np.zeros(3))
        steps = round(self.dt_s / options.simulation_step_s)
        given = simulation.advance(command.torques, np.concatenate([push, np.zeros(3)]), steps)
        acting = Acting(given, forces, in_contact, np.zeros(6), push, touches)
        self.kept.add(self.controller.row(n), dynamics, acting)
        if steps_left(self.plan.plan, now_s - self.plan.begins_s):
            self.tally.oldest_s = max(self.tally.oldest_s, now_s - self.plan.begins_s)
        return dynamics

    def _acting(self, now_s: float) -> list[Push]:
        """Pushes but for those that are over."""
        asked = self.options.pushes
        self.pushes += asked[self.pushes_known :]
        self.pushes_known = len(asked)
        self.pushes = [push for push in self.pushes if now_s < push.at_s + push.duration_s]
        return self.pushes

    def _searching(self, now_s: float) -> bool:
        """Whether a late end-effector comes down on ground that is lower than planned: a new plan would hold it up again."""
        from mcplan.tracking.contacts import Mode

        late = any(contact.mode is Mode.SEARCH for contact in self.controller.contacts)
        self.late_s = (now_s if np.isinf(self.late_s) else self.late_s) if late else np.inf
        return late and now_s - self.late_s < SEARCH_S

    def _ask(self, now_s: float, read: tuple[Array, Array], standing: NDArray[np.bool_], touchdown: bool) -> None:
        """Submit the state if a replan is due. The simulation waits, its clock goes on by the latency."""
        under_way, push = self.plan, self.controller.unknown.push
        com_W, velocity_W = self.controller.dynamics.com_W, self.controller.dynamics.com_velocity_W
        # Plans begin beside the measured CoM while a push is felt: it is there that the robot leaves them or does not.
        beside_W = com_W + com_shift_W(push, under_way.plan.robot.com_height, under_way.plan.scene.gravity)
        t = now_s - under_way.begins_s
        self._set_goal(now_s)
        self.pace.new_goal = self.aim.open
        self.pace.commanded = self.online.command_at(now_s) is not None
        reason = self.pace.due(now_s, touchdown, under_way.plan, t, beside_W, velocity_W)
        if reason is None:
            return
        state = self.reader.read(now_s, *read, self._for_planner(standing), under_way.plan, t)
        state = replace(state, push=push)
        heading = float(state.knot.base_rpy[2])
        self.planner.command = self._command(now_s, com_W, heading)
        told = self.ground.told(now_s)
        self.other_ground |= told
        if told | self.ground.feel_heights(state, self.controller.speeds_m_s()):
            self._plan_on(self.ground.scene)
            self.reaches = [lifting(robot, self.ground.unevenness_m()) for robot in self.known_reaches]
        # Near the goal the phases that are left are enough, unless the robot has to catch itself.
        leads_on = self.planner.command is None and not self.aim.open and not self.other_ground
        few = reason in ("period", "touchdown") and leads_on
        named = {"phases_min": 1} if few else {}
        self._choose_reach()
        self.planner.submit(state, **{**named, **self.aim.phases(com_W, heading)})
        update = self.planner.wait()
        assert update is not None
        self.pace.asked(now_s)
        latency_s = self.online.latency_s if self.online.fixed_latency else update.took_s
        self.tally.computed(update, latency_s, reason)
        off_m = distances(under_way.plan, t, beside_W, velocity_W)
        on_plan = off_m[0] < self.online.com_margin_m and off_m[1] < self.online.capture_margin_m
        needless = few and update.usable and update.plan is not None and longer(update.plan, under_way.plan, t)
        needless |= few and on_plan and misses_at_once(update, t, self.online.period_s)
        self.pending = Pending(update, now_s + latency_s, needless)

    def _choose_reach(self) -> None:
        """Under a command to a side plan with wide reach first: boxes bound strides there more than joints do."""
        command = self.planner.command
        aside_m_s = ASIDE_M_S * np.sqrt(self.first_plan.robot.com_height / HUMAN_M)
        aside = command is not None and abs(command[1]) > aside_m_s
        self.planner.robots = self.reaches[::-1] if aside else self.reaches

    def _feel_slips(self, forces_W: Array) -> None:
        """Plan and control with less friction where an end-effector slips."""
        controller = self.controller
        slippery = self.ground.feel_slips(controller.surfaces_now(), list(forces_W), controller.sole_velocities_W())
        for surface, friction in slippery.items():
            controller.set_friction(surface, friction)
        if slippery:
            self.pace.slipped = True
            self._plan_on(self.ground.scene)

    def _set_goal(self, now_s: float) -> None:
        """Plan to another goal if one holds by now and no command does."""
        if self.online.command_at(now_s) is not None:
            return
        if self.aim.ask(self.online.goal_at(now_s), self.controller.dynamics.com_W, self._heading()):
            self._plan_on(self.ground.scene)

    def _heading(self) -> float:
        """Of the base [rad]."""
        base_WB = self.controller.dynamics.base_WB
        return float(np.arctan2(base_WB[1, 0], base_WB[0, 0]))

    def _plan_on(self, scene: Scene) -> None:
        """Plan on this ground from now on."""
        self.planner.scene = self.aim.on(scene)

    def _command(self, now_s: float, com_W: Array, heading: float) -> tuple[float, float, float] | None:
        """The velocity that is asked for or leads towards a goal, or a stand where no plan has come for long."""
        if now_s - self.failing_s > self.online.stop_after_s:
            self.tally.stops += not self.stopping
            self.stopping = True
        command = self.online.command_at(now_s)
        self.aim.steering &= command is None
        if self.aim.steering:
            command = self.aim.velocity(now_s, com_W, heading)
            if command is None:
                self._plan_on(self.ground.scene)
        return STAND if self.stopping else command

    def _for_planner(self, standing: NDArray[np.bool_]) -> list[bool]:
        """Contacts that the planner is told, sooner than forces say for certain."""
        told = []
        for end, (firmly, contact) in enumerate(zip(standing, self.controller.contacts, strict=True)):
            moved_W = self.controller.dynamics.end_effector_position_W(end) - contact.position_W
            told.append(contact.stands(bool(firmly), bool(self.in_contact[end]), float(np.linalg.norm(moved_W))))
        return told

    def _take_over(self, now_s: float) -> None:
        """Follow the update that waits, if its computation is over."""
        if self.pending is None or now_s < self.pending.ready_s - 1e-9:
            return
        update, needless, self.pending = self.pending.update, self.pending.needless, None
        if needless:
            return
        if not update.usable or update.plan is None:
            self.failing_s = min(self.failing_s, update.begins_s)
            return
        stands = update.plan_from in ("recovery", "stop") or self.planner.command == STAND
        self.failing_s, self.stopping, self.other_ground = np.inf, False, False
        self.controller.set_plan(update.plan, update.begins_s, np.array(update.com_shift_W))
        self.planner.take_over(update)
        if self.online.command_at(now_s) is None and stands:
            self.aim.stopped(now_s, self.controller.dynamics.com_W, self._heading())
            self._plan_on(self.ground.scene)
        elif self.planner.command is None and update.status in ("solved", "acceptable"):
            self.aim.led_to()
        followed = FollowedPlan(update.plan, update.begins_s, now_s, update.took_s, update.message, update.com_shift_W)
        self.kept.plans.append(followed)
        self.tally.used += 1

    def _touchdowns(self, before: NDArray[np.bool_], standing: NDArray[np.bool_], dynamics: RobotDynamics) -> None:
        """Count contacts that the first plan did not have."""
        for end in np.flatnonzero(standing & ~before):
            place = dynamics.end_effector_position_W(int(end))
            planned = [
                np.asarray(knot.end_effectors_W[end])
                for knot, contacts in zip(self.first_plan.knots, self.first_plan.contact_sequence(), strict=False)
                if contacts[end] >= 0
            ]
            if not any(np.linalg.norm(place - known) < SAME_PLACE_M for known in planned):
                self.tally.contact_changes += 1

    def _over(self, now_s: float) -> bool:
        """Whether the plan under way has ended and its end was held, and so were pushes."""
        if self.ends:
            return True
        if self.online.command_at(now_s) or not np.isnan(self.online.duration_s):
            return False
        if self.aim.open or any(row[0] > now_s for row in (*self.online.goal, *self.online.command)):
            return False
        ended_s = self.plan.begins_s + float(self.plan.plan.duration())
        ended_s = max([ended_s, *(push.at_s + push.duration_s for push in self.options.pushes)])
        return bool(now_s - ended_s > self.options.hold_s)

    def _result(self, n: int, fell_at: float, wall_s: float, interrupted: bool) -> RunResult:
        recording = replace(self.kept.recording(fell_at), true_scene=self.true_scene)
        measures = measure(recording, self._end_posture())
        if self.simulation.model.link_pairs:
            measures = with_touches(measures, recording.touches)
        measures = replace(
            measures,
            qp_failures=self.failures,
            simulator_warnings=self.simulation.warnings,
            realtime_factor=(n + 1) * self.dt_s / wall_s,
            control_ms=1e3 * self.control_s / (n + 1),
            leg_torque_limit_ratio=float(at_torque_limit(recording)[:, self.controller.legs].any(axis=1).mean()),
        )
        options, online = self.options, self.online
        if self.beside.steer is not None:
            options, online = as_it_was(options, online, n * self.dt_s)
        off_m, turned_rad = self._goal_off(n * self.dt_s)
        tally = self.tally.measures(self.ground.felt)
        tally = replace(tally, goal_off_m=off_m, goal_turned_rad=turned_rad, kept_from_s=self.kept.from_s)
        return RunResult(recording, measures, options, interrupted, tally, online, tuple(self.kept.plans))

    def _goal_off(self, now_s: float) -> tuple[float | None, float | None]:
        """From the CoM to the goal, on the level [m], and the turn to its heading [rad]; None: none is walked to."""
        commanded = self.online.command_at(now_s) is not None or self.online.engine == "rhp"
        if commanded:
            return None, None
        self.actual.update(*self.simulation.state())  # what the controller reads has noise
        base_WB = self.actual.base_WB
        heading = float(np.arctan2(base_WB[1, 0], base_WB[0, 0]))
        return self.aim.off_m(self.actual.com_W), self.aim.turned_rad(heading)

    def _end_posture(self) -> Array:
        """Where the plan under way ends; not a number where the robot could not take that posture up."""
        plan = self.plan.plan
        try:
            return posture_at(self.urdf_model, plan, plan.duration())
        except InvalidInput:
            return np.full(self.urdf_model.model.nq, np.nan)
