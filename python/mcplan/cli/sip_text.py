"""What mcplan sip prints: a line that follows the search, and a summary."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mcplan.cli.terminal import control, printable

if TYPE_CHECKING:
    from mcplan import sip
    from mcplan._core import LogLevel, PlanarTask

#: [s] between two states of the line: in a terminal, where it is written over, and in a file.
_TERMINAL_S, _FILE_S = 0.1, 2.0


class Progress:
    """Logger of the planner on stderr: the search's state in one line, or with `verbose` its whole table."""

    def __init__(self, task: str, verbose: bool) -> None:
        self.task = task
        self.verbose = verbose
        self.terminal = sys.stderr.isatty()
        self.iterations = 0
        self.begin_s = time.monotonic()
        self.shown_s = self.begin_s  # in a file a short search leaves no line
        self.width = 0

    def __call__(self, level: LogLevel, line: str) -> None:
        """Take a line of the planner."""
        if self.verbose:
            print(line, file=sys.stderr, flush=True)
            return
        state = iteration_state(line)
        if state is None:
            return
        self.iterations += state[0] > 0  # the rows numbered 0 are starts
        now_s = time.monotonic()
        if now_s - self.shown_s < (_TERMINAL_S if self.terminal else _FILE_S):
            return
        self.shown_s = now_s
        _, violation, optimality = state
        lead = f"{self.task}: iteration {self.iterations}, {now_s - self.begin_s:.1f} s"
        self._show(f"{lead}, constraints to {violation}, optimality to {optimality}")

    def end(self) -> None:
        """Clear the line for the summary."""
        if self.width > 0 and self.terminal:
            self._show("")
            control(sys.stderr, "\r")

    def _show(self, text: str) -> None:
        if self.terminal:
            control(sys.stderr, f"\r{printable(text):{self.width}}")
        else:
            print(text, file=sys.stderr, flush=True)
        self.width = len(text)


def iteration_state(line: str) -> tuple[int, str, str] | None:
    """Iteration, violation of the constraints and of optimality, from a row of the solver's table; None: no row."""
    cells = line.split()
    if len(cells) < 4 or not cells[0].rstrip("r").isdigit():
        return None
    return int(cells[0].rstrip("r")), cells[2], cells[3]


def summary_text(result: sip.Result, options: sip.Options, written: Sequence[Path]) -> str:
    """How the search ended, the motion phase by phase, what is wrong with it, what is proved, what was saved."""
    plan, report = result.plan, result.report
    task = plan.task
    lead = f"{task.name}  {task.robot.name}  "
    indent = " " * len(lead)
    solved = str(report.status) == "solved"
    took = f"{report.time_s:.2f} s ({report.iterations} iterations)"
    how = f"{options.forces.name} forces, {_criterion(options)}" if options.dynamics else "kinematics alone"
    word = "in" if solved else "after"
    lines = [f"{lead}{report.status} {word} {took}: {len(plan.durations)} phases, {plan.duration():.2f} s long, {how}"]
    if not solved:
        lines.append(indent + (report.message or "no motion that the checker accepts"))
    worst = report.worst_violation
    if worst.name and (solved or str(worst) not in report.message):
        label = "worst" if worst.value > worst.tolerance else "closest to its limit"
        lines.append(f"{indent}{label}: {worst}")
    terms = ", ".join(f"{name} {value:.4g}" for name, value in report.cost_terms.items())
    cost = f"cost {report.cost:.4g} ({terms})" if options.has_cost() else f"no cost ({terms})"
    lines.append(f"{indent}{cost}; drift of contacts {1e3 * result.drift_m:.2g} mm, {1e3 * result.drift_rad:.2g} mrad")
    times = [(report.timing_s.get(part, 0.0), part) for part in ("evaluation", "linear_solver")]
    parts = ", ".join(f"{100.0 * used / max(report.time_s, 1e-9):.0f} % {part}" for used, part in times)
    size = f"{result.parameters} parameters, {result.constraints} constraints"
    lines.append(f"{indent}{size}; time: {parts.replace('_', ' ')}")
    lines += phase_rows(task, plan.durations)
    if result.certificate is not None:
        proofs = str(result.certificate).splitlines()
        lines += proofs[:1] if result.certificate.proved() else proofs
    files = [str(path) for path in written]
    if files:
        lines.append(f"Saved {', '.join(files)}" + ("" if solved else f", with status {report.status}"))
    return "\n".join(printable(line) for line in lines)


def phase_rows(task: PlanarTask, durations: Sequence[float]) -> list[str]:
    """A row per phase: start, duration and contacts."""
    robot, surfaces = task.robot, task.surfaces
    rows = ["  phase  start [s]  lasts [s]  contacts"]
    start = 0.0
    for k, (phase, duration) in enumerate(zip(task.phases, durations, strict=True)):
        pairs = [(robot.end_effectors[c.end_effector].name, surfaces[c.surface].name) for c in phase.contacts]
        contacts = ", ".join(f"{who} on {surface}" for who, surface in pairs)
        rows.append(f"  {k:5d}  {start:9.3f}  {duration:9.3f}  {contacts}")
        start += duration
    return rows


def _criterion(options: sip.Options) -> str:
    weights = {"torque": options.torque_weight, "time": options.duration_weight, "jerk": options.jerk_weight}
    names = [name for name, weight in weights.items() if weight > 0.0]
    return f"minimum {' and '.join(names)}" if names else "nothing minimised"
