"""mcplan bench"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated, Any

import typer

from mcplan.arguments import MAX_JOBS
from mcplan.cli.given_options import at_least, named_as_typed, require_none_given, within
from mcplan_bench.cli.output import say

from .contacts import contacts
from .deadlines import deadlines
from .motion import motion
from .tracking import tracking

app = typer.Typer(
    invoke_without_command=True,
    rich_markup_mode=None,
)
app.command()(contacts)
app.command()(deadlines)
app.command()(motion)
app.command()(tracking)

_OUT = typer.Option("--out", metavar="DIR", help="Folder for JSON and CSV.")
_JOBS = typer.Option("--jobs", metavar="N", callback=within(1, MAX_JOBS), help="Number of processes.")
_SCENES = typer.Option("--scenes", metavar="N", callback=at_least(0), help="Number of random scenes.")
_SEED = typer.Option("--seed", metavar="K", callback=at_least(0), help="Seed of the first random scene.")
_ROBOT = typer.Option("--robot", metavar="R", help="Robot: built-in name or TOML file.")


@app.callback()
@named_as_typed("repeats", "threads")
def speed(
    context: typer.Context,
    repeats: Annotated[
        int,
        typer.Option(
            "--repeats", metavar="N", callback=at_least(1), help="Number of solves of which a median is taken."
        ),
    ] = 7,
    threads: Annotated[
        int, typer.Option("--threads", metavar="N", callback=at_least(1), help="Number of threads of this search.")
    ] = 1,
    quick: Annotated[bool, typer.Option("--quick", help="Measure the growth at few sizes only.")] = False,
    out: Annotated[Path, _OUT] = Path("out/bench"),
    json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> int:
    """Time this search against the paper's, and its growth.

    Growth is with phases, end-effectors and surfaces. Times are medians over repeats, in one run. An iteration is what
    both methods repeat: linearise, value functions, pricing, line search; of this search those with the sequence free
    (`iteration`) and all with the later, frozen ones (`all`).

    Example: mcplan bench --repeats 5

    Example: mcplan bench robustness --scenes 40
    """
    if context.invoked_subcommand is not None:
        require_none_given(context, f"must stand after {context.invoked_subcommand}, or be left out")
        return 0
    from mcplan.files.outputs import require_folder
    from mcplan_bench import growth, records
    from mcplan_bench import speed as bench

    require_folder("--out", out)
    rows = bench.compare(repeats=repeats, threads=threads, progress=say)
    grown = growth.measure(quick, max(1, repeats - 2), threads, say)
    result: dict[str, Any] = {
        "machine": records.machine(),
        "threads": threads,
        "repeats": repeats,
        "scenes": rows,
        "growth": grown,
        "exponents": growth.exponents(grown),
    }
    records.write_csv(out / "speed.csv", rows)
    records.write_csv(out / "growth.csv", grown)
    records.write_json(out / "bench.json", result)
    if json:
        print(json_module.dumps(records.plain(result)))
        return 0
    _print_speed(rows)
    _print_growth(grown, result["exponents"])
    print(f"Wrote {out}/bench.json, speed.csv, growth.csv")
    return 0


@app.command()
@named_as_typed("scenes", "seed", "model", time_limit_s="--time-limit")
def robustness(
    scenes: Annotated[int, _SCENES] = 300,
    seed: Annotated[int, _SEED] = 0,
    settings: Annotated[
        bool, typer.Option("--settings/--no-settings", help="Plan the 15 settings on the paper's four scenes.")
    ] = True,
    robot: Annotated[str, _ROBOT] = "humanoid44",
    model: Annotated[
        str | None,
        typer.Option("--model", metavar="M", help="Model of contacts: wrench (default) or lipm, the paper's."),
    ] = None,
    time_limit: Annotated[
        float | None, typer.Option("--time-limit", metavar="S", help="Maximum time of each solve [s]; default: none.")
    ] = None,
    jobs: Annotated[int, _JOBS] = 1,
    out: Annotated[Path, _OUT] = Path("out/robustness"),
    json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> int:
    """Count good plans over settings and random scenes.

    There are 15 settings on the paper's four scenes, and random scenes that can be crossed. Settings: proximal_weight
    10, 30, 100 x duration_initial_s 0.30, 0.35, 0.40, 0.45, 0.50. What is good there: flat: solved, no flight, feet
    alternate; stairs: the same and a contact on every tread; gap: solved with one flight, apex 0.15 m over take-off;
    gap_with_rail: solved with both hands on the pads while both feet are off. A random scene is good when solved. Every
    solved plan is checked again. Exit code 1 unless 14 of 15 settings of every scene and 90 % of the random scenes are
    good. Repeat a failure: python -m mcplan.files.generate random SEED > scene.toml

    Example: mcplan bench robustness --scenes 40 --seed 100 --jobs 2

    Example: mcplan bench robustness --model lipm
    """
    from mcplan.files.outputs import require_folder
    from mcplan_bench import records
    from mcplan_bench import robustness as bench

    require_folder("--out", out)
    options: dict[str, Any] = {"robot": robot, "time_limit_s": time_limit, "model": model or ""}
    result: dict[str, Any] = {"machine": records.machine(), "seed": seed, "model": model}
    enough = True
    for part, tasks, ratio in (
        ("settings", bench.setting_tasks(**options) if settings else [], 14 / 15),
        ("random", bench.random_tasks(scenes, seed, **options), 0.9),
    ):
        if not tasks:
            continue
        outcomes = bench.run(tasks, jobs, say)
        rows = bench.summary(outcomes)
        result[part] = {"summary": rows, "outcomes": [outcome.row() for outcome in outcomes]}
        records.write_csv(out / f"{part}.csv", result[part]["outcomes"])
        good = sum(outcome.good for outcome in outcomes)
        if part == "settings":
            enough = enough and all(row["good"] >= ratio * row["runs"] for row in rows)
        else:
            enough = enough and good >= ratio * len(outcomes)
        if not json:
            _print_part(part, rows, outcomes)
    records.write_json(out / "robustness.json", result)
    print(json_module.dumps(records.plain(result)) if json else f"Wrote {out}/robustness.json and CSV beside it")
    return 0 if enough else 1


def _print_speed(rows: list[dict[str, Any]]) -> None:
    from mcplan.cli.table import print_table

    print("Time per iteration, and of a whole plan")
    print_table(
        [
            [
                row["scene"],
                f"{row['iteration_ms']:.3f} ms",
                f"{row['iteration_all_ms']:.3f} ms",
                f"{row['paper_iteration_ms']:.3f} ms",
                f"{row['ratio']:.1f}",
                f"{100 * row['pricing_ratio']:.0f} / {100 * row['pricing_ratio_all']:.0f} %",
                f"{row['pricing_us']:.2f} us",
                f"{row['paper_pricing_us']:.2f} us",
                f"{row['plan_ms']:.0f} ms",
                f"{row['paper_plan_ms']:.0f} ms",
                f"{row['status']} / {row['paper_status']}",
            ]
            for row in rows
        ],
        [
            "scene",
            "iteration",
            "all",
            "paper's",
            "ratio",
            "pricing",
            "a neighbour",
            "paper's",
            "plan",
            "paper's",
            "ended",
        ],
    )
    print()


def _print_growth(rows: list[dict[str, Any]], exponents: dict[str, float]) -> None:
    from mcplan.cli.table import print_table

    print("Growth of an iteration")
    print_table(
        [
            [
                row["varied"],
                str(row["amount"]),
                f"{row['neighbours']:.0f}",
                f"{row['iteration_ms']:.3f} ms",
                f"{row['iteration_per_phase_us']:.1f} us",
                f"{row['linearise_ms']:.3f} ms",
                f"{row['value_functions_ms']:.3f} ms",
                f"{row['pricing_ms']:.3f} ms",
            ]
            for row in rows
        ],
        ["varied", "amount", "neighbours", "iteration", "per phase", "linearise", "value functions", "pricing"],
    )
    print()
    print_table([[name.replace("_", " "), f"{value:.2f}"] for name, value in exponents.items()], ["exponent of", ""])
    print()


def _print_part(part: str, rows: list[dict[str, Any]], outcomes: list[Any]) -> None:
    from mcplan.cli.table import print_table
    from mcplan_bench.robustness import line

    good = sum(outcome.good for outcome in outcomes)
    print(
        {"settings": "15 settings on each scene", "random": f"{len(outcomes)} random scenes"}[part] + f": {good} good"
    )
    head = ["scene" if part == "settings" else "kind", "good", "median cost", "median time", "longest", "statuses"]
    print_table(
        [
            [
                row["kind"],
                f"{row['good']}/{row['runs']}",
                f"{row['median_cost']:.3f}",
                f"{row['median_time_s']:.2f} s",
                f"{row['largest_time_s']:.2f} s",
                ", ".join(f"{count} {status}" for status, count in row["statuses"].items()),
            ]
            for row in rows
        ],
        head,
    )
    failures = [outcome for outcome in outcomes if not outcome.good]
    for outcome in failures:
        print(f"  {line(outcome)}")
    print()
