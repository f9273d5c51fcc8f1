"""The contacts of a plan's end-effectors, phase by phase, as a table that fits a terminal of 80 columns."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan._core import Plan

#: Columns of the table, in a terminal and in a file alike.
WIDTH = 80
#: Longer names of end-effectors are cut.
NAME_WIDTH = 24
_INDENT = "  "


def contact_rows(plan: Plan) -> list[str]:
    """One line per end-effector: its surface in each phase, by number, "-" when free.

    Where the phases do not fit into 80 columns, the table goes on below, each part under its phases. The surfaces that
    occur are named below it.

    Args:
        plan: Any plan; one without phases has no rows.
    """
    sequence = plan.contact_sequence()
    if not sequence:
        return []
    names = [_cut(end.name) for end in plan.robot.end_effectors]
    width = max((len(name) for name in names), default=0)
    used = sorted({i for row in [*sequence, list(plan.final_contacts)] for i in row if i >= 0})
    digits = len(str(max(used, default=0)))
    lead = len(_INDENT) + width + 2
    per_line = max((WIDTH - lead + 1) // (digits + 1), 1)
    rows: list[str] = []
    for first in range(0, len(sequence), per_line):
        part = sequence[first : first + per_line]
        if len(sequence) > per_line:
            rows.append(f"{_INDENT}phases {first} to {first + len(part) - 1}")
        for number, name in enumerate(names):
            cells = [str(row[number]) if row[number] >= 0 else "-" for row in part]
            rows.append(f"{_INDENT}{name:{width}}  " + " ".join(f"{cell:>{digits}}" for cell in cells))
    legend = ", ".join(f"{i} {plan.scene.surfaces[i].name}" for i in used)
    return [*rows, *wrapped(legend, " " * lead)]


def wrapped(text: str, indent: str = "", more: str | None = None) -> list[str]:
    """A text in lines of at most 80 columns.

    Args:
        text: Words.
        indent: In front of the first line.
        more: In front of the others; None: the same.
    """
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent if more is None else more)


def _cut(name: str) -> str:
    return name if len(name) <= NAME_WIDTH else name[: NAME_WIDTH - 3] + "..."
