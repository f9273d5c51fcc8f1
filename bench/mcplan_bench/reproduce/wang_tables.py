"""Table III and the costs of Figure 4 of Wang et al. from the runs, beside what is published."""

from __future__ import annotations

from typing import Any

import numpy as np

from .wang_runs import METHODS, TERRAINS, Run

TITLES = {
    "single": "baseline (`single`)",
    "com": "candidate 1 (`com`)",
    "rectangle": "candidate 2 (`rectangle`)",
    "point": "candidate 3 (`point`)",
}

#: Table III: mean and standard deviation of the time of a cycle [s], for the terrains in order.
PUBLISHED_3 = {
    ("single", 1): ((1.63, 1.56), (0.78, 0.22), (1.84, 1.67)),
    ("single", 2): ((2.93, 2.02), (1.45, 0.58), (3.53, 3.16)),
    ("rectangle", 2): ((1.30, 0.59), (1.00, 0.27), (1.12, 0.24)),
    ("point", 2): ((0.58, 0.03), (0.57, 0.06), (0.62, 0.07)),
}


def find(runs: list[Run], terrain: str, method: str, predicted: int) -> Run | None:
    """The run from the scene's own start, if there is one."""
    for run in runs:
        c = run.config
        if (c.terrain, c.method, c.predicted, c.seed) == (terrain, method, predicted, 0):
            return run
    return None


def horizons(runs: list[Run], method: str) -> list[int]:
    """Numbers of predicted steps that were run."""
    return sorted({run.config.predicted for run in runs if run.config.method == method})


def seeds(runs: list[Run]) -> list[int]:
    """Seeds of the noisy starts."""
    return sorted({run.config.seed for run in runs if run.config.seed})


def table_3_rows(runs: list[Run]) -> list[dict[str, Any]]:
    """One row per cell: time, processor time and iterations of its cycles over all starts."""
    out = []
    for (method, predicted), published in PUBLISHED_3.items():
        for terrain, (mean, deviation) in zip(TERRAINS, published, strict=True):
            here = [
                run
                for run in runs
                if (run.config.method, run.config.predicted, run.config.terrain) == (method, predicted, terrain)
            ]
            cycles = [cycle for run in here for cycle in run.cycles]
            if not cycles:
                continue
            row: dict[str, Any] = {
                "method": method,
                "predicted": predicted,
                "terrain": terrain,
                "published_mean_s": mean,
                "published_std_s": deviation,
                "starts": len(here),
                "cycles": len(cycles),
                "converged": sum(cycle["converged"] for cycle in cycles),
            }
            for name, key in (("time", "time_s"), ("cpu", "cpu_s"), ("iterations", "iterations")):
                values = np.array([cycle[key] for cycle in cycles], dtype=float)
                row |= {f"{name}_mean": values.mean(), f"{name}_std": values.std(), f"{name}_max": values.max()}
            total = sum(cycle["time_s"] for cycle in cycles)
            row["evaluation_ratio"] = sum(cycle["evaluation_s"] for cycle in cycles) / total
            row["load"] = float(np.mean([run.load for run in here]))
            out.append(row)
    return out


def table_3(rows: list[dict[str, Any]]) -> list[str]:
    """Table III as Markdown."""
    lines = [
        "| method | terrain | paper [s] | here, wall clock [s] | longest | processor time [s] | iterations | cycles converged |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        lines.append(
            f"| {TITLES[row['method']]}, {row['predicted']}-step PH | {row['terrain']} "
            f"| {row['published_mean_s']:.2f} ± {row['published_std_s']:.2f} "
            f"| {row['time_mean']:.3f} ± {row['time_std']:.3f} | {row['time_max']:.3f} "
            f"| {row['cpu_mean']:.3f} ± {row['cpu_std']:.3f} "
            f"| {row['iterations_mean']:.0f} ± {row['iterations_std']:.0f} | {row['converged']} of {row['cycles']} |"
        )
    return lines


def faster(rows: list[dict[str, Any]], method: str = "point") -> list[tuple[str, float, float]]:
    """For each terrain the time of the 1-step baseline over that of a method with two steps: published and here."""
    return [
        (baseline["terrain"], baseline["published_mean_s"] / other["published_mean_s"], _ratio(baseline, other, "cpu"))
        for baseline, other in _beside_baseline(rows, method)
    ]


def why_slower(rows: list[dict[str, Any]], method: str) -> tuple[float, float] | None:
    """Iterations, and processor time of one, of a method with two steps over those of the 1-step baseline: means over
    terrains. None without such runs."""
    pairs = _beside_baseline(rows, method)
    if not pairs:
        return None
    iterations = float(np.mean([1.0 / _ratio(baseline, other, "iterations") for baseline, other in pairs]))
    time = float(np.mean([1.0 / _ratio(baseline, other, "cpu") for baseline, other in pairs]))
    return iterations, time / iterations


def _beside_baseline(rows: list[dict[str, Any]], method: str) -> list[tuple[dict[str, Any], dict[str, Any]]]:
    cells = {(row["method"], row["predicted"], row["terrain"]): row for row in rows}
    both = [(cells.get(("single", 1, terrain)), cells.get((method, 2, terrain))) for terrain in TERRAINS]
    return [(baseline, other) for baseline, other in both if baseline and other]


def _ratio(baseline: dict[str, Any], other: dict[str, Any], what: str) -> float:
    return float(baseline[f"{what}_mean"] / other[f"{what}_mean"])


def cost_rows(runs: list[Run]) -> list[dict[str, Any]]:
    """One row per walk from the scene's start: what Figures 4d-4i show."""
    out = []
    for run in runs:
        if run.config.seed or not run.cycles:
            continue
        times = np.array([cycle["time_s"] for cycle in run.cycles])
        cpu = np.array([cycle["cpu_s"] for cycle in run.cycles])
        out.append(
            {
                "terrain": run.config.terrain,
                "method": run.config.method,
                "predicted": run.config.predicted,
                "success": run.success,
                "cycles": len(run.cycles),
                "failure": run.failure,
                "distance_m": run.distance_m,
                "cost_per_m": run.cost_per_m,
                "acc_per_m": run.acc_per_m,
                "momentum_per_m": run.momentum_per_m,
                "time_mean_s": times.mean(),
                "time_std_s": times.std(),
                "cpu_mean_s": cpu.mean(),
                "iterations_mean": float(np.mean([cycle["iterations"] for cycle in run.cycles])),
                "defect": max(cycle["defect"] for cycle in run.cycles),
                "drift_com_m": max(cycle["drift_com_m"] for cycle in run.cycles),
                "drift_momentum": max(cycle["drift_momentum"] for cycle in run.cycles),
            }
        )
    order = {terrain: i for i, terrain in enumerate(TERRAINS)}
    return sorted(out, key=lambda r: (METHODS.index(r["method"]), r["predicted"], order[r["terrain"]]))


def rises(rows: list[dict[str, Any]], ratio: float = 0.05) -> tuple[int, int]:
    """How often one more predicted step raised the cost per metre by more than `ratio`, and of how many times."""
    cells = {(r["method"], r["terrain"], r["predicted"]): r["cost_per_m"] for r in rows if r["success"]}
    pairs = [(cost, cells[m, t, p + 1]) for (m, t, p), cost in cells.items() if (m, t, p + 1) in cells]
    return sum(after > (1.0 + ratio) * before for before, after in pairs), len(pairs)


def costs(rows: list[dict[str, Any]]) -> list[str]:
    """The numbers of Figure 4 as Markdown."""
    lines = [
        "| method | PH | terrain | cycles | distance [m] | acceleration per m | momentum per m | wall clock [s] | processor [s] "
        "| iterations |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        done = f"{row['cycles']}" if row["success"] else f"{row['failure']}"
        lines.append(
            f"| `{row['method']}` | {row['predicted']} | {row['terrain']} | {done} | {row['distance_m']:.2f} "
            f"| {row['acc_per_m']:.3f} | {row['momentum_per_m']:.4f} | {row['time_mean_s']:.3f} ± {row['time_std_s']:.3f} "
            f"| {row['cpu_mean_s']:.3f} | {row['iterations_mean']:.0f} |"
        )
    return lines
