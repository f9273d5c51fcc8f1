"""Names that have moved can still be had for one release, with a DeprecationWarning that says the new one."""

from __future__ import annotations

import warnings
from typing import Any


def tell(earlier: str, now: str, stacklevel: int = 3) -> None:
    """Warn whoever called the caller, in one line.

    Args:
        earlier: Name within mcplan, e.g. ``"load_motion"``.
        now: What it is called now, likewise.
        stacklevel: Calls from here to who used the name.
    """
    rule = f"mcplan.{earlier} is mcplan.{now} now; the earlier name goes with the next release"
    warnings.warn(rule, DeprecationWarning, stacklevel=stacklevel)


def attribute(owner: str, earlier: str, now: str) -> property:
    """A member under its earlier name, to read and to write."""

    def get(self: Any) -> Any:
        tell(f"{owner}.{earlier}", f"{owner}.{now}")
        return getattr(self, now)

    def put(self: Any, value: Any) -> None:
        tell(f"{owner}.{earlier}", f"{owner}.{now}")
        setattr(self, now, value)

    return property(get, put, doc=f"Earlier name of ``{now}``, for one release.")
