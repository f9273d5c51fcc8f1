"""mcplan version"""

from __future__ import annotations


def version() -> None:
    """Print the version, and that of the solver that is linked.

    Example: mcplan version
    """
    from mcplan._core import __version__, nlp

    print(__version__)
    print(f"Ipopt {nlp.ipopt_version()}")
