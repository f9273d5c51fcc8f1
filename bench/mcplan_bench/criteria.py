"""What makes a plan of the paper's scenes a good one, beyond passing the checker."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from mcplan import Plan
    from mcplan.model import Report

#: Least rise of the CoM over its height at take-off that counts as a jump [m].
APEX_M = 0.15

#: Terms of the cost that are constants of the contact sequence: choices of this engine, in no published cost.
OWN_TERMS = ("flight", "contact_change")

Sequence2 = Sequence[Sequence[int]]


def comparable_cost(report: Report) -> float:
    """The cost J of a plan without the constants on flights and on contact changes.

    Those two say which of two sequences is wanted when their motions cost the same (1/2 for each phase of flight, 0.005 for each
    contact made or broken). A cost that is published, or one of another model, knows the motion alone: what it costs to be off
    the reference and at the limits. The weights of the terms that are left are the report's own.
    """
    return float(sum(cost for name, cost in report.cost_terms.items() if name not in OWN_TERMS))


def shortcoming(scene: str, plan: Plan) -> str:
    """Why a plan that the checker accepts is not what the scene is about; "" for a good one.

    flat             no flight, feet swing in turn
    stairs           the same, and a foot on every surface
    gap              exactly one flight (adjacent phases without contact count once), apex at least 0.15 m above take-off
    gap_with_rail    a phase with both hands in contact and both feet off
    any other        nothing to find fault with

    Args:
        scene: Name of the built-in scene.
        plan: A plan for it.
    """
    sequence = plan.contact_sequence()
    feet, hands = (
        [i for i, end in enumerate(plan.robot.end_effectors) if end.kind == kind] for kind in ("foot", "hand")
    )
    if scene in ("flat", "stairs"):
        if flights(sequence):
            return f"{len(flights(sequence))} flights"
        if not alternate(sequence, feet):
            return "feet do not alternate"
        missed = set(range(len(plan.scene.surfaces))) - {row[i] for row in sequence for i in feet}
        if scene == "stairs" and missed:
            return "no foot on " + ", ".join(plan.scene.surfaces[i].name for i in sorted(missed))
    elif scene == "gap":
        stretches = flights(sequence)
        if len(stretches) != 1:
            return f"{len(stretches)} flights"
        apex = apex_m(plan, *stretches[0])
        if apex < APEX_M:
            return f"apex {apex:.3f} m over take-off"
    elif scene == "gap_with_rail":
        crossing = any(all(row[i] < 0 for i in feet) and all(row[i] >= 0 for i in hands) for row in sequence)
        if not hands or not crossing:
            return "no phase on both hands alone"
    return ""


def flights(sequence: Sequence2) -> list[tuple[int, int]]:
    """Stretches without any contact: first phase and the one after the last."""
    return _stretches([all(surface < 0 for surface in row) for row in sequence])


def swings(sequence: Sequence2, ends: Sequence[int]) -> list[int]:
    """The end-effectors in the order in which they start to swing; several at once in the order of `ends`."""
    begins = [(first, end) for end in ends for first, _ in _stretches([row[end] < 0 for row in sequence])]
    return [end for _, end in sorted(begins, key=lambda entry: (entry[0], list(ends).index(entry[1])))]


def alternate(sequence: Sequence2, feet: Sequence[int]) -> bool:
    """Whether no foot swings twice in a row."""
    order = swings(sequence, feet)
    return all(a != b for a, b in zip(order, order[1:], strict=False))


def apex_m(plan: Plan, first: int, end: int) -> float:
    """Highest CoM of a stretch of phases, above where it starts [m]."""
    times = plan.knot_times()
    heights = [plan.at(t).com_W[2] for t in np.linspace(times[first], times[end], 101)]
    return float(max(heights) - heights[0])


def _stretches(flags: Sequence[bool]) -> list[tuple[int, int]]:
    out, first = [], None
    for k, flag in enumerate([*flags, False]):
        if flag and first is None:
            first = k
        elif not flag and first is not None:
            out.append((first, k))
            first = None
    return out
