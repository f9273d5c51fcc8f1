"""ProxQP in a build that rounds equally every time."""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any


def load() -> Any:
    """The module ``proxsuite.proxqp``, in the build for any processor if proxsuite was not imported before.

    The builds with AVX round by where memory happens to lie: two runs of one plan would differ by 1e-9 and more. They
    register the same types, so that only one build fits into a process, and proxsuite takes the fastest: it is told
    that there is no AVX. It costs a fifth to a half of the solver's speed.
    """
    if "proxsuite" in sys.modules:
        return sys.modules["proxsuite"].proxqp
    name = "proxsuite.instructionset"
    plain = ModuleType(name)
    plain.has_AVX512F = plain.has_AVX2 = lambda: False  # type: ignore[attr-defined]
    sys.modules[name] = plain
    try:
        return importlib.import_module("proxsuite").proxqp
    finally:
        del sys.modules[name]
