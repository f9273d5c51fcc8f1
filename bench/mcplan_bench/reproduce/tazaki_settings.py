"""What the published form of the search solves and what ours does, from 15 settings each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from mcplan import Robot
from mcplan_bench.criteria import comparable_cost
from mcplan_bench.robustness import SETTINGS
from mcplan_bench.sections import ABSENT, number, table_lines
from mcplan_bench.speed import PAPER

Row = dict[str, Any]

#: The published form with the paper's input and with ours, then our search with the paper's model and with ours.
FORMS: dict[str, dict[str, Any]] = {
    "paper's, input $\\lambda$": PAPER,
    "paper's, input $\\mu$": {**PAPER, "stiffness_input": "mu"},
    "ours, `lipm`": {"model": "lipm"},
    "ours, `wrench`": {},
}


def measure(names: Sequence[str], robot: Robot, quick: bool, say: Callable[[str], None]) -> list[Row]:
    """Plan scenes by all forms from all settings; quick: from the first two.

    Returns:
        A row for each scene and form.
    """
    rows = []
    for name in names:
        for form, options in FORMS.items():
            rows.append(_row(name, form, robot, options, SETTINGS[:2] if quick else SETTINGS))
            say(f"settings, {name}, {form}: {rows[-1]['solved']} of {rows[-1]['settings']} solved")
    return rows


def _row(name: str, form: str, robot: Robot, options: dict[str, Any], settings: Sequence[tuple[float, float]]) -> Row:
    import mcplan

    scene = mcplan.load_scene(name)
    reports = [
        mcplan.plan(scene, robot, **options, proximal_weight=weight, duration_initial_s=duration).report
        for weight, duration in settings
    ]
    published = "method" in options
    costs = [report.paper_cost if published else comparable_cost(report) for report in reports]
    return {
        "scene": name,
        "form": form,
        "settings": len(reports),
        "solved": sum(str(report.status) == "solved" for report in reports),
        "at_rest": sum(report.paper_verdict.startswith("converged") for report in reports) if published else None,
        "cost_min": min(costs),
        "cost_median": float(np.median(costs)),
        "cost_max": max(costs),
        "iterations": float(np.median([report.iterations for report in reports])),
    }


def table(rows: Sequence[Row]) -> list[str]:
    """The rows as lines of Markdown."""
    head = ["scene", "form", "accepted by the checker", "at rest by its own cost", "J, least", "median", "largest"]
    cells = [
        [
            row["scene"],
            row["form"],
            f"{row['solved']} of {row['settings']}",
            ABSENT if row["at_rest"] is None else f"{row['at_rest']} of {row['settings']}",
            *(number(row[f"cost_{which}"], ".3g") for which in ("min", "median", "max")),
        ]
        for row in rows
    ]
    return table_lines(head, cells)
