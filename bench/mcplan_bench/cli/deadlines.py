"""mcplan bench deadlines"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer

from mcplan_bench.cli.output import say


def deadlines(
    quick: Annotated[
        bool, typer.Option("--quick", help="Run one case of each engine under the shortest limit.")
    ] = False,
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for JSON and CSV.")] = Path("out/deadlines"),
    json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> int:
    """Measure by how much solves overrun their time limit.

    Surfaces that the path never comes near are timed, too. The overrun is in CPU time, set-up and check included, of
    every engine under limits from 10 ms to 1 s, on scenes of up to a thousand surfaces and 288 phases.

    Example: mcplan bench deadlines --quick
    """
    from mcplan_bench import deadlines as bench
    from mcplan_bench import records

    rows = bench.overruns(quick, say)
    idle = bench.idle_surfaces(quick, say)
    result = {"machine": records.machine(), "overruns": rows, "idle_surfaces": idle}
    records.write_csv(out / "overruns.csv", rows)
    records.write_csv(out / "idle_surfaces.csv", idle)
    records.write_json(out / "deadlines.json", result)
    if json:
        print(json_module.dumps(records.plain(result)))
        return 0
    worst = max(rows, key=lambda row: row["cpu_over_s"])
    print(f"Largest overrun: {1e3 * worst['cpu_over_s']:+.0f} ms of CPU, {worst['engine']} {worst['case']}", end="")
    print(f" at {worst['limit_s']:g} s")
    print("Idle surfaces: " + ", ".join(f"{row['idle']}: {row['cpu_s']:.2f} s" for row in idle))
    print(f"Wrote {out}/deadlines.json, overruns.csv, idle_surfaces.csv")
    return 0
