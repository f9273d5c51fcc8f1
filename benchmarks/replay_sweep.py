"""Replay every plan of a sweep that is called solved: by the checker, and from its forces alone.

mcplan sweep benchmarks/reliability.toml --out out/reliability --jobs 2
python benchmarks/replay_sweep.py out/reliability [--jobs 2] [--every 10]

Exit code 1 if a replay disagrees. Friction is that of the generator `solvable`.
"""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

import mcplan as mp
from mcplan_bench.solvable import rejection


def replayed(out: Path, name: str) -> str:
    """What is wrong with a plan of the sweep; empty: nothing."""
    return rejection(mp.Plan.load(out / name))


def main() -> int:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=Path, help="Folder of the sweep.")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="Number of processes.")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="Replay every N-th plan.")
    given = parser.parse_args()
    table, times = mp.load_sweep(given.out).table, mp.load_sweep(given.out).times
    solved = table[table["status"] == "solved"]
    wrong = []
    with ProcessPoolExecutor(given.jobs) as pool:
        names = list(solved["plan"])[:: given.every]
        for k, found in enumerate(pool.map(partial(replayed, given.out), names, chunksize=20), 1):
            wrong += [f"{names[k - 1]}: {found}"] if found else []
            if k % 500 == 0:
                print(f"{k} of {len(names)} replayed, {len(wrong)} rejected", flush=True)
    print(table.groupby("entry")["status"].value_counts().to_string())
    print(f"{len(solved)} of {len(table)} solved; {len(wrong)} of {len(names)} rejected by a replay")
    spent = times["plan_cpu_s"]
    print(
        f"CPU of a plan: median {spent.median():.2f} s, 99 % {spent.quantile(0.99):.2f} s, longest {spent.max():.2f} s"
    )
    print("\n".join(wrong))
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
