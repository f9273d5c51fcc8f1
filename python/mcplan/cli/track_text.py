"""What mcplan track prints: a line that follows the run and its pictures, and JSON."""

from __future__ import annotations

import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan.cli.terminal import control, printable

if TYPE_CHECKING:
    from mcplan.planar.tracking import PlanarResult, Suitability
    from mcplan.tracking import TrackingResult
    from mcplan.tracking.findings import Feasibility
    from mcplan.wb import MotionCheckResult

#: [s] between two states of the line: in a terminal, where it is written over, and in a file.
_TERMINAL_S, _FILE_S = 0.1, 5.0
#: What of a run in space has no counterpart in the plane: no such quantity is controlled, or it is measured otherwise.
_NOT_PLANAR = (
    *("com_rms_m", "com_max_m", "orientation_rms_deg", "swing_rms_m", "final_base_error_m", "control_ms"),
    *(
        "torque_step_use",
        "torque_limit_ratio",
        "leg_torque_limit_ratio",
        "self_contacts",
        "self_contact_N",
        "self_contact_m",
    ),
    *("terrain_contacts", "terrain_contact_N", "touches"),
)


class Progress:
    """One line on stderr: how far the simulation is, then how far its pictures are."""

    def __init__(self, silent: bool) -> None:
        self.silent = silent
        self.terminal = sys.stderr.isatty()
        self.begin_s = self.shown_s = time.monotonic()  # in a file a short run leaves no line
        self.width = 0
        self.drawing_s = 0.0  # when the first picture of a video was made

    def simulated(self, now_s: float, end_s: float) -> None:
        """So much is simulated."""
        took = time.monotonic() - self.begin_s
        left = "" if now_s <= 0.0 else f", {took * (end_s / now_s - 1.0):.0f} s left"
        self._show(f"simulated {now_s:.1f} of {end_s:.1f} s{left}")

    def drawn(self, count: int, of: int) -> None:
        """So many pictures of a video are made."""
        if count <= 1:
            self.drawing_s = time.monotonic()
            self._show(f"video: picture {count} of {of}")
            return
        left_s = (time.monotonic() - self.drawing_s) * (of - count) / (count - 1)
        self._show(f"video: picture {count} of {of}, {left_s:.0f} s left")

    def working(self, what: str) -> None:
        """Show a task whose progress has no steps."""
        self._show(what, at_once=True)

    def end(self) -> None:
        """Clear the line for what is printed next."""
        if self.width > 0 and self.terminal:
            control(sys.stderr, f"\r{'':{self.width}}\r")
        self.width = 0

    def _show(self, text: str, at_once: bool = False) -> None:
        now_s = time.monotonic()
        pause_s = _TERMINAL_S if self.terminal else _FILE_S
        if self.silent or (now_s - self.shown_s < pause_s and not (at_once and self.terminal)):
            return
        self.shown_s = now_s
        if self.terminal:
            control(sys.stderr, f"\r{printable(text):{self.width}}")
        else:
            print(text, file=sys.stderr, flush=True)
        self.width = len(text)


def summary(
    result: TrackingResult | PlanarResult,
    plan: Path | None,
    feasibility: Feasibility | Suitability | MotionCheckResult | None,
) -> dict[str, Any]:
    """What ``--json`` prints: the same keys for every plan, null where a measure makes no sense, and for whole-body plans
    their own measures besides."""
    from mcplan._core import __version__
    from mcplan.tracking import TrackingResult

    common = {
        "interrupted": result.interrupted,
        "followed": result.followed,
        "feasible": None if feasibility is None else feasibility.ok(),
        "verdict": None if feasibility is None else feasibility.verdict,
        "options": asdict(result.options),
        "version": __version__,
    }
    if isinstance(result, TrackingResult):
        from mcplan.tracking.report import nearest_to_torque_limit, nearest_to_velocity_limit

        recording = result.recording
        return {
            "plan": None if plan is None else str(plan),
            "scene": recording.plan.scene.name,
            "robot": recording.simulated_robot.name,
            "duration_s": recording.plan.duration(),
            **finite_items(result.measures.as_dict()),
            "torque_joint": nearest_to_torque_limit(recording)[0],
            **_fastest(*nearest_to_velocity_limit(recording)),
            "touches": [asdict(touch) for touch in recording.touches] if result.options.self_contacts else None,
            **common,
        }
    return {"plan": None if plan is None else str(plan), **_planar(result), **common}


def _planar(result: PlanarResult) -> dict[str, Any]:
    from mcplan.planar.tracking.measures import nearest_to_velocity_limit
    from mcplan.tracking.report import nearest_to_torque_limit

    plan, measures = result.recording.plan, result.measures
    return {
        "scene": plan.task.name,
        "robot": plan.task.robot.name,
        "duration_s": plan.duration(),
        "fell": not measures.completed,
        **dict.fromkeys(_NOT_PLANAR),
        "assist_force_rms_N": 0.0,
        "assist_moment_rms_Nm": 0.0,
        "qp_failures": 0,
        **finite_items(measures.as_dict()),
        "torque_joint": nearest_to_torque_limit(result.recording)[0],
        **_fastest(*nearest_to_velocity_limit(result.recording)),
    }


def _fastest(joint: str, time_s: float) -> dict[str, Any]:
    from mcplan.cli.check import finite

    return {
        "velocity_joint": joint or None,
        "velocity_at_s": finite(time_s),
    }


def finite_items(data: dict[str, Any]) -> dict[str, Any]:
    """With null for numbers that JSON cannot represent."""
    from mcplan.cli.check import finite

    return {
        key: {name: finite(item) for name, item in value.items()} if isinstance(value, dict) else finite(value)
        for key, value in data.items()
    }
