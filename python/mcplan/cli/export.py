"""mcplan export"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer

from mcplan.cli.given_options import named_as_typed

FileArgument = Annotated[
    Path | None,
    typer.Argument(metavar="[FILE]", help="Plan (mcplan plan or rhp -o), motion (motion -o) or run (track --save)."),
]
ToOption = Annotated[
    str | None, typer.Option("--to", metavar="FORMAT", help="Name of the format; mcplan export --list prints them.")
]
OutputOption = Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE", help="File to write.")]
RobotOption = Annotated[
    str | None,
    typer.Option("--robot", metavar="R", help="Robot with a URDF, of formats with joints; default: the plan's own."),
]
RateOption = Annotated[
    float | None,
    typer.Option("--rate", metavar="HZ", help="Samples per second [1/s]; default: what is usual for the format."),
]
ListOption = Annotated[bool, typer.Option("--list", help="List the formats, what each needs and contains.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


@named_as_typed("to", "robot", path="--output", rate_hz="--rate", what="FILE")
def export(
    file: FileArgument = None,
    to: ToOption = None,
    output: OutputOption = None,
    robot: RobotOption = None,
    rate: RateOption = None,
    list_formats: ListOption = False,
    json: JsonOption = False,
) -> int:
    """Write a saved plan, motion or run in another tool's format.

    Of a run the recorded joints are written, of a motion its own; a plan gets joints by inverse kinematics where the
    format has them.

    Example: mcplan export run.npz --to mjlab -o motion.npz

    Example: mcplan export --list
    """
    from mcplan.cli.terminal import printable
    from mcplan.errors import InvalidInput
    from mcplan.export import export as write

    if list_formats:
        for option, value in (("FILE", file), ("--to", to), ("--output", output), ("--robot", robot), ("--rate", rate)):
            if value is not None:
                raise InvalidInput(option, "must not stand beside --list")
        _print_formats(json)
        return 0
    if file is None or to is None or output is None:
        missing = "FILE" if file is None else "--to" if to is None else "--output"
        raise InvalidInput(missing, "is required; mcplan export --list prints the formats")
    written = write(file, to, output, robot=robot, rate_hz=rate)
    if json:
        print(json_module.dumps({"file": str(file), "format": to, "output": str(written)}))
    else:
        print(printable(f"Saved {written}"))
    return 0


def _print_formats(json: bool) -> None:
    from mcplan.cli.table import print_table
    from mcplan.export import FORMATS

    if json:
        keys = ("name", "tool", "suffix", "needs", "joints", "rate_hz", "holds")
        print(json_module.dumps({"formats": [{key: getattr(f, key) for key in keys} for f in FORMATS.values()]}))
        return
    rows = [
        [f.name, f.tool, " ".join(f.suffix), f.needs, f"{f.rate_hz:g} Hz" if f.rate_hz else "knots", f.holds]
        for f in FORMATS.values()
    ]
    print_table(rows, ["format", "for", "file", "needs", "rate", "contains"])
