"""Tables I-III and Figures 4 and 5 of J. Wang, S. Kim, S. Vijayakumar, S. Tonneau, "Multi-Fidelity Receding Horizon
Planning for Multi-Contact Locomotion", from runs on this machine.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from mcplan.errors import InvalidInput
from mcplan.extras import require
from mcplan.files.outputs import write_whole
from mcplan_bench import records

from . import wang_figures, wang_kernel, wang_size, wang_table_2, wang_tables, wang_tracking
from .wang_runs import FILE, NOISE, ROBOT, TERRAINS, Run, collect, configs
from .wang_runs import rows as cycle_rows


def reproduce(
    out: Path,
    quick: bool = False,
    progress: Callable[[str], None] | None = None,
    cycles: int = 14,
    lookahead_max: int = 5,
    seeds: int = 0,
    tracked_seeds: int = 0,
    no_track: bool = False,
    resume: bool = False,
) -> list[Path]:
    """Write wang.md, the tables as CSV, all numbers as runs.json and cycles.csv, and the figures as PNG.

    Args:
        out: Folder, made if it does not exist.
        quick: One terrain, two cycles, horizons of at most three steps.
        progress: Called with a line for each walk.
        cycles: Steps of each walk.
        lookahead_max: Longest horizon in steps, the executed one included: 2 to 10.
        seeds: Noisy starts of the walks with one and two predicted steps, beside the scene's own.
        tracked_seeds: Those of them that are tracked, too.
        no_track: Track nothing: Table II then has the planner's own measures alone.
        resume: Take the walks that runs.json and tracked.jsonl in `out` have and run the rest; where none is missing,
            nothing is solved or simulated.

    Returns:
        The files written, the page first.

    Raises:
        InvalidInput: A number is out of its range, or the walks to resume are those of another version.
        MissingExtra: matplotlib is not installed, or what tracking needs.
        KeyboardInterrupt: Ctrl-C; what was done by then is written.
    """
    require("mcplan reproduce wang", "view", "matplotlib")
    if not no_track:
        require("mcplan reproduce wang", "sim", "mujoco", "pinocchio", "proxsuite")
    _require_numbers(cycles, lookahead_max, {"seeds": seeds, "tracked_seeds": tracked_seeds})
    say = progress or (lambda text: None)
    out.mkdir(parents=True, exist_ok=True)
    if quick:
        cycles, lookahead_max = min(cycles, 2), min(lookahead_max, 3)
    requested = configs(lookahead_max, seeds, TERRAINS[-1:] if quick else TERRAINS, trapezoidal=not quick)
    sizes = wang_size.built()
    made, about = collect(requested, cycles, out, resume, say)
    everything = [run for run in made if run.config.solver == "ipopt"]
    tracked: list[wang_tracking.Tracked] = []
    if not (no_track or about["interrupted"]):
        longest = 1 if quick else wang_tracking.LONGEST
        candidates = wang_tracking.wanted(everything, tracked_seeds, longest)
        tracked, about["interrupted"] = wang_tracking.collect(candidates, out, resume, say)
    written = _write(out, about, sizes, everything, tracked, wang_kernel.rows(made))
    if about["interrupted"]:
        raise KeyboardInterrupt
    return written


def _write(
    out: Path,
    about: dict[str, Any],
    sizes: list[dict[str, Any]],
    everything: list[Run],
    tracked: list[wang_tracking.Tracked],
    solvers: list[dict[str, Any]],
) -> list[Path]:
    """Write tables, figures and the page, which comes first of what is returned."""
    runs = [run for run in everything if run.config.transcription == "euler"]
    table_2, table_3 = wang_table_2.rows(everything, tracked), wang_tables.table_3_rows(runs)
    figure_4, figure_5 = wang_tables.cost_rows(runs), wang_figures.figure_5_rows(runs)
    written = [
        out / FILE,
        records.write_csv(out / "cycles.csv", cycle_rows(everything)),
        records.write_csv(out / "tracked.csv", wang_table_2.run_rows(tracked)),
        records.write_csv(out / "table_1.csv", sizes),
        records.write_csv(out / "table_2.csv", table_2),
        records.write_csv(out / "table_3.csv", table_3),
        records.write_csv(out / "solvers.csv", solvers),
        records.write_csv(out / "figure_4.csv", figure_4),
        records.write_csv(out / "figure_5.csv", figure_5),
        *wang_figures.pictures(out),
        wang_figures.figure_4(out, runs),
        wang_figures.figure_5(out, figure_5),
    ]
    page = out / "wang.md"
    tables = (_table_2(table_2, runs, tracked), table_3, solvers)
    lines = _page(about, runs, sizes, tables, (figure_4, figure_5))
    write_whole("\n".join(lines) + "\n", page)
    return [page, *written]


def _table_2(rows: list[dict[str, Any]], runs: list[Run], tracked: list[wang_tracking.Tracked]) -> list[str]:
    starts = wang_table_2.starts(wang_table_2.start_rows(tracked))
    return [*wang_table_2.table(rows, runs, tracked), *starts, *wang_table_2.details(tracked)]


def _require_numbers(cycles: int, lookahead_max: int, seeds: dict[str, int]) -> None:
    for name, value, low, high in (("cycles", cycles, 1, None), ("lookahead_max", lookahead_max, 2, 10)):
        if value < low or (high is not None and value > high):
            raise InvalidInput(name, f"must be {low} to {high}" if high else f"must be at least {low}", str(value))
    for name, value in seeds.items():
        if value < 0:
            raise InvalidInput(name, "must be at least 0", str(value))


def _page(
    about: dict[str, Any],
    runs: list[Run],
    sizes: list[dict[str, Any]],
    tables: tuple[list[str], list[dict[str, Any]], list[dict[str, Any]]],
    figures: tuple[list[dict[str, Any]], list[dict[str, Any]]],
) -> list[str]:
    """Lines of wang.md; table II as lines, table III, the solvers and figures 4 and 5 as rows."""
    (table_2, table_3, solvers), (figure_4, figure_5) = tables, figures
    return [
        *_head(about, wang_tables.seeds(runs), table_3),
        "## Table I: variables and constraints of an instant",
        "",
        *wang_size.table(sizes),
        "",
        "## Table II: predicted steps needed",
        "",
        *table_2,
        "",
        "## Table III: time of a cycle",
        "",
        *wang_tables.table_3(table_3),
        "",
        *_times(table_3),
        "",
        *wang_kernel.section(solvers),
        "## Figure 4: cost and time over the horizon",
        "",
        "![terrains, cost and time](figure_4.png)",
        "",
        *_costs(figure_4),
        "",
        *wang_tables.costs(figure_4),
        "",
        "## Figure 5: time to plan a step and time to walk it",
        "",
        "![time to plan against duration](figure_5.png)",
        "",
        *_margin(figure_5),
    ]


def _head(about: dict[str, Any], seeds: list[int], table_3: list[dict[str, Any]]) -> list[str]:
    load = sum(row["load"] for row in table_3) / max(len(table_3), 1)
    busy = ", more than the cores: wall clocks are longer than on an idle machine" if load > about["cores"] else ""
    named = (
        f"{seeds[0]} to {seeds[-1]}"
        if len(seeds) > 2 and seeds[-1] - seeds[0] == len(seeds) - 1
        else ", ".join(map(str, seeds))
    )
    starts = f"and for Table III from noisy ones (seeds {named})" if seeds else "(no seeds)"
    lines = [
        "# Tables I to III and Figures 4 and 5 of Wang et al.",
        "",
        f"mcplan {about['version']}, {about['date']}, on {about['cpu']}, {about['cores']} cores, one thread;",
        f"load average during the runs of Table III: {load:.1f}{busy}.",
        f"Robot {ROBOT}, {about['cycles']} cycles a walk, from the scene's start {starts}.",
        "Written by `mcplan reproduce wang`, which also writes the numbers of every cycle to `runs.json` and `cycles.csv`; from",
        "the former `mcplan reproduce wang --resume` draws all again.",
        "",
        'All walks are in the paper\'s form: `paper=True` and, where nothing else is said, `transcription="euler"`. "n-step PH"',
        "is a prediction horizon of n steps, `lookahead` n + 1.",
        "",
    ]
    if about["interrupted"]:
        lines += ["**Interrupted: walks are missing.**", ""]
    return lines


def _times(rows: list[dict[str, Any]]) -> list[str]:
    ratio = max((row["evaluation_ratio"] for row in rows), default=0.0)
    compared = "; ".join(
        f"{terrain} {published:.1f} there, {here:.1f} here" for terrain, published, here in wang_tables.faster(rows)
    )
    lines = [
        "Mean and standard deviation over the cycles of all starts, failed ones included. Wall clock is set-up, solve and",
        "check of a cycle. Processor time is that of its thread: waiting for a busy machine does not add to it, shared caches",
        "do; on an idle machine the two agree.",
        "",
        "Differences:",
        "",
        "- Solver and machine: KNITRO 10.10 with functions from CasADi in Python on a laptop with a Xeon E3-1535M v6 (at most",
        "  4.2 GHz) there, Ipopt with MUMPS and functions in C++ here.",
        "- The program: implied faces of the polytopes are left out, psi is eliminated, and the matrix is ordered by AMD.",
        f"  Functions and derivatives take at most {100 * ratio:.1f} % of the time in any cell: the language they are",
        "  written in decides little, the factorisation of the matrix most.",
        "- The guess: the paper draws ten random guesses for the first two cycles of each walk, from which Ipopt does not",
        "  converge and KNITRO, by the authors' published logs, needs 541 and 783 iterations. Here these cycles start from a",
        f"  nominal guess, and `--seeds` moves the start of the walk by up to {100 * NOISE:.0f} % of the scale of each number.",
        "  So the paper's mean and spread hold its first cycles' long searches, and ours are steadier.",
    ]
    if compared:
        lines += [
            "",
            "How many times as long as `point` with two predicted steps the baseline with one takes, by the means (here of",
            f"processor time): {compared}.",
            "The paper's baseline is slow through long searches, its standard deviation being as large as its mean on two",
            "terrains; such searches are rare here, which leaves the gain of the smaller program.",
        ]
    lines += _candidate_2(rows)
    return lines


def _candidate_2(rows: list[dict[str, Any]]) -> list[str]:
    """Candidate 2 beside the baseline, than which it is faster on two of three terrains in the paper."""
    why = wang_tables.why_slower(rows, "rectangle")
    if why is None:
        return []
    compared = "; ".join(
        f"{terrain} {published:.1f} there, {here:.1f} here"
        for terrain, published, here in wang_tables.faster(rows, "rectangle")
    )
    iterations, time = why
    verdict = "is slower than the baseline here" if iterations * time > 1.0 else "is faster than the baseline here, too"
    return [
        "",
        "The same ratio for `rectangle` with two predicted steps:",
        f"{compared}.",
        f"Candidate 2 {verdict}: it takes {iterations:.2f} times as many iterations, and each of them {time:.2f} times as",
        "long, since its second predicted step makes the program larger (variables and rows in the table above) and its",
        "relaxed torques are rows of every corner. Where it is faster in the paper, it needs none of the baseline's long",
        "searches.",
    ]


def _costs(rows: list[dict[str, Any]]) -> list[str]:
    risen, pairs = wang_tables.rises(rows)
    return [
        "Running cost of the executed steps, acceleration and momentum, over the distance. The paper prints curves and no",
        "numbers for them: the baseline lowest, candidate 3 below candidate 2, both far higher with one predicted step than with",
        "two. It finds that longer horizons usually cost less; here one more step raised the cost by over 5 % in",
        f"{risen} of {pairs} cases, for a walk has several local optima, with costs up to a factor of two apart.",
        "Nor are the foot polytopes that are public today quite those of the authors (steps of 0.317 and 0.323 m on level ground",
        "instead of 0.327 m). Walks that fail have no point in the figure.",
    ]


def _margin(rows: list[dict[str, Any]]) -> list[str]:
    late = {
        name: sum(row[f"{name}_mean_s"] >= row["motion_mean_s"] for row in rows) for name in ("single_1", "point_2")
    }
    return [
        "Means over terrains and starts, with their standard deviation; processor time. Planning takes longer than walking the",
        f"step in {late['single_1']} of {len(rows)} cycles with the baseline and in {late['point_2']} with `point`.",
        "In the paper it often does with the baseline and never with `point`.",
    ]
