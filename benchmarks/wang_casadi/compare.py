"""mcplan's receding horizon beside CasADi + Ipopt: the same cycles in one run, in turn, on one thread.

    python benchmarks/wang_casadi/compare.py [--repeats 3] [--out build/wang_casadi]

mcplan walks; the state at the start of each of its cycles is what CasADi solves too, warm-started from its own solution two
cycles before. Needs the extra `bench`. What may be compared and what not: benchmarks/README.md.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from typing import Any

from run import MODES, TERRAINS, versions  # first: it sets the number of threads

import mcplan  # isort: skip
import numpy as np  # isort: skip
from horizon import Settings  # isort: skip
from loop import Loop, State  # isort: skip
from walker import load_patches, load_walker  # isort: skip

CASES = (("point", 3), ("single", 2))
LIMIT = 1e-4  # of the relative difference of the optima


def planner(
    terrain: str, robot: str, fidelity: str, lookahead: int, transcription: str, paper: bool, solver: str = "ipopt"
) -> Any:
    """mcplan's, before its first cycle."""
    from mcplan._core import rhp

    options = rhp.Options()
    options.fidelity, options.transcription = getattr(rhp.Fidelity, fidelity), getattr(rhp.Transcription, transcription)
    options.lookahead, options.paper, options.solver = lookahead, paper, getattr(rhp.Solver, solver)
    # As in the peers' program.
    options.foothold_margin_m, options.sole_ratio, options.com_height = 0.0, 1.0, (0.87, 1.07)
    return rhp.RecedingHorizon(mcplan.load_scene(terrain), mcplan.load_robot(robot), options)


def state_of(ours: Any, terrain: str) -> State:
    """Where mcplan's next cycle starts."""
    patches, at = load_patches(terrain), ours.state()
    return State(
        np.array(at.com_W),
        np.array(at.com_velocity_W),
        np.array(at.angular_momentum_W),
        np.array(at.feet_W),
        (patches[at.surfaces[0]], patches[at.surfaces[1]]),
    )


def walk(
    terrain: str, robot: str, case: tuple[str, int], mode: tuple[str, bool], peers: dict[str, Loop], cycles: int
) -> list[dict[str, Any]]:
    """One walk of mcplan, every cycle solved by the peers too."""
    ours = planner(terrain, robot, *case, *mode)
    rows = []
    for _ in range(cycles):
        start = state_of(ours, terrain)
        cpu = time.process_time()
        cycle = ours.step()
        row: dict[str, Any] = {
            "mcplan": {
                "cost": cycle.cost,
                "iterations": cycle.iterations,
                "time_s": cycle.time_s,
                "evaluation_s": cycle.evaluation_s,
                "cpu_s": time.process_time() - cpu,
                "success": cycle.executed,
            }
        }
        for form, peer in peers.items():
            out = peer.step(start).outcome
            running = out.objective - out.parts["terminal"]
            row[form] = {
                "cost": out.objective,
                "iterations": out.iterations,
                "time_s": out.time_s,
                "evaluation_s": out.evaluation_s,
                "cpu_s": out.cpu_s,
                "success": out.success,
                "difference": (cycle.cost - out.objective) / abs(out.objective),
                "difference_running": (cycle.cost - out.objective) / running,
            }
        rows.append(row)
        if not cycle.executed:
            break
    return rows


def measured(
    terrain: str, robot: str, case: tuple[str, int], mode: tuple[str, bool], cycles: int, repeats: int
) -> dict[str, Any]:
    """Medians over repeats of every cycle; means of them over the cycles with a warm start."""
    forms = ("same", "plain") if mode[1] else ("same",)
    walker = load_walker(terrain, robot)
    built = {form: Loop(walker, Settings(*case, *mode, form=form)) for form in forms}
    for loop in built.values():  # not timed
        loop.horizon(0), loop.horizon(1)
    runs = []
    for _ in range(repeats):
        peers = {form: Loop(walker, loop.settings, loop.horizons) for form, loop in built.items()}
        runs.append(walk(terrain, robot, case, mode, peers, cycles))
    names = ("mcplan", *forms)

    def mean(name: str, key: str) -> float:
        return float(np.mean([np.median([run[i][name][key] for run in runs]) for i in range(2, len(runs[0]))]))

    out: dict[str, Any] = {
        "terrain": terrain,
        "fidelity": case[0],
        "lookahead": case[1],
        "transcription": mode[0],
        "paper": mode[1],
        "cycles_done": sum(row["mcplan"]["success"] for row in runs[0]),
    }
    for name in names:
        out[name] = {key: mean(name, key) for key in ("time_s", "cpu_s", "iterations")}
        out[name]["evaluation_ratio"] = mean(name, "evaluation_s") / out[name]["time_s"]
        out[name]["ms_per_iteration"] = 1e3 * out[name]["time_s"] / out[name]["iterations"]
    for form in forms:
        out[form]["ratio"] = out[form]["time_s"] / out["mcplan"]["time_s"]
        out[form]["ratio_cpu"] = out[form]["cpu_s"] / out["mcplan"]["cpu_s"]
        for key in ("difference", "difference_running"):
            out[form][key] = [row[form][key] for row in runs[0] if row[form]["success"] and row["mcplan"]["success"]]
        out[form]["other_optima"] = int(np.sum(np.abs(out[form]["difference"]) > LIMIT))
    return out | {"cycles": runs[0]}


HEAD = (
    "terrain",
    "fidelity",
    "look-ahead",
    "transcription",
    "mcplan [s]",
    "it.",
    "eval.",
    "CasADi",
    "[s]",
    "it.",
    "eval.",
    "ratio",
    "of CPU time",
    "median and largest difference of the optima",
    "cycles with another optimum",
)


def markdown(rows: list[dict[str, Any]]) -> str:
    """The table."""
    lines = ["| " + " | ".join(HEAD) + " |", "|" + "---|" * len(HEAD)]
    for row in rows:
        ours = row["mcplan"]
        for form in ("same", "plain"):
            if form not in row:
                continue
            peer, apart = row[form], np.abs(row[form]["difference"])
            cells = (
                row["terrain"],
                row["fidelity"],
                row["lookahead"],
                row["transcription"],
                f"{ours['time_s']:.3f}",
                f"{ours['iterations']:.1f}",
                f"{ours['evaluation_ratio']:.1%}",
                form,
                f"{peer['time_s']:.3f}",
                f"{peer['iterations']:.1f}",
                f"{peer['evaluation_ratio']:.1%}",
                f"{peer['ratio']:.2f}",
                f"{peer['ratio_cpu']:.2f}",
                f"{np.median(apart):.1e}, {np.max(apart):.1e}",
                peer["other_optima"],
            )
            lines.append("| " + " | ".join(str(cell) for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--cycles", type=int, default=14)
    parser.add_argument("--robot", default="talos_wang")
    parser.add_argument("--terrains", nargs="+", default=list(TERRAINS))
    parser.add_argument("--out", type=Path, default=Path("build/wang_casadi"))
    args = parser.parse_args()
    rows = []
    for case in CASES:
        for mode in MODES:
            for terrain in args.terrains:
                rows.append(measured(terrain, args.robot, case, mode, args.cycles, args.repeats))
                lines = markdown(rows[-1:]).splitlines()
                print("\n".join(lines if len(rows) == 1 else lines[2:]), flush=True)
    args.out.mkdir(parents=True, exist_ok=True)
    (args.out / "compare.json").write_text(json.dumps({"versions": versions(), "rows": rows}, indent=1) + "\n")
    (args.out / "compare.md").write_text(markdown(rows))


if __name__ == "__main__":
    main()
