"""A Markdown page and its parts."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_FENCE = re.compile(r"^ *```")


@dataclass
class Page:
    """A page as it is on disk, and as it should be.

    Attributes:
        path: Of the file.
        text: What it should say; checks rewrite it.
        on_disk: What it says.
    """

    path: Path
    text: str
    on_disk: str

    @staticmethod
    def read(path: Path) -> Page:
        """A page from its file."""
        text = path.read_text(encoding="utf-8")
        return Page(path, text, text)

    @property
    def name(self) -> str:
        """The path from the root of the repository."""
        return self.path.relative_to(ROOT).as_posix() if self.path.is_relative_to(ROOT) else self.path.name

    def write(self) -> None:
        """Write what it should say."""
        self.path.write_text(self.text, encoding="utf-8")
        self.on_disk = self.text

    def lines(self) -> Iterator[tuple[int, str, bool]]:
        """Number, text and whether it is code, of every line; the fences themselves are code."""
        inside = False
        for number, line in enumerate(self.text.splitlines(), 1):
            fence = bool(_FENCE.match(line))
            yield number, line, inside or fence
            inside ^= fence

    def blocks(self, language: str) -> Iterator[tuple[int, str]]:
        """Line number and text of every fenced block in a language ("" for none)."""
        found: list[str] | None = None
        fenced, begin = False, 0
        for number, line in enumerate(self.text.splitlines(), 1):
            if _FENCE.match(line):
                if found is not None:
                    yield begin, "\n".join(found)
                found = [] if not fenced and line.strip() == f"```{language}" else None
                fenced, begin = not fenced, number + 1
            elif found is not None:
                found.append(line)


def all_pages() -> list[Page]:
    """Every page of the repository that speaks of the product, README first; those of the site alone are for its build."""
    top = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "third_party_notes.md", "benchmarks/README.md"]
    docs = [path for path in sorted((ROOT / "docs").rglob("*.md")) if path.parent.name != "site"]
    return [Page.read(path) for path in [*(ROOT / name for name in top), *docs]]
