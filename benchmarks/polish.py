"""What the interior point for fixed sequences makes of whole plans: processor time and cost beside the penalty, one thread.

python benchmarks/polish.py [SCENE ...]
"""

from __future__ import annotations

import sys
import time

import mcplan as mp

SCENES = ["flat", "stairs", "gap", "gap_with_rail", "stepping_stones"]
REPEATS = 3


def main(scenes: list[str]) -> None:
    """Print a line for each scene: the fastest of some runs, by turns, since others may use the machine."""
    for name in scenes:
        ms = {"penalty": float("inf"), "interior_point": float("inf")}
        words = {}
        for _ in range(REPEATS):
            for polish in ("penalty", "interior_point"):
                begin = time.process_time()
                report = mp.plan(name, "humanoid44", polish=polish).report
                ms[polish] = min(ms[polish], 1e3 * (time.process_time() - begin))
                words[polish] = f"{report.status}, J {report.cost:.4g}, {report.iterations} iterations"
        ratio = ms["penalty"] / ms["interior_point"]
        parts = "; ".join(f"{polish} {ms[polish]:.0f} ms ({words[polish]})" for polish in words)
        print(f"{name}: {parts}; {ratio:.2f} times faster", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or SCENES)
