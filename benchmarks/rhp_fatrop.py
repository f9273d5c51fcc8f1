#!/usr/bin/env python3
"""Cycles of the receding horizon by mcplan's kernel, by its Ipopt, and by CasADi with fatrop, from the same states.

    python benchmarks/rhp_fatrop.py [--cycles 14] [--tolerances 1e-3] [--cases point single] [--out FILE.json]

The kernel walks; the state at the start of each of its cycles is what the others solve too, each warm-started from its own
solution two cycles before. Needs the extra `bench`. What may be compared and what not: benchmarks/README.md.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent / "wang_casadi"))
from run import TERRAINS  # isort: skip  # first: it sets the number of threads

import casadi as ca  # isort: skip
from compare import planner, state_of  # isort: skip
from horizon import Settings  # isort: skip
from loop import Loop  # isort: skip
from stages import StagedHorizon  # isort: skip
from walker import load_walker  # isort: skip

LOOKAHEAD = {"point": 3, "single": 2}
LIMIT = 1e-4  # of violations of a solution of fatrop's, in the rows of horizon.py and their units
Row = dict[str, Any]


def horizons_of(settings: Settings, tolerance: float, iterations: int) -> dict[int, StagedHorizon]:
    """The programs of both legs; they serve every terrain, which is in their parameters."""
    options = {"fatrop": {"print_level": 0, "tol": tolerance, "max_iter": iterations}}
    walker = load_walker()
    return {foot: StagedHorizon(walker, settings, foot, "fatrop", options) for foot in (0, 1)}


def ours(planned: Any, *state: Any) -> Row:
    """A cycle of mcplan's, set-up and check included."""
    cpu = time.process_time()
    cycle = planned.step(*state)
    cpu = time.process_time() - cpu
    return {"cpu_s": cpu, "iterations": cycle.iterations, "cost": cycle.cost, "success": cycle.executed}


def theirs(loop: Loop, start: Any) -> Row:
    """A cycle of fatrop's: the call of the solver alone."""
    index = len(loop.cycles)
    horizon = loop.horizon(index)
    cycle = loop.step(start)
    out = cycle.outcome
    patches = [loop.walker.step(index + i)[1] for i in range(loop.settings.lookahead)]
    parameters = loop.parameters(start, horizon.first_foot, patches, loop.origins)
    violation = horizon.whole.violation(out.values, parameters)
    return {
        "cpu_s": out.cpu_s,
        "functions_s": out.evaluation_cpu_s,
        "iterations": out.iterations,
        "cost": out.objective,
        "violation": violation,
        "status": out.status,
        "success": out.success and violation < LIMIT,
    }


def walk(terrain: str, settings: Settings, programs: dict[str, dict[int, StagedHorizon]], cycles: int) -> list[Row]:
    """One walk of the kernel's, every cycle solved by the others too."""
    case = (terrain, "talos_wang", settings.fidelity, settings.lookahead, settings.transcription, settings.paper)
    kernel, ipopt = planner(*case, solver="ipm"), planner(*case, solver="ipopt")
    walker = load_walker(terrain)
    loops = {name: Loop(walker, settings, dict(each)) for name, each in programs.items()}
    rows = []
    for _ in range(cycles):
        given, start = kernel.state(), state_of(kernel, terrain)
        row = {"kernel": ours(kernel), "ipopt": ours(ipopt, given)}
        row |= {name: theirs(loop, start) for name, loop in loops.items()}
        rows.append(row)
        if not row["kernel"]["success"] or not row["ipopt"]["success"]:
            break
    return rows


HEAD = (
    "terrain",
    "model",
    "solver",
    "solved",
    "iterations",
    "CPU ms (max)",
    "of which functions",
    "over the kernel",
    "largest violation",
    "cost above the kernel's: median, least, most",
)


def table(terrain: str, settings: Settings, rows: list[Row]) -> list[str]:
    """A line for each solver: medians over the cycles that it solves."""
    lines = []
    for name in rows[0]:
        solved = [row for row in rows if row[name]["success"]]
        cells = [terrain, f"{settings.fidelity} {settings.lookahead}", name, f"{len(solved)}/{len(rows)}"]
        if solved:
            cpu = [row[name]["cpu_s"] for row in solved]
            cells.append(f"{statistics.median(row[name]['iterations'] for row in solved):.0f}")
            cells.append(f"{1e3 * statistics.median(cpu):.0f} ({1e3 * max(cpu):.0f})")
            functions = [row[name].get("functions_s") for row in solved]
            cells.append("" if functions[0] is None else f"{1e3 * statistics.median(functions):.0f}")
        if solved and name != "kernel":
            cells.append(f"{statistics.median(row[name]['cpu_s'] / row['kernel']['cpu_s'] for row in solved):.1f}")
            violations = [row[name]["violation"] for row in solved if "violation" in row[name]]
            cells.append(f"{max(violations):.0e}" if violations else "")
            apart = [row[name]["cost"] / row["kernel"]["cost"] - 1 for row in solved]
            cells.append(f"{statistics.median(apart):+.1e}, {min(apart):+.1e}, {max(apart):+.1e}")
        lines.append("| " + " | ".join(cells + [""] * (len(HEAD) - len(cells))) + " |")
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cycles", type=int, default=14)
    parser.add_argument("--cases", nargs="+", choices=tuple(LOOKAHEAD), default=tuple(LOOKAHEAD))
    parser.add_argument("--terrains", nargs="+", choices=TERRAINS, default=TERRAINS)
    parser.add_argument("--tolerances", nargs="+", type=float, default=[1e-3], help="of fatrop, one after the other")
    parser.add_argument("--max-iterations", type=int, default=300, help="of fatrop")
    parser.add_argument("--euler", action="store_true", help="forward Euler and the paper's bounds, not linear forces")
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    kept = []
    print(f"CasADi {ca.__version__}, its functions (SX) in its virtual machine; medians over cycles")
    print("| " + " | ".join(HEAD) + " |\n" + "|" + "---|" * len(HEAD), flush=True)
    for fidelity in arguments.cases:
        mode = ("euler", True) if arguments.euler else ("trapezoidal", False)
        settings = Settings(fidelity, LOOKAHEAD[fidelity], *mode, turned=not arguments.euler)
        programs = {
            f"fatrop {tolerance:g}": horizons_of(settings, tolerance, arguments.max_iterations)
            for tolerance in arguments.tolerances
        }
        for terrain in arguments.terrains:
            rows = walk(terrain, settings, programs, arguments.cycles)
            kept.append({"terrain": terrain, "fidelity": fidelity, "cycles": rows})
            print("\n".join(table(terrain, settings, rows)), flush=True)
    if arguments.out:
        arguments.out.write_text(json.dumps({"casadi": ca.__version__, "walks": kept}, indent=1) + "\n")


if __name__ == "__main__":
    main()
