"""A run in the words of those who build robots: what happened, how far off the plan, what the joints had to give."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from .measures import Measures, torque_step_uses, velocity_uses
from .options import Options, Push
from .recording import Array, Recording
from .touches import hardest


class Reported(Protocol):
    """What a report reads of a TrackingResult, which lies above: it prints itself by this."""

    @property
    def recording(self) -> Recording: ...
    @property
    def measures(self) -> Measures: ...
    @property
    def options(self) -> Options: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def completed(self) -> bool: ...
    @property
    def falls_at_end(self) -> bool: ...


def report(result: Reported) -> str:
    """The headline, and below it a line for each measure."""
    return as_text(headline(result), rows_of(result))


def as_text(title: str, rows: list[tuple[str, str]]) -> str:
    """A title, and below it names and values in two columns."""
    width = max(len(name) for name, _ in rows)
    return "\n".join([title, *(f"  {name:{width}}  {value}" for name, value in rows)])


def headline(result: Reported) -> str:
    """Scene, robot, and how the run ended."""
    recording = result.recording
    plan, lasts = recording.plan, recording.plan.duration()
    assisted = "assisted" if result.options.assist else "unassisted"
    return f"{plan.scene.name}  {recording.simulated_robot.name}  {ending(result)} (plan of {lasts:.2f} s, {assisted})"


def ending(result: Reported) -> str:
    """How the run ended."""
    measures = result.measures
    if measures.fell:
        return f"fell after {measures.completed_s:.2f} s"
    if result.interrupted:
        return f"interrupted after {measures.completed_s:.2f} s, until then without a fall"
    if result.falls_at_end:
        return f"about to fall at the end, after {measures.completed_s:.2f} s: its capture point is beside its soles"
    return f"followed to the end: {measures.completed_s:.2f} s without a fall"


def rows_of(result: Reported) -> list[tuple[str, str]]:
    """What was measured, and its value."""
    m, options = result.measures, result.options
    joint, time_s = nearest_to_torque_limit(result.recording)
    rows = [
        ("CoM off the plan", f"{length(m.com_rms_m)} rms, {length(m.com_max_m)} at most"),
        ("orientation off the plan", f"{m.orientation_rms_deg:.2g} deg rms"),
        ("swinging end-effectors", f"{length(m.swing_rms_m)} rms off the plan"),
        ("slip in contact", f"{length(m.slip_m)} at most"),
        *(
            [("base at the end", f"{length(m.final_base_error_m)} from where the plan ends")]
            if result.completed
            else []
        ),
        ("largest torque", f"{100.0 * m.torque_use:.0f} % of the limit of {joint}, at {time_s:.2f} s"),
        ("fastest joint", speed_text(result.recording)),
        *torque_steps(result),
        ("contacts of links", touches_text(result)),
        ("assistance", assistance_text(result)),
    ]
    disturbed = disturbances_text(options)
    if disturbed:
        rows.append(("not told to the controller", disturbed))
    return [*rows, ("controller", controller_text(result)), ("simulator", simulator_text(result))]


class Torques(Protocol):
    """What recordings of robots in space and of planar ones have in common."""

    @property
    def joints(self) -> tuple[str, ...]: ...
    @property
    def times_s(self) -> Array: ...
    @property
    def torques(self) -> Array: ...
    @property
    def torque_limits(self) -> Array: ...


def nearest_to_torque_limit(recording: Torques) -> tuple[str, float]:
    """The joint whose torque came nearest to its limit, and when [s]."""
    use = np.abs(recording.torques) / recording.torque_limits
    n, joint = np.unravel_index(int(np.argmax(use)), use.shape)
    return recording.joints[joint], float(recording.times_s[n])


def nearest_to_velocity_limit(recording: Recording) -> tuple[str, float]:
    """The joint whose speed came nearest to its limit, or went farthest beyond it, and when [s]; "" and NaN: no limits."""
    use = velocity_uses(recording)
    if not use.any():
        return "", float("nan")
    n, joint = np.unravel_index(int(np.argmax(use)), use.shape)
    return recording.joints[joint], float(recording.times_s[n])


def speed_text(recording: Recording) -> str:
    joint, time_s = nearest_to_velocity_limit(recording)
    if not joint:
        return "no limits are known"
    return f"{100.0 * velocity_uses(recording).max():.0f} % of the speed limit of {joint}, at {time_s:.2f} s"


def torque_steps(result: Reported) -> list[tuple[str, str]]:
    """A row if a torque changed by more than its limit within 2 ms: no motor does so."""
    use = torque_step_uses(result.recording)
    if not use.max(initial=0.0) > 1.0:
        return []
    n, joint = np.unravel_index(int(np.argmax(use)), use.shape)
    count, name = int((use.max(axis=1) > 1.0).sum()), result.recording.joints[joint]
    largest = f"the largest by {100.0 * use[n, joint]:.0f} % in {name}, at {result.recording.times_s[n]:.2f} s"
    return [("torques that jump", f"{count} by more than their limit in 2 ms, {largest}")]


def touches_text(result: Reported) -> str:
    """What links hit, the hardest of each kind."""
    m, parts = result.measures, []
    if m.self_contacts is None:
        return "not simulated"
    for terrain, count in ((False, m.self_contacts), (True, m.terrain_contacts)):
        touch = hardest(result.recording.touches, terrain)
        if touch is not None:
            parts.append(f"{count} {'with the terrain' if terrain else 'with each other'}, hardest {touch}")
    return "; ".join(parts) or "none, but for end-effectors"


def assistance_text(result: Reported) -> str:
    if not result.options.assist:
        return "none"
    m = result.measures
    largest = float(np.linalg.norm(result.recording.assist[:, :3], axis=1).max())
    return f"{m.assist_force_rms_N:.1f} N and {m.assist_moment_rms_Nm:.1f} N m rms on the base, {largest:.0f} N at most"


def disturbances_text(options: Options) -> str:
    """What differs from the plan's world, empty: nothing."""
    parts = [
        f"{name} {100.0 * (scale - 1.0):+.1f} %"
        for name, scale in (("mass", options.mass_scale), ("friction", options.friction_scale))
        if scale != 1.0
    ]
    if options.ground_shift_m:
        parts.append(f"ground {1e3 * options.ground_shift_m:+.1f} mm")
    parts += [push_text(push) for push in options.pushes]
    if options.torque_delay_s:
        parts.append(f"torques {1e3 * options.torque_delay_s:.2g} ms late")
    if options.torque_bandwidth_hz:
        parts.append(f"torques of {options.torque_bandwidth_hz:.0f} Hz")
    if options.sensor_noise:
        parts.append(f"sensor noise x {options.sensor_noise:.2g}")
    return ", ".join(parts) + (f" (seed {options.seed})" if options.seed else "")


def push_text(push: Push) -> str:
    towards = {0.0: "forward", 90.0: "to the left", 180.0: "backward", 270.0: "to the right"}
    where = towards.get(push.direction_deg % 360.0, f"towards {push.direction_deg:.0f} deg")
    return f"push of {push.force_N:.0f} N for {push.duration_s:.2g} s at {push.at_s:.2f} s {where}"


def controller_text(result: Reported) -> str:
    m = result.measures
    solved = "every step solved" if m.qp_failures == 0 else f"{m.qp_failures} steps not solved"
    return f"{solved}, {m.control_ms:.2f} ms a step"


def simulator_text(result: Reported) -> str:
    m = result.measures
    count = m.simulator_warnings
    warned = "no warnings" if count == 0 else f"{count} warning{'' if count == 1 else 's'}"
    return f"{warned}, {m.realtime_factor:.2f} times real time"


def length(metres: float) -> str:
    """In mm below 10 cm, in cm below 1 m, else in m."""
    if metres < 0.0995:
        return f"{1e3 * metres:.2g} mm"
    return f"{100.0 * metres:.0f} cm" if metres < 0.995 else f"{metres:.2f} m"
