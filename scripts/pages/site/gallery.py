"""The gallery: pages, pictures and videos that commands make, and a page that shows them."""

from __future__ import annotations

import html
import json
import shlex
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

if sys.version_info >= (3, 11):
    import tomllib
else:  # pages are checked there, too, but no site is built
    import tomli as tomllib

from pages.page import ROOT

ENTRIES = ROOT / "docs/site/gallery.toml"
#: Files that the commands of an entry may write and the site shows.
PAGE, PICTURE, VIDEO = "page.html", "picture.png", "video.mp4"
#: The commands that an entry was made by, for the next build.
MADE_BY = "made_by.json"


@dataclass(frozen=True)
class Entry:
    """A plan, motion or run of the gallery.

    Attributes:
        name: Of its folder.
        text: What it shows.
        commands: What makes it.
    """

    name: str
    text: str
    commands: list[str]


def entries() -> list[Entry]:
    """All entries, in the order in which they are shown."""
    return [Entry(**entry) for entry in tomllib.loads(ENTRIES.read_text(encoding="utf-8"))["entry"]]


def make(entry: Entry, folder: Path, fresh: bool) -> None:
    """Run the commands of an entry, unless they have been run before.

    Args:
        entry: What to make.
        folder: Of the gallery; the entry has a folder in it.
        fresh: Run them anyway.

    Raises:
        SystemExit: A command fails.
    """
    place = folder / entry.name
    done = place / MADE_BY
    if not fresh and done.exists() and json.loads(done.read_text(encoding="utf-8")) == entry.commands:
        return
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    for command in entry.commands:
        print(f"gallery: {command}", flush=True)
        words = [sys.executable, "-m", *shlex.split(command)]
        ran = subprocess.run(words, cwd=place, capture_output=True, text=True)
        if ran.returncode != 0:
            sys.exit(f"gallery: {command}: exit code {ran.returncode}\n{ran.stderr}")
    done.write_text(json.dumps(entry.commands), encoding="utf-8")


def write_gallery(source: Path, folder: Path, fresh: bool, quick: bool) -> None:
    """Make all entries and the page that shows them.

    Args:
        source: Where Sphinx reads.
        folder: Where entries are kept from one build to the next.
        fresh: Make them anew.
        quick: Make none, show those that are there.
    """
    lines = [
        "# Gallery",
        "",
        "Pages open without a network: turn the robot with the mouse, play with the button of the page.",
        "",
    ]
    lines += ["```{raw} html", '<div class="gallery">']
    shown = source / "gallery_files" / "gallery"
    shown.mkdir(parents=True)
    for entry in entries():
        if not quick:
            make(entry, folder, fresh)
        elif not (folder / entry.name / MADE_BY).exists():
            continue
        target = shown / entry.name
        target.mkdir()
        for name in (PAGE, PICTURE, VIDEO):
            if (folder / entry.name / name).exists():
                shutil.copy(folder / entry.name / name, target / name)
        lines += _figure(entry, folder / entry.name)
    lines += ["</div>", "```", ""]
    (source / "gallery.md").write_text("\n".join(lines), encoding="utf-8")


def _figure(entry: Entry, made: Path) -> list[str]:
    text, at = html.escape(entry.text), f"gallery/{entry.name}"
    links = [f'<a href="{at}/{PAGE}">page</a>']
    shown = f'<img src="{at}/{PICTURE}" alt="{text}" loading="lazy">'
    if (made / VIDEO).exists():
        links.append(f'<a href="{at}/{VIDEO}">video</a>')
        shown = f'<video src="{at}/{VIDEO}" poster="{at}/{PICTURE}" controls muted loop preload="none"></video>'
    else:
        shown = f'<a href="{at}/{PAGE}">{shown}</a>'
    commands = "<br>".join(f"<code>{html.escape(command)}</code>" for command in entry.commands)
    return [f"<figure>{shown}<figcaption>{text} {' · '.join(links)}<br>{commands}</figcaption></figure>"]
