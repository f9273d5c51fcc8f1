"""Blocks that a command prints, between marks:

    <!-- made by: mcplan scenes -->
    ...
    <!-- end -->

Several commands are separated by ` && `; they run in a folder of their own, and all are shown. Of one that ends in `(silent)`
the output is not. `made slowly by` marks blocks whose commands plan or simulate: they are made with --slow, and numbers may then
differ by a fiftieth, since a search ends slightly elsewhere on another processor. Times on the clock are never compared, and
stand as they are when a block is made again: they were measured on a quiet machine.
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from pages.page import Page

MARK = re.compile(r"<!-- made (slowly )?by: (.+?) -->\n(.*?)<!-- end -->", re.S)
#: Tables of a benchmark, which `--markdown` puts: of one machine on one day, and never compared.
MEASURED = re.compile(r"<!-- begin: (.+?) -->\n(.*?)<!-- end: \1 -->", re.S)
#: What depends on the machine and its load.
CLOCK = re.compile(r"(?:after|in) [\d.]+ s\b|[\d.]+ ms a step|[\d.]+ times real time")
_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
#: Largest relative difference of numbers in blocks that are made slowly.
ABOUT = 0.02


def refresh(page: Page, slow: bool) -> list[str]:
    """Run the commands of a page's blocks and put what they print; returns those that could not be run."""
    faults: list[str] = []

    def replaced(match: re.Match[str]) -> str:
        slowly, command, old = bool(match[1]), match[2], match[3]
        if slowly and not slow:
            return match[0]
        try:
            new = output(command)
        except RuntimeError as found:
            faults.append(f"{page.name}: {found}")
            return match[0]
        kept = old if same(old, new, ABOUT if slowly else 0.0) else with_clock_of(old, new)
        return match[0].replace(f"-->\n{old}<!--", f"-->\n{kept}<!--")

    page.text = MARK.sub(replaced, page.text)
    for command, body in MEASURED.findall(page.text):
        if not re.search(r"\d{4}-\d\d-\d\d", body):
            faults.append(f"{page.name}: what `{command}` measured has no date")
    return faults


def output(command: str) -> str:
    """A fenced block with commands and what they print.

    Raises:
        RuntimeError: A command ended with something else than 0 (done) or 1 (done, with a negative answer).
    """
    lines = []
    with tempfile.TemporaryDirectory() as folder:
        for part in command.split(" && "):
            command, silent = part.removesuffix(" (silent)"), part.endswith(" (silent)")
            printed = run(command, Path(folder)).splitlines()
            lines += [f"$ {command}", *([] if silent else printed)]
    return "\n".join(["```", *lines, "```", ""])


def run(command: str, folder: Path) -> str:
    """What one `mcplan` command prints on its standard output, without spaces at the ends of lines."""
    words = shlex.split(command)
    if words[0] != "mcplan":
        raise RuntimeError(f"`{command}` is no mcplan command")
    env = {**os.environ, "COLUMNS": "120", "TERM": "dumb", "NO_COLOR": "1"}
    done = subprocess.run(
        [sys.executable, "-m", "mcplan", *words[1:]], cwd=folder, env=env, capture_output=True, text=True
    )
    if done.returncode not in (0, 1):
        raise RuntimeError(f"`{command}` ended with {done.returncode}: {done.stderr.strip()[-300:]}")
    return "\n".join(line.rstrip() for line in done.stdout.splitlines())


def same(old: str, new: str, about: float = 0.0) -> bool:
    """Whether two texts agree but for times on the clock, their numbers within `about` (relative, and a unit of the last
    digit that is shown)."""
    old, new = CLOCK.sub("TIME", old), CLOCK.sub("TIME", new)
    if about == 0.0:
        return old == new
    if _NUMBER.sub("#", old).split() != _NUMBER.sub("#", new).split():
        return False
    return all(
        abs(float(a) - float(b)) <= about * max(abs(float(a)), abs(float(b))) + _last_digit(a)
        for a, b in zip(_NUMBER.findall(old), _NUMBER.findall(new), strict=True)
    )


def with_clock_of(old: str, new: str) -> str:
    """The new text with the times on the clock of the old one, where it has as many."""
    times = CLOCK.findall(old)
    if len(times) != len(CLOCK.findall(new)):
        return new
    return CLOCK.sub(lambda _: times.pop(0), new)


def _last_digit(number: str) -> float:
    mantissa, _, exponent = number.partition("e")
    return 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
