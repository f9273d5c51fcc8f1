"""Ground that is not as planned: what is simulated, and what the planner is told of it."""

from __future__ import annotations

from mcplan._core import Scene, Surface
from mcplan.errors import InvalidInput, shown
from mcplan.tracking.recording import numbered_as

#: Who may touch a surface that is not there: surfaces keep their numbers, which plans go by.
NOBODY = "nobody"


def require_known(true: Scene, planned: Scene) -> None:
    """Raise InvalidInput where the ground has a surface that plans cannot name, or lacks one that the robot stands on.

    Args:
        true: What is simulated.
        planned: What the first plan knows.
    """
    names = [surface.name for surface in planned.surfaces]
    for i, surface in enumerate(true.surfaces):
        if surface.name not in names:
            rule = "must be the name of a surface of the plan's scene: " + ", ".join(names[:20])
            raise InvalidInput(f"true_scene.surfaces[{i}].name", rule, shown(surface.name))
    there = {surface.name for surface in true.surfaces}
    for end, name in dict(planned.start.contacts).items():
        if name not in there:
            raise InvalidInput("true_scene.surfaces", f"must have '{name}', on which {end} stands at the start")
    if abs(true.gravity - planned.gravity) > 1e-9:
        raise InvalidInput("true_scene.gravity", f"must be that of the plan, {planned.gravity:g}", f"{true.gravity:g}")


def require_goal(true: Scene, planned: Scene) -> None:
    """Raise InvalidInput where a planner that is told of the ground would have no goal any more.

    Args:
        true: What is simulated, and told.
        planned: What the first plan knows, the goal on it.
    """
    there = {surface.name for surface in true.surfaces}
    for end, name in dict(planned.goal.contacts).items():
        if name not in there:
            rule = f"must have '{name}', on which {end} stands at the goal, or the planner must not be told (told_at_s)"
            raise InvalidInput("true_scene.surfaces", rule)


def as_told(true: Scene, planned: Scene) -> Scene:
    """The plan's scene with its surfaces as they are; nobody may touch those that are not there."""
    told = numbered_as(planned, true, _without)
    told.validate()
    return told


def _without(surface: Surface) -> Surface:
    missing = surface.__copy__()
    missing.end_effectors = [NOBODY]
    return missing
