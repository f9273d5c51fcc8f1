"""Table III of Wang et al. by Ipopt and by mcplan's own interior-point kernel, side by side."""

from __future__ import annotations

from typing import Any

import numpy as np

from .wang_runs import KERNEL, TABLE_3, TERRAINS, Run
from .wang_tables import TITLES


def rows(runs: list[Run]) -> list[dict[str, Any]]:
    """One row per cell of Table III that both were run with, from the scene's own start.

    Args:
        runs: Of both solvers.
    """
    cells = {
        (c.method, c.predicted, c.terrain, c.solver): run
        for run in runs
        if (c := run.config).seed == 0 and c.transcription == "euler" and run.cycles
    }
    out = []
    for method, predicted in TABLE_3:
        for terrain in TERRAINS:
            both = [cells.get((method, predicted, terrain, solver)) for solver in ("ipopt", KERNEL)]
            if None in both:
                continue
            row: dict[str, Any] = {"method": method, "predicted": predicted, "terrain": terrain}
            for name, run in zip(("ipopt", KERNEL), both, strict=True):
                row |= _measures(name, run)  # type: ignore[arg-type]  # neither is None
            row["ratio"] = row["ipopt_cpu_s"] / max(row[f"{KERNEL}_cpu_s"], 1e-9)
            out.append(row)
    return out


def _measures(name: str, run: Run) -> dict[str, Any]:
    cpu = np.array([cycle["cpu_s"] for cycle in run.cycles])
    return {
        f"{name}_iterations": float(np.mean([cycle["iterations"] for cycle in run.cycles])),
        f"{name}_cpu_s": float(cpu.mean()),
        f"{name}_cpu_std_s": float(cpu.std()),
        f"{name}_cpu_max_s": float(cpu.max()),
        f"{name}_converged": sum(cycle["converged"] for cycle in run.cycles),
        f"{name}_cycles": len(run.cycles),
        f"{name}_cost_per_m": run.cost_per_m,
    }


def table(rows: list[dict[str, Any]]) -> list[str]:
    """Both solvers side by side, as Markdown."""
    lines = [
        "| method | terrain | iterations: Ipopt | kernel | processor time [s]: Ipopt | kernel | longest: Ipopt | kernel | ratio "
        "| cost per m: Ipopt | kernel | converged: Ipopt | kernel |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        of = [{key.removeprefix(f"{name}_"): row[key] for key in row} for name in ("ipopt", KERNEL)]
        cells = [f"{one['iterations']:.0f}" for one in of]
        cells += [f"{one['cpu_s']:.3f} ± {one['cpu_std_s']:.3f}" for one in of]
        cells += [f"{one['cpu_max_s']:.3f}" for one in of]
        cells += [f"{row['ratio']:.1f}", *(f"{one['cost_per_m']:.3f}" for one in of)]
        cells += [f"{one['converged']} of {one['cycles']}" for one in of]
        title = f"{TITLES[row['method']]}, {row['predicted']}-step PH"
        lines.append(f"| {title} | {row['terrain']} | " + " | ".join(cells) + " |")
    return lines


def section(rows: list[dict[str, Any]]) -> list[str]:
    """Heading, table and what it says; nothing where the kernel was not run."""
    if not rows:
        return []
    ratios = [row["ratio"] for row in rows]
    apart = [
        row[f"{KERNEL}_cost_per_m"] / row["ipopt_cost_per_m"] - 1.0 for row in rows if row["ipopt_cost_per_m"] > 0.0
    ]
    solved = [sum(row[f"{name}_converged"] for row in rows) for name in ("ipopt", KERNEL)]
    cycles = [sum(row[f"{name}_cycles"] for row in rows) for name in ("ipopt", KERNEL)]
    lines = [
        "### The same by the kernel",
        "",
        "The walks of Table III from the scene's own start once more, with mcplan's own interior-point kernel (`--solver ipm`,",
        "docs/theory/ipm.md) in place of Ipopt. Means over the cycles of a walk, ± their standard deviation; *ratio*: Ipopt's",
        "processor time over the kernel's. Each solver walks on from its own steps.",
        "",
        *table(rows),
        "",
        f"- Converged: {solved[0]} of {cycles[0]} cycles by Ipopt, {solved[1]} of {cycles[1]} by the kernel.",
        f"- Ipopt takes {min(ratios):.1f} to {max(ratios):.1f} times the kernel's processor time.",
    ]
    if apart:
        lines += [
            f"- A metre by the kernel costs {100 * min(apart):+.1f} % to {100 * max(apart):+.1f} % more than one by Ipopt:",
            "  where the two end in other minima of a cycle, their walks go apart.",
        ]
    return [*lines, ""]
