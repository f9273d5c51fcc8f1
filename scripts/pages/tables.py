"""Tables that the code knows: whole ones between marks, and columns and rows of tables that people write.

<!-- table: robot_limits -->      the whole table is made by the function of this name below; `table slowly` marks one that
    ...                               plans, and is made with --slow
    <!-- end -->

<!-- defaults of: rhp.Options -->   in the table below, the first column names fields and the second has their defaults
<!-- rows are: status -->           in the table below, the first column has these names, all of them and no others
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable
from enum import Enum
from types import SimpleNamespace
from typing import Any

import mcplan
from mcplan import Tolerances, rhp, sip
from mcplan._core import ddp
from mcplan.files import reading
from mcplan.files.reading import size_text
from mcplan.files.robots import list_robots
from mcplan.files.scenes import list_scenes
from mcplan.tracking.options import Options as TrackingOptions
from pages import known, made
from pages.page import Page

_MADE = re.compile(r"<!-- table( slowly)?: (\w+) -->\n(.*?)<!-- end -->", re.S)
_DEFAULTS = re.compile(r"(<!-- defaults of: ([\w.]+) -->\n(?:<!--.*-->\n)*\n?)((?:\|.*\n)+)")
_ROWS = re.compile(r"<!-- rows are: ([\w ]+) -->\n(?:<!--.*-->\n)*\n?((?:\|.*(?:\n|$))+)")
_NAME = re.compile(r"`([\w/]+)`")
OPTIONS: dict[str, Callable[[], Any]] = {
    "ddp.Options": ddp.Options,
    "rhp.Options": rhp.Options,
    "sip.Options": sip.Options,
    "tracking.Options": TrackingOptions,
    "CMakeLists.txt": lambda: SimpleNamespace(**known.cmake_options()),
    "Tolerances": Tolerances,
}
#: Options that are called otherwise in Python than in the struct.
CALLED = {"time_limit": "time_limit_s"}


def refresh(page: Page, slow: bool = False) -> list[str]:
    """Rewrite a page's tables; returns rows that are missing or name nothing."""
    faults: list[str] = []
    page.text = _MADE.sub(lambda match: _made(match, slow), page.text)
    page.text = _DEFAULTS.sub(lambda m: m[1] + _defaults(page, m[2], m[3], faults), page.text)
    for match in _ROWS.finditer(page.text):
        rows = match[2].strip().splitlines()[2:]
        # A row without a name goes on with the one above it.
        there = {name for row in rows for name in _NAME.findall(row.split("|")[1])}
        wanted = set(known.LISTS[match[1]]())
        if there != wanted:
            faults.append(
                f"{page.name}, table of {match[1]}: lacks {sorted(wanted - there)}, has {sorted(there - wanted)} too much"
            )
    return faults


def _made(match: re.Match[str], slow: bool) -> str:
    slowly, name, old = match[1] or "", match[2], match[3]
    if slowly and not slow:
        return match[0]
    new = MADE[name]()
    kept = old if slowly and made.same(old, new, made.ABOUT) else new
    return f"<!-- table{slowly}: {name} -->\n{kept}<!-- end -->"


def _defaults(page: Page, what: str, table: str, faults: list[str]) -> str:
    options = OPTIONS[what]()
    lines = table.splitlines()
    for i, line in enumerate(lines[2:], 2):
        cells = line.split("|")
        names = _NAME.findall(cells[1])
        if not names:  # goes on with the row above it
            continue
        values = []
        for name in names:
            try:
                values.append(default(getattr(options, CALLED.get(name, name))))
            except AttributeError:
                faults.append(f"{page.name}: {what} has no {name}")
                return table
        if [_plain(v) for v in _split(cells[2])] != [_plain(v) for v in values]:
            cells[2] = f" {', '.join(values)} "
            lines[i] = "|".join(cells)
    return "\n".join(lines) + "\n"


def default(value: Any) -> str:
    """A default as pages write it."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None or value == () or (isinstance(value, float) and math.isinf(value)):
        return "none"
    if isinstance(value, Enum) or type(value).__module__.startswith("mcplan._core"):
        if hasattr(value, "min"):
            return f"({value.min:g}, {value.max:g})"
        return f"`{getattr(value, 'name', value)}`"
    if isinstance(value, (tuple, list)):
        return f"({', '.join(f'{v:g}' for v in value)})"
    return f"{value:g}"


def _split(cell: str) -> list[str]:
    return [part.strip() for part in re.split(r",(?![^(]*\))", cell)]


def _plain(text: str) -> str:
    """Numbers by their values: 0.80 is 0.8, and 1e-3 is 0.001."""
    return re.sub(r"-?\d[\d.]*(?:e-?\d+)?", lambda m: f"{float(m[0]):g}", text)


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table in Markdown."""
    head = list(head)
    cells = [head, ["---"] * len(head), *map(list, rows)]
    return "".join("| " + " | ".join(row) + " |\n" for row in cells)


def robot_limits() -> str:
    """What the limbs of robots made from a URDF bear, and how far soles turn."""
    rows = []
    for name in list_robots():
        robot = mcplan.load_robot(name)
        if not robot.urdf or any(end.com_reach.given for end in robot.end_effectors):
            continue
        weight = robot.mass * 9.81
        kinds = []
        for kind in ("foot", "hand"):
            forces = sorted({end.max_force for end in robot.end_effectors if end.kind == kind}, reverse=True)
            kinds.append(" and ".join(f"{force:g} N, {force / weight:.2f}" for force in forces))
        foot = next(end for end in robot.end_effectors if end.kind == "foot")
        right, left = -foot.yaw_range[0], foot.yaw_range[1]
        inward, outward = (right, left) if foot.nominal_B[1] > 0.0 else (left, right)
        turn = f"{inward:.2f}, {outward:.2f} rad" if math.isfinite(left) else ""
        moment = f"{foot.max_moment[2]:g} N m" if foot.max_moment[2] > 0 else ""
        rows.append([f"`{name}`", *kinds, turn, moment])
    return table(["", "feet, of the weight", "hands, of the weight", "soles turn in, out", "moment"], rows)


def robots() -> str:
    """The built-in robots as numbers."""
    rows = []
    for name in list_robots():
        r = mcplan.load_robot(name)
        kinds = [end.kind for end in r.end_effectors]
        limbs = ", ".join(f"{kinds.count(k)} {k}" for k in dict.fromkeys(kinds))
        low, high = r.phase_duration
        rows.append(
            [f"`{name}`", f"{r.mass:.1f}", f"{r.com_height:.2f}", limbs, f"{low:g} to {high:g}", f"{r.swing_height:g}"]
            + [f"{r.sole_support:g}", f"{r.pressure_ratio:g}"]
        )
    head = ["robot", "mass [kg]", "CoM at [m]", "end-effectors", "`phase_duration` [s]", "`swing_height` [m]"]
    return table([*head, "`sole_support`", "`pressure_ratio`"], rows)


def scenes() -> str:
    """The built-in scenes as numbers."""
    rows = []
    for name in list_scenes():
        s = mcplan.load_scene(name)
        way = s.goal.position_W - s.start.position_W
        turn = math.degrees(s.goal.yaw - s.start.yaw)
        frictions = sorted({surface.friction for surface in s.surfaces if not surface.grasp})
        goal = ", ".join(
            f"{x:.2f}".rstrip("0").rstrip(".").replace("-0", "0") if abs(x) < 0.005 else f"{x:.2f}" for x in way
        )
        rows.append(
            [f"`{name}`", f"({goal})" + (f", {turn:.0f}°" if abs(turn) > 0.5 else ""), str(len(s.surfaces))]
            + [", ".join(f"{f:g}" for f in frictions), "yes" if any(x.grasp for x in s.surfaces) else ""]
            + [str(len(s.steps)) if s.steps else "", str(len(s.rules)) if s.rules else ""]
        )
    return table(["scene", "way to the goal [m]", "surfaces", "friction", "`grasp`", "steps", "rules"], rows)


def file_limits() -> str:
    """Largest sizes of files that are read."""
    rows = [
        ["scene, robot or planar task (TOML)", size_text(reading.MAX_TOML)],
        ["reach polytopes (JSON)", size_text(reading.MAX_POLYTOPES)],
        ["URDF or SRDF", size_text(reading.MAX_URDF)],
        ["mesh", size_text(reading.MAX_MESH)],
        ["plan, its arrays", f"{size_text(reading.MAX_PLAN)}, {size_text(reading.MAX_PLAN_INFLATED)}"],
        ["run, its arrays", f"{size_text(reading.MAX_RUN)}, {size_text(reading.MAX_RUN_INFLATED)}"],
    ]
    return table(["file", "at most"], rows)


def least_torque() -> str:
    """Least torque by motion and case: criterion, and in brackets the largest `moment` that the checker finds [N m]."""
    rows = []
    for name in ("cartwheel", "climbing", "walking"):
        cells = []
        for forces in ("uniform", "per_body", "per_point"):
            result = mcplan.whole_body(name, forces=forces)
            if result.report.status != mcplan.Status.solved:
                cells.append(str(result.report.status))
                continue
            moment = next(c.value for c in mcplan.check(result.plan).constraints if c.name == "moment")
            cells.append(f"{result.report.cost:.0f} ({moment:.2f})")
        rows.append([name, *cells])
    return table(["motion", "case 1", "case 2", "case 3"], rows)


MADE: dict[str, Callable[[], str]] = {f.__name__: f for f in (robot_limits, robots, scenes, file_limits, least_torque)}
