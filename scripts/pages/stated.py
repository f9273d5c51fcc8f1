"""Numbers in sentences. A file of `docs/stated/` says for a page which words hold which numbers of the code:

    page = "docs/theory/ddp.md"

    [[stated]]
    says = "at most {} switches, each of which must save a fraction of $10^{{}}$"
    is = ['code("ddp/search.cpp", "kSwitchesPerIteration")', '...']

`{}` is a number or a word of the page, ` ... ` any text of the same paragraph. What follows `is` is Python, with the names of
`value` below. A number may be rounded to the digits that the page shows.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from functools import cache
from typing import Any

import mcplan
from mcplan import PlanarTolerances, Tolerances, rhp, sip
from mcplan._core import ddp, toml_from
from mcplan.planar.tracking.run import DEFAULT_OPTIONS as PLANAR_TRACKING
from mcplan.planar.tracking.settings import ContactSettings, Feedback
from mcplan.tracking.options import Gains
from mcplan.tracking.options import Options as TrackingOptions
from pages import constants
from pages.page import ROOT, Page

_TOKEN = r"([-−+]?\d[\d.,]*\d(?:e[-+]?\d+)?|[-−]?\d(?:e[-+]?\d+)?|[\w-]+)"
WORDS = "none one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen".split()


def refresh(pages: Sequence[Page]) -> list[str]:
    """Put the code's numbers into the sentences; returns sentences that are gone and expressions that fail."""
    faults: list[str] = []
    by_name = {page.name: page for page in pages}
    for file in sorted((ROOT / "docs/stated").glob("*.toml")):
        content = toml_from(file.read_bytes())
        if content["page"] not in by_name:
            faults.append(f"docs/stated/{file.name}: there is no page {content['page']}")
            continue
        for entry in content["stated"]:
            fault = state(by_name[content["page"]], entry["says"], entry["is"])
            faults += [f"docs/stated/{file.name}: {fault}"] if fault else []
    return faults


def state(page: Page, says: str, expressions: Sequence[str]) -> str | None:
    """Put the values of expressions where a sentence of the page has `{}`; returns what is wrong with it."""
    match = re.search(pattern(says), page.text)
    if not match:
        return f"{page.name} no longer says: {says}"
    if says.count("{}") != len(expressions):
        return f"{says}: {says.count('{}')} places for {len(expressions)} values"
    text, at = "", 0
    for group, expression in enumerate(expressions, 1):
        try:
            shown = written(match[group], value(expression))
        except Exception as error:
            return f"{page.name}, {says}: {expression}: {error}"
        text += page.text[at : match.start(group)] + shown
        at = match.end(group)
    page.text = text + page.text[at:]
    return None


def pattern(says: str) -> str:
    """A regular expression for a sentence however its lines are broken."""
    parts = []
    for piece in re.split(r"(\{\}|\.\.\. ?)", says):
        if piece == "{}":
            parts.append(_TOKEN)
        elif piece.startswith("..."):
            parts.append(r"(?:(?!\n\n)[\s\S])*?")
        else:
            parts.append(r"\s+".join(re.escape(word) for word in re.split(r"\s+", piece)))
    return "".join(parts)


def written(old: str, wanted: Any) -> str:
    """A value as the page writes it: unchanged where it agrees with what is there, to the digits shown there."""
    if isinstance(wanted, str):
        return wanted
    if (shown := number(old)) is not None:
        mantissa, _, exponent = old.partition("e") if old.lower() not in WORDS else (old, "", "")
        unit = 10.0 ** int(exponent or 0)
        rounded = round(wanted / unit, len(mantissa.partition(".")[2])) * unit
        if math.isclose(shown, rounded, rel_tol=1e-9, abs_tol=1e-15):
            return old
    if old.lower() in WORDS and float(wanted).is_integer() and wanted < len(WORDS):
        word = WORDS[int(wanted)]
        return word.capitalize() if old[0].isupper() else word
    return f"{wanted:g}"


def number(text: str) -> float | None:
    """What a number or a number's word says; None for another word."""
    if text.lower() in WORDS:
        return float(WORDS.index(text.lower()))
    try:
        return float(text.replace("−", "-").replace(",", ""))
    except ValueError:
        return None


@cache
def value(expression: str) -> Any:
    """What an expression of `docs/stated/` is worth."""
    return eval(
        expression,
        {
            "code": constants.code,
            "found": constants.found,
            "py": constants.py,
            "mp": mcplan,
            "ddp": ddp.Options(),
            "rhp": rhp.Options(),
            "sip": sip.Options(),
            "tracking": TrackingOptions(),
            "gains": Gains(),
            "planar_tracking": PLANAR_TRACKING,
            "contacts": ContactSettings(),
            "feedback": Feedback(),
            "tolerances": Tolerances(),
            "whole_body": PlanarTolerances(),
            "robot": mcplan.load_robot,
            "planar_robot": mcplan.load_planar_robot,
            "scene": mcplan.load_scene,
            "task": mcplan.load_planar_task,
            "math": math,
        },
    )
