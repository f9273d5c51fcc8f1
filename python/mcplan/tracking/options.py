"""What a run may be asked for: plain data with defaults."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan
from mcplan.errors import InvalidArgument, InvalidOptions, shown

#: Sees a simulation: simulated time [s], configuration (nq,) in Pinocchio's order, the plan that is followed.
Watch = Callable[[float, NDArray[np.float64], Plan], None]


def require_watch(watch: Watch | None) -> None:
    """Raise InvalidArgument where that is no function."""
    if watch is not None and not callable(watch):
        raise InvalidArgument("watch", "must be a function of time, configuration and plan", shown(watch))


#: Least time step of MuJoCo [s]: 200 steps to a control step of the default length.
SIMULATION_STEP_MIN_S = 1e-5
#: Largest force of a push [N]: the weight of ten tonnes.
PUSH_MAX_N = 1e5
#: Share of a control step that is rounding.
ROUNDING = 1e-6
#: Largest gain and weight of the controller, a thousand times the largest default.
GAIN_MAX = 1e6


@dataclass(frozen=True)
class Push:
    """A force on the robot's base.

    Attributes:
        force_N: Its size, at most 1e5; one below 0 points the other way.
        duration_s: How long it acts, above 0.
        at_s: When it begins.
        direction_deg: Where it points, in the ground plane: 0 forward (x of the world), 90 to the left.
    """

    force_N: float
    duration_s: float
    at_s: float
    direction_deg: float = 90.0

    def force_W(self, time_s: float, step_s: float) -> np.ndarray:
        """(3,) mean [N] over a control step that begins at a time: the impulse is that of the push, whenever it begins."""
        angle = np.radians(self.direction_deg)
        acts_s = min(time_s + step_s, self.at_s + self.duration_s) - max(time_s, self.at_s)
        share = float(np.clip(acts_s / step_s, 0.0, 1.0))
        if share < ROUNDING or share > 1.0 - ROUNDING:  # sums of times are rounded
            share = round(share)
        return share * self.force_N * np.array([np.cos(angle), np.sin(angle), 0.0])


@dataclass(frozen=True)
class Gains:
    """Weights and gains of the controller's tasks, 0 to 1e6 each: the same for every robot and plan.

    Each task asks for the acceleration a_reference + kp (x_reference - x) + kd (v_reference - v), kd = 2 sqrt(kp).
    """

    com_kp: float = 60.0
    com_weight: float = 100.0
    base_kp: float = 80.0
    base_weight: float = 10.0
    momentum_kp: float = 5.0  # damping of the angular momentum about the CoM
    momentum_weight: float = 0.01
    swing_kp: float = 200.0
    swing_weight: float = 10.0
    contact_kp: float = 60.0
    contact_weight: float = 1e3
    hand_weight: float = 100.0
    posture_kp: float = 20.0
    posture_weight: float = 0.03
    leg_posture_weight: float = 0.01  # of joints that move one foot and no other end-effector
    joint_kp: float = 100.0  # of all joints along a motion, which has their velocities and accelerations
    joint_weight: float = 0.3
    force_weight: float = 1e-6


@dataclass(frozen=True)
class Options:
    """How a plan is tracked.

    Attributes:
        simulation_step_s: Time step of MuJoCo, 1e-5 to 0.005 s.
        control_step_s: Time step of the controller; a multiple of the simulation's.
        assist: Assist the base with a bounded wrench, as the assisted set-up of Tazaki's paper does with inertia.
        pushes: Forces on the base; each begins before the end of the run and ends after its start.
        mass_scale: Factor on the masses of the simulated robot that the controller does not know of.
        friction_scale: Factor on the friction of the simulated surfaces that the controller does not know of.
        ground_shift_m: Height by which the simulated surfaces lie above the planned ones.
        seed: Seed of disturbances of mass, friction, ground, a push, motors and sensors, drawn on top (see
            ``disturbances``); 0: none. Options of a result are those drawn: they repeat the run with a seed of 0.
        hold_s: Time for which the last state of the plan is kept at the end.
        speed_limits: Motors have the less torque the nearer a joint is to the URDF's velocity limit (see ``actuators``),
            and the controller keeps the speeds of joints within these limits; False: full torque at every speed.
        self_contacts: Links make contact with each other and, besides the end-effectors, with the terrain; False: they
            pass through each other and through the terrain.
        torque_bandwidth_hz: Bandwidth of the motors' torques, a first order lag; 0: they follow at once.
        torque_delay_s: Time from the state that the controller reads to its torques, rounded to simulation steps.
        sensor_noise: Standard deviation of what the controller reads, in units of the noise of usual sensors (see
            ``sensors``); 0: it reads the simulator's state.
        noise_seed: Seed of that noise; a seed other than 0 sets it, too.
        gains: Gains of the controller.
    """

    simulation_step_s: float = 0.001
    control_step_s: float = 0.002
    assist: bool = False
    pushes: tuple[Push, ...] = ()
    mass_scale: float = 1.0
    friction_scale: float = 1.0
    ground_shift_m: float = 0.0
    seed: int = 0
    hold_s: float = 1.0
    speed_limits: bool = True
    self_contacts: bool = True
    torque_bandwidth_hz: float = 0.0
    torque_delay_s: float = 0.0
    sensor_noise: float = 0.0
    noise_seed: int = 0
    gains: Gains = field(default_factory=Gains)

    def validate(self) -> None:
        """Raise InvalidOptions naming the first field out of its range."""
        ratio = self.control_step_s / self.simulation_step_s if self.simulation_step_s > 0 else 0.0
        _require(
            "simulation_step_s",
            f"must lie in {SIMULATION_STEP_MIN_S:g} to 0.005 s",
            self.simulation_step_s,
            SIMULATION_STEP_MIN_S <= self.simulation_step_s <= 0.005,
        )
        _require(
            "control_step_s",
            "must be a multiple of simulation_step_s, at most 0.05 s",  # falls are looked for once a control step
            self.control_step_s,
            self.control_step_s <= 0.05 and ratio >= 1 and abs(ratio - round(ratio)) < 1e-9,
        )
        _require("mass_scale", "must lie in 0.2 to 5", self.mass_scale, 0.2 <= self.mass_scale <= 5)
        _require(
            "friction_scale", "must lie above 0 and at most 10", self.friction_scale, 0 < self.friction_scale <= 10
        )
        _require("ground_shift_m", "must lie in -0.2 to 0.2", self.ground_shift_m, abs(self.ground_shift_m) <= 0.2)
        _require("hold_s", "must lie in 0 to 60", self.hold_s, 0 <= self.hold_s <= 60)
        _require(
            "torque_bandwidth_hz",
            "must lie in 1 to 1000, or be 0",
            self.torque_bandwidth_hz,
            self.torque_bandwidth_hz == 0 or 1 <= self.torque_bandwidth_hz <= 1000,
        )
        _require("torque_delay_s", "must lie in 0 to 0.05", self.torque_delay_s, 0 <= self.torque_delay_s <= 0.05)
        _require("sensor_noise", "must lie in 0 to 100", self.sensor_noise, 0 <= self.sensor_noise <= 100)
        _require("seed", "must not be negative", self.seed, self.seed >= 0)
        _require("noise_seed", "must not be negative", self.noise_seed, self.noise_seed >= 0)
        for i, push in enumerate(self.pushes):
            for item in fields(push):
                value = getattr(push, item.name)
                _require(f"pushes[{i}].{item.name}", "must be finite", value, bool(np.isfinite(value)))
            _require(f"pushes[{i}].duration_s", "must be above 0", push.duration_s, push.duration_s > 0)
            rule = f"must lie in -{PUSH_MAX_N:g} to {PUSH_MAX_N:g}, and not be 0"
            _require(f"pushes[{i}].force_N", rule, push.force_N, 0 < abs(push.force_N) <= PUSH_MAX_N)
        for item in fields(self.gains):
            value = getattr(self.gains, item.name)
            holds = isinstance(value, int | float | np.integer | np.floating) and 0 <= value <= GAIN_MAX
            _require(f"gains.{item.name}", f"must be a number in 0 to {GAIN_MAX:g}", value, bool(holds))

    def require_pushes_within(self, run_s: float) -> None:
        """Raise InvalidOptions naming the first push that does not act in a run of that duration."""
        for i, push in enumerate(self.pushes):
            rule = f"must lie before the end of the run, {run_s:.6g} s"
            _require(f"pushes[{i}].at_s", rule, push.at_s, push.at_s < run_s)
            rule = f"must not lie so far before the start of the run that the push of {push.duration_s:g} s is over by then"
            _require(f"pushes[{i}].at_s", rule, push.at_s, push.at_s >= 0 or push.at_s + push.duration_s > 0)


def _require(field_name: str, rule: str, value: object, holds: bool) -> None:
    if not holds:
        raise InvalidOptions(field_name, rule, str(value))
