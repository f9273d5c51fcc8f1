"""Table II and Figures 1 to 4 of Y. Tazaki, "Fast Multi-Contact Motion Planning Based on Best-Neighbor Search of Contact
Sequences", from runs on this machine: the published form of the search and ours, and a robot of 44 kg that follows the
plans. And its model of contacts against ours, which has no table in the paper.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan.extras import require
from mcplan.files.outputs import write_whole
from mcplan_bench import SCENES, records
from mcplan_bench.speed import iterations, searching_iterations

from . import tazaki_figures, tazaki_models, tazaki_settings, tazaki_text, tazaki_tracking
from .tazaki_names import METHODS, PREFIX

if TYPE_CHECKING:
    from mcplan.ddp import Result

#: Table II: average time of an iteration [ms] with and without OpenMP, on a Ryzen 5950X.
PUBLISHED_MS = {
    "flat": (12.16, 11.36),
    "stairs": (16.73, 13.55),
    "gap": (12.72, 10.87),
    "gap_with_rail": (14.29, 12.16),
}


def reproduce(out: Path, quick: bool = False, progress: Callable[[str], None] | None = None) -> list[Path]:
    """Write tazaki.md, tables as CSV, the figures as PNG, and the robot of Figure 2 as URDF and TOML.

    Args:
        out: Folder, made if it does not exist.
        quick: One repeat instead of nine, one scene instead of four, two settings instead of 15, one run of Figure 2.
        progress: Called with a line for each thing that is done.

    Returns:
        The files written, the page first.

    Raises:
        MissingExtra: matplotlib is not installed.
    """
    require("mcplan reproduce tazaki", "view", "matplotlib")
    import mcplan

    say = progress or (lambda text: None)
    out.mkdir(parents=True, exist_ok=True)
    names = SCENES[:1] if quick else SCENES
    threads = max(2, os.cpu_count() or 1)
    robot = mcplan.load_robot("humanoid44")
    loads = [_load()]
    rows = []
    for name in names:
        rows.append(table_2_row(name, robot, 1 if quick else 9, threads))
        say(f"Table II, {name}: " + ", ".join(f"{method} {rows[-1][f'{method}_1_ms']:.3f} ms" for method in METHODS))
        loads.append(_load())
    results: dict[str, dict[str, Result]] = {}
    for name in names:
        results[name] = {}
        for method, options in METHODS.items():
            result = mcplan.plan(name, robot, record_history=True, **options)
            results[name][method] = result
            say(f"figures, {name}, {method}: {result.report.status}")
    solved = tazaki_settings.measure(names, robot, quick, say)
    compared, rail = tazaki_models.compare_models(names, robot, say)
    followed, written, missing = tazaki_tracking.track_all(out, names, quick, say)
    tables = {"table_2": rows, "settings": solved, "models": compared, "figure_2": followed}
    written += [records.write_csv(out / f"{PREFIX}{name}.csv", table) for name, table in tables.items() if table]
    drawn = tazaki_models.save_hand_forces(out, rail)
    written += [drawn] if drawn else []
    written += [
        draw(out, results) for draw in (tazaki_figures.figure_1, tazaki_figures.figure_3, tazaki_figures.figure_4)
    ]
    page = out / "tazaki.md"
    pictures = [path.name for path in written if path.suffix == ".png"]
    lines = [
        *tazaki_text.head(records.machine(), results, loads),
        *tazaki_text.table_2(rows, threads, max(loads) > (os.cpu_count() or 1)),
        *tazaki_text.solved(solved, results),
        *tazaki_text.figures(pictures),
        *tazaki_text.figure_2(followed, pictures, missing),
        *tazaki_models.section_lines(compared, drawn.name if drawn else ""),
    ]
    write_whole("\n".join(lines) + "\n", page)
    return [page, *written]


def _load() -> float:
    """Load average of the last minute."""
    return os.getloadavg()[0]


def table_2_row(name: str, robot: Any, repeats: int, threads: int) -> dict[str, Any]:
    """Times per iteration on one thread and on several, for both methods, beside the published ones."""
    import mcplan

    scene = mcplan.load_scene(name)
    first = searching_iterations(mcplan.plan(scene, robot).report)
    with_ms, without_ms = PUBLISHED_MS[name]
    row: dict[str, Any] = {"scene": name, "published_parallel_ms": with_ms, "published_1_ms": without_ms}
    for method, options in METHODS.items():
        limits = {} if method == "paper" else {"max_iterations": first, "restarts": 0}
        for count in (threads, 1):
            timing, results = iterations(scene, robot, repeats, {**options, **limits, "threads": count})
            kind = "parallel" if count > 1 else "1"
            row[f"{method}_{kind}_ms"] = timing.ms
            if count > 1:
                row[f"{method}_parallel_loops"] = results[0].report.parallel_loops
        row[f"{method}_neighbours"] = timing.neighbours
        row[f"{method}_pricing_ratio"] = timing.pricing_ratio
    whole, _ = iterations(scene, robot, repeats, {})
    row["standard_all_ms"] = whole.ms
    return row
