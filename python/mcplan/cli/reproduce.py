"""mcplan reproduce"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def reproduce(
    paper: Annotated[str, typer.Argument(metavar="PAPER", help="tazaki")],
    out: Annotated[Path | None, typer.Option("--out", metavar="DIR", help="Default: out/PAPER.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="One scene and one repeat, to see that it works.")] = False,
) -> int:
    """Reproduce a paper's tables and figures on this machine: a Markdown page with CSV and PNG beside it.

    Example: mcplan reproduce tazaki
    """
    from mcplan.errors import InvalidInput
    from mcplan.reproduce import PAPERS

    if paper not in PAPERS:
        raise InvalidInput("PAPER", f"must be one of {', '.join(PAPERS)}", repr(paper))
    from mcplan.reproduce import tazaki

    written = tazaki.reproduce(out or Path("out") / paper, quick, lambda text: print(text, flush=True))
    print(f"Wrote {written[0]} and {len(written) - 1} files beside it")
    return 0
