#!/usr/bin/env python3
"""mcplan beside its peers: the same goals on the same machine, one thread, in one run; a page of tables.

    .venv/bin/python benchmarks/peers/run.py [--out docs/peers.md] [--only towr motions] [--sources DIR]

TOWR and sl1m are cloned from GitHub and compiled, or taken from DIR/towr, DIR/ifopt, DIR/sl1m; Crocoddyl and CasADi with fatrop
come from PyPI, each into an environment of its own below build/peers. What cannot be had is said in the page.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import platform
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

os.environ.setdefault("OMP_NUM_THREADS", "1")

import fatrop
import motions
import sl1m
import tables
import towr
from environments import Unavailable
from measures import measure
from tasks import TASKS, answer_of

#: Gravity of TOWR, which cannot be set [m/s^2]; the scenes have 9.8.
TOWR_GRAVITY = 9.80665


def centroidal(folder: Path, given: Path | None) -> list[dict[str, Any]]:
    """mcplan and TOWR on the tasks."""
    program, found = towr.build(folder, given), []
    for scene, robot in TASKS:
        task, answer = answer_of(scene, robot)
        broken = measure(answer.samples, task.limits).row()
        ours = {"planner": "mcplan plan", "given": "nothing more", "answer": answer.status, "cpu_s": answer.cpu_s}
        found.append({"case": task.name, **ours, **broken})
        limits = replace(task.limits, gravity=TOWR_GRAVITY)
        for gait in towr.gaits_of(answer):
            report, samples = towr.plan(program, task, gait, folder / "runs")
            answered = {0: "solved", 1: "acceptable", -4: "time limit"}.get(
                report["status"], f"Ipopt {report['status']}"
            )
            theirs = {"planner": "TOWR", "given": gait.name, "answer": answered, "cpu_s": report["cpu_s"]}
            found.append({"case": task.name, **theirs, **measure(samples, limits).row()})
            print(f"  {task.name}, {gait.name}: {answered}", flush=True)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    root = Path(__file__).resolve().parents[2]
    parser.add_argument("--only", nargs="+", choices=tables.SECTIONS, default=tuple(tables.SECTIONS), help="some peers")
    parser.add_argument("--sources", type=Path, help="folder with towr, ifopt and sl1m, instead of clones from GitHub")
    parser.add_argument("--build", type=Path, default=root / "build/peers", help="folder of environments and builds")
    parser.add_argument("--out", type=Path, help="write the page there; default: print it")
    words = parser.parse_args()
    ways = {
        "towr": lambda folder: centroidal(folder, words.sources),
        "sl1m": lambda folder: sl1m.rows(folder, words.sources),
        "fatrop": fatrop.rows,
        "motions": motions.rows,
    }
    rows = words.build / "rows.json"
    # Of peers that are not asked for now.
    stored: dict[str, dict[str, Any]] = json.loads(rows.read_text()) if rows.exists() else {}
    kept, dates = stored.get("rows", {}), stored.get("dates", {})
    for name in words.only:
        folder = words.build.absolute() / name
        folder.mkdir(parents=True, exist_ok=True)
        print(f"{name} ...", file=sys.stderr, flush=True)
        try:
            kept[name] = ways[name](folder)
        except Unavailable as error:
            kept[name] = str(error)
        dates[name] = datetime.date.today().isoformat()
        rows.write_text(json.dumps({"rows": kept, "dates": dates}, indent=1) + "\n")
    page = tables.page(kept, dates, f"{platform.machine()}, Python {platform.python_version()}")
    if words.out:
        words.out.write_text(page)
    else:
        print(page)


if __name__ == "__main__":
    main()
