"""mcplan schema"""

from __future__ import annotations

from typing import Annotated

import typer


def schema(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="[KIND]", help="Kind of file: scene, robot, planar_robot, planar_task or sweep."),
    ] = None,
) -> None:
    """Print where the JSON schemas of files are, for editors.

    The first line of a TOML file names it: #:schema PATH

    Example: mcplan schema scene
    """
    from mcplan.cli.table import print_table
    from mcplan.errors import InvalidInput, shown
    from mcplan.files.schema import KINDS, path_of

    if kind is None:
        print_table([name, str(path_of(name))] for name in KINDS)
        return
    if kind not in KINDS:
        raise InvalidInput("KIND", f"must be one of {', '.join(KINDS)}", shown(kind))
    print(path_of(kind))
