"""Tables with titles, for the terminal and for pages in Markdown."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass, field

#: Longest line of text of a page.
WIDTH = 130
#: Cell of a number that there is not.
ABSENT = "-"


@dataclass(frozen=True)
class Section:
    """A table with its title, and lines below it."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    notes: Sequence[str] = field(default_factory=tuple)


def section_lines(section: Section, heading: str) -> list[str]:
    """A section as lines of Markdown: blank, title, table, notes as a list."""
    lines = ["", f"{heading} {section.title}", "", *table_lines(section.head, section.rows)]
    return lines + [""] * bool(section.notes) + [line for note in section.notes for line in text_lines(note, "- ")]


def text_lines(text: str, lead: str = "") -> list[str]:
    """A paragraph, or with a lead the entry of a list, as lines that are not too long."""
    return textwrap.wrap(
        text,
        WIDTH,
        initial_indent=lead,
        subsequent_indent=" " * len(lead),
        break_long_words=False,
        break_on_hyphens=False,
    )


def table_lines(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    """A table as lines of Markdown."""
    cells = [list(head), ["---"] * len(head), *rows]
    return ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in cells]


def between_marks(page: str, begin: str, end: str, text: str) -> str | None:
    """The page with a text between two of its lines; None where it does not have them."""
    before, first, rest = page.partition(begin)
    _, last, after = rest.partition(end)
    return f"{before}{begin}\n\n{text}\n{end}{after}" if first and last else None


def number(value: float | None, form: str, factor: float = 1.0, unit: str = "") -> str:
    """A cell of a number, or of none."""
    if value is None:
        return ABSENT
    return f"{value:{form}}" if form == "d" else f"{factor * value:{form}}{unit}"


def holds(value: bool | None) -> str:
    """Whether a row meets its demands; None: it has none."""
    return {True: "yes", False: "NO", None: "not demanded"}[value]
