"""Table II and Figures 1, 3 and 4 of Y. Tazaki, "Fast Multi-Contact Motion Planning Based on Best-Neighbor Search of
Contact Sequences", from runs on this machine: the published form of the search and ours. And its model of contacts against
ours, which has no table in the paper.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.extras import require
from mcplan.files.outputs import write_whole
from mcplan_bench import SCENES, records
from mcplan_bench.speed import PAPER, iterations, searching_iterations

from . import tazaki_models

if TYPE_CHECKING:
    from mcplan.ddp import Result

#: Table II: average time of an iteration [ms] with and without OpenMP, on a Ryzen 5950X.
PUBLISHED_MS = {
    "flat": (12.16, 11.36),
    "stairs": (16.73, 13.55),
    "gap": (12.72, 10.87),
    "gap_with_rail": (14.29, 12.16),
}

METHODS: dict[str, dict[str, Any]] = {"paper": PAPER, "standard": {}}


def reproduce(out: Path, quick: bool = False, progress: Callable[[str], None] | None = None) -> list[Path]:
    """Write tazaki.md, table_2.csv, models.csv and the figures as PNG.

    Args:
        out: Folder, made if it does not exist.
        quick: One repeat instead of nine, one scene instead of four.
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
    rows = []
    for name in names:
        rows.append(table_2_row(name, robot, 1 if quick else 9, threads))
        say(f"Table II, {name}: " + ", ".join(f"{method} {rows[-1][f'{method}_1_ms']:.3f} ms" for method in METHODS))
    written = [records.write_csv(out / "table_2.csv", rows)]
    results: dict[str, dict[str, Result]] = {}
    for name in names:
        results[name] = {}
        for method, options in METHODS.items():
            result = mcplan.plan(name, robot, record_history=True, **options)
            results[name][method] = result
            written += figures(out, name, method, result)
            say(f"figures, {name}, {method}: {result.report.status}")
    compared, rail = tazaki_models.compare_models(names, robot, say)
    written.append(records.write_csv(out / "models.csv", compared))
    drawn = tazaki_models.save_hand_forces(out, rail)
    written += [drawn] if drawn else []
    page = out / "tazaki.md"
    models = tazaki_models.section_lines(compared, drawn.name if drawn else "")
    write_whole(page_text(rows, results, threads, models), page)
    return [page, *written]


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


def figures(out: Path, name: str, method: str, result: Result) -> list[Path]:
    """Figures 1, 3 and 4 of one scene."""
    from mcplan.view.pictures.picture import picture
    from mcplan.view.plots.report import has_sequences, plot_contact_sequence, plot_cost
    from mcplan.view.sheets import save_figure

    written = []
    if result.plan.phases:
        written.append(picture(result.plan, path=out / f"figure_1_{name}_{method}.png"))
    if has_sequences(result.report):
        written.append(out / f"figure_3_{name}_{method}.png")
        save_figure(plot_contact_sequence(result.report, result.plan), written[-1])
    if result.report.history:
        written.append(out / f"figure_4_{name}_{method}.png")
        save_figure(plot_cost(result.report), written[-1])
    return written


def late_switches(result: Result) -> int:
    """Switches in the last ten iterations: chattering, when there are any."""
    return sum(row.switches for row in result.report.history[-10:])


def page_text(
    rows: list[dict[str, Any]], results: dict[str, dict[str, Result]], threads: int, models: list[str]
) -> str:
    """The page: table, text, lines on the models, figures."""
    machine = records.machine()
    phases = max(len(result.plan.phases) for by_method in results.values() for result in by_method.values())
    lines = [
        "# Table II and Figures 1, 3, 4 of Tazaki's paper",
        "",
        f"mcplan {machine['version']} on {machine['cpu']}, {machine['cores']} cores; robot humanoid44, {phases} phases.",
        'Written by `mcplan reproduce tazaki`. "paper": `method="paper"`, `stiffness_input="lambda_"`, the published',
        'algorithm; "ours": the defaults.',
        "",
        "## Table II: average time of an iteration [ms]",
        "",
        f"| scene | published (Ryzen 5950X), parallel | not | paper here, {threads} threads | 1 thread "
        f"| ours, {threads} threads | 1 thread | ours, with the frozen iterations |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        keys = ("published_parallel_ms", "published_1_ms", "paper_parallel_ms", "paper_1_ms", "standard_parallel_ms")
        cells = [_cell(row, key) for key in (*keys, "standard_1_ms", "standard_all_ms")]
        lines.append(f"| {row['scene']} | {' | '.join(cells)} |")
    ratio = float(np.median([row["paper_1_ms"] / row["standard_1_ms"] for row in rows]))
    lines += [
        "",
        *_differences(ratio),
        "",
        *_threads(rows, threads),
        "",
        *_figures_text(),
        "",
        "## How the runs ended",
        "",
        "Status, cost and worst constraint are those of the plan, whose contacts were made exact, by the checker. The last",
        "column has the published algorithm's own: its cost at its last iterate, and whether that had come to rest.",
        "",
        "| scene | method | status | cost | iterations | switches | of these in the last 10 iterations | worst constraint "
        "| by its own measures |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for name, by_method in results.items():
        for method, result in by_method.items():
            report = result.report
            lines.append(
                f"| {name} | {_title(method)} | {report.status} | {report.cost:.3g} | {report.iterations} "
                f"| {report.switches} | {late_switches(result)} | {report.worst_violation} | {_own_verdict(report)} |"
            )
    lines += ["", *models]
    titles = {
        1: "Figure 1: the motions found",
        3: "Figure 3: contact sequence over the number of switches",
        4: "Figure 4: complementarity weight and cost over the iterations",
    }
    for number, title in titles.items():
        lines += ["", f"## {title}"]
        for name, by_method in results.items():
            for method in by_method:
                lines += ["", f"![{name}, {_title(method)}](figure_{number}_{name}_{method}.png)"]
    return "\n".join(lines) + "\n"


def _title(method: str) -> str:
    return "ours" if method == "standard" else method


def _cell(row: dict[str, Any], key: str) -> str:
    """A time; a dash where threads were asked for and none was started."""
    started = not key.endswith("_parallel_ms") or row.get(key.replace("_ms", "_loops"), 1) > 0
    return f"{row[key]:.2f}" if started else "–"


def _own_verdict(report: Any) -> str:
    return f"cost {report.paper_cost:.3g}, {report.paper_verdict}" if report.paper_verdict else "–"


def _differences(ratio: float) -> list[str]:
    return [
        "What is counted: linearisation, value functions, pricing of the neighbours and line search, by wall clock, divided",
        "by the number of iterations; median over repeats. Of ours, the iterations in which the sequence is free; the last",
        "column averages over all, also those that polish a frozen sequence. First sequence, closing of the dynamics defects",
        "and checking come once a plan and are left out, as in the paper.",
        "",
        f"On one thread here an iteration of the published form takes {ratio:.1f} times as long as one of ours (median of the",
        "scenes). Where it comes from: the published form computes all value functions anew for each switch and starts each",
        "iteration with J* at infinity, so that it makes at least one switch whether or not that pays; a neighbour costs it",
        "a Riccati step and a minimisation. Ours starts from the cost of staying, updates value functions from the switched",
        "step on, prices neighbours by their low rank and leaves out end-effectors that may touch nothing in the scene.",
    ]


def _threads(rows: list[dict[str, Any]], threads: int) -> list[str]:
    """What threads did, of the forms of which any were started."""
    lines = [
        'Threads: the paper runs its loop over neighbours as a "parallel for", and found OpenMP to be slower by 7 to 23.5 %.'
    ]
    for method, whose in (("paper", "The published form here"), ("standard", "Ours")):
        entered = [row for row in rows if row.get(f"{method}_parallel_loops", 0) > 0]
        if not entered:
            why = (
                "there is one processor, or no OpenMP"
                if method == "paper"
                else "it shares out loops of 400 neighbours or more, which none of these scenes has"
            )
            lines.append(f"{whose} started no thread: {why}; there is nothing to compare (–).")
            continue
        loops = sum(row[f"{method}_parallel_loops"] for row in entered)
        ratio = float(np.median([row[f"{method}_parallel_ms"] / row[f"{method}_1_ms"] for row in entered]))
        lines.append(
            f"{whose} shared out {loops} loops over neighbours among {threads} threads at most, in a run of each scene: an "
            f"iteration takes {ratio:.2f} times as long as with one (median of the scenes)."
        )
    return [*lines, "One thread is the default."]


def _figures_text() -> list[str]:
    return [
        "Not the same as in the paper: a proximal term in its form too (docs/theory/ddp.md says why); the machine. Figure 3:",
        "the published form keeps switching to the end, which the paper calls persistent chattering; ours stops when the cost",
        "no longer falls. The sequence is drawn as it is after an iteration; switches there and back within one do not show.",
        "In Figure 4 the costs are those at the weight of each iteration, so they rise with it; ours polishes",
        "at the full weight after the search, compares several first guesses, and begins again from other settings when the",
        "checker rejects a plan: where its cost jumps, another candidate begins.",
    ]
