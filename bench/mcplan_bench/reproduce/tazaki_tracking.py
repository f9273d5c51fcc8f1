"""Figure 2 of Tazaki's paper: plans of the four scenes, followed in MuJoCo by a robot of 44 kg with 30 joints."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.errors import MissingExtra
from mcplan.view import NoGraphics
from mcplan_bench import SCENES
from mcplan_bench.sections import ABSENT, number, table_lines, text_lines

from . import tazaki_robot
from .tazaki_names import PREFIX

if TYPE_CHECKING:
    from mcplan import Robot
    from mcplan.ddp import Result
    from mcplan.tracking import TrackingResult

Row = dict[str, Any]

#: What is added to the pelvis' moments of inertia in the paper's set-up [kg m^2]; the robot's own are 5.5 at most.
HELD_INERTIA = 1000.0
#: Set-ups: that of the paper, and none.
SETUPS = {"held": "inertia", "free": "none"}
#: Plans: ours for `humanoid44`, ours as for a robot that is tracked, and of the paper's model of contacts.
PLANS = {"ours": "ours", "margin": "ours, with margins", "lipm": "paper's model"}
#: Numbers for planning of built-in robots that are tracked, `talos` and `g1`.
MARGINS: Row = {"phase_duration": [0.3, 0.6], "sole_support": 1.0, "pressure_ratio": 0.75, "tracked": True}
#: Distance of the CoM from the plan [m] from which on a run is off its plan.
OFF_M = 0.05
#: Snapshots of a run.
FRAMES = 8


@dataclass(frozen=True)
class Run:
    """A plan of a scene, and the set-up in which it is followed."""

    scene: str
    plan: str
    setup: str


def runs(scenes: Sequence[str], quick: bool) -> list[Run]:
    """All runs; quick: one."""
    found = [Run(scene, plan, setup) for scene in scenes for plan in PLANS for setup in SETUPS]
    return found[:1] if quick else found


def track_all(
    out: Path, scenes: Sequence[str], quick: bool, say: Callable[[str], None]
) -> tuple[list[Row], list[Path], str]:
    """Plan, follow, measure and draw.

    Args:
        out: Folder for the robot and the pictures.
        scenes: Built-in scenes.
        quick: One run.
        say: Called with a line for each run.

    Returns:
        A row for each run; files written; why there are no rows or no pictures, "" where there are.
    """
    robots = {setup: tazaki_robot.write_robot(out, HELD_INERTIA if setup == "held" else 0.0) for setup in SETUPS}
    written = [out / f"{robot.name}.{kind}" for robot in robots.values() for kind in ("urdf", "toml")]
    rows: list[Row] = []
    why = ""
    plans: dict[tuple[str, str], Result] = {}
    for run in runs(scenes, quick):
        key = (run.scene, run.plan)
        if key not in plans:
            plans[key] = plan_for(run, robots["free"])
        try:
            row, result = follow(run, plans[key], robots[run.setup])
        except MissingExtra as error:
            return [], written, str(error)
        rows.append(row)
        if result is not None and drawn(run, row["fell"]):
            try:
                written.append(draw(run, result, out))
            except NoGraphics as error:
                why = str(error)
        say(f"Figure 2, {run.scene}, {run.plan}, {run.setup}: {ending(rows[-1])}")
    return rows, written, why


def plan_for(run: Run, robot: Robot) -> Result:
    """The plan that is followed; its robot has the joints' numbers for planning with the margins alone."""
    import mcplan

    if run.plan == "margin":
        planned = robot.__copy__()
        for name, value in MARGINS.items():
            setattr(planned, name, value)
        return mcplan.plan(run.scene, planned)
    return mcplan.plan(run.scene, tazaki_robot.PLANNED_FOR, model="lipm" if run.plan == "lipm" else "wrench")


def follow(run: Run, planned: Result, robot: Robot) -> tuple[Row, TrackingResult | None]:
    """Follow a plan that the checker accepts; what was measured, and the run, if there was one."""
    from mcplan.tracking.runner import track

    row: Row = {"scene": run.scene, "plan": run.plan, "setup": run.setup, "planned": str(planned.report.status)}
    if row["planned"] != "solved":
        return row | dict.fromkeys(MEASURED), None
    result = track(planned.plan, robot)
    return row | measured(result), result


def draw(run: Run, result: TrackingResult, out: Path) -> Path:
    """Snapshots of a run, side by side.

    Raises:
        NoGraphics: There is no graphics context.
    """
    from mcplan.view.pictures.run_strip import save_run_strip

    return save_run_strip(result, out / picture_name(run.scene, run.setup), frames=instants(result))


def picture_name(scene: str, setup: str) -> str:
    """File of the snapshots of our plan: Figures 2a to 2d, as in the paper."""
    return f"{PREFIX}figure_2{'abcd'[SCENES.index(scene)]}_{setup}.png"


def instants(result: TrackingResult) -> list[float]:
    """Times of the snapshots [s]: equally spaced, but for one in the middle of the first phase without a foot in contact."""
    recording = result.recording
    times = np.linspace(0.0, recording.times_s[-1], FRAMES)
    feet = [i for i, end in enumerate(recording.plan.robot.end_effectors) if end.kind == "foot"]
    off = np.flatnonzero((recording.contacts_plan[:, feet] < 0).all(axis=1))
    if len(off):
        ended = np.flatnonzero(np.diff(off) > 1)
        middle = 0.5 * (recording.times_s[off[0]] + recording.times_s[off[ended[0]] if len(ended) else off[-1]])
        times[1 + int(np.argmin(np.abs(times[1:-1] - middle)))] = middle
    return [float(t) for t in times]


def drawn(run: Run, fell: bool) -> bool:
    """Whether a run is in Figure 2: our plans as the paper follows them, and without help where that ends in a fall."""
    return run.plan == "ours" and (run.setup == "held" or fell)


#: What is measured of a run.
MEASURED = (
    "duration_s",
    "fell",
    "completed_s",
    "com_rms_m",
    "com_max_m",
    "orientation_rms_deg",
    "swing_rms_m",
    "slip_m",
    "torque_use",
    "torque_joint",
    "velocity_use",
    "velocity_joint",
    "self_contacts",
    "terrain_contacts",
    "off_at_s",
    "off_contacts",
    "off_limited",
)


def measured(result: TrackingResult) -> Row:
    """Measures of a run, and when its CoM left the plan by more than OFF_M: what was in contact, which motors at a limit."""
    from mcplan.tracking.measures import velocity_uses
    from mcplan.tracking.report import nearest_to_torque_limit, nearest_to_velocity_limit

    recording, measures = result.recording, result.measures
    row: Row = {name: getattr(measures, name) for name in MEASURED if hasattr(measures, name)}
    row |= {
        "duration_s": recording.plan.duration(),
        "torque_joint": nearest_to_torque_limit(recording)[0],
        "velocity_joint": nearest_to_velocity_limit(recording)[0],
    }
    off = np.flatnonzero(np.linalg.norm(recording.com_W - recording.com_plan_W, axis=1) > OFF_M)
    row |= dict.fromkeys(("off_at_s", "off_contacts", "off_limited"))
    if len(off):
        n = int(off[0])
        before = slice(max(0, n - round(0.1 / (recording.times_s[1] - recording.times_s[0]))), n + 1)
        uses = np.maximum(np.abs(recording.torques) / recording.torque_limits, velocity_uses(recording))
        strained = np.asarray(uses[before].max(axis=0) > 0.999)
        ends = recording.plan.robot.end_effectors
        touching = [end.name for end, s in zip(ends, recording.contacts_plan[n], strict=True) if s >= 0]
        row["off_at_s"] = float(recording.times_s[n])
        row["off_contacts"] = " ".join(touching) or "none"
        row["off_limited"] = " ".join(name for name, at in zip(recording.joints, strained, strict=True) if at) or "none"
    return {name: row[name] for name in MEASURED}


def ending(row: Row) -> str:
    """How a run ended."""
    if row["fell"] is None:
        return f"plan {row['planned']}"
    if row["fell"]:
        return f"fell at {row['completed_s']:.2f} s of {row['duration_s']:.2f} s"
    return f"to the end, {row['duration_s']:.2f} s"


def table(rows: Sequence[Row]) -> list[str]:
    """The runs."""
    head = ["scene", "plan", "help", "run", "CoM off by, rms", "at most", "base", "feet in the air", "slip"]
    head += ["torque", "", "speed", "", "links meet", "links on terrain"]
    cells = [
        [
            row["scene"],
            PLANS[row["plan"]],
            SETUPS[row["setup"]],
            ending(row),
            *(number(row[name], ".1f", 1e3, " mm") for name in ("com_rms_m", "com_max_m")),
            number(row["orientation_rms_deg"], ".1f", unit=" deg"),
            *(number(row[name], ".1f", 1e3, " mm") for name in ("swing_rms_m", "slip_m")),
            number(row["torque_use"], ".2f"),
            row["torque_joint"] or ABSENT,
            number(row["velocity_use"], ".2f"),
            row["velocity_joint"] or ABSENT,
            *(number(row[name], "d") for name in ("self_contacts", "terrain_contacts")),
        ]
        for row in rows
    ]
    return table_lines(head, cells)


def falls(rows: Sequence[Row]) -> list[str]:
    """Each fall, and what was seen when the CoM left its plan."""
    lines = []
    for row in rows:
        if row["fell"]:
            contacts = ", ".join(name.replace("_", " ") for name in row["off_contacts"].split())
            limited = ", ".join(row["off_limited"].split())
            lines += text_lines(
                f"{row['scene']}, {PLANS[row['plan']]}, help {SETUPS[row['setup']]}: {ending(row)}. The CoM was "
                f"{1e3 * OFF_M:.0f} mm off its plan from {row['off_at_s']:.2f} s on; in contact by the plan then: {contacts}; "
                f"motors at a limit of torque or speed in the 0.1 s before: {limited}.",
                "- ",
            )
    return lines
