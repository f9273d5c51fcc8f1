"""Results of ``mcplan bench contacts`` as tables, for the terminal and for a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .contacts import Row
from .contacts_cases import (
    HAND_PEAK,
    ITERATION_MS,
    MOMENTUM_NMS,
    PRESSURE_M,
    RAIL_COST,
    RAIL_GOOD,
    RATIO,
    REACH_M,
    SLIP_M,
    SWING_STIFFNESS,
    TANGENT,
)
from .sections import ABSENT, Section, between_marks, holds, number, section_lines, text_lines

#: Between these lines of a page the tables are put.
BEGIN, END = "<!-- begin: mcplan bench contacts -->", "<!-- end: mcplan bench contacts -->"


def sections(result: dict[str, Any]) -> list[Section]:
    """Tables of what the result has.

    Args:
        result: `rows` (list of Row), `settings` (`rows`, `summary`) and `speed` (list of rows), or some of them.
    """
    out = []
    if "rows" in result:
        out += [_plans(result["rows"]), _contacts(result["rows"]), _motions(result["rows"])]
    if "settings" in result:
        out.append(_settings(result["settings"]))
    if "speed" in result:
        out.append(_speed(result["speed"]))
    return out


def markdown(result: dict[str, Any], page: str = "") -> str:
    """A page with the tables of a result.

    Args:
        result: As for ``sections``; and `machine`, `jobs`, `command`: what it was measured on and by.
        page: Text that the tables go into, between BEGIN and END if it has them; without them the tables are a page of their own.
    """
    put = between_marks(page, BEGIN, END, _content(result, "###"))
    return put if put is not None else f"# Plans held to what contacts give: results\n\n{_content(result, '##')}\n"


def _content(result: dict[str, Any], heading: str) -> str:
    machine = result["machine"]
    lines = [
        *text_lines(
            f"Written by `{result['command']}`. Rows that do not hold what is demanded say why below their table."
        ),
        "",
        f"{machine['date']}, {machine['cpu']}, {machine['cores']} cores; mcplan {machine['version']}, "
        f"Python {machine['python']}. "
        f"Runs at a time: {result['jobs']}.",
    ]
    for section in sections(result):
        lines += section_lines(section, heading)
    return "\n".join(lines)


def _plans(rows: Sequence[Row]) -> Section:
    head = [
        "plan",
        "robot",
        "ended",
        "in",
        "J",
        "of it durations",
        "flights",
        "hands only",
        "feet in turn",
        "no foot on",
        "holds",
    ]
    cells = [
        [
            row.case,
            row.robot,
            row.status,
            number(row.time_s, ".2f", unit=" s"),
            number(row.cost, ".3g"),
            number(row.cost_duration, ".2g"),
            number(row.flights, "d"),
            number(row.hands_only, "d"),
            {True: "yes", False: "no", None: ABSENT}[row.alternate],
            row.missed or ABSENT,
            holds(row.holds),
        ]
        for row in rows
    ]
    notes = [f"{row.case}: {row.why or row.message}" for row in rows if row.why or row.message]
    return Section("Plans", head, cells, notes)


def _contacts(rows: Sequence[Row]) -> Section:
    head = ["plan", "tangent, foot", "hand", "circle, foot", "hand", "peak, foot", "hand", "hand's mean"]
    head += ["pressure off sole", "off surface", "slip", "reach", "swing stiffness"]
    cells = [
        [
            row.case,
            *(number(value, ".3f") for value in (row.tangent_foot, row.tangent_hand, row.circle_foot, row.circle_hand)),
            *(number(value, ".2f") for value in (row.peak_foot, row.peak_hand)),
            ABSENT if row.hand_mean_low is None else f"{row.hand_mean_low:.3f}-{row.hand_mean_high:.3f}",
            *(number(value, ".2f", 1e3) for value in (row.pressure_off_sole_m, row.pressure_off_surface_m)),
            *(number(value, ".2f", 1e3) for value in (row.slip_m, row.reach_m)),
            number(row.swing_stiffness, ".1g"),
        ]
        for row in rows
        if row.cost is not None
    ]
    notes = [
        f"At most, on the paper's four scenes: tangents {TANGENT:g}, pressure {1e3 * PRESSURE_M:g} mm, slip "
        f"{1e3 * SLIP_M:g} mm, reach {1e3 * REACH_M:g} mm, swing stiffness {SWING_STIFFNESS:g} of g over CoM height, hands "
        f"{HAND_PEAK:g} of the weight at the peak and half the weight each, within 5 %, in the mean of the phase on hands alone.",
        "Tangent: larger of the two tangential components over the normal force; circle: both together. Forces over the "
        "weight; lengths in mm.",
    ]
    return Section("Contacts at 1 kHz, from the forces", head, cells, notes)


def _motions(rows: Sequence[Row]) -> Section:
    head = [
        "plan",
        "angular momentum",
        "roll",
        "pitch",
        "CoM, lowest at knots",
        "between",
        "highest at knots",
        "between",
    ]
    head += ["replay: CoM", "momentum", "base", "from the start"]
    cells = [
        [
            row.case,
            number(row.momentum_Nms, ".2f", unit=" N m s"),
            *(number(value, ".1f", unit=" deg") for value in (row.roll_deg, row.pitch_deg)),
            *(
                number(value, ".3f")
                for value in (row.com_low_knots_m, row.com_low_m, row.com_high_knots_m, row.com_high_m)
            ),
            number(row.com_replay_m, ".1e", unit=" m"),
            number(row.momentum_replay_Nms, ".1e", unit=" N m s"),
            *(number(value, ".2g", unit=" deg") for value in (row.orientation_deg, row.orientation_from_start_deg)),
        ]
        for row in rows
        if row.cost is not None
    ]
    notes = [
        f"At most, on the paper's four scenes: {MOMENTUM_NMS:g} N m s. Replay: largest difference between a knot and the "
        "phase before it, integrated from its forces; base, from the start: integrated over the whole plan."
    ]
    return Section("Body: momentum, base, CoM heights [m], replay", head, cells, notes)


def _settings(found: dict[str, Any]) -> Section:
    summary, rows = found["summary"], found["rows"]
    head = ["setting", "ended", "J", "hands only", "tangent, foot", "hand", "hand's peak", "in", "contacts hold"]
    cells = [
        [
            row.case.partition(", ")[2],
            row.status,
            number(row.cost, ".3g"),
            number(row.hands_only, "d"),
            *(number(value, ".3f") for value in (row.tangent_foot, row.tangent_hand)),
            number(row.peak_hand, ".2f"),
            number(row.time_s, ".2f", unit=" s"),
            holds(row.holds),
        ]
        for row in rows
    ]
    notes = [
        f"{summary['hands_only']} of {summary['runs']} find a plan with a phase on hands alone, at least {RAIL_GOOD} are "
        f"demanded; best J {number(summary['min_cost'], '.3g')}, at most {RAIL_COST:g}; median "
        f"{number(summary['median_cost'], '.3g')}. {summary['hold_contacts']} hold all that the plan of the default setting "
        f"is held to. Holds: {holds(summary['holds'])}."
    ]
    notes += [f"{row.case.partition(', ')[2]}: {row.why}" for row in rows if row.why]
    return Section("gap_with_rail from 16 settings", head, cells, notes)


def _speed(rows: Sequence[dict[str, Any]]) -> Section:
    first = rows[0]
    ours, other = first["ours_model"], first["other_model"]
    head = [
        "scene",
        f"{ours}, sequence free",
        other,
        "ratio",
        f"{ours}, whole plan",
        other,
        "ratio",
        "a plan",
        other,
        "holds",
    ]
    cells = [
        [
            row["scene"],
            *(f"{row[f'{key}_ms']:.3f} ms" for key in ("ours", "other")),
            f"{row['ratio']:.2f}",
            *(f"{row[f'{key}_all_ms']:.3f} ms" for key in ("ours", "other")),
            f"{row['ratio_all']:.2f}",
            *(f"{row[f'{key}_plan_ms']:.0f} ms" for key in ("ours", "other")),
            holds(row["holds"]),
        ]
        for row in rows
    ]
    median = float(np.median([max(row["ratio"], row["ratio_all"]) for row in rows]))
    notes = [
        f"Of the processor, medians. At most {RATIO:g} times and {ITERATION_MS:g} ms are demanded. The larger of the two "
        f"ratios, median of the scenes: {median:.2f}."
    ]
    return Section("Time of an iteration", head, cells, notes)
