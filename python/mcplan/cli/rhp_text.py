"""What mcplan rhp prints: a row per cycle, and a summary."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from mcplan.cli.terminal import printable

if TYPE_CHECKING:
    from mcplan import rhp

_COLUMNS: tuple[tuple[str, int], ...] = (
    ("cycle", 5),
    ("status", 17),
    ("iterations", 10),
    ("time [s]", 8),
    ("length [s]", 10),
    ("travel [m]", 10),
    ("acc cost", 8),
)
_MORE = (
    ("step from", 13),
    ("variables", 9),
    ("rows", 6),
    ("evaluation", 10),
    ("linear solver", 13),
    ("CoM drift", 9),
    ("L drift", 8),
)


class Progress:
    """Rows of a table on stderr, one a cycle as it ends; `verbose` adds sizes, parts of the time and drift."""

    def __init__(self, verbose: bool) -> None:
        self.columns = _COLUMNS + (_MORE if verbose else ())
        self._print([name for name, _ in self.columns])

    def row(self, cycle: rhp.Cycle) -> None:
        """Print a cycle."""
        step = [f"{cycle.duration_s:.2f}", f"{cycle.distance_m:.3f}", f"{cycle.acceleration_cost:.3f}"]
        cells = [str(cycle.index), str(cycle.status), str(cycle.iterations), f"{cycle.time_s:.3f}"]
        cells += step if cycle.executed else ["-"] * 3
        time_s = max(cycle.time_s, 1e-9)
        cells += [cycle.step_from.name, str(cycle.variables), str(cycle.constraints)]
        cells += [f"{100.0 * cycle.evaluation_s / time_s:.0f} %", f"{100.0 * cycle.linear_solver_s / time_s:.0f} %"]
        cells += [f"{cycle.drift_com_m:.1e}", f"{cycle.drift_momentum:.1e}"] if cycle.executed else ["-"] * 2
        self._print(cells)

    def _print(self, cells: Sequence[str]) -> None:
        shown = zip(cells, self.columns, strict=False)
        texts = [f"{cell:{'<' if name == 'status' else '>'}{width}}" for cell, (name, width) in shown]
        print("  ".join(texts).rstrip(), file=sys.stderr, flush=True)


def summary_text(
    walk: rhp.Walk, scene: str, robot: str, options: rhp.Options, written: Sequence[Path], interrupted: bool
) -> str:
    """How the walk ended, how far it went, what it cost, what is wrong with it, what was saved.

    Args:
        walk: Its cycles until the end, a failure or an interruption.
        scene: The scene's name.
        robot: The robot's name.
        options: What it was planned with.
        written: Files with its plan.
        interrupted: Whether Ctrl-C ended it.
    """
    from mcplan.cli.check import warning_lines

    report = walk.report
    lead = f"{scene}  {robot}  "
    indent = " " * len(lead)
    count = len(walk.cycles)
    done = sum(cycle.executed for cycle in walk.cycles)
    model = f"{options.fidelity.name}, lookahead {options.lookahead}, {options.transcription.name}"
    each = f"{report.time_s / max(count, 1):.3f} s and {report.iterations / max(count, 1):.0f} iterations a cycle"
    lines = [f"{lead}{report.status} ({model}): {_cycles(done)} done in {report.time_s:.2f} s, {each}"]
    if report.message:
        lines.append(indent + report.message)
    if done:
        cost = f"per metre: acceleration {walk.acc_per_m():.3f}, angular momentum {walk.momentum_per_m():.4f}"
        lines.append(f"{indent}walked {walk.distance_m():.2f} m in {walk.plan.duration():.2f} s; cost {cost}")
        drift = f"CoM {1e3 * walk.drift_com_m():.2g} mm, angular momentum {walk.drift_momentum():.2g} kg m2/s"
        lines.append(f"{indent}forces replayed, largest drift of a step: {drift}")
    worst = str(report.worst_violation)
    if report.worst_violation.name and worst not in report.message:
        label = "closest to its limit" if str(report.status) == "solved" else "worst"
        lines.append(f"{indent}{label}: {worst}")
    lines += warning_lines(report.warnings)
    files = [str(path) for path in written]
    if files and not done:
        lines.append(f"Not written, since no step was found: {', '.join(files)}")
    elif files:
        end = "the interruption" if interrupted else "" if walk.success else "the failure"
        ending = end and f", the {_cycles(done)} before {end}"
        lines.append(f"Saved {', '.join(files)}{ending}")
    return "\n".join(printable(line) for line in lines)


def _cycles(count: int) -> str:
    return f"{count} cycle{'' if count == 1 else 's'}"
