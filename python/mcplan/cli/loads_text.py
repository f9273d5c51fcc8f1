"""What plans of contact wrenches ask for, in words and as JSON."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from mcplan.cli.contacts_text import wrapped

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot
    from mcplan.kinematics.loads import Loads


def load_lines(plan: Plan) -> list[str]:
    """Lines below a plan's contacts: peak angular momentum, peak forces in weights; none for other plans."""
    from mcplan.kinematics.loads import loads_of

    return _lines(plan, loads_of(plan))


def all_lines(plan: Plan) -> list[str]:
    """The same and before it the largest tangential over normal force, for plans that come without a report."""
    from mcplan.kinematics.loads import loads_of

    loads = loads_of(plan)
    friction = friction_lines(loads.frictions) if loads is not None and loads.frictions else []
    return friction + _lines(plan, loads)


def _lines(plan: Plan, loads: Loads | None) -> list[str]:
    if loads is None:
        return []
    lines = [
        f"  angular momentum: {_momentum(loads.angular_momentum, plan.robot, plan.scene.gravity)} kg m^2/s at most"
    ]
    if loads.forces:
        lines += _listed("largest force in weights: ", loads.forces)
    return lines


def friction_lines(frictions: dict[str, float]) -> list[str]:
    """The line on friction, of a report or of a plan; more than one where it does not fit into 80 columns."""
    return _listed("friction used (tangential / normal): ", frictions)


def load_dict(plan: Plan) -> dict[str, Any]:
    """Keys of the JSON; null for other plans."""
    from mcplan.kinematics.loads import loads_of

    loads = loads_of(plan)
    return {
        "angular_momentum_max": None if loads is None else loads.angular_momentum,
        "force_max_weights": None if loads is None else loads.forces,
    }


def _listed(lead: str, values: dict[str, float]) -> list[str]:
    text = ", ".join(f"{name} {value:.2f}" for name, value in values.items())
    return wrapped(lead + text, "  ", " " * (2 + len(lead)))


def _momentum(value: float, robot: Robot, gravity: float) -> str:
    """Two digits behind the point for robots of human size; for others the figures that count against m h sqrt(g h)."""
    unit = robot.mass * robot.com_height * math.sqrt(gravity * robot.com_height)
    if 1.0 <= unit < 1e4:
        return f"{value:.2f}"
    return f"{round(value, 3 - math.floor(math.log10(unit))):.3g}"
