"""mcplan version"""

from __future__ import annotations


def version() -> None:
    """Print the version.

    Example: mcplan version
    """
    from mcplan._core import __version__

    print(__version__)
