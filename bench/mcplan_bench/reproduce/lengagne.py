"""Tables I to IV and Figures 2 to 4 of S. Lengagne, P. Mathieu, A. Kheddar, E. Yoshida, "Generation of Dynamic
Multi-Contact Motions: 2D case studies", from runs on this machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from mcplan.errors import InvalidInput
from mcplan.extras import require
from mcplan.files.outputs import write_whole
from mcplan_bench import records

from . import lengagne_figures, lengagne_tables
from .lengagne_runs import FILE, Run, collect
from .lengagne_settings import chosen_motions, configs
from .lengagne_text import (
    differences_3,
    differences_4,
    differences_grid,
    differences_kinematics,
    differences_solvers,
    head,
)

TABLES = (1, 2, 3, 4)


def reproduce(
    out: Path,
    quick: bool = False,
    progress: Callable[[str], None] | None = None,
    tables: Sequence[int] = TABLES,
    motions: Sequence[str] | None = None,
    repeats: int = 3,
    resume: bool = False,
) -> list[Path]:
    """Write lengagne.md, the tables as CSV, all numbers as runs.json, film strips as PNG and the plans of Table IV.

    Args:
        out: Folder, made if it does not exist.
        quick: The cartwheel alone, each row once.
        progress: Called with a line for each run.
        tables: Of the paper, 1 to 4.
        motions: "cartwheel", "climbing", "walking" (the paper's), "climbing_steep" (Table III); None: all.
        repeats: Runs of a row that takes less than a second, of which medians are kept.
        resume: Take the runs that runs.json in `out` has and run the rest; where none is missing, nothing is solved.

    Returns:
        The files written, the page first.

    Raises:
        InvalidInput: No such table or motion, repeats below 1, or the runs to resume are those of another version.
        MissingExtra: matplotlib is not installed.
        KeyboardInterrupt: Ctrl-C; what was done by then is written.
    """
    require("mcplan reproduce lengagne", "view", "matplotlib")
    for table in tables:
        if table not in TABLES:
            raise InvalidInput("tables", "must be among 1, 2, 3, 4", str(table))
    if repeats < 1:
        raise InvalidInput("repeats", "must be at least 1", str(repeats))
    chosen = chosen_motions(motions)
    say = progress or (lambda text: None)
    out.mkdir(parents=True, exist_ok=True)
    if quick:
        chosen, repeats = chosen[:1], 1
    requested = configs(sorted(set(tables)), chosen, quick)
    runs, about = collect(requested, out, repeats, resume, say)
    runs = [kept for kept in runs if kept.config in set(requested)]

    parts = {
        "table_1": lengagne_tables.kinematic_rows(runs, 1),
        "table_2": lengagne_tables.kinematic_rows(runs, 2),
        "grid": lengagne_tables.grid_rows(runs),
        "table_3": lengagne_tables.dynamic_rows(runs),
        "table_4": lengagne_tables.full_rows(runs),
        "solvers": [row for table in (3, 4) for row in lengagne_tables.solver_rows(runs, table)],
    }
    written = [out / FILE, *(records.write_csv(out / f"{name}.csv", rows) for name, rows in parts.items() if rows)]
    pictures = lengagne_figures.costs(out, parts["table_4"])
    if 4 in tables:
        pictures += lengagne_figures.strips(out, chosen)
    page = out / "lengagne.md"
    write_whole("\n".join(_page(about, runs, parts, pictures)) + "\n", page)
    if about["interrupted"]:
        raise KeyboardInterrupt
    return [page, *written, *pictures]


def _page(
    about: dict[str, Any], runs: list[Run], parts: dict[str, list[dict[str, Any]]], pictures: list[Path]
) -> list[str]:
    tables = lengagne_tables
    lines = head(about, runs)
    for name, title, table, text in (
        ("table_1", "Table I: kinematics, free-flyer as parameters", tables.kinematic_table, None),
        ("table_2", "Table II: kinematics, free-flyer from the joints", tables.kinematic_table, differences_kinematics),
        ("grid", "Time grid and extrema instead of the hull", tables.grid_table, differences_grid),
        ("table_3", "Table III: dynamics, nothing minimised", tables.dynamic_table, differences_3),
        ("table_4", "Table IV: full motions, least torque", tables.full_table, differences_4),
        ("solvers", "Tables III and IV by Ipopt and by the kernel", tables.solver_table, differences_solvers),
    ):
        if parts[name]:
            lines += ["", f"## {title}", "", *table(parts[name])]
            lines += ["", *text(parts)] if text else []
    for path in pictures:
        if "costs" in path.stem:
            lines += ["", f"![criterion over the cases, paper and here]({path.name})"]
            continue
        (motion, number), *_ = (pair for pair in lengagne_figures.FIGURES.items() if path.stem.endswith(f"_{pair[1]}"))
        lines += ["", f"## Figure {number}: {motion}", "", "Solution of Table IV, case 3, at equal steps in time."]
        lines += ["", f"![{motion}, postures with contact forces and friction cones]({path.name})"]
    return lines
