"""The quadratic programs of a tracked walk, solved by ProxQP as in mcplan and by other solvers, in one run on one core.

    .venv/bin/python benchmarks/tracking_qp/compare.py [--case flat/talos] [--seconds 4]

The first run puts quadprog, Clarabel and OSQP into build/tracking_qp, since mcplan does not need them. What is compared:
benchmarks/README.md.
"""

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ("quadprog==0.1.14", "clarabel==0.11.1", "osqp==1.1.3")
#: Of OSQP and its import of a code generator; what else it asks for is in mcplan's environment.
NEEDED = ("jinja2", "markupsafe", "joblib", "setuptools")

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # read when NumPy is imported
os.environ.setdefault("OMP_NUM_THREADS", "1")


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("--case", default="flat/talos", help="of mcplan bench tracking, of a humanoid")
    words.add_argument("--seconds", type=float, default=4.0, help="of the walk")
    words.add_argument("--packages", type=Path, default=ROOT / "build/tracking_qp", help="where solvers are put")
    given = words.parse_args()
    provide(given.packages)
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

    import numpy as np
    from solvers import SOLVERS, excess, objective

    problems = recorded(given.case, given.seconds)
    times = {name: [] for name in SOLVERS}
    costs, worst, failures = {name: [] for name in SOLVERS}, dict.fromkeys(SOLVERS, 0.0), dict.fromkeys(SOLVERS, 0)
    solvers = {name: make() for name, make in SOLVERS.items()}
    for problem, structure in problems:
        for name, solve in solvers.items():
            tick = time.perf_counter()
            x = solve(problem, structure)
            times[name].append(1e3 * (time.perf_counter() - tick))
            if x is None:
                failures[name] += 1
                costs[name].append(np.nan)
                continue
            costs[name].append(objective(problem, x))
            worst[name] = max(worst[name], excess(problem, x))
    sizes = sorted({(len(p.gradient), len(p.equality_value), len(p.lower)) for p, _ in problems})
    print(f"{len(problems)} programs of {given.case}; variables, equalities, rows: {', '.join(map(str, sizes))}")
    print(
        f"{'':10}{'median ms':>11}{'p99 ms':>9}{'ratio':>8}{'not solved':>12}{'excess':>10}{'cost above quadprog':>22}"
    )
    reference, best = np.median(times["ProxQP"]), np.array(costs["quadprog"])
    for name in SOLVERS:
        above = np.nanmax((np.array(costs[name]) - best) / np.maximum(np.abs(best), 1.0))
        print(
            f"{name:10}{np.median(times[name]):11.3f}{np.quantile(times[name], 0.99):9.3f}"
            f"{np.median(times[name]) / reference:8.2f}{failures[name]:12d}{worst[name]:10.1e}{above:22.1e}"
        )


def provide(folder: Path) -> None:
    """Put the solvers where they can be imported, behind everything else."""
    ready = folder / "ready"
    if not ready.exists():
        print(f"Putting {', '.join(PACKAGES)} into {folder} (once)", flush=True)
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", str(folder)]
        subprocess.run([*pip, *PACKAGES, *NEEDED], check=True)
        ready.touch()
    sys.path.append(str(folder))


def recorded(name: str, seconds: float) -> list:
    """Programs and structures of all control steps of the first seconds of a tracked plan."""
    from mcplan.tracking.options import Options
    from mcplan.tracking.quadratic_program import QuadraticProgram
    from mcplan_bench.tracking import plan_of, track_plan
    from mcplan_bench.tracking_cases import named

    found = []
    solve = QuadraticProgram.solve

    def kept(self, problem, structure):
        found.append((problem, structure))
        return solve(self, problem, structure)

    QuadraticProgram.solve = kept
    try:
        track_plan(named(name), plan_of(named(name)).plan)
    finally:
        QuadraticProgram.solve = solve
    return found[: round(seconds / Options().control_step_s)]


if __name__ == "__main__":
    main()
