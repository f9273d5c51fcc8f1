#!/usr/bin/env python3
"""Whole-body motions of planar robots with each solver of their programs.

    python benchmarks/sip_solvers.py [--task NAME ...] [--runs 3] [--out FILE.json]

Feasible motions and those of least torque, for each law of contact forces. Times are CPU time of one thread, the check of the
result included; of several runs the median.
"""

from __future__ import annotations

import argparse
import json
import statistics
import time
from pathlib import Path

import mcplan as mp

TASKS = ("cartwheel", "climbing", "walking")
FORCES = ("uniform", "per_body", "per_point")
SOLVERS = ("ipopt", "ipm")
LIMIT_S = 300.0  # wall clock of one motion


def solved(task: str, minimise: str, forces: str, solver: str, runs: int) -> dict[str, object]:
    """One motion, several times; its bytes are the same each time."""
    times = []
    for _ in range(runs):
        begin = time.process_time()
        result = mp.whole_body(task, minimise=minimise, forces=forces, solver=solver, time_limit=LIMIT_S)
        times.append(time.process_time() - begin)
    report = result.report
    return {
        "cpu_s": statistics.median(times),
        "iterations": report.iterations,
        "cost": report.cost,
        "status": str(report.status),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--task", action="append", help="planar task instead of all three; may be repeated")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    kept = []
    print(
        "task        minimise  forces     Ipopt: status, it, s, cost            kernel                          ratio"
    )
    for task in arguments.task or TASKS:
        for minimise in ("none", "torque"):
            for forces in FORCES:
                row = {solver: solved(task, minimise, forces, solver, arguments.runs) for solver in SOLVERS}
                kept.append({"task": task, "minimise": minimise, "forces": forces, **row})
                cells = [
                    f"{r['status']:10} {r['iterations']:4d} {r['cpu_s']:6.2f} {r['cost']:8.1f}" for r in row.values()
                ]
                ratio = row["ipopt"]["cpu_s"] / row["ipm"]["cpu_s"]  # type: ignore[operator]
                print(f"{task:11} {minimise:9} {forces:10} {cells[0]}   {cells[1]}   {ratio:5.1f}", flush=True)
    if arguments.out:
        arguments.out.write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
