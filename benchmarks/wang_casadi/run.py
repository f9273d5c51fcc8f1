"""CasADi + Ipopt on the program of docs/theory/rhp.md: the first cycles that the tests compare with, and whole walks.

    python benchmarks/wang_casadi/run.py first-cycles --out tests/data/wang_casadi_first_cycles.json
    python benchmarks/wang_casadi/run.py walks --form plain --out build/casadi_walks.json

Needs the extra `bench`. One thread.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import subprocess
import sys
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

for _library in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_library, "1")

import casadi as ca  # noqa: E402
import numpy as np  # noqa: E402
from horizon import Settings  # noqa: E402
from loop import Cycle, Loop  # noqa: E402
from program import Values  # noqa: E402
from walker import load_walker  # noqa: E402

TERRAINS = ("up_and_down", "v_shape", "rubbles")
#: Fidelity and look-ahead.
CASES = (("single", 2), ("single", 3), ("com", 3), ("rectangle", 3), ("point", 3))
#: Transcription and whether as published.
MODES = (("euler", True), ("trapezoidal", False))


def versions() -> dict[str, str]:
    """Of CasADi, and of the Ipopt and the linear solver in its wheel, which only Ipopt's banner tells."""
    script = "import casadi as c; x=c.SX.sym('x'); c.nlpsol('s','ipopt',dict(x=x,f=x**2))(x0=1)"
    banner = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    found = re.search(r"This is Ipopt version (\S+), running with linear solver (.+?)\.\n", banner)
    return {"casadi": ca.__version__} | ({"ipopt": found[1], "linear_solver": found[2]} if found else {})


def record(cycle: Cycle) -> dict[str, Any]:
    """A cycle for a file."""
    outcome = cycle.outcome
    end = {"com_W": cycle.end.com, "com_velocity_W": cycle.end.velocity, "angular_momentum_W": cycle.end.momentum}
    return {
        "cycle": cycle.index,
        "status": outcome.status,
        "success": outcome.success,
        "iterations": outcome.iterations,
        "objective": outcome.objective,
        "parts": outcome.parts,
        "footholds_W": cycle.footholds.tolist(),
        "durations_s": cycle.durations.tolist(),
        "end": {name: value.tolist() for name, value in end.items()},
    }


def times(cycle: Cycle) -> dict[str, float]:
    """Of a cycle [s]: wall clock, process, wall clock in functions and derivatives."""
    return {name: getattr(cycle.outcome, name) for name in ("time_s", "cpu_s", "evaluation_s")}


def noisy(guess: Values, seed: int) -> Values:
    """A guess with normal noise: 0.05 (m, m/s, s) on motion, footholds and durations, 0.1 on all else."""
    rng = np.random.default_rng(seed)
    return {
        name: value + rng.normal(scale=0.05 if name[0] in "cvwT" else 0.1, size=value.shape)
        for name, value in guess.items()
    }


def first_cycles() -> list[dict[str, Any]]:
    """The first cycle of every case, mode and terrain, from the nominal guess, and the optima that noisy ones find."""
    rows = []
    for fidelity, lookahead in CASES:
        for transcription, paper in MODES:
            settings = Settings(fidelity, lookahead, transcription, paper)
            for terrain in TERRAINS:
                loop = Loop(load_walker(terrain), settings)
                cycle = loop.step()
                others = []
                for seed in (1, 2, 3):
                    again = Loop(loop.walker, settings, loop.horizons)
                    other = again.step(perturb=partial(noisy, seed=seed)).outcome
                    others.append(other.objective if other.success else None)
                about = {"terrain": terrain, "fidelity": fidelity, "lookahead": lookahead}
                about |= {"transcription": transcription, "paper": paper}
                sizes = {"from_noisy_guesses": others, "sizes": loop.horizon(0).program.sizes}
                rows.append(about | record(cycle) | sizes)
                print(
                    *about.values(),
                    cycle.outcome.status,
                    cycle.outcome.iterations,
                    f"{cycle.outcome.objective:.6f}",
                    others,
                    flush=True,
                )
    return rows


def summary(loop: Loop, cycles: int) -> dict[str, Any]:
    """Of a walk; times and iterations over the cycles after the first two, which have no warm start."""
    done = [cycle for cycle in loop.cycles if cycle.outcome.success]
    warm = [cycle.outcome for cycle in loop.cycles[2:]]
    distance = float(done[-1].end.com[0] - done[0].start.com[0]) if done else 0.0
    per_metre = {
        name: sum(cycle.outcome.parts[f"{name}_executed"] for cycle in done) / distance if done else None
        for name in ("acc", "momentum")
    }
    out: dict[str, Any] = {
        "success": len(done) == cycles,
        "cycles_done": len(done),
        "distance_m": distance,
        "acc_per_m": per_metre["acc"],
        "momentum_per_m": per_metre["momentum"],
        "status": loop.cycles[-1].outcome.status,
        "sizes": loop.horizon(0).program.sizes,
    }
    if warm:
        wall = np.array([outcome.time_s for outcome in warm])
        out |= {
            "iterations": float(np.mean([outcome.iterations for outcome in warm])),
            "time_s": float(wall.mean()),
            "time_std_s": float(wall.std()),
            "time_max_s": float(wall.max()),
            "cpu_s": float(np.mean([outcome.cpu_s for outcome in warm])),
            "evaluation_ratio": float(sum(outcome.evaluation_s for outcome in warm) / wall.sum()),
        }
    return out


def walks(form: str, cycles: int, mode: tuple[str, bool]) -> list[dict[str, Any]]:
    """Whole walks of every case and terrain."""
    rows = []
    for fidelity, lookahead in CASES:
        settings = Settings(fidelity, lookahead, *mode, form=form)
        for terrain in TERRAINS:
            loop = Loop(load_walker(terrain), settings)
            loop.run(cycles)
            total = summary(loop, cycles)
            each = [record(c) | times(c) for c in loop.cycles]
            rows.append({"terrain": terrain} | asdict(settings) | total | {"cycles": each})
            numbers = {k: round(v, 4) for k, v in total.items() if isinstance(v, float)}
            print(fidelity, lookahead, *mode, form, terrain, total["cycles_done"], total["status"], numbers, flush=True)
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("first-cycles", "walks"))
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--form", choices=("same", "plain"), default="same", help="of the walks")
    parser.add_argument("--transcription", choices=("euler", "trapezoidal"), default="euler", help="of the walks")
    parser.add_argument("--cycles", type=int, default=14)
    args = parser.parse_args()
    if args.what == "first-cycles":
        rows = first_cycles()
    else:
        rows = walks(args.form, args.cycles, (args.transcription, args.transcription == "euler"))
    command = "python benchmarks/wang_casadi/run.py " + " ".join(sys.argv[1:])
    args.out.parent.mkdir(parents=True, exist_ok=True)
    args.out.write_text(json.dumps({"command": command, "versions": versions(), "rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
