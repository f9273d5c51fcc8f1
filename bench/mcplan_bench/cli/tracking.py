"""mcplan bench tracking"""

from __future__ import annotations

import functools
import json as json_module
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from mcplan.arguments import MAX_JOBS
from mcplan.cli.given_options import at_least, within
from mcplan_bench.cli.output import cases_named, print_sections, say, write_page

if TYPE_CHECKING:
    from mcplan_bench.tracking import Keep
    from mcplan_bench.tracking_cases import Case

#: Disturbed runs of each plan, unless --seeds says how many.
SEEDS = 20
PACKAGES = ("mujoco", "pin", "proxsuite", "numpy")


ShortOption = Annotated[
    bool, typer.Option("--short", help="Run three quick cases without timing, for continuous integration.")
]
CaseOption = Annotated[
    list[str] | None,
    typer.Option("--case", metavar="NAME", help="Case to run instead of all; may have * in it, and be repeated."),
]
TableOption = Annotated[bool, typer.Option("--table/--no-table", help="Track the cases.")]
RobustnessOption = Annotated[
    bool, typer.Option("--robustness", help="Simulate disturbed runs of flat, stairs and rubbles, too.")
]
SeedsOption = Annotated[
    int | None,
    typer.Option(
        "--seeds",
        metavar="N",
        callback=at_least(1),
        help="With --robustness: number of disturbed runs of each plan (20).",
    ),
]
SpeedOption = Annotated[
    bool | None, typer.Option("--speed/--no-speed", help="Time control steps on one core; default: unless --short.")
]
JobsOption = Annotated[
    int,
    typer.Option(
        "--jobs",
        metavar="N",
        callback=within(1, MAX_JOBS),
        help="Number of processes; with several, times of runs are longer.",
    ),
]
ListCasesOption = Annotated[bool, typer.Option("--list", help="Print the names of the cases.")]
HtmlOption = Annotated[Path | None, typer.Option("--html", metavar="DIR", help="Folder for a page of each run.")]
StripsOption = Annotated[Path | None, typer.Option("--strips", metavar="DIR", help="Folder for snapshots of each run.")]
MarkdownOption = Annotated[
    Path | None,
    typer.Option("--markdown", metavar="FILE", help="File for the tables: a page, or between the marks for them."),
]
OutOption = Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for JSON and CSV.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def tracking(
    short: ShortOption = False,
    case: CaseOption = None,
    table: TableOption = True,
    robustness: RobustnessOption = False,
    seeds: SeedsOption = None,
    speed: SpeedOption = None,
    jobs: JobsOption = 1,
    list_cases: ListCasesOption = False,
    html: HtmlOption = None,
    strips: StripsOption = None,
    markdown: MarkdownOption = None,
    out: OutOption = Path("out/tracking"),
    json: JsonOption = False,
) -> int:
    """Track plans of all three planners in simulation.

    The runs are compared with what is demanded of them. Without assistance but for the cases named assisted, torque
    limits on. Walks: no fall, CoM within 15 mm rms, base within 50 mm at the end, every QP solved, no warning of the
    simulator. Planar robots: contact forces within 10 % rms of the plan, drift of 10 mm. Disturbed: 18 of 20 stay up.
    Speed: 1 ms for a control step, 1.5 times real time. Exit code 1 unless all holds, as it does not without --case:
    unassisted, the jump over short_gap falls.

    Example: mcplan bench tracking --short

    Example: mcplan bench tracking --case 'flat/*' --no-speed --strips strips

    Example: mcplan bench tracking --robustness --jobs 2 --markdown docs/tracking.md
    """
    from mcplan.extras import require

    require("mcplan bench tracking", "sim", "mujoco", "pinocchio", "proxsuite")
    from mcplan_bench import records, tracking_speed
    from mcplan_bench import tracking as bench

    seeds = _seeds(robustness, seeds)
    _require_folders({"--out": out, "--html": html, "--strips": strips})
    chosen = _chosen(short, case or [])
    if list_cases:
        return _list(chosen)
    _require_drawing(html, strips)
    result: dict[str, Any] = {"machine": records.machine(), "packages": records.versions(*PACKAGES), "jobs": jobs}
    result["command"] = _command(short, case or [], table, seeds if robustness else None, jobs)
    holds: list[bool | None] = []
    if table:
        result["rows"] = bench.table(chosen, jobs, say, _keep(html, strips))
        holds += [row.holds for row in result["rows"]]
    if robustness:
        result["robustness"] = _robustness(seeds, jobs, case)
        holds += [row["holds"] for row in result["robustness"]["summary"]]
    if speed if speed is not None else not (short or case):
        say("speed: on one core")
        result["speed"] = tracking_speed.measure()
        holds.append(result["speed"]["holds"])
    result["holds"] = False not in holds
    written = _write(result, out, markdown)
    print(json_module.dumps(_plain(result))) if json else _print(result, written)
    return 0 if result["holds"] else 1


def _list(chosen: list[Case]) -> int:
    print("\n".join(entry.name for entry in chosen))
    return 0


def _seeds(robustness: bool, seeds: int | None) -> int:
    from mcplan.errors import InvalidInput

    if seeds is not None and not robustness:
        raise InvalidInput("--seeds", "needs --robustness")
    return SEEDS if seeds is None else seeds


def _robustness(seeds: int, jobs: int, case: list[str] | None) -> dict[str, Any]:
    from mcplan_bench import tracking_robustness
    from mcplan_bench.tracking_cases import DISTURBED

    disturbed = [entry for entry in DISTURBED if not case or any(fnmatchcase(entry.name, name) for name in case)]
    outcomes = tracking_robustness.run(seeds, jobs, say, disturbed)
    return {"seeds": seeds, "summary": tracking_robustness.summary(outcomes, disturbed), "outcomes": outcomes}


def _require_folders(folders: dict[str, Path | None]) -> None:
    from mcplan.files.outputs import require_folder

    for option, folder in folders.items():
        require_folder(option, folder)


def _require_drawing(html: Path | None, strips: Path | None) -> None:
    from mcplan.extras import require

    if html is not None:
        require("pages of runs", "view", "meshcat")
    if strips is not None:
        require("rendering a run", "sim", "PIL")


def _command(short: bool, case: list[str], table: bool, seeds: int | None, jobs: int) -> str:
    """What was typed, as far as it says what is measured."""
    words = ["--short"] * short + [f"--case '{name}'" for name in case] + ["--no-table"] * (not table)
    words += [f"--robustness --seeds {seeds}"] * (seeds is not None) + [f"--jobs {jobs}"] * (jobs > 1)
    return " ".join(["mcplan bench tracking", *words])


def _chosen(short: bool, names: list[str]) -> list[Case]:
    from mcplan_bench.tracking_cases import CASES, SHORT

    return cases_named(SHORT if short else CASES, names)


def _keep(html: Path | None, strips: Path | None) -> Keep | None:
    if html is None and strips is None:
        return None
    for folder in (html, strips):
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
    return functools.partial(_draw, html, strips)


def _draw(html: Path | None, strips: Path | None, case: Case, run: Any) -> None:
    from mcplan.showing import save_strip, show

    name = case.name.replace("/", "_")
    if html is not None:
        show(run).save_html(html / f"{name}.html")
    if strips is not None:
        save_strip(run, strips / f"{name}.png")


def _write(result: dict[str, Any], out: Path, markdown: Path | None) -> list[Path]:
    from mcplan_bench import records
    from mcplan_bench.tracking_text import markdown as page

    plain = _plain(result)
    written = [records.write_json(out / "tracking.json", plain)]
    if "rows" in result:
        written.append(records.write_csv(out / "tracking.csv", plain["rows"]))
    if "robustness" in result:
        written.append(records.write_csv(out / "robustness.csv", plain["robustness"]["outcomes"]))
    if markdown is not None:
        written.append(write_page(markdown, lambda before: page(result, before)))
    return written


def _plain(result: dict[str, Any]) -> dict[str, Any]:
    """The result with rows and outcomes as dicts, and nothing in it that JSON cannot represent."""
    from mcplan_bench import records

    out = dict(result)
    if "rows" in out:
        out["rows"] = [row.as_dict() for row in out["rows"]]
    if "robustness" in out:
        outcomes = [outcome.as_dict() for outcome in out["robustness"]["outcomes"]]
        out["robustness"] = {**out["robustness"], "outcomes": outcomes}
    plain: dict[str, Any] = records.plain(out)
    return plain


def _print(result: dict[str, Any], written: list[Path]) -> None:
    from mcplan_bench.tracking_text import sections

    print_sections(sections(result))
    print(f"Wrote {', '.join(str(path) for path in written)}")
