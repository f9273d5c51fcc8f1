"""Results of ``mcplan bench tracking`` as tables, for the terminal and for the docs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .sections import ABSENT, Section, between_marks, section_lines, text_lines
from .sections import holds as _holds
from .sections import number as _number
from .tracking import TRACKED, Row
from .tracking_cases import CONTROL_MS, REALTIME_FACTOR

#: Between these lines of a page the tables are put.
BEGIN, END = "<!-- begin: mcplan bench tracking -->", "<!-- end: mcplan bench tracking -->"


def sections(result: dict[str, Any]) -> list[Section]:
    """Tables of what the result has.

    Args:
        result: `rows` (list of Row), `robustness` (`summary`, `outcomes`) and `speed`, or some of them.
    """
    out = []
    rows = result.get("rows", [])
    humanoids = [row for row in rows if row.planner != "sip"]
    planar = [row for row in rows if row.planner == "sip"]
    if humanoids:
        out += [_errors(humanoids), _effort(humanoids), _limits(humanoids)]
    if planar:
        out.append(_planar(planar))
    if "robustness" in result:
        out.append(_robustness(result["robustness"]))
    if "speed" in result:
        out.append(_speed(result["speed"]))
    return out


def markdown(result: dict[str, Any], page: str = "") -> str:
    """A page with the tables of a result.

    Args:
        result: As for ``sections``; and `machine`, `packages`, `jobs`, `command`: what it was measured on, with and by.
        page: Text that the tables go into, between BEGIN and END if it has them; without them the tables are a page of their own.
    """
    put = between_marks(page, BEGIN, END, _content(result, "###"))
    if put is not None:
        return put
    return f"# Plans tracked in simulation: results\n\n{_content(result, '##')}"


def _content(result: dict[str, Any], heading: str) -> str:
    machine, packages = result["machine"], result["packages"]
    with_what = ", ".join(f"{name} {version}" for name, version in packages.items())
    lines = [
        *text_lines(
            f"Written by `{result['command']}`. Rows that do not hold what is demanded say why below their table."
        ),
        "",
        f"{machine['date']}, {machine['cpu']}, {machine['cores']} cores; mcplan {machine['version']}, "
        f"Python {machine['python']},",
        f"{with_what}. Runs at a time: {result['jobs']}.",
    ]
    for section in sections(result):
        lines += section_lines(section, heading)
    return "\n".join(lines) + "\n"


def _errors(rows: Sequence[Row]) -> Section:
    head = ["plan", "robot", "scale", "planned", "steps", "run", "CoM rms", "max", "base", "swing", "slip", "holds"]
    cells = [
        [
            row.case,
            row.robot,
            f"{row.scale:g}",
            row.planned,
            _number(row.steps, "d") if row.planned in TRACKED else ABSENT,
            _run(row),
            *(_number(value, ".1f", 1e3) for value in (row.com_rms_m, row.com_max_m, row.final_base_error_m)),
            *(_number(value, ".1f", 1e3) for value in (row.swing_rms_m, row.slip_m)),
            _holds(row.holds),
        ]
        for row in rows
    ]
    notes = [f"{row.case}: {row.why or row.message}" for row in rows if row.why or row.message]
    return Section("Humanoids: errors in mm", head, cells, notes)


def _effort(rows: Sequence[Row]) -> Section:
    head = [
        "plan",
        "torque, legs",
        "",
        "at limit",
        "all",
        "",
        "assist",
        "",
        "failures",
        "warnings",
        "x real time",
        "control step",
    ]
    cells = [
        [
            row.case,
            *(_number(row.leg_torque_use, ".2f"), row.leg_torque_joint, _number(row.leg_limit_ratio, ".1f", 1e2, " %")),
            *(_number(row.torque_use, ".2f"), row.torque_joint),
            *(_number(row.assist_force_rms_N, ".0f", unit=" N"), _number(row.assist_moment_rms_Nm, ".1f", unit=" N m")),
            *(_number(row.qp_failures, "d"), _number(row.simulator_warnings, "d")),
            *(_number(row.realtime_factor, ".2f"), _number(row.control_ms, ".2f", unit=" ms")),
        ]
        for row in rows
        if row.fell is not None
    ]
    return Section("Humanoids: torques over their limits, assistance, solver and time", head, cells)


def _limits(rows: Sequence[Row]) -> Section:
    head = ["plan", "speed", "", "torque in 2 ms", "links meet", "", "depth", "links on terrain", ""]
    cells = [
        [
            row.case,
            *(_number(row.velocity_use, ".2f"), row.velocity_joint),
            _number(row.torque_step_use, ".2f"),
            *(_number(row.self_contacts, "d"), _number(row.self_contact_N, ".0f", unit=" N")),
            _number(row.self_contact_m, ".1f", 1e3, " mm"),
            *(_number(row.terrain_contacts, "d"), _number(row.terrain_contact_N, ".0f", unit=" N")),
        ]
        for row in rows
        if row.fell is not None
    ]
    note = (
        "largest speed over its limit, and the joint; largest change of a torque within 2 ms over its limit; contacts of "
        "links with each other, and of links other than end-effectors with the terrain, and the largest force of each"
    )
    return Section("Humanoids: speeds over their limits, and what links hit", head, cells, [note])


def _planar(rows: Sequence[Row]) -> Section:
    head = [
        "plan",
        "robot",
        "planned",
        "in",
        "run",
        "forces' error",
        "drift",
        "torque",
        "speed",
        "warnings",
        "x real time",
        "holds",
    ]
    cells = [
        [
            row.case,
            row.robot,
            row.planned,
            _number(row.planning_s, ".1f", unit=" s"),
            _run(row),
            _number(row.force_rms, ".1f", 1e2, " %"),
            _number(row.drift_m, ".1f", 1e3, " mm"),
            _number(row.torque_use, ".2f"),
            _number(row.velocity_use, ".2f"),
            _number(row.simulator_warnings, "d"),
            _number(row.realtime_factor, ".2f"),
            _holds(row.holds),
        ]
        for row in rows
    ]
    notes = [f"{row.case}: {row.why or row.message}" for row in rows if row.why or row.message]
    return Section("Planar robots", head, cells, notes)


def _robustness(found: dict[str, Any]) -> Section:
    from .tracking_robustness import line

    head = ["plan", "stay up", "fell with seeds", "largest CoM rms", "QP failures", "warnings", "holds"]
    cells = [
        [
            row["case"],
            f"{row['survived']} of {row['runs']}",
            ", ".join(str(seed) for seed in row["fell"]) or ABSENT,
            _number(row["largest_com_rms_m"], ".1f", 1e3, " mm"),
            str(row["qp_failures"]),
            str(row["simulator_warnings"]),
            _holds(row["holds"]),
        ]
        for row in found["summary"]
    ]
    return Section("Disturbed", head, cells, [line(outcome) for outcome in found["outcomes"] if outcome.fell])


def _speed(row: dict[str, Any]) -> Section:
    head = ["plan", "control step", "99th percentile", "QP", "model", "rest", "MuJoCo", "x real time", "holds"]
    parts = [f"{row[f'{part}_ms']:.2f} ms, {100 * row[f'{part}_ratio']:.0f} %" for part in ("qp", "model", "rest")]
    cells = [
        row["case"],
        f"{row['control_ms']:.2f} ms",
        f"{row['p99_ms']:.2f} ms",
        *parts,
        f"{row['simulation_ms']:.2f} ms",
        f"{row['realtime_factor']:.2f}",
        _holds(row["holds"]),
    ]
    note = (
        f"medians of {row['repeats']} runs; at most {CONTROL_MS:g} ms and at least {REALTIME_FACTOR:g} times "
        "real time are demanded; MuJoCo: its steps within one control step"
    )
    return Section("Speed on one core", head, [cells], [note])


def _run(row: Row) -> str:
    if row.fell is None:
        return ABSENT
    word = ("left the plan" if row.planner == "sip" else "fell") if row.fell else "up"
    return f"{word}, {row.completed_s:.1f} s"
