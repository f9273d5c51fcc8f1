"""Optional packages of the viewer, imported when they are first used."""

from __future__ import annotations

import importlib
from types import ModuleType


class MissingPackage(ImportError):
    """A package of the extra ``view`` is not installed."""


def need(module: str, purpose: str, package: str | None = None) -> ModuleType:
    """Import a module of the extra ``view``.

    Args:
        module: Module to import.
        purpose: What needs it, as the subject of the message: "plots".
        package: Name on PyPI, where it differs from the module's.

    Raises:
        MissingPackage: It is not installed; the message says what to install.
    """
    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = package or module.split(".")[0]
        raise MissingPackage(f"{purpose} needs {name}: pip install 'mcplan[view]'") from error
