"""The command line of `scripts/docs`."""

from __future__ import annotations

import argparse
import difflib
import sys
from pathlib import Path

from pages import commands, links, made, names, pictures, stated, tables
from pages.page import Page, all_pages
from pages.site.build import build


def main(arguments: list[str] | None = None) -> int:
    """Check or rewrite the pages.

    Returns:
        0 when every page is up to date, 1 when one is stale or says what is not so.
    """
    parser = argparse.ArgumentParser(prog="scripts/docs", description=__doc__)
    parser.add_argument("--check", action="store_true", help="Change nothing; print what is stale.")
    parser.add_argument("--slow", action="store_true", help="Also blocks marked `made slowly by`.")
    parser.add_argument("--pictures", metavar="NAME", nargs="+", help="Draw pictures again, or all.")
    parser.add_argument("--site", metavar="DIR", nargs="?", const="build/site/html", help="Build the site into DIR.")
    parser.add_argument("--fresh", action="store_true", help="With --site: run all notebooks and the gallery again.")
    parser.add_argument("--quick", action="store_true", help="With --site: run no notebook and no command.")
    given = parser.parse_args(arguments)
    if given.site:
        return build(Path(given.site).resolve(), given.fresh, given.quick)
    if given.pictures:
        return pictures.draw(given.pictures)
    pages = all_pages()
    faults = review(pages, given.slow)
    for page in pages:
        if page.text == page.on_disk:
            continue
        if given.check:
            faults.append(f"{page.name} is stale; scripts/docs rewrites it:\n{_diff(page)}")
        else:
            page.write()
            print(f"rewrote {page.name}")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


def review(pages: list[Page], slow: bool = False) -> list[str]:
    """Bring the texts of the pages up to date in memory; returns what cannot be mended by rewriting."""
    faults: list[str] = []
    for page in pages:
        faults += made.refresh(page, slow)
        faults += tables.refresh(page, slow)
    faults += stated.refresh(pages)
    for page in pages:
        faults += links.faults(page) + commands.faults(page) + names.faults(page)
    return faults + commands.help_faults() + links.source_faults() + pictures.faults(pages)


def _diff(page: Page) -> str:
    lines = difflib.unified_diff(
        page.on_disk.splitlines(), page.text.splitlines(), f"{page.name} as it is", "as it should be", "", "", 1, ""
    )
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
