"""mcplan bench contacts"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated, Any

import typer

from mcplan.arguments import MAX_JOBS
from mcplan.cli.given_options import at_least, within
from mcplan_bench.cli.output import cases_named, print_sections, say, write_page

#: Solves behind each time, unless --repeats says how many.
REPEATS = 5

CaseOption = Annotated[
    list[str] | None,
    typer.Option("--case", metavar="NAME", help="Case to run instead of all; may have * in it, and be repeated."),
]
TableOption = Annotated[bool, typer.Option("--table/--no-table", help="Plan the cases.")]
SettingsOption = Annotated[
    bool | None,
    typer.Option("--settings/--no-settings", help="Plan gap_with_rail from 16 settings; default: unless --case."),
]
SpeedOption = Annotated[
    bool | None,
    typer.Option("--speed/--no-speed", help="Time iterations of both models; default: unless --case."),
]
RepeatsOption = Annotated[
    int | None,
    typer.Option("--repeats", metavar="N", callback=at_least(1), help="Number of solves behind each time (5)."),
]
JobsOption = Annotated[
    int, typer.Option("--jobs", metavar="N", callback=within(1, MAX_JOBS), help="Number of processes.")
]
ListCasesOption = Annotated[bool, typer.Option("--list", help="Print the names of the cases.")]
MarkdownOption = Annotated[
    Path | None,
    typer.Option("--markdown", metavar="FILE", help="File for the tables: a page, or between the marks for them."),
]
OutOption = Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for JSON and CSV.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def contacts(
    case: CaseOption = None,
    table: TableOption = True,
    settings: SettingsOption = None,
    speed: SpeedOption = None,
    repeats: RepeatsOption = None,
    jobs: JobsOption = 1,
    list_cases: ListCasesOption = False,
    markdown: MarkdownOption = None,
    out: OutOption = Path("out/contacts"),
    json: JsonOption = False,
) -> int:
    """Measure the contacts of plans at 1 kHz, and judge them.

    All is measured from the plans' forces alone. The paper's four scenes with a friction of 0.7 everywhere and nothing
    to hold on to: cost, tangential forces, centre of pressure, slip, reach, angular momentum, forces of the hands. The
    same without offsets of the lines of force, which must fail. Slopes, walls, turns, four legs. Talos, whose hands
    support 0.15 of its weight: no plan on hands alone may be claimed. 16 settings on gap_with_rail. Times of an
    iteration beside those of the paper's model. Exit code 1 unless all holds.

    Example: mcplan bench contacts --case flat --case 'gap*'

    Example: mcplan bench contacts --markdown contacts.md
    """
    from mcplan.files.outputs import require_folder
    from mcplan_bench import contacts as bench
    from mcplan_bench import records
    from mcplan_bench.contacts_cases import CASES, setting_cases

    require_folder("--out", out)
    chosen = cases_named(CASES, case or [])
    if list_cases:
        print("\n".join(entry.name for entry in chosen))
        return 0
    timed = not case if speed is None else speed
    _require_timed(timed, repeats)
    words = [f"--case '{name}'" for name in case or []] + ["--no-table"] * (not table)
    words += ["--settings" if settings else "--no-settings"] * (settings is not None)
    words += ["--speed" if speed else "--no-speed"] * (speed is not None) + [f"--jobs {jobs}"] * (jobs > 1)
    result: dict[str, Any] = {"machine": records.machine(), "jobs": jobs}
    result["command"] = " ".join(["mcplan bench contacts", *words])
    verdicts: list[bool | None] = []
    if table:
        result["rows"] = bench.run(chosen, jobs, say)
        verdicts += [row.holds for row in result["rows"]]
    if settings if settings is not None else not case:
        rows = bench.run(setting_cases(), jobs, say)
        result["settings"] = {"rows": rows, "summary": bench.settings_summary(rows)}
        verdicts.append(result["settings"]["summary"]["holds"])
    if timed:
        result["speed"] = bench.compare_speed(repeats or REPEATS, progress=say)
        verdicts += [row["holds"] for row in result["speed"]]
    result["holds"] = False not in verdicts
    written = _write(result, out, markdown)
    if json:
        print(json_module.dumps(_plain(result)))
    else:
        _print(result)
        print(f"Wrote {', '.join(str(path) for path in written)}")
    return 0 if result["holds"] else 1


def _require_timed(timed: bool, repeats: int | None) -> None:
    from mcplan.errors import InvalidInput

    if repeats is not None and not timed:
        raise InvalidInput("--repeats", "needs --speed")


def _write(result: dict[str, Any], out: Path, markdown: Path | None) -> list[Path]:
    from mcplan_bench import records
    from mcplan_bench.contacts_text import markdown as page

    plain = _plain(result)
    written = [records.write_json(out / "contacts.json", plain)]
    if "rows" in result:
        written.append(records.write_csv(out / "contacts.csv", plain["rows"]))
    if "settings" in result:
        written.append(records.write_csv(out / "settings.csv", plain["settings"]["rows"]))
    if "speed" in result:
        written.append(records.write_csv(out / "speed.csv", plain["speed"]))
    if markdown is not None:
        written.append(write_page(markdown, lambda before: page(result, before)))
    return written


def _plain(result: dict[str, Any]) -> dict[str, Any]:
    """The result with its rows as plain data."""
    from mcplan_bench import records

    plain = dict(result)
    if "rows" in result:
        plain["rows"] = [row.as_dict() for row in result["rows"]]
    if "settings" in result:
        plain["settings"] = {**result["settings"], "rows": [row.as_dict() for row in result["settings"]["rows"]]}
    return dict(records.plain(plain))


def _print(result: dict[str, Any]) -> None:
    from mcplan_bench.contacts_text import sections

    print_sections(sections(result))
