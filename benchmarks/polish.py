"""What the interior point makes of whole plans and of replanning, beside the penalty; processor time, one thread.

python benchmarks/polish.py [SCENE ...]
"""

from __future__ import annotations

import statistics
import sys
import time

from replanning import TIMES_S, measured

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


def main(scenes: list[str]) -> None:
    """Print two lines for each scene, whole plans and replanning, and the medians of the ratios over the scenes."""
    faster, cost, again_faster = [], [], []
    for name in scenes:
        both = plans(name)
        parts = []
        for kind, (ms, result) in both.items():
            report = result.report
            parts.append(f"{kind} {ms:.0f} ms ({report.status}, J {report.cost:.4g}, {report.iterations} iterations)")
        faster.append(both["penalty"][0] / both["interior_point"][0])
        cost.append(both["interior_point"][1].report.cost / both["penalty"][1].report.cost)
        print(f"{name}: {'; '.join(parts)}; {faster[-1]:.2f} times faster, J {cost[-1]:.3f} times as high", flush=True)
        # Both replan the same plan from the same states.
        first = both["penalty"][1].plan
        took: dict[str, list[float]] = {kind: [] for kind in KINDS}
        ends: dict[str, list[str]] = {kind: [] for kind in KINDS}
        for t in TIMES_S:
            for kind in KINDS:
                begin = time.process_time()
                report = mp.replan(first, t, measured(first, t), polish=kind).report
                took[kind].append(1e3 * (time.process_time() - begin))
                ends[kind].append(f"{report.cost:.4g}" if str(report.status) == "solved" else str(report.status))
        again_faster += [old / new for old, new in zip(*took.values(), strict=True)]
        words = [
            f"{kind} median {statistics.median(took[kind]):.0f} ms, max {max(took[kind]):.0f} ms, J {', '.join(ends[kind])}"
            for kind in KINDS
        ]
        print(f"{name}, replanned at {', '.join(map(str, TIMES_S))} s: {'; '.join(words)}", flush=True)
    print(
        f"medians: whole plans {statistics.median(faster):.2f} times faster at {statistics.median(cost):.3f} times the cost, "
        f"replanning {statistics.median(again_faster):.2f} times faster"
    )


if __name__ == "__main__":
    main(sys.argv[1:] or SCENES)
