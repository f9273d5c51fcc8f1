"""--push newtons,seconds,at,direction"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mcplan.tracking import Push

#: What the four numbers are called in messages.
FIELDS = ("newtons", "seconds", "at", "direction")


def parse_pushes(texts: Sequence[str]) -> list[Push]:
    """Pushes from the words of the command line.

    Raises:
        InvalidOptions: Not four numbers, or one that is out of range; the message names it.
    """
    return [_push(text) for text in texts]


def require_within(pushes: Sequence[Push], end_s: float) -> None:
    """Raises InvalidOptions for a push that would never act."""
    from mcplan.errors import InvalidOptions

    for push in pushes:
        if not 0.0 <= push.at_s < end_s:
            raise InvalidOptions("--push: at", f"must lie in the run, from 0 to {end_s:.6g} s", f"{push.at_s:g}")


def _push(text: str) -> Push:
    from mcplan.errors import InvalidOptions, shown
    from mcplan.tracking.options import PUSH_MAX_N, Push

    words = text.split(",")
    if len(words) != len(FIELDS):
        raise InvalidOptions("--push", f"must be {','.join(FIELDS)}, such as 40,0.2,3,90", shown(text))
    numbers = []
    for name, word in zip(FIELDS, words, strict=True):
        try:
            number = float(word)
        except ValueError:
            raise InvalidOptions(f"--push: {name}", "must be a number", shown(word.strip())) from None
        if not math.isfinite(number):
            raise InvalidOptions(f"--push: {name}", "must be finite", word.strip())
        if number <= 0.0 and name in FIELDS[:2]:
            raise InvalidOptions(f"--push: {name}", "must be above 0", word.strip())
        if number > PUSH_MAX_N and name == FIELDS[0]:
            raise InvalidOptions(f"--push: {name}", f"must be at most {PUSH_MAX_N:g}", word.strip())
        numbers.append(number)
    return Push(*numbers)
