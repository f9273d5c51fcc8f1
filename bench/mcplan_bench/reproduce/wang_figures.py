"""Figures 4 and 5 of Wang et al. from the runs."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mcplan.view.colours import COM, COOL, TEXT, WARM
from mcplan.view.sheets import label, legend, save_figure, sheet

from .wang_runs import METHODS, TERRAINS, Config, Run, plan_path
from .wang_tables import find, horizons

LOOKS = {
    "single": (COOL[0], "o", "baseline (single)"),
    "com": (COM, "x", "candidate 1 (com)"),
    "rectangle": (WARM[1], "s", "candidate 2 (rectangle)"),
    "point": (WARM[0], "^", "candidate 3 (point)"),
}

Chart = tuple[list[int], list[float]]


def pictures(out: Path) -> list[Path]:
    """Pictures of the terrains with the walk of `point` with two predicted steps; terrains without one are left out."""
    from mcplan import Plan
    from mcplan.view.pictures.picture import picture

    written = []
    for terrain in TERRAINS:
        saved = plan_path(out, Config(terrain, "point", 2))
        if saved.exists():
            written.append(picture(Plan.load(saved), path=out / f"figure_4_{terrain}.png", meshes=False))
    return written


def curve(runs: list[Run], terrain: str, method: str, value: str) -> Chart:
    """Horizons that succeed, and their cost per metre or mean time of a cycle [s]."""
    steps, values = [], []
    for predicted in horizons(runs, method):
        run = find(runs, terrain, method, predicted)
        if run is None or not run.success:
            continue
        steps.append(predicted)
        values.append(run.cost_per_m if value == "cost" else float(np.mean([c[value] for c in run.cycles])))
    return steps, values


def figure_4(out: Path, runs: list[Run]) -> Path:
    """(a)-(c) terrains, (d)-(f) cost per metre and (g)-(i) time of a cycle over the number of predicted steps."""
    from matplotlib.image import imread

    figure, axes = sheet(3, 3, size=(13.0, 8.4), height_ratios=(0.55, 1.0, 1.0))
    rows = (("cost", "cost per metre"), ("cpu_s", "processor time of a cycle [s]"))
    highest = [
        max((max(curve(runs, t, m, value)[1], default=0.0) for t in TERRAINS for m in METHODS), default=0.0)
        for value, _ in rows
    ]
    for column, terrain in enumerate(TERRAINS):
        top = axes[0, column]
        top.axis("off")
        label(top, title=f"({'abc'[column]}) {terrain}")
        still = out / f"figure_4_{terrain}.png"
        if still.exists():
            top.imshow(imread(still))
        for row, (value, title) in enumerate(rows):
            chart = axes[1 + row, column]
            for method in METHODS:
                steps, values = curve(runs, terrain, method, value)
                colour, marker, name = LOOKS[method]
                if steps:
                    chart.plot(steps, values, color=colour, marker=marker, markersize=6, label=name)
            label(
                chart,
                x="predicted steps" if row else "",
                y=title if column == 0 else "",
                title=f"({'defghi'[3 * row + column]})",
            )
            chart.set_xticks(sorted({p for m in METHODS for p in horizons(runs, m)}))
            chart.set_ylim(0.0, 1.08 * highest[row] or 1.0)
    lines = axes[1, 0].get_legend_handles_labels()
    figure.legend(*lines, loc="outside lower center", ncol=4, frameon=False, fontsize=10, labelcolor=TEXT)
    path = out / "figure_4.png"
    save_figure(figure, path)
    return path


def figure_5_rows(runs: list[Run]) -> list[dict[str, Any]]:
    """Per cycle, over terrains and starts: mean and standard deviation of the processor times and of the motion [s]."""
    rows = []
    count = max((len(run.cycles) for run in runs), default=0)
    for index in range(count):
        row: dict[str, Any] = {"cycle": index + 1}
        for name, method, predicted, key in (
            ("single_1", "single", 1, "cpu_s"),
            ("point_2", "point", 2, "cpu_s"),
            ("motion", "point", 2, "duration_s"),
        ):
            values = [
                run.cycles[index][key]
                for run in runs
                if (run.config.method, run.config.predicted) == (method, predicted) and index < len(run.cycles)
            ]
            row[f"{name}_mean_s"] = float(np.mean(values)) if values else float("nan")
            row[f"{name}_std_s"] = float(np.std(values)) if values else float("nan")
        rows.append(row)
    return rows


def figure_5(out: Path, rows: list[dict[str, Any]]) -> Path:
    """Time to plan a cycle against the duration of its motion."""
    figure, axes = sheet(1, 1, size=(10.5, 4.2))
    chart = axes[0, 0]
    chart.grid(False, axis="x")
    at = np.array([row["cycle"] for row in rows], dtype=float)
    for shift, name, colour, title in (
        (-0.27, "single_1", LOOKS["single"][0], "planning, baseline (single), 1-step PH"),
        (0.0, "point_2", LOOKS["point"][0], "planning, candidate 3 (point), 2-step PH"),
        (0.27, "motion", "#B9C1CA", "motion of the cycle (point)"),
    ):
        means = [row[f"{name}_mean_s"] for row in rows]
        spread = [row[f"{name}_std_s"] for row in rows]
        error = {"ecolor": TEXT, "elinewidth": 1.0, "capsize": 2.5}
        chart.bar(at + shift, means, 0.25, yerr=spread, color=colour, label=title, error_kw=error)
    chart.set_xticks(at)
    chart.set_ylim(bottom=0.0)
    label(chart, x="cycle", y="time [s]")
    legend(figure, loc="outside upper center", ncol=3)
    path = out / "figure_5.png"
    save_figure(figure, path)
    return path
