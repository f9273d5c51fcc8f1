"""mcplan reproduce"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer


def reproduce(
    paper: Annotated[str, typer.Argument(metavar="PAPER", help="tazaki or wang")],
    out: Annotated[Path | None, typer.Option("--out", metavar="DIR", help="Default: out/PAPER.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="One scene, little of each, to see that it works.")] = False,
    cycles: Annotated[
        int | None, typer.Option("--cycles", metavar="N", help="wang: steps of each walk; default 14.")
    ] = None,
    lookahead_max: Annotated[
        int | None,
        typer.Option("--lookahead-max", metavar="N", help="wang: longest horizon, 2 to 10 steps; default 5."),
    ] = None,
    seeds: Annotated[
        int | None, typer.Option("--seeds", metavar="K", help="wang: noisy starts beside the scene's; default 0.")
    ] = None,
    resume: Annotated[
        bool, typer.Option("--resume", help="wang: take the walks that DIR has, run the missing, draw all again.")
    ] = False,
) -> int:
    """Reproduce a paper's tables and figures on this machine: a Markdown page with CSV and PNG beside it.

    Example: mcplan reproduce tazaki

    Example: mcplan reproduce wang --lookahead-max 6 --seeds 10
    """
    from mcplan.errors import InvalidInput
    from mcplan.reproduce import PAPERS

    if paper not in PAPERS:
        raise InvalidInput("PAPER", f"must be one of {', '.join(PAPERS)}", repr(paper))
    folder = out or Path("out") / paper
    given = {"cycles": cycles, "lookahead_max": lookahead_max, "seeds": seeds, "resume": resume or None}
    options: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if paper == "wang":
        from mcplan.reproduce import wang

        written = wang.reproduce(folder, quick, _say, **options)
    else:
        from mcplan.reproduce import tazaki

        if options:
            name = next(iter(options)).replace("_", "-")
            raise InvalidInput(f"--{name}", "must be left out: only wang has it", paper)
        written = tazaki.reproduce(folder, quick, _say)
    print(f"Wrote {written[0]} and {len(written) - 1} files beside it")
    return 0


def _say(text: str) -> None:
    print(text, flush=True)
