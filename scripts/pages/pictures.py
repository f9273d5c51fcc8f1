"""The list of docs/pictures.md: which command makes which picture."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pages import commands
from pages.page import ROOT, Page

LIST = ROOT / "docs/pictures.md"
_ITEM = re.compile(r"^- \[(?P<file>[\w./]+)\]\([^)]+\): `(?P<made>[\w./]+)` of\n(?P<commands>(?:  - `.+`\n)+)", re.M)


@dataclass(frozen=True)
class Picture:
    """A picture: its file below docs/, the commands that make it, and the file that they write."""

    file: str
    commands: tuple[str, ...]
    made: str


def listed(text: str) -> list[Picture]:
    """Pictures of the list."""
    return [Picture(m["file"], tuple(re.findall(r"`([^`]+)`", m["commands"])), m["made"]) for m in _ITEM.finditer(text)]


def faults(pages: Sequence[Page]) -> list[str]:
    """Pictures that no command makes, that no page shows, or whose command the product would refuse."""
    text = LIST.read_text(encoding="utf-8")
    table = listed(text)
    there = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.png")}
    named = {picture.file for picture in table}
    out = [f"docs/pictures.md: no entry for {file}" for file in sorted(there - named)]
    out += [f"docs/pictures.md: there is no {file}" for file in sorted(named - there)]
    for picture in table:
        for command in picture.commands:
            if command.startswith("mcplan ") and (why := commands.wrong(command)):
                out.append(f"docs/pictures.md: `{command}`: {why}")
    shown = {
        (page.path.parent / link).resolve()
        for page in pages
        for link in re.findall(r"(?:!\[[^\]]*\]\(|^\[[^\]]+\]: )([^)\n]+)", page.text, re.M)
    }
    return out + [f"docs/{f}: no page shows it" for f in sorted(there) if (ROOT / "docs" / f).resolve() not in shown]


def draw(names: Sequence[str]) -> int:
    """Draw pictures again, by their names or all (`all`), commands that they share once; returns the exit code."""
    table = listed(LIST.read_text(encoding="utf-8"))
    chosen = [p for p in table if {"all", p.file, Path(p.file).name, Path(p.file).stem} & set(names)]
    if not chosen:
        print(f"no picture {' or '.join(names)}; there are: {', '.join(p.file for p in table)}", file=sys.stderr)
        return 2
    done: dict[tuple[str, ...], Path] = {}
    with tempfile.TemporaryDirectory() as folder:
        for picture in chosen:
            if picture.commands not in done:
                done[picture.commands] = Path(folder) / str(len(done))
                done[picture.commands].mkdir()
                for command in picture.commands:
                    print(f"$ {command}", flush=True)
                    words = command.split()
                    words = ["-m", *words] if words[0] == "mcplan" else words[1:]
                    code = subprocess.run([sys.executable, *words], cwd=done[picture.commands]).returncode
                    if code not in ((0, 1) if command.startswith("mcplan ") else (0,)):
                        print(f"{picture.file} is as it was: the command ended with {code}", file=sys.stderr)
                        return 1
            shutil.copyfile(done[picture.commands] / picture.made, ROOT / "docs" / picture.file)
            print(f"wrote docs/{picture.file}", flush=True)
    return 0
