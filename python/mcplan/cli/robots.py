"""mcplan robots"""

from __future__ import annotations

import functools
import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mcplan.cli.given_options import at_least, named_as_typed
from mcplan.cli.terminal import say

if TYPE_CHECKING:
    from collections.abc import Iterable

    from mcplan._core import Robot
    from mcplan.files.urdf_setups import End


NameArgument = Annotated[str | None, typer.Argument(metavar="[NAME]", help="Robot: built-in name or TOML file.")]
FromUrdfOption = Annotated[
    str | None,
    typer.Option(
        "--from-urdf", metavar="URDF", help="Source of a new robot: a URDF file, or talos, anymal, go2 or g1."
    ),
]
EndOption = Annotated[
    list[str] | None,
    typer.Option(
        "--end",
        metavar="NAME=FRAME[:KIND[:LxW[:X,Y,Z]]]",
        help="End-effector of the new robot: URDF link, kind, half size, contact point; with --planar NAME=FRAME[:POINT,...].",
    ),
]
PlanarOption = Annotated[
    bool, typer.Option("--planar", help="Make a planar robot, from the joints about one axis, for sip.")
]
SrdfOption = Annotated[
    Path | None, typer.Option("--srdf", metavar="FILE", help="SRDF file whose first posture is the nominal one.")
]
PostureOption = Annotated[
    list[str] | None,
    typer.Option("--posture", metavar="JOINT=ANGLE", help="Angle of a joint [rad] in the nominal posture."),
]
ReachPolytopesOption = Annotated[
    bool, typer.Option("--reach-polytopes", help="Add the reach of feet as polytopes, for rhp.")
]
FacesOption = Annotated[
    int | None,
    typer.Option(
        "--faces", metavar="N", callback=at_least(6), help="Maximum number of faces of a polytope, 6 at least (30)."
    ),
]
StrengthOption = Annotated[
    bool,
    typer.Option("--strength", help="Print the forces that the arms of robot NAME can exert, over random postures."),
]
SeedOption = Annotated[
    int | None,
    typer.Option(
        "--seed",
        metavar="SEED",
        callback=at_least(0),
        help="With --strength or --from-urdf: seed of the random postures (0).",
    ),
]
OutputOption = Annotated[Path | None, typer.Option("-o", "--output", metavar="FILE", help="TOML file for the robot.")]


@named_as_typed("posture", "srdf", "faces", "seed", source="--from-urdf", ends="--end")
def robots(
    name: NameArgument = None,
    from_urdf: FromUrdfOption = None,
    end: EndOption = None,
    planar: PlanarOption = False,
    srdf: SrdfOption = None,
    posture: PostureOption = None,
    reach_polytopes: ReachPolytopesOption = False,
    faces: FacesOption = None,
    strength: StrengthOption = False,
    seed: SeedOption = None,
    output: OutputOption = None,
) -> None:
    """List, print or copy robots, or make one from a URDF.

    Example: mcplan robots talos -o my.toml

    Example: mcplan robots --from-urdf my.urdf --end left_foot=l_sole:foot:0.10x0.05 --end right_foot=r_sole -o my.toml
    """
    from mcplan.cli import planar_robots
    from mcplan.errors import InvalidInput, shown

    for option, given in (
        ("--reach-polytopes", reach_polytopes),
        ("--planar", planar),
        ("--posture", bool(posture)),
        ("--end", bool(end)),
        ("--srdf", srdf is not None),
    ):
        if given and from_urdf is None:
            raise InvalidInput(option, "needs --from-urdf")
    if output is not None and name is None and from_urdf is None:
        raise InvalidInput("--output", "needs the NAME of a robot, or --from-urdf")
    if seed is not None and not strength and (from_urdf is None or planar):
        raise InvalidInput("--seed", "needs --strength, or --from-urdf without --planar")
    count, seed = _faces(reach_polytopes, faces), seed or 0
    if name is not None and from_urdf is not None:
        raise InvalidInput("NAME", "may not stand beside --from-urdf", shown(name))
    for option, given in (
        ("--reach-polytopes", reach_polytopes),
        ("--srdf", srdf is not None),
        ("--posture", bool(posture)),
    ):
        if given and planar:
            raise InvalidInput(option, "may not stand beside --planar")
    if strength and (name is None or from_urdf is not None or planar_robots.is_planar(name)):
        raise InvalidInput("--strength", "needs the NAME of a robot with a URDF")
    if strength and output is not None:
        raise InvalidInput("--strength", "may not stand beside --output")
    if from_urdf is not None and planar:
        planar_robots.planar_robot_from_urdf(from_urdf, end or [], output)
    elif from_urdf is not None:
        _from_urdf(_Given(from_urdf, end or [], srdf, posture or []), output, count, seed)
    elif name is None:
        _print_list()
    elif output is not None:
        _copy(name, output)
    else:
        _print(name, seed if strength else None)


def _faces(reach_polytopes: bool, faces: int | None) -> int | None:
    """Of the polytopes; None: without them."""
    from mcplan.errors import InvalidInput
    from mcplan.files.reach_polytopes import FACES

    if faces is not None and not reach_polytopes:
        raise InvalidInput("--faces", "needs --reach-polytopes")
    return (faces or FACES) if reach_polytopes else None


def _print_list() -> None:
    from mcplan.cli.table import print_table
    from mcplan.files.planar_robots import list_planar_robots, load_planar_robot
    from mcplan.files.robots import list_robots, load_robot

    rows = [[entry, "", load_robot(entry).description] for entry in list_robots()]
    rows += [[entry, "planar", load_planar_robot(entry).description] for entry in list_planar_robots()]
    print_table(rows)


def _print(name: str, strength_seed: int | None) -> None:
    """Print a robot; `strength_seed`: of the postures over which its arms' strength is printed, None: is not."""
    from mcplan.cli import planar_robots, robots_strength
    from mcplan.files.planar_robots import load_planar_robot
    from mcplan.files.robots import load_robot

    if planar_robots.is_planar(name):
        planar_robots.print_planar_robot(load_planar_robot(name))
        return
    robot = load_robot(name)
    strengths = [] if strength_seed is None else robots_strength.strengths(robot, strength_seed)
    _print_robot(robot)
    if strength_seed is not None:
        robots_strength.print_strengths(strengths)


def _copy(name: str, output: Path) -> None:
    """Write a robot's file."""
    from mcplan.cli.planar_robots import is_planar
    from mcplan.files.outputs import TOML, require_target
    from mcplan.files.planar_robots import load_planar_robot, save_planar_robot
    from mcplan.files.robots import load_robot

    require_target("--output", output, TOML)
    comment = f"Made by: mcplan robots {name} -o {output}"
    if is_planar(name):
        save_planar_robot(load_planar_robot(name), output, comment)
        say(f"Wrote {output}")
    else:
        _write(load_robot(name), output, comment)


def _write(robot: Robot, output: Path, comment: str) -> None:
    """Write a robot, with the path of its URDF as its file needs it, if it can have that."""
    from mcplan.files.robots import save_robot, urdf_beside

    beside = urdf_beside(robot.urdf, output)
    if beside is None:
        note = f"lies neither in the folder of {output} nor below: left out. Copy it there, and add its path as urdf"
        print(f"note: {robot.urdf} {note}", file=sys.stderr)
    robot.urdf = beside or ""
    save_robot(robot, output, comment)
    say(f"Wrote {output}")


@dataclass(frozen=True)
class _Given:
    """What a robot is worked out from, as it was typed."""

    source: str
    ends: list[str]
    srdf: Path | None
    posture: list[str]


def _from_urdf(given: _Given, output: Path | None, faces: int | None, seed: int) -> None:
    """faces: of the reach polytopes; None: without them."""
    from mcplan.files import reach_polytopes
    from mcplan.files.outputs import TOML, require_target
    from mcplan.files.robots import robot_to_dict
    from mcplan.files.toml import toml_text
    from mcplan.files.urdf import header, robot_from_urdf
    from mcplan.files.urdf_setups import SETUPS

    require_target("--output", output, TOML)
    source, ends, srdf, posture = given.source, given.ends, given.srdf, given.posture
    parsed, srdf_path = tuple(_parse_end(text) for text in ends), str(srdf) if srdf else None
    angles = dict(_parse_angle(text) for text in posture) if posture else None
    robot = robot_from_urdf(source, parsed, srdf=srdf_path, posture=angles, seed=seed)
    if not robot.trunk:
        reason = f"{source} has no visual shapes of it, or its meshes were not found"
        print(f"note: no trunk, {reason}: plans keep a ball about the CoM out of solids alone", file=sys.stderr)
    words = ["mcplan robots --from-urdf", source, *(f"--end {text}" for text in ends)]
    words += [f"--srdf {srdf}"] if srdf else []
    words += [f"--posture {text}" for text in posture]
    if faces is not None:
        words += ["--reach-polytopes", *([f"--faces {faces}"] if faces != reach_polytopes.FACES else [])]
    words += [f"--seed {seed}"] if seed else []
    words += [f"-o {output}"] if output else []
    own_posture = bool(
        posture or (source in SETUPS and SETUPS[source].posture) or (Path(source).is_file() and not srdf)
    )
    comment = header(" ".join(words), own_posture=own_posture)
    if faces is not None:
        origin = reach_polytopes.Origin(source, parsed, srdf_path, angles)
        progress = functools.partial(print, file=sys.stderr)
        reach_polytopes.add_reach_polytopes(robot, origin, faces, seed=seed, progress=progress)
        comment += "\n" + reach_polytopes.header(faces, seed)
    if output is None:
        robot.validate()
        print(toml_text(robot_to_dict(robot), comment), end="")
    else:
        _write(robot, output, comment)


def _parse_end(text: str) -> End:
    from mcplan.errors import InvalidInput, shown
    from mcplan.files.urdf_setups import End

    try:
        name, rest = text.split("=", 1)
        parts = rest.split(":")
        frame, kind, size, point = [*parts, *["", "foot", "0x0", "0,0,0"][len(parts) :]]
        length, width = (float(part) for part in size.split("x"))
        x, y, z = (float(part) for part in point.split(","))
    except ValueError:
        raise InvalidInput("--end", "must read NAME=FRAME[:KIND[:LENGTHxWIDTH[:X,Y,Z]]]", shown(text)) from None
    return End(name, frame, kind, (length, width), frame_offset=(x, y, z))


def _parse_angle(text: str) -> tuple[str, float]:
    from mcplan.errors import InvalidInput, shown

    try:
        joint, angle = text.split("=", 1)
        return joint, float(angle)
    except ValueError:
        raise InvalidInput("--posture", "must read JOINT=ANGLE", shown(text)) from None


def _print_robot(robot: Robot) -> None:
    from mcplan.cli.table import print_table

    say(f"{robot.name}: {robot.description}" if robot.description else robot.name)
    say(
        f"mass {robot.mass:g} kg, inertia {_numbers(robot.inertia)} kg m^2, CoM height {robot.com_height:g} m, "
        f"swing height {robot.swing_height:g} m"
    )
    if robot.urdf:
        say(f"URDF {robot.urdf}")
    say()
    rows = [
        [
            e.name,
            e.kind,
            _numbers(e.nominal_B),
            f"{_numbers(e.reach_min_B)} .. {_numbers(e.reach_max_B)}",
            _numbers(e.half_size) if e.half_size.any() else "point",
            f"{e.max_force:.0f}",
            _numbers(e.max_moment),
            f"{e.yaw_range[0]:.2f} .. {e.yaw_range[1]:.2f}" if math.isfinite(e.yaw_range[0]) else "any",
        ]
        for e in robot.end_effectors
    ]
    head = [
        "end-effector",
        "kind",
        "nominal [m]",
        "reach [m]",
        "half size [m]",
        "force [N]",
        "moment [N m]",
        "yaw [rad]",
    ]
    print_table(rows, head)
    for e in robot.end_effectors:
        for normal, b in zip(e.reach_cut.A, e.reach_cut.b, strict=True):
            say(f"{e.name}: its reach is cut at {_face(normal, b)}")
        reaches = [("CoM", e.com_reach)] if e.com_reach.given else []
        for who, reach in [*reaches, *e.partner_reach.items()]:
            say(f"{e.name}: polytope of the {who}, {len(reach.b)} faces")


def _face(normal: Iterable[float], b: float) -> str:
    """A x <= b as an inequality: "-0.420 x +0.908 z <= -0.521 m"."""
    text = " ".join(f"{value:+.3f} {axis}" for value, axis in zip(normal, "xyz", strict=True) if value)
    return f"{text} <= {b:.3f} m"


def _numbers(values: object) -> str:
    return " ".join(f"{value:.3f}" for value in values)  # type: ignore[attr-defined]
