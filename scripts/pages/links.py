"""Links, anchors, pictures, and the width of lines: of all but tables that a benchmark or `mcplan reproduce` writes."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from pages.page import ROOT, Page

WIDTH = 130
_SENT = re.compile(r"(docs/[\w/]+\.md)(?:, \"([^\"\n]+)\")?")
_LINK = re.compile(r"\]\(([^)\s]*)\)|^\[[^\]]+\]: (\S+)$")


def faults(page: Page) -> list[str]:
    """What leads nowhere, and lines that are too long."""
    out = []
    measured = reproduced = page.name.startswith("docs/reproduce/")
    for number, line, is_code in page.lines():
        measured = reproduced or ((measured or line.startswith("<!-- begin: ")) and not line.startswith("<!-- end: "))
        if len(line) > WIDTH and not (measured and line.startswith("|")):
            out.append(f"{page.name}:{number}: {len(line)} columns, at most {WIDTH}")
        if not is_code:
            found = [inline or listed for inline, listed in _LINK.findall(line)]
            out += [f"{page.name}:{number}: {fault}" for link in found if (fault := _broken(page, link))]
    return out


def source_faults() -> list[str]:
    """Pages, and headings of them, that comments and docstrings send the reader to and that do not exist."""
    out = []
    for folder in ("cpp", "python", "bench", "scripts", "examples", "benchmarks", "tests/cpp"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".cpp", ".hpp", ".py", ".toml", ".txt"):
                continue
            for target, heading in _SENT.findall(path.read_text(encoding="utf-8")):
                where = f"{path.relative_to(ROOT)}: {target}"
                if not (ROOT / target).exists():
                    out.append(f"{where} does not exist")
                elif heading and _anchor(heading) not in anchors(ROOT / target):
                    out.append(f'{where} has no heading "{heading}"')
    return out


def _broken(page: Page, link: str) -> str | None:
    if "://" in link:
        return None
    file, _, anchor = link.partition("#")
    path = (page.path.parent / file).resolve() if file else page.path
    if not path.exists():
        return f"there is no {file}"
    if anchor and anchor not in anchors(path if file else page.path):
        return f"{path.name} has no heading #{anchor}"
    return None


@cache
def anchors(path: Path) -> frozenset[str]:
    """Anchors of a page's headings, as GitHub makes them."""
    seen: dict[str, int] = {}
    out = set()
    for _, line, is_code in Page.read(path).lines():
        heading = re.match(r"#+ +(.*)", line)
        if is_code or not heading:
            continue
        anchor = _anchor(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading[1]))
        count = seen.get(anchor, 0)
        seen[anchor] = count + 1
        out.add(anchor if count == 0 else f"{anchor}-{count}")
    return frozenset(out)


def _anchor(heading: str) -> str:
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
