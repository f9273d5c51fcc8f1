#!/usr/bin/env python3
"""Walks on the three terrains with each solver of their programs, cycle by cycle.

    python benchmarks/rhp_solvers.py [--cycles 14] [--out FILE.json]

Each solver walks on from its own steps: as long as both find the same optima, their programs are the same but for the
last digits. Times are CPU time of one thread, set-up and check included; a row gives medians over cycles.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from pathlib import Path

import mcplan as mp
from mcplan import rhp

MODELS = (("single", 2), ("single", 3), ("rectangle", 3), ("point", 3))
TERRAINS = ("rubbles", "v_shape", "up_and_down")


def cycles_of(terrain: str, fidelity: str, lookahead: int, count: int) -> list[dict[str, object]]:
    """Both solvers on each cycle of one walk."""
    scene, robot = mp.load_scene(terrain), mp.load_robot("talos_wang")
    planners = {
        solver: rhp.receding_horizon(scene, robot, fidelity=fidelity, lookahead=lookahead, solver=solver, cycles=count)
        for solver in ("ipopt", "ipm")
    }
    rows: list[dict[str, object]] = []
    for index in range(count):
        row: dict[str, object] = {"terrain": terrain, "model": f"{fidelity} {lookahead}", "cycle": index}
        for solver, planner in planners.items():
            begin = time.process_time()
            cycle = planner.step()
            row[solver] = {
                "cpu_s": time.process_time() - begin,
                "iterations": cycle.iterations,
                "cost": cycle.cost,
                "status": str(cycle.status),
                "executed": cycle.executed,
            }
        rows.append(row)
    return rows


def row_of(rows: list[dict[str, object]]) -> str:
    """Solved cycles, medians of iterations and times, the median ratio, and where the kernel's cost is highest."""

    def column(solver: str, key: str) -> list[float]:
        return [row[solver][key] for row in rows]  # type: ignore[index]

    cells = [f"{sum(column('ipopt', 'executed')):2d} {sum(column('ipm', 'executed')):2d} "]
    for solver in ("ipopt", "ipm"):
        cells.append(f"{statistics.median(column(solver, 'iterations')):8.0f}")
        cells.append(f"{1e3 * statistics.median(column(solver, 'cpu_s')):6.0f}")
    ratios = (a / b for a, b in zip(column("ipopt", "cpu_s"), column("ipm", "cpu_s"), strict=True))
    apart = max((b - a) / abs(a) for a, b in zip(column("ipopt", "cost"), column("ipm", "cost"), strict=True))
    cells.append(f"({1e3 * max(column('ipm', 'cpu_s')):.0f})  {statistics.median(ratios):8.1f}  {apart:+.1e}")
    return " ".join(cells)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cycles", type=int, default=14)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    kept = []
    print("terrain      model        solved  Ipopt it  ms      ipm it  ms (max)        ratio  cost: largest difference")
    for terrain in TERRAINS:
        for fidelity, lookahead in MODELS:
            rows = cycles_of(terrain, fidelity, lookahead, arguments.cycles)
            kept += rows
            print(f"{terrain:12} {fidelity + ' ' + str(lookahead):12} " + row_of(rows), flush=True)
    if arguments.out:
        arguments.out.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
