"""A run in words, for captions and titles."""

from __future__ import annotations

import numpy as np

from mcplan.tracking import Measures, Recording
from mcplan.tracking.touches import hardest


def run_lines(recording: Recording, measures: Measures | None) -> list[str]:
    """What came of a run, in a few lines; without measures, what the recording tells by itself."""
    robot = recording.simulated_robot
    first, last = float(recording.times_s[0]), float(recording.times_s[-1])
    end = f"fell at {recording.fell_at_s:.2f} s" if np.isfinite(recording.fell_at_s) else f"{last:.2f} s without a fall"
    lines = [f"{robot.name}: {end}" + (f"; recorded from {first:.2f} s on" if first > 0.0 else "")]
    miss = np.linalg.norm(recording.com_W - recording.com_plan_W, axis=1)
    rms, largest = float(np.sqrt(np.mean(miss**2))), float(miss.max())
    if measures is not None:
        rms, largest = measures.com_rms_m, measures.com_max_m
    lines.append(f"CoM off by {1e3 * rms:.1f} mm rms, {1e3 * largest:.1f} mm at most")
    if measures is not None:
        m = measures
        lines.append(f"base off by {m.orientation_rms_deg:.1f}°, swings by {1e3 * m.swing_rms_m:.1f} mm rms")
        lines.append(f"slip {1e3 * m.slip_m:.1f} mm; torques up to {100.0 * m.torque_use:.0f} % of limits")
        if np.isfinite(m.velocity_use):
            lines.append(f"joints up to {100.0 * m.velocity_use:.0f} % of their speed limits")
    else:
        use = float((np.abs(recording.torques) / recording.torque_limits).max())
        lines.append(f"torques up to {100.0 * use:.0f} % of limits")
    for terrain, what in ((False, "links touch each other"), (True, "links touch the terrain")):
        touch = hardest(recording.touches, terrain)
        if touch is not None:
            count = sum(item.terrain == terrain for item in recording.touches)
            lines.append(f"{what} {count} times, hardest: {touch}")
    lines.append(_assistance(recording))
    return lines


def _assistance(recording: Recording) -> str:
    force, moment = (np.sqrt(np.mean(np.sum(w**2, axis=1))) for w in (recording.assist[:, :3], recording.assist[:, 3:]))
    if force == 0.0 and moment == 0.0:
        return "unassisted"
    return f"assisted: {force:.0f} N and {moment:.1f} N m rms on the base"
