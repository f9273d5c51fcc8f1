"""Copies of what the site is made of, in one folder with the layout of the repository, so that links go on leading somewhere."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path, PurePosixPath

from pages.page import ROOT

#: Pages outside of docs that the site has, too.
OTHERS = ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "third_party_notes.md", "benchmarks/README.md")
#: What a link to a folder leads to.
FOLDERS = {"examples": "reference/examples.md", "docs": "index.md", "benchmarks": "benchmarks/README.md"}
_LINK = re.compile(r"(\]\()([^)\s]+)(\))")
_FENCE = re.compile(r"^ *(```|:::)")


def stage(folder: Path) -> None:
    """Copy pages, notebooks, pictures and what they link to.

    Args:
        folder: Where Sphinx reads; emptied before.
    """
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    pages = [*(ROOT / name for name in OTHERS), *sorted((ROOT / "docs").rglob("*"))]
    for source in pages:
        name = source.relative_to(ROOT)
        if source.is_dir() or name.parts[:2] in (("docs", "site"), ("docs", "stated")) or name == Path("docs/index.md"):
            continue
        if source.suffix == ".md":
            write_page(folder, name.as_posix(), source.read_text(encoding="utf-8"), name.as_posix())
        else:
            copy(folder, name.as_posix())
    for source in sorted((ROOT / "docs/site").glob("*.md")):
        text = source.read_text(encoding="utf-8")
        write_page(folder, source.name, text, f"docs/site/{source.name}")
    shutil.copy(ROOT / "docs/site/conf.py", folder / "conf.py")
    shutil.copytree(ROOT / "docs/site/static", folder / "_static")


def write_page(folder: Path, name: str, text: str, written_at: str) -> None:
    """Write a page whose links are those of another place.

    Args:
        folder: Where Sphinx reads.
        name: Of the page in it.
        text: The page.
        written_at: Where its links start from, in the repository.
    """
    lines, in_fence = [], False
    for line in text.splitlines():
        in_fence ^= bool(_FENCE.match(line))
        moved = line if in_fence else _LINK.sub(lambda m: m[1] + _moved(folder, m[2], written_at, name) + m[3], line)
        lines.append(moved)
    target = folder / name
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")


def copy(folder: Path, name: str) -> None:
    """Copy a file of the repository to the same place."""
    target = folder / name
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(ROOT / name, target)


def _moved(folder: Path, link: str, written_at: str, name: str) -> str:
    """A link as it has to be on the page that is staged; files that it leads to are staged with it."""
    if "://" in link or link.startswith(("#", "mailto:")):
        return link
    path, mark, anchor = link.partition("#")
    aim = PurePosixPath(os.path.normpath(PurePosixPath(written_at).parent / path)).as_posix()
    if aim == "docs/index.md":
        aim = "index.md"
    elif (ROOT / aim).is_dir():
        aim = FOLDERS[aim]
    elif (ROOT / aim).is_file() and not (aim.startswith("docs/") or aim in OTHERS):
        copy(folder, aim)
    if aim.startswith("docs/site/"):
        aim = aim.removeprefix("docs/site/")
    start = PurePosixPath(name).parent
    return PurePosixPath(os.path.relpath(aim, start)).as_posix() + mark + anchor
