"""The walk that a run with rhp begins with, and whose steps it goes on with."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mcplan._core import Plan, require_standing, rhp
from mcplan.errors import InvalidInput

from .horizon_loop import computing_s
from .horizon_planner import online_options

if TYPE_CHECKING:
    from mcplan._core import Robot, Scene

    from .options import OnlineOptions

#: Steps of a walk on a scene, if it does not list more.
STEPS = 14


def first_walk(scene: Scene, robot: Robot, online: OnlineOptions, sequence: Plan | None = None) -> Plan:
    """A walk of rhp that comes to rest after its last step.

    Args:
        scene: Its ``steps`` are walked, and on, to 14 at least.
        robot: With two feet.
        online: Time that is left for horizons.
        sequence: A plan whose start and steps are taken instead.

    Raises:
        InvalidScene: There are no steps.
        InvalidPlan: The sequence uses hands, or lifts both feet at once.
        InvalidInput: A step is not found.
    """
    if sequence is None:
        require_standing(scene, robot)
        cycles = max(STEPS, len(scene.steps))
        steps = rhp.RecedingHorizon(scene, robot, online_options(computing_s(online), {"cycles": cycles})).walk()
        _require(scene, steps.success, steps.report.message)
        sequence = steps.plan
    options = online_options(computing_s(online), {"cycles": len(sequence.phases)})
    walk = rhp.RecedingHorizon(scene, robot, sequence, options).walk()
    _require(scene, walk.success, walk.report.message)
    return walk.plan


def _require(scene: Scene, found: bool, message: str) -> None:
    if not found:
        raise InvalidInput("scene", "must have a walk of rhp to begin with", f"{scene.name}: {message}")
