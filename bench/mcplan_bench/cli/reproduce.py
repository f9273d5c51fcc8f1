"""mcplan reproduce"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from mcplan.cli.given_options import named_as_typed
from mcplan_bench.cli.output import say

PaperArgument = Annotated[str, typer.Argument(metavar="PAPER", help="Paper: lengagne, tazaki or wang.")]
OutOption = Annotated[
    Path | None, typer.Option("--out", metavar="DIR", help="Folder for all that is written; default: out/PAPER.")
]
QuickOption = Annotated[bool, typer.Option("--quick", help="Run one scene and little of each, to see that it works.")]
CyclesOption = Annotated[
    int | None, typer.Option("--cycles", metavar="N", help="wang: number of steps of each walk; default 14.")
]
LookaheadMaxOption = Annotated[
    int | None,
    typer.Option("--lookahead-max", metavar="N", help="wang: maximum horizon, 2 to 10 steps; default 5."),
]
SeedsOption = Annotated[
    int | None, typer.Option("--seeds", metavar="K", help="wang: number of noisy starts beside the scene's; default 0.")
]
TrackedSeedsOption = Annotated[
    int | None, typer.Option("--tracked-seeds", metavar="K", help="wang: how many of them are tracked, too; default 0.")
]
NoTrackOption = Annotated[
    bool, typer.Option("--no-track", help="wang: track no walk; it takes 20 s each and needs mcplan[sim].")
]
TablesOption = Annotated[
    str | None, typer.Option("--tables", metavar="LIST", help="lengagne: tables among 1,2,3,4; default all.")
]
MotionsOption = Annotated[
    str | None,
    typer.Option(
        "--motions", metavar="LIST", help="lengagne: motions among cartwheel,climbing,walking,climbing_steep."
    ),
]
RepeatsOption = Annotated[
    int | None, typer.Option("--repeats", metavar="N", help="lengagne: number of runs of quick rows; default 3.")
]
ResumeOption = Annotated[
    bool, typer.Option("--resume", help="lengagne, wang: take the runs that DIR has, run the rest, draw all again.")
]


@named_as_typed("cycles", "lookahead_max", "seeds", "tracked_seeds", "tables", "motions", "repeats")
def reproduce(
    paper: PaperArgument,
    out: OutOption = None,
    quick: QuickOption = False,
    cycles: CyclesOption = None,
    lookahead_max: LookaheadMaxOption = None,
    seeds: SeedsOption = None,
    tracked_seeds: TrackedSeedsOption = None,
    no_track: NoTrackOption = False,
    tables: TablesOption = None,
    motions: MotionsOption = None,
    repeats: RepeatsOption = None,
    resume: ResumeOption = False,
) -> int:
    """Reproduce a paper's tables and figures on this machine.

    They are written as a Markdown page with CSV and PNG beside it.

    Example: mcplan reproduce tazaki

    Example: mcplan reproduce wang --lookahead-max 6 --seeds 10

    Example: mcplan reproduce lengagne --tables 1,2 --motions cartwheel,walking
    """
    from mcplan.errors import InvalidInput, shown
    from mcplan.files.outputs import require_folder
    from mcplan_bench.reproduce import PAPERS

    if paper not in PAPERS:
        raise InvalidInput("PAPER", f"must be one of {', '.join(PAPERS)}", shown(paper))
    folder = out or Path("out") / paper
    require_folder("--out", folder)
    given: dict[str, Any] = {"cycles": cycles, "lookahead_max": lookahead_max, "seeds": seeds}
    given |= {"tables": None if tables is None else _numbers(tables), "motions": motions and motions.split(",")}
    given |= {"repeats": repeats, "resume": resume or None}
    given |= {"tracked_seeds": tracked_seeds, "no_track": no_track or None}
    options = {name: value for name, value in given.items() if value is not None}
    for name in options:
        if name not in _OWN[paper]:
            owners = " and ".join(other for other in PAPERS if name in _OWN[other])
            raise InvalidInput(f"--{name.replace('_', '-')}", f"must be left out: it is for {owners}", shown(paper))
    written: list[Path]
    if paper == "lengagne":
        from mcplan_bench.reproduce import lengagne

        written = lengagne.reproduce(folder, quick, say, **options)
    elif paper == "wang":
        from mcplan_bench.reproduce import wang

        written = wang.reproduce(folder, quick, _say, **options)
    else:
        from mcplan_bench.reproduce import tazaki

        written = tazaki.reproduce(folder, quick, _say)
    print(f"Wrote {written[0]} and {len(written) - 1} files beside it")
    return 0


#: Options that a paper has of its own.
_OWN: dict[str, tuple[str, ...]] = {
    "lengagne": ("tables", "motions", "repeats", "resume"),
    "tazaki": (),
    "wang": ("cycles", "lookahead_max", "seeds", "tracked_seeds", "no_track", "resume"),
}


def _numbers(text: str) -> list[int]:
    """Whole numbers from "1,2,3"."""
    from mcplan.errors import InvalidInput, shown

    try:
        return [int(part) for part in text.split(",")]
    except ValueError:
        raise InvalidInput("--tables", "must be numbers with commas between them, such as 1,2", shown(text)) from None


def _say(text: str) -> None:
    print(text, flush=True)
