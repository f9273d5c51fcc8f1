"""`mcplan` commands in code blocks and in sentences: verbs, options and built-in names exist."""

from __future__ import annotations

import inspect
import re
import shlex
from collections.abc import Iterator
from functools import cache
from typing import Any

import typer.main

from mcplan.cli.app import app, complete
from mcplan_bench.reproduce import PAPERS
from pages import known
from pages.page import Page

_INLINE = re.compile(r"`(mcplan [^`]+)`")
#: Stand for something that the reader puts in.
_PLACEHOLDER = re.compile(r"[A-Z][A-Z_]*$|.*[./{*|].*|-?$")


def faults(page: Page) -> list[str]:
    """Commands that the product would refuse."""
    return [
        f"{page.name}:{number}: `{command}`: {why}" for number, command in spoken_of(page) if (why := wrong(command))
    ]


def spoken_of(page: Page) -> Iterator[tuple[int, str]]:
    """Line number and text of every `mcplan` command of a page."""
    text = page.text.replace("\\\n", "  ")  # a command that goes on in the next line
    dropped = page.text.count("\\\n") and {i for i, line in enumerate(page.text.splitlines(), 1) if line.endswith("\\")}
    lines = Page(page.path, text, text).lines()
    for number, line, is_code in lines:
        number += sum(1 for i in dropped or () if i < number)
        if is_code or line.startswith("    mcplan "):
            bare = re.sub(r"^(\s*\$ |\.venv/bin/|\s+)", "", line)
            for part in re.split(r"\s(?:&&|\|)\s", re.sub(r"\s#\s.*", "", bare)):
                if re.match(r"mcplan( |$)", part.strip()):
                    yield number, part.strip()
        else:
            for command in _INLINE.findall(line):
                yield number, command.partition(" | ")[0]


def help_faults() -> list[str]:
    """Examples of help texts that the product would refuse."""
    out = []
    for name, verb in all_verbs():
        for example in re.findall(r"Example: (mcplan .*(?:\n .*)*)", inspect.cleandoc(verb.help or "")):
            for command in example.split(" && "):
                if why := wrong(command):
                    out.append(f"{name} --help: `{command}`: {why}")
    return out


def all_verbs() -> Iterator[tuple[str, Any]]:
    """Names and commands of all verbs, the program itself first."""
    yield from _verbs(_root(), "mcplan")


def _verbs(verb: Any, name: str) -> Iterator[tuple[str, Any]]:
    yield name, verb
    for word, below in getattr(verb, "commands", {}).items():
        yield from _verbs(below, f"{name} {word}")


def wrong(command: str) -> str | None:
    """Why a command would be refused; None when it would not.

    Values are those of the page where they are given in capitals (FILE, X) and not looked at; what is left out is not missed.
    """
    words = shlex.split(command)[1:]
    verb: Any = _root()
    path = ["mcplan"]
    while words and hasattr(verb, "commands") and words[0] in verb.commands:
        path.append(words[0])
        verb = verb.commands[words.pop(0)]
    if verb is _root():
        return None if not words or words[0].startswith(("-", "X")) else f"there is no verb {words[0]}"
    if hasattr(verb, "commands") and words and not words[0].startswith("-"):
        return f"{' '.join(path)} has no verb {words[0]}"
    known = {name: p for p in verb.params for name in [*p.opts, *p.secondary_opts] if name.startswith("-")}
    known.update({"--help": None, "-h": None})
    positional: list[str] = []
    while words:
        word = words.pop(0)
        name, joined, value = word.partition("=")
        if not name.startswith("-") or name == "-":
            positional.append(word)
            continue
        if name not in known:
            return f"{' '.join(path)} has no option {name}"
        option = known[name]
        if option is not None and not option.is_flag and not option.count:
            value = value if joined else words.pop(0) if words else "VALUE"
            if fault := _refused(verb, option, value):
                return fault
    places = sum(parameter.param_type_name == "argument" for parameter in verb.params)
    if len(positional) > places:
        return f"{' '.join(path)} takes {places} without an option, got {' '.join(positional)}"
    return _unknown_name(path[-1], positional)


def _refused(verb: Any, option: Any, value: str) -> str | None:
    """What is wrong with the value of an option: the parser is asked, of `--robot` the list of robots."""
    if option.opts[0] == "--robot" and not _PLACEHOLDER.match(value):
        return None if value in known.LISTS["robots"]() else f"there is no robot {value}"
    if _PLACEHOLDER.match(value) and not re.match(r"[\d.]+$", value):
        return None
    try:
        verb.make_context(verb.name, [option.opts[0], value])
    except Exception as found:  # of click or of typer's own copy of it
        said = found.format_message() if hasattr(found, "format_message") else str(found)
        return said if said.startswith("Invalid value") else None
    return None


def _unknown_name(verb: str, positional: list[str]) -> str | None:
    scenes, tasks = known.LISTS["scenes"], known.LISTS["planar tasks"]
    lists = {
        "plan": scenes,
        "rhp": scenes,
        "scenes": scenes,
        "sip": tasks,
        "tasks": tasks,
        "robots": lambda: known.LISTS["robots"]() + known.LISTS["planar robots"](),
        "reproduce": lambda: list(PAPERS),
    }
    if verb not in lists or not positional or _PLACEHOLDER.match(positional[0]):
        return None
    names = lists[verb]()
    return None if positional[0] in names else f"{verb} knows no {positional[0]}"


@cache
def _root() -> Any:
    complete("--help")
    return typer.main.get_command(app)
