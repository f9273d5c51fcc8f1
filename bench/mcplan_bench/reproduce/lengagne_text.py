"""What the page of Lengagne et al. says about its tables."""

from __future__ import annotations

import textwrap
from typing import Any

from . import lengagne_paper as paper
from .lengagne_runs import Run
from .lengagne_settings import EQUAL_S, HOPELESS_S, ITERATIONS, STEEP, TIME_LIMIT_S
from .lengagne_tables import paired, percent, unordered

Row = dict[str, Any]
Parts = dict[str, list[Row]]


def paragraph(text: str) -> list[str]:
    """Lines of the page."""
    return textwrap.wrap(text, 125, break_long_words=False, break_on_hyphens=False)


def bullet(text: str) -> list[str]:
    """An entry of a list."""
    return textwrap.wrap(f"- {text}", 125, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)


def head(about: Row, runs: list[Run]) -> list[str]:
    """Title, machine, how to read the numbers."""
    load = sum(kept.load for kept in runs) / max(len(runs), 1)
    busy = ", more than the cores: wall clocks are longer than on an idle machine" if load > about["cores"] else ""
    lines = ["# Tables I to IV of Lengagne et al.", ""]
    lines += paragraph(
        f"mcplan {about['version']}, {about['date']}, on {about['cpu']}, {about['cores']} cores, one thread; load average "
        f"during the runs: {load:.1f}{busy}. Written by `mcplan reproduce lengagne`, which also writes all numbers to "
        "`runs.json`, the tables as CSV and the plans of Table IV; from the former `mcplan reproduce lengagne --resume` draws "
        "all again."
    )
    lines.append("")
    lines += paragraph(
        "S. Lengagne, P. Mathieu, A. Kheddar, E. Yoshida: *Generation of Dynamic Multi-Contact Motions: 2D case studies*, "
        "Humanoids 2010. The theory and what was changed in it: docs/theory/sip.md."
    )
    lines.append("")
    for text in (
        "**The paper's figures are from a machine of 2010 and from other robots**: it prints no masses, lengths or stances. "
        "`climber9`, `walker9` and the stances here are our own, with its numbers of joints, phases and contacts. N can be "
        "compared; iterations and times say of what order they are; criteria can be compared between cases alone.",
        "*time*: wall clock of the whole solve, with the check of the result. *processor*: time of the solver's thread; "
        "waiting for a busy machine does not add to it. Medians over three runs where one takes less than a second.",
        "*iterations*: of all attempts. Where one way of using second derivatives fails, others are tried (sip.md, "
        "Solution), each within the paper's limit of "
        f"{ITERATIONS[1]} iterations in Tables I and II and {ITERATIONS[3]} in Table III. For Table IV it says none and has "
        f"{max(row.iterations for row in paper.TABLE_4.values())} iterations in one row; here each attempt has "
        f"{ITERATIONS[4]}. With dynamics the search begins with kinematics alone, and with a cost it goes on from a motion "
        "without. "
        f"A run has at most {TIME_LIMIT_S[1]:.0f} s, {TIME_LIMIT_S[3]:.0f} s in Table III and {TIME_LIMIT_S[4]:.0f} s in Table "
        "IV, unless said.",
        "*rows*: of the program, without bounds of parameters. The paper has one or two for each polynomial; here each of its "
        "Bernstein coefficients has one.",
        "*status*: OK, as in the paper: the solver converged within the constraints that it was given. What contacts do then "
        "is *drift*, their largest distance and angle from their places, at 1 kHz by exact kinematics.",
        "*depth*: how far a swinging foot gets into ground, slope or wall, by the same check. The paper has no clearance, and "
        "rows with its contacts have none here, *(not asked)*; with the tube feet are kept out, as mcplan does by default.",
        "All start from $P=0$, the robot's zero posture, and one second, unless said.",
    ):
        lines += bullet(text)
    if about["interrupted"]:
        lines += ["", "**Interrupted: rows are missing.**"]
    return lines


def converged(rows: list[Row]) -> str:
    """ "3 of 4" with status OK."""
    return f"{sum(row['status'] == 'OK' for row in rows)} of {len(rows)}"


def largest(rows: list[Row], key: str) -> float:
    """Of a column, 0 without rows."""
    return max((float(row[key]) for row in rows), default=0.0)


def kept_out(without: list[Row], with_clearance: list[Row]) -> str:
    """Where swinging feet go with clearance and without."""
    deepest = largest(with_clearance, "depth_mm")
    kept = f"up to {deepest:.2g} mm" if deepest > 0.0 else "not at all"
    return (
        f"Without clearance swinging feet go up to {largest(without, 'depth_mm'):.0f} mm into ground, slope or wall, with it "
        f"{kept}; the checker accepts 1.5 mm. The paper does not say what its motions do there."
    )


def differences_kinematics(parts: Parts) -> list[str]:
    """On Tables I and II."""
    rows = [row for name in ("table_1", "table_2") for row in parts[name]]
    bands = [row for row in rows if row["neq"] != "tube"]
    refused = [row for row in bands if row["strict_status"] == "REFUSED"]
    strict = [row for row in bands if row["strict_status"] == "OK"]
    lines = paragraph(
        "Order 5, one duration; coefficients 0 to $N_{eq}$ of each contact's error within 1e-3 m and 1e-3 rad. "
        "*tube*: its Bernstein coefficients within 1 mm and 5 mrad, and clearance, as mcplan does by default. *strict*: "
        "coefficients zero."
    )
    lines.append("")
    table_1 = [row for row in parts["table_1"] if row["neq"] != "tube"]
    if table_1:
        lines += bullet(
            f"Table I: {converged(table_1)} rows converge with the band. The paper's mostly do not for motions 1 and 2, which it "
            "puts down to the free-flyer as parameters: its equation (7) is met by no spline. It need not be met: to a "
            "millimetre, splines come close enough. What makes the difference is the tolerance of the contacts, which the "
            "paper does not tell: strict ones fail here, too (last columns)."
        )
    lines += bullet(
        f"Strict equalities: Ipopt refuses {len(refused)} of {len(bands)} rows at once, for they have more equalities than free "
        f"variables; {len(strict)} converge. The paper's cartwheel with $N_{{eq}}=1$ has 96 equalities for 82 parameters when "
        "all contacts are counted, and climbing 516 for 298, so that its equalities must have had a tolerance. Here one contact "
        "of a phase is left out where the free-flyer is computed, its error being that of the others; this is why some of these "
        "rows can be solved at all."
    )
    lines += bullet(
        "$N_{eq}=0$ holds contacts in the middles of intervals alone: in between they drift by up to "
        f"{largest([row for row in bands if row['neq'] == 0], 'drift_mm'):.0f} mm. With $N_{{eq}}$ of 1 to 3 by up to "
        f"{largest([row for row in bands if row['neq'] != 0], 'drift_mm'):.1f} mm; in the tube by "
        f"{largest([row for row in rows if row['neq'] == 'tube'], 'drift_mm'):.1f} mm (1 mm in x and 1 mm in y). The checker "
        "accepts 1.5 mm: its verdict on each row is in the CSV."
    )
    lines += bullet(kept_out(bands, [row for row in rows if row["neq"] == "tube"]))
    return lines + bullet(
        "The paper prints 108 parameters for the cartwheel in Table I: $12 \\cdot 9$, without the duration that its other rows "
        "count."
    )


def differences_grid(parts: Parts) -> list[str]:
    """On the statement that time grids do not converge."""
    rows = parts["grid"]
    grid = [row for row in rows if row["continuous"] == "grid"]
    soft = [row for row in grid if row["contacts"] != "equal"]
    hard = [row for row in grid if row["contacts"] == "equal"]
    tube = [row for row in grid if row["contacts"] == "tube"]
    extrema = [row for row in rows if row["continuous"] == "extremum"]
    lines = paragraph(
        'The paper: "We run all the planning processes presented in Tables I and II using a time-grid discretization method '
        '(10 points per intervals). None of them converged." Here `continuous="grid"`, `grid_points=10`, with contacts held by '
        "the coefficients of Tables I and II, by a tube at the points of the grid, and within 0.01 mm and 0.01 mrad there, "
        f"which stands for equalities (each at most {EQUAL_S:.0f} s). *beyond*: positions (ratio to the range) and velocities "
        "(ratio to the limit) beyond their limits between the points, at 1 kHz; - where less than 1e-4."
    )
    lines.append("")
    lines += bullet(f"With a tolerance of the contacts {converged(soft)} rows converge. It is not the grid that fails.")
    lines += bullet(
        f"Within 0.01 mm at the points {converged(hard)} still converge. Equalities cannot: they would be 3 x 10 for each "
        "contact of an interval, 480 for the cartwheel's 82 parameters, 2580 and 1560 for the 298 of climbing and walking, and "
        "Ipopt refuses that. If the paper had equalities on its grid, its statement is one about them and not about grids."
    )
    lines += bullet(
        "Between the points of the grid limits are exceeded by up to "
        f"{percent(max(largest(grid, 'position_beyond'), largest(grid, 'velocity_beyond')))}, and contacts held within 1 mm and "
        f"5 mrad at the points drift up to {largest(tube, 'drift_mm'):.2f} mm and {largest(tube, 'drift_mrad'):.2f} mrad: ten "
        "points are dense for an interval of a cubic. What a grid lacks is the guarantee; and it has 10 rows for each "
        "polynomial, the hull 3 to 8 at order 5."
    )
    ratio = extremum_iterations(extrema, parts)
    return lines + bullet(
        f"Extrema: {converged(extrema)} converge"
        + (f", with {ratio:.1f} times the iterations of the hull in the median." if ratio else ".")
        + " The place of an extremum jumps, and with it the gradient of its row. They need the fewest rows."
    )


def extremum_iterations(rows: list[Row], parts: Parts) -> float | None:
    """Iterations with extrema over those with the hull, for the same table, motion and contacts: the median."""
    hull = {}
    for table in (1, 2):
        for row in parts[f"table_{table}"]:
            hull[table, row["motion"], "" if row["neq"] == "tube" else row["neq"]] = row["iterations"]
    keys = [(row["table"], row["motion"], row["neq"]) for row in rows]
    ratios = sorted(row["iterations"] / hull[key] for key, row in zip(keys, rows, strict=True) if key in hull)
    return ratios[len(ratios) // 2] if ratios else None


def differences_3(parts: Parts) -> list[str]:
    """On Table III."""
    rows = [row for row in parts["table_3"] if row["forces"] in paper.CASES.values()]
    bands = [row for row in rows if row["contacts"] == "band"]
    tubes = [row for row in rows if row["contacts"] == "tube"]
    lines = paragraph(
        "Order 8, one duration of at least 1 s, forces in their cones; no torque limits. *band*: coefficients 0 to 2 within "
        "1e-3 m and 1e-3 rad; that the paper's $N_{eq}$ is 2 follows from its numbers of rows. *tube*: 1 mm, 5 mrad, and "
        "clearance."
    )
    lines.append("")
    lines += bullet(f"{converged(bands)} converge with the band, {converged(tubes)} with the tube.")
    lines += bullet(kept_out(bands, [row for row in tubes if row["status"] == "OK"]))
    if any(row["motion"] == "climbing" for row in rows):
        lines += bullet(
            "The paper's climbing fails in case 1, which it calls predictable, for lack of internal forces. On our slope of 30 "
            "degrees case 1 has solutions: whether it has is a matter of slope, friction and stances."
        )
    for row in tubes:
        if row["motion"] == STEEP and row["forces"] == "uniform":
            ends = "converges" if row["status"] == "OK" else f"does not converge within {HOPELESS_S:.0f} s"
            lines += bullet(
                f"On a slope of 60 degrees (`{STEEP}`, not in the paper) case 1 {ends}. "
                "This proves nothing: a motion of case 1 exists there, at the limits of the torques and at about twice the cost."
            )
    for band, tube in paired(parts["table_3"]):
        if band["forces"] == "parameters":
            lines += bullet(
                "Forces as parameters (section III-C), $N=338$ as in the paper, which does not converge in 1000 iterations. "
                f"Here: {band['status']} with the band after {band['iterations']} iterations, {tube['status']} with the tube "
                f"after {tube['iterations']}. But balance is asked of coefficients 0 to 2 of each interval (the paper's 90 "
                f"rows), and in between nothing carries up to {band['balance_N']:.0f} N and {tube['balance_N']:.0f} N: these are "
                "no motions, and the checker says so. Forces that follow from the joints balance to 1e-12 N."
            )
    return lines


def fall(rows: list[Row], key: str, case: int) -> str:
    """By how much a criterion falls from a case to the next: "7 to 33 %" over the motions, or ""."""
    ratios = []
    for motion in paper.MOTIONS:
        costs = {row["case"]: row[key] for row in rows if row["motion"] == motion and row["kept"] and row[key] != ""}
        if case in costs and case + 1 in costs:
            ratios.append(100.0 * (1.0 - costs[case + 1] / costs[case]))
    return f"{min(ratios):.0f} to {max(ratios):.0f} %" if ratios else ""


def differences_4(parts: Parts) -> list[str]:
    """On Table IV."""
    rows = parts["table_4"]
    kept = [row for row in rows if row["kept"]]
    again = [f"{row['motion']} in case {row['case']}" for row in rows if row["start"] != "P = 0"]
    solved = sum(row["checker"] == "solved" for row in kept)
    proved = sum(row["certified"] is True for row in kept)
    bad = unordered(rows)
    ratio = largest([{"ratio": row["evaluation_s"] / row["time_s"]} for row in rows], "ratio")
    lines = paragraph(
        "Least integral of the squared torques; a duration of 0.2 to 5 s for each phase; limits of positions, velocities and "
        "torques, forces in their cones, tube of 1 mm and 5 mrad, clearance from every surface. OK: Ipopt's optimality error is "
        "below 1e-4 with the cost scaled to 100 at its start."
    )
    lines.append("")
    lines += bullet(
        f"{solved} of {len(kept)} are solved to the checker's tolerances, {proved} of {len(kept)} certified: every inequality is "
        "proved for every instant (docs/theory/sip_certificate.md), also that swinging feet are at most 1.5 mm inside ground, "
        f"slope and wall; samples find {largest(kept, 'depth_mm'):.2g} mm."
    )
    if bad:
        lines += bullet(f"**Criteria do not fall from case to case: {', '.join(bad)}.**")
    else:
        lines += bullet(
            "Criteria fall from case 1 to case 3 as in the paper; each case contains the one before. All are local minima: other "
            "starts end elsewhere."
        )
    if again:
        lines += bullet(
            "From P = 0 a richer case ended in a worse minimum than the poorer one, and was started once more from that one's "
            f"solution: {', '.join(again)}."
        )
    falls = [
        f"{case} to {case + 1} by {here} here and {there} there"
        for case in (1, 2)
        if (here := fall(rows, "cost", case)) and (there := fall(rows, "paper_criterion", case))
    ]
    if falls:
        lines += bullet(
            f"Criteria fall from case {' and from '.join(falls)}. What bounds the paper's beta has is not said; ours are "
            "exp(-5) to exp(5). Nor does it give the unit of its criterion."
        )
    lines += bullet(
        f"Functions and derivatives take at most {percent(ratio)} of the time, Ipopt's linear algebra most. The Hessian of cost "
        "and constraints is exact; the paper does not say what it gives Ipopt."
    )
    return lines + bullet("Climbing in case 1 is not in the paper.")


def differences_solvers(parts: Parts) -> list[str]:
    """On Tables III and IV by both solvers."""
    rows = parts["solvers"]
    faster = [row["ipopt_cpu_s"] / row["ipm_cpu_s"] for row in rows if row["ipm_cpu_s"] > 0.0]
    lines = paragraph(
        "The rows with the tube once more, with mcplan's own interior-point kernel (`--solver ipm`, docs/theory/ipm.md) in place "
        "of Ipopt. *status*: what the planner says, with the checker's word in it. Where a richer case was started from a poorer "
        "one, the cheaper run of each solver."
    )
    lines.append("")
    solved = [sum(row[f"{name}_status"] == "solved" for row in rows) for name in ("ipopt", "ipm")]
    lines += bullet(f"Solved: {solved[0]} of {len(rows)} by Ipopt, {solved[1]} of {len(rows)} by the kernel.")
    if faster:
        lines += bullet(f"Ipopt takes {min(faster):.1f} to {max(faster):.1f} times the kernel's processor time.")
    costs = [row["ipm_cost"] / row["ipopt_cost"] - 1.0 for row in rows if row["table"] == 4 and row["ipopt_cost"]]
    if costs:
        lines += bullet(
            f"The kernel's criteria of Table IV lie between {100 * min(costs):+.1f} % and {100 * max(costs):+.1f} % of "
            "Ipopt's: both are local minima."
        )
    return lines
