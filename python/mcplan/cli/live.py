"""--live: a search or a run in a browser while it goes on."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot, Scene
    from mcplan.tracking.options import Watch
    from mcplan.view.live import LiveView, PlanningView

LiveOption = Annotated[
    bool,
    typer.Option(
        "--live", help="Show the run in a browser while it is simulated; it waits until the address is opened."
    ),
]
LivePlanningOption = Annotated[
    bool,
    typer.Option("--live", help="Show the search in a browser while it goes on; it waits until the address is opened."),
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
        _opened(view, "run")
        yield view


@contextlib.contextmanager
def watching_search(live: bool, scene: str | Scene, robot: str) -> Iterator[PlanningView | None]:
    """The same for a search in a scene, with a robot.

    Args:
        live: Whether it is asked for.
        scene: The scene, or its name or file.
        robot: The robot's name or file.
    """
    if not live:
        yield None
        return
    from mcplan.solve import robot_of, scene_of
    from mcplan.view.live import PlanningView

    with PlanningView(scene_of(scene), robot_of(robot)) as view:
        _opened(view, "search")
        yield view


def _opened(view: LiveView | PlanningView, what: str) -> None:
    print(f"open {view.url} in a browser; the {what} begins then", file=sys.stderr, flush=True)
    view.wait()
