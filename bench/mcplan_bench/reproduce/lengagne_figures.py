"""Figures 2 to 4 of Lengagne et al., and the costs of Table IV, from the runs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mcplan.view.colours import COOL, TEXT
from mcplan.view.sheets import label, legend, save_figure, sheet

from . import lengagne_paper as paper
from .lengagne_settings import Config

#: The paper's figures by motion.
FIGURES = {"cartwheel": 2, "climbing": 3, "walking": 4}

#: Prefix of the pictures' names: the page is in one folder with those of other papers.
PREFIX = "lengagne_"

GREY = "#B9C1CA"
#: [1/inch] of pictures: small enough for a page.
DPI = 90


def strips(out: Path, motions: Sequence[str]) -> list[Path]:
    """Film strips of the solutions of Table IV, case 3; motions without one are left out."""
    from mcplan.files.whole_body_plans import load_whole_body_plan
    from mcplan.planar.view import film_strip

    written = []
    for motion, number in FIGURES.items():
        saved = out / f"{Config(4, motion, 'tube', forces='per_point').key}.npz"
        if motion in motions and saved.exists():
            path = out / f"{PREFIX}figure_{number}.png"
            save_figure(film_strip(load_whole_body_plan(saved), frames=8), path, dpi=DPI)
            written.append(path)
    return written


def costs(out: Path, rows: list[dict[str, Any]]) -> list[Path]:
    """Criterion of Table IV over the case, paper and here, as ratios to case 2, which all motions have."""
    motions = [m for m in FIGURES if any(row["motion"] == m and row["case"] == 2 and row["kept"] for row in rows)]
    if not motions:
        return []
    figure, axes = sheet(1, len(motions), size=(3.6 * len(motions) + 0.6, 3.6), sharey=True)
    for column, motion in enumerate(motions):
        chart = axes[0, column]
        chart.grid(False, axis="x")
        here = {row["case"]: row["cost"] for row in rows if row["motion"] == motion and row["kept"]}
        there = {case: paper.TABLE_4[motion, case].criterion for case in paper.CASES if (motion, case) in paper.TABLE_4}
        for shift, values, colour, name in ((-0.2, there, GREY, "paper"), (0.2, here, COOL[0], "here")):
            ratios = [values[case] / values[2] for case in values]
            bars = chart.bar([case + shift for case in values], ratios, 0.36, color=colour, label=name)
            chart.bar_label(bars, [f"{value:.4g}" for value in values.values()], fontsize=8, color=TEXT, padding=2)
        chart.set_xlim(0.5, 3.5)
        chart.set_xticks(list(paper.CASES), [f"{c}\n{name}" for c, name in paper.CASES.items()])
        label(chart, y="criterion over that of case 2" if column == 0 else "", title=motion)
    axes[0, 0].set_ylim(top=1.08 * axes[0, 0].get_ylim()[1])
    legend(axes[0, 0], loc="upper right")
    path = out / f"{PREFIX}costs.png"
    save_figure(figure, path, dpi=DPI)
    return [path]
