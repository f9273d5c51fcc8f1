"""Optional dependencies: asked for when used, with one line that says what to install."""

from __future__ import annotations

import importlib.util

from mcplan.errors import MissingExtra


def require(what: str, extra: str, *modules: str) -> None:
    """Make sure that the modules of an extra are installed, without importing them.

    Args:
        what: The feature that needs them, for the message.
        extra: Name of the extra in pyproject.toml.
        *modules: Import names.

    Raises:
        MissingExtra: "mcplan.show needs meshcat: pip install 'mcplan[view]'".
    """
    missing = [name for name in modules if importlib.util.find_spec(name) is None]
    if missing:
        raise MissingExtra(f"{what} needs {', '.join(missing)}: pip install 'mcplan[{extra}]'")
