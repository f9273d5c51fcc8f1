"""What the verbs of `mcplan bench` have in common: cases by name, progress, tables on the terminal and pages of them."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypeVar

if TYPE_CHECKING:
    from mcplan_bench.sections import Section


class Named(Protocol):
    @property
    def name(self) -> str: ...


_Case = TypeVar("_Case", bound=Named)


def cases_named(cases: Sequence[_Case], names: Sequence[str]) -> list[_Case]:
    """The cases that the names address, in which `*` stands for anything; without names all of them.

    Raises:
        InvalidInput: A name addresses none.
    """
    from mcplan.errors import InvalidInput, shown

    for name in names:
        if not any(fnmatchcase(case.name, name) for case in cases):
            raise InvalidInput("--case", f"must name one of {', '.join(case.name for case in cases)}", shown(name))
    return [case for case in cases if not names or any(fnmatchcase(case.name, name) for name in names)]


def say(text: str) -> None:
    """Print a line of progress, which is no result, to stderr."""
    print(text, file=sys.stderr, flush=True)


def print_sections(sections: Iterable[Section]) -> None:
    """Print tables with their titles and notes."""
    from mcplan.cli.table import print_table

    for section in sections:
        print(section.title)
        if section.rows:
            print_table(section.rows, section.head)
        for note in section.notes:
            print(f"  {note}")
        print()


def write_page(path: Path, page: Callable[[str], str]) -> Path:
    """Write a page that is made of what the file has had; its folder is made if it does not exist."""
    from mcplan.files.outputs import write_whole

    path.parent.mkdir(parents=True, exist_ok=True)
    before = path.read_text(encoding="utf-8") if path.is_file() else ""
    return write_whole(page(before), path)
