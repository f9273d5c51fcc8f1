"""--live: a run in a browser while it is simulated."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot
    from mcplan.tracking.options import Watch

LiveOption = Annotated[
    bool,
    typer.Option(
        "--live", help="Show the run in a browser while it is simulated; it waits until the address is opened."
    ),
]


@contextlib.contextmanager
def watching(live: bool, plan: Plan, robot: Robot | None) -> Iterator[Watch | None]:
    """What the simulation is watched by: nothing, or a server whose address is printed and has been opened.

    Args:
        live: Whether it is asked for.
        plan: Its scene is shown.
        robot: The robot that moves; None: the plan's own.
    """
    if not live:
        yield None
        return
    from mcplan.view.live import LiveView

    with LiveView(plan, robot) as view:
        print(f"open {view.url} in a browser; the run begins then", file=sys.stderr, flush=True)
        view.wait()
        yield view
