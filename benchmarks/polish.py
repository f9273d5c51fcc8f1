"""What the interior point makes of whole plans, beside the penalty; processor time, one thread.

python benchmarks/polish.py [SCENE ...]
"""

from __future__ import annotations

import argparse
import statistics
import time

import mcplan as mp

SCENES = ["flat", "stairs", "gap", "gap_with_rail", "stepping_stones"]
KINDS = ("penalty", "interior_point")
REPEATS = 3


def plans(name: str) -> dict[str, tuple[float, mp.PlanResult]]:
    """The fastest of some runs of each kind [ms], by turns, since others may use the machine; with the plan."""
    out: dict[str, tuple[float, mp.PlanResult]] = {}
    for _ in range(REPEATS):
        for kind in KINDS:
            begin = time.process_time()
            result = mp.plan(name, "humanoid44", polish=kind)
            ms = 1e3 * (time.process_time() - begin)
            out[kind] = (min(ms, out[kind][0] if kind in out else ms), result)
    return out


def main() -> None:
    """Print a line for each scene, and the medians of the ratios over the scenes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=SCENES, metavar="SCENE")
    faster, cost = [], []
    for name in parser.parse_args().scenes:
        both = plans(name)
        parts = []
        for kind, (ms, result) in both.items():
            report = result.report
            status = report.status.name
            parts.append(f"{kind} {ms:.0f} ms ({status}, J {report.cost:.4g}, {report.iterations} iterations)")
        faster.append(both["penalty"][0] / both["interior_point"][0])
        cost.append(both["interior_point"][1].report.cost / both["penalty"][1].report.cost)
        print(f"{name}: {'; '.join(parts)}; {faster[-1]:.2f} times faster, J {cost[-1]:.3f} times as high", flush=True)
    print(f"medians: {statistics.median(faster):.2f} times faster at {statistics.median(cost):.3f} times the cost")


if __name__ == "__main__":
    main()
