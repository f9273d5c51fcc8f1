"""Links of the finished site that lead nowhere."""

from __future__ import annotations

from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

#: Attributes that lead to another file.
LEADING = {"a": "href", "img": "src", "link": "href", "script": "src", "video": "src"}


class _Found(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.links: list[str] = []
        self.anchors: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        told = dict(attrs)
        self.anchors |= {value for key in ("id", "name") if (value := told.get(key))}
        if link := told.get(LEADING.get(tag, "")):
            self.links.append(link)


def faults(folder: Path) -> list[str]:
    """Links between pages of a site whose file or anchor does not exist.

    Args:
        folder: With the HTML.
    """
    out = []
    for page in sorted(folder.rglob("*.html")):
        if "gallery" in page.relative_to(folder).parts[:-1]:
            continue  # pages of the product, each whole in itself
        for link in _read(page).links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            aim = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            where = f"{page.relative_to(folder)}: {link}"
            if not aim.exists():
                out.append(f"{where}: there is no such file")
            elif parts.fragment and aim.suffix == ".html" and unquote(parts.fragment) not in _read(aim).anchors:
                out.append(f"{where}: there is no such heading")
    return out


@cache
def _read(page: Path) -> _Found:
    found = _Found()
    found.feed(page.read_text(encoding="utf-8"))
    return found
