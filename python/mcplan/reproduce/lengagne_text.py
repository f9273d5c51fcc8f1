"""What the page of Lengagne et al. says about its tables."""

from __future__ import annotations

from typing import Any

from . import lengagne_paper as paper
from .lengagne_runs import HOPELESS_S, STEEP, Run
from .lengagne_tables import paired, unordered

Parts = dict[str, list[dict[str, Any]]]


def head(about: dict[str, Any], runs: list[Run]) -> list[str]:
    """Title, machine, how to read the numbers."""
    load = sum(kept.load for kept in runs) / max(len(runs), 1)
    busy = ", more than the cores: wall clocks are longer than on an idle machine" if load > about["cores"] else ""
    lines = [
        "# Tables I to IV of Lengagne et al.",
        "",
        f"mcplan {about['version']}, {about['date']}, on {about['cpu']}, {about['cores']} cores, one thread;",
        f"load average during the runs: {load:.1f}{busy}.",
        "Written by `mcplan reproduce lengagne`, which also writes all numbers to `runs.json`, the tables as CSV and the plans of",
        "Table IV; from the former `mcplan reproduce lengagne --resume` draws all again.",
        "",
        "S. Lengagne, P. Mathieu, A. Kheddar, E. Yoshida: *Generation of Dynamic Multi-Contact Motions: 2D case studies*,",
        "Humanoids 2010. The theory, with all that was changed: [sip.md](../theory/sip.md).",
        "",
        "- **The paper's figures are from another machine, of 2010, and from other robots**: it prints no masses, lengths or stances.",
        "  `climber9`, `walker9` and the stances are our own, with its numbers of joints, phases and contacts. N can be compared;",
        "  iterations and times say of what order they are; criteria can be compared between cases alone.",
        "- *time*: wall clock of the whole solve with the check of the result. *processor*: time of the solver's thread; waiting for",
        "  a busy machine does not add to it. Both are medians over the repeats in the CSV.",
        "- *iterations*: of all attempts. Where one way of using second derivatives fails, others are tried",
        "  (docs/theory/sip.md, Solution), and each has the paper's limit of iterations, 200 in Tables I and II, 1000 in III and IV.",
        "- *rows*: of the program without bounds of parameters. The paper has a row for each polynomial, here each of its Bernstein",
        "  coefficients has one.",
        "- *status*: OK, as in the paper: the solver converged within the constraints that it was given. What the motion then does",
        "  between them is *drift*, the largest distance and angle of a contact from its place, at 1 kHz by exact kinematics.",
        "- All start from P = 0, the robot's zero posture, and one second, unless said.",
    ]
    if about["interrupted"]:
        lines += ["", "**Interrupted: rows are missing.**"]
    return lines


def differences_kinematics(parts: Parts) -> list[str]:
    """On Tables I and II."""
    rows = [row for name in ("table_1", "table_2") for row in parts[name]]
    bands = [row for row in rows if row["neq"] != "tube"]
    solved = sum(row["status"] == "OK" for row in bands)
    refused = sum(row["strict_status"] == "REFUSED" for row in bands)
    coarse = [row["drift_mm"] for row in bands if row["neq"] == 0]
    fine = [row["drift_mm"] for row in bands if row["neq"] not in (0, "tube")]
    tubes = [row["drift_mm"] for row in rows if row["neq"] == "tube"]
    lines = [
        "Order 5, one duration, no clearance; coefficients 0 to N_eq of each contact's error within 1e-3 m and 1e-3 rad. *tube*: its",
        "Bernstein coefficients within 1 mm and 5 mrad, the default of mcplan. *strict*: coefficients zero.",
        "",
        f"- {solved} of {len(bands)} rows with the band converge, where in the paper those with the free-flyer as parameters mostly do",
        "  not. Its equation (7), which no spline meets, is met to a millimetre by the finite number of intervals there are;",
        "  what the paper blames on the free-flyer is the strictness of its equalities. With a tolerance, parameters for the",
        "  free-flyer cost some iterations and a third more variables.",
        f"- Strict equalities: Ipopt refuses {refused} of {len(bands)} rows at once, because they have more equalities than free variables.",
        "  The paper's cartwheel with N_eq = 1 has 96 equalities for 82 parameters when all contacts are counted, so it must have had",
        "  a tolerance. Here one contact of a phase is left out where the free-flyer is computed, its error being that of the others,",
        "  which is why some of these rows exist at all. Those that converge stand still in double support.",
    ]
    if coarse:
        lines += [
            f"- N_eq = 0 holds contacts in the middles of intervals alone; in between they drift by up to {max(coarse):.0f} mm."
        ]
    if fine and tubes:
        lines += [
            f"  With N_eq of 1 to 3 up to {max(fine):.1f} mm, in the tube {max(tubes):.1f} mm (at most 1 mm in x and in y).",
        ]
    return [
        *lines,
        "- The paper prints 108 parameters for the cartwheel in Table I: 12 x 9, without the duration that its other rows count.",
    ]


def differences_grid(parts: Parts) -> list[str]:
    """On the statement that time grids do not converge."""
    rows = parts["grid"]
    grid = [row for row in rows if row["continuous"] == "grid"]
    soft = [row for row in grid if row["contacts"] != "equal"]
    hard = [row for row in grid if row["contacts"] == "equal"]
    extrema = [row for row in rows if row["continuous"] == "extremum"]
    tube = [row for row in grid if row["contacts"] == "tube"]
    beyond = max((max(row["position_beyond"], row["velocity_beyond"]) for row in grid), default=0.0)
    return [
        'The paper: "We run all the planning processes presented in Tables I and II using a time-grid discretization method (10',
        'points per intervals). None of them converged." Here `continuous="grid"`, `grid_points=10`, with contacts held by the',
        "coefficients of Tables I and II, by a tube at the points of the grid, and all but equal there (1e-6 m, 1e-6 rad).",
        "*beyond*: position (share of the range) and velocity (share of the limit) past their limits at 1 kHz.",
        "",
        f"- With a tolerance {converged(soft)} of {len(soft)} rows converge. So it is not the grid that fails.",
        f"- With equalities at the points {converged(hard)} of {len(hard)} converge"
        + (": ten points of three errors for each contact are more conditions" if hard else ""),
        "  than an interval has parameters. This is how the paper's statement can be understood, and it is true of any dense grid.",
        f"- Between the points of the grid limits are exceeded by up to {percent_text(beyond)}, and contacts in the tube drift up to",
        f"  {max((row['drift_mm'] for row in tube), default=0.0):.2f} mm and {max((row['drift_mrad'] for row in tube), default=0.0):.2f} "
        "mrad: ten points an interval are dense for cubic joints. What is missing is the",
        "  guarantee, and rows: the hull has 3 to 8 for each polynomial, the grid 10.",
        f"- Extrema: {converged(extrema)} of {len(extrema)} converge, in {median_ratio(rows, parts)} times the iterations of the hull",
        "  (median): the place of an extremum jumps, and its row's gradient with it.",
    ]


def converged(rows: list[dict[str, Any]]) -> int:
    """Rows with status OK."""
    return sum(row["status"] == "OK" for row in rows)


def percent_text(share: float) -> str:
    return f"{100 * share:.2g} %"


def median_ratio(rows: list[dict[str, Any]], parts: Parts) -> str:
    """Iterations with extrema over those with the hull, for the same table, motion and contacts."""
    hull = {}
    for table in (1, 2):
        for row in parts[f"table_{table}"]:
            hull[table, row["motion"], "" if row["neq"] == "tube" else row["neq"]] = row["iterations"]
    ratios = sorted(
        row["iterations"] / hull[row["table"], row["motion"], row["neq"]]
        for row in rows
        if row["continuous"] == "extremum" and (row["table"], row["motion"], row["neq"]) in hull
    )
    return f"{ratios[len(ratios) // 2]:.1f}" if ratios else "-"


def differences_3(parts: Parts) -> list[str]:
    """On Table III."""
    rows = parts["table_3"]
    case_3 = [row for row in rows if row["forces"] in paper.CASES.values()]
    bands = [row for row in case_3 if row["contacts"] == "band"]
    tubes = [row for row in case_3 if row["contacts"] == "tube"]
    depth = max((row["depth_mm"] for row in case_3), default=0.0)
    lines = [
        "Order 8, one duration of at least 1 s, forces in their cones; no torque limits, no clearance. *band*: coefficients 0 to 2",
        "within 1e-3, the paper's N_eq = 2 (its numbers of rows tell so). *tube*: 1 mm, 5 mrad.",
        "",
        f"- Converged: {converged(bands)} of {len(bands)} with the band, {converged(tubes)} of {len(tubes)} with the tube.",
        f"- Without clearance, swinging feet go up to {depth:.0f} mm into the ground, as they may in the paper.",
    ]
    if any(row["motion"] == "climbing" for row in rows):
        lines += [
            "- The paper's climbing fails in case 1, which it puts down to the lack of internal forces. On our slope of 30 degrees",
            "  case 1 has solutions: feasibility of case 1 is a matter of slope, friction and stances, not of the number of contacts.",
        ]
    steep = [row for row in tubes if row["motion"] == STEEP and row["forces"] == "uniform"]
    if steep:
        row = steep[0]
        word = "converges" if row["status"] == "OK" else "does not converge"
        lines += [
            f"  On 60 degrees (`{STEEP}`), which the paper lacks, case 1 {word} here within {HOPELESS_S:.0f} s,",
            "  while cases 2 and 3 are solved. That is the solver giving up: a motion of case 1 exists there too, at the limit of the",
            "  torques and with about twice the cost, so this is no proof that internal forces are needed.",
        ]
    parameters = [pair for pair in paired(rows) if pair[0]["forces"] == "parameters"]
    for band, tube in parameters:
        lines += [
            "- Forces as parameters (section III-C; N = 338 as in the paper, which does not converge in 1000 iterations):",
            f"  {band['status']} with the band, {band['iterations']} iterations; {tube['status']} with the tube, "
            f"{tube['iterations']}. Balance is asked of coefficients 0 to 2 (the",
            f"  paper's 90 rows); in between {band['balance_N']:.0f} N and {tube['balance_N']:.0f} N are carried by nothing, so that these "
            "are no motions, and the",
            "  checker says so. Forces from the joints balance to 1e-12 N.",
        ]
    return lines


def differences_4(parts: Parts) -> list[str]:
    """On Table IV."""
    rows = parts["table_4"]
    kept = [row for row in rows if row["kept"]]
    proved = sum(row["certified"] is True for row in kept)
    solved = sum(row["checker"] == "solved" for row in kept)
    again = [row for row in rows if row["start"] != "P = 0"]
    bad = unordered(rows)
    lines = [
        "Integral of the squared torques; a duration for each phase, 0.2 to 5 s; limits of positions, velocities, torques and",
        "cones; tube of 1 mm and 5 mrad; clearance. Converged means Ipopt's optimality error below 1e-4 with the cost scaled to 100",
        "at its start, by second-order steps with exact second derivatives. A motion without cost is searched first (in the iterations).",
        "",
        f"- {solved} of {len(kept)} solved to the checker's tolerances, {proved} of {len(kept)} certified: every inequality proved",
        "  over the whole motion, not only at samples (docs/theory/sip_certificate.md).",
        "- Criteria fall from case 1 to 3, as in the paper, since each case contains the one before"
        + (f"; not so: {', '.join(bad)}." if bad else ". All are local minima."),
    ]
    if again:
        lines += [
            "- Where a richer case ended in a worse minimum from P = 0 than the poorer one, it was started once more from that one's",
            "  solution: " + ", ".join(f"{row['motion']} case {row['case']}" for row in again) + ".",
        ]
    lines += [
        "- Case 3 gains more over case 1 here than in the paper: the paper's beta may not have the range of ours (exp of -5 to 5),",
        "  and internal forces unload bent knees, which depends on robot and stance.",
        "- Phases with two contacts go to their shortest duration (0.2 s) in the walk and the cartwheel.",
        "- Climbing, case 1, is not in the paper.",
    ]
    return lines
