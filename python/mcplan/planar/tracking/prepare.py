"""Plans that a simulated robot can follow: what has to be asked of the planner, and of a task.

    import mcplan as mp
    from mcplan.planar.tracking import PLANNING, track_whole_body, with_clearances

    task = with_clearances(mp.load_planar_task("climbing"))
    result = track_whole_body(mp.whole_body(task, **PLANNING).plan)

The default plans move their feet within a tube of 1 mm and 5 mrad while these carry weight, which a foot on the ground
cannot, and their contacts may carry nothing at all. docs/tracking_planar.md has the numbers.
"""

from __future__ import annotations

import copy
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from mcplan.errors import InvalidOptions, InvalidPlanarTask

if TYPE_CHECKING:
    from mcplan._core import PlanarPhase, PlanarTask

#: Options of mp.whole_body for plans that are to be tracked. For tasks of many steps add phase_duration_s=(0.3, 5.0).
PLANNING: MappingProxyType[str, Any] = MappingProxyType(
    {
        "tube_m": 2e-5,
        "tube_rad": 1e-4,
        "min_normal_force": 5.0,  # [N] at every point: contacts without load slide
        "clearance_m": -5e-5,  # with the default of -1 mm feet scrape over the ground
    }
)


#: Longer tasks than this take no phase shorter or longer than PHASES_S [s]: durations of many free phases run away.
SHORT_TASK, PHASES_S = 5, (0.3, 5.0)


def trackable(task: PlanarTask) -> tuple[PlanarTask, dict[str, Any]]:
    """What ``mcplan sip --trackable`` plans: a task with clearances, and options of mp.whole_body.

        task, options = trackable(mp.load_planar_task("walking"))
        plan = mp.whole_body(task, **options).plan

    Args:
        task: Any planar task.

    Returns:
        The task as of with_clearances, and PLANNING with limits of the phases of tasks of many steps.

    Raises:
        InvalidPlanarTask: As with_clearances.
    """
    more = {"phase_duration_s": PHASES_S} if len(task.phases) > SHORT_TASK else {}
    return with_clearances(task), {**PLANNING, **more}


def with_clearances(task: PlanarTask, height_m: float = 0.02) -> PlanarTask:
    """The task with clearances that keep the points of every swing in front of the surface that it leaves and lands on.

    Args:
        task: Swings that have a clearance keep it and get no other.
        height_m: Height of the points in the middle of a swing.

    Returns:
        A new task.

    Raises:
        InvalidPlanarTask: A swing without clearances goes from one surface to another: what lies between is not known here.
        InvalidOptions: The height is not above 0.
    """
    from mcplan._core import PlanarClearance

    if not height_m > 0:
        raise InvalidOptions("height_m", "must be above 0", str(height_m))
    out = copy.deepcopy(task)
    phases = list(out.phases)
    for k, phase in enumerate(phases):
        done = {contact.end_effector for contact in phase.contacts}
        done |= {clearance.end_effector for clearance in phase.clearances}
        added = []
        for e in set(range(len(out.robot.end_effectors))) - done:
            beside = set(_surface(phases[k::-1], e) + _surface(phases[k:], e))
            if len(beside) > 1:
                name = out.robot.end_effectors[e].name
                rule = f"needs clearances for {name}, which swings from one surface to another"
                raise InvalidPlanarTask(f"phases[{k}].clearances", rule)
            added += [PlanarClearance(end_effector=e, surface=s, middle_height=height_m) for s in beside]
        phase.clearances = [*phase.clearances, *added]
    out.phases = phases
    return out


def _surface(phases: list[PlanarPhase], end: int) -> list[int]:
    """The surface of an end-effector's first contact in these phases, if it has any."""
    return [c.surface for phase in phases for c in phase.contacts if c.end_effector == end][:1]
