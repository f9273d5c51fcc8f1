"""What plans of contact wrenches ask for, in words and as JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mcplan._core import Plan


def load_lines(plan: Plan) -> list[str]:
    """Lines below a plan's contacts: peak angular momentum, peak forces in weights; none for other plans."""
    from mcplan.kinematics.loads import loads_of

    loads = loads_of(plan)
    if loads is None:
        return []
    lines = [f"  angular momentum: {loads.angular_momentum:.2f} kg m^2/s at most"]
    if loads.forces:
        lines.append("  largest force in weights: " + _listed(loads.forces))
    return lines


def friction_line(plan: Plan) -> list[str]:
    """Largest tangential over normal force of each end-effector, for plans that come without a report."""
    from mcplan.kinematics.loads import loads_of

    loads = loads_of(plan)
    return [friction_text(loads.frictions)] if loads is not None and loads.frictions else []


def friction_text(frictions: dict[str, float]) -> str:
    """The line on friction, of a report or of a plan."""
    return "  friction used (tangential / normal): " + _listed(frictions)


def load_dict(plan: Plan) -> dict[str, Any]:
    """Keys of the JSON; null for other plans."""
    from mcplan.kinematics.loads import loads_of

    loads = loads_of(plan)
    return {
        "angular_momentum_max": None if loads is None else loads.angular_momentum,
        "force_max_weights": None if loads is None else loads.forces,
    }


def _listed(values: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:.2f}" for name, value in values.items())
