"""Table I of Wang et al.: variables and constraints of an instant, by formula, and the check of the formula against the
programs that are built.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .wang_runs import Config, planner

INTERVALS = 7
DOUBLE, SINGLE = 2 * INTERVALS, INTERVALS  #: intervals of a step on two feet and on one

#: Table I: decision variables, non-convex and convex constraints of a knot.
PUBLISHED = {"single": (36, 12, 0), "com": (18, 0, 6), "rectangle": (78, 0, 48), "point": (12, 0, 12)}


@dataclass(frozen=True)
class Knot:
    """Counts of the model alone at one instant: dynamics and relaxation, without friction, reach and bounds."""

    variables: int
    nonconvex: int
    convex: int
    psi: int = 0  #: of the variables, those that only lifted_psi has


def knot(method: str, feet: int = 2, lifted_psi: bool = False) -> Knot:
    """Counts of one instant of a predicted step, for `single` of every step.

    Args:
        method: The fidelity.
        feet: In contact, 1 or 2. The paper counts two, also where one swings.
        lifted_psi: Count the bounds psi as variables.
    """
    points = feet * (1 if method == "point" else 4)
    states, forces, acceleration = 6, 3 * points, 3
    if method == "single":
        # Steps of c, v and L are bilinear in the duration, the rate of L in levers and forces.
        return Knot(states + 3 + forces + acceleration + 3, 9 + 3, 3)
    bounds = 0 if method == "com" else 6 * points
    psi = bounds if lifted_psi else 0
    # Durations are fixed: the steps of c and v are linear, as is the sum of the forces.
    return Knot(states + forces + acceleration + psi, 0, 6 + 3 + bounds, psi)


def variables_per_step(method: str, lifted_psi: bool = False) -> int:
    """Variables that one more predicted step adds: its instants, three durations, a foothold."""
    double, single = knot(method, 2, lifted_psi), knot(method, 1, lifted_psi)
    return DOUBLE * double.variables + SINGLE * single.variables + 3 + 2


def model_rows_per_step(method: str) -> int:
    """Rows of the model that one more predicted step adds."""
    double, single = knot(method, 2), knot(method, 1)
    return DOUBLE * (double.nonconvex + double.convex) + SINGLE * (single.nonconvex + single.convex)


def built(terrain: str = "rubbles") -> list[dict[str, Any]]:
    """Sizes of the programs of the first cycle with one and two predicted steps, beside what the formulas say.

    Rows that all methods have (friction of corners, reach, footholds) cancel in the difference to `com`. The last
    columns are empty where they do not: a point foot has friction at one point instead of four.
    """
    sizes: dict[tuple[str, bool], list[tuple[int, int]]] = {}
    for method in PUBLISHED:
        for lifted in (False, True) if method in ("rectangle", "point") else (False,):
            sizes[method, lifted] = []
            for predicted in (1, 2):
                # One iteration: the program is built whether or not it is solved. Forces of three components and all
                # rows, as in the paper.
                options = {"friction_rows": True, "all_faces": True, "lifted_psi": lifted, "max_iterations": 1}
                cycle = planner(Config(terrain, method, predicted), **options).step()
                sizes[method, lifted].append((cycle.variables, cycle.constraints))
    out = []
    com_rows = sizes["com", False][1][1] - sizes["com", False][0][1]
    for (method, lifted), ((variables, rows), (variables_2, rows_2)) in sizes.items():
        cancels = method != "point"
        out.append(
            {
                "method": method,
                "lifted_psi": lifted,
                "variables_1_step": variables,
                "variables_2_step": variables_2,
                "variables_added": variables_2 - variables,
                "variables_by_formula": variables_per_step(method, lifted),
                "rows_1_step": rows,
                "rows_2_step": rows_2,
                "rows_more_than_com": rows_2 - rows - com_rows if cancels else "",
                "rows_by_formula": model_rows_per_step(method) - model_rows_per_step("com") if cancels else "",
            }
        )
    return out


def table(sizes: list[dict[str, Any]]) -> list[str]:
    """Table I as Markdown, with why it differs."""
    titles = {
        "single": "Centroidal dynamics (`single`)",
        "com": "CoM only (`com`)",
        "rectangle": "Rectangular foot (`rectangle`)",
        "point": "Point foot (`point`)",
    }
    lines = [
        "| model of an instant | variables, paper | ours | with psi as variables | on one foot | non-convex rows, paper | ours "
        "| convex rows, paper | ours |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for method, (variables, nonconvex, convex) in PUBLISHED.items():
        here, lifted = knot(method), knot(method, lifted_psi=True)
        lines.append(
            f"| {titles[method]} | {variables} | {here.variables} | {lifted.variables} | {knot(method, 1).variables} "
            f"| {nonconvex} | {here.nonconvex} | {convex} | {here.convex} |"
        )
    lines += [
        "",
        "Ours: two feet in contact, the model alone (dynamics and relaxation), without friction, force limits and reach, which",
        "are linear. Where the counts differ:",
        "",
        "- The acceleration is a variable here (3 variables, 3 linear rows in every model), so that its square is a cost of",
        "  three variables instead of 24 forces: 39 = 36 + 3.",
        "- The 12 non-convex rows are the same in both: the Euler steps of c, v and L, bilinear in the duration, and the",
        "  definition of the rate of L.",
        r"- $\psi$ is eliminated: 48 and 12 variables less, with the same number of rows,",
        r"  $\lvert \alpha \pm \delta \rvert^2 \le \psi_{max}$ instead of $\lvert \alpha \pm \delta \rvert^2 \le \psi$. The",
        "  optimum is the same (docs/theory/rhp.md).",
        "- The levers p - c are no variables in either; here footholds are two coordinates of their surface.",
        "- Counted with forces of three components and friction as rows, as in the paper. What runs by default has factors",
        "  of the friction pyramid's 4 edges instead (8 without `paper`): one variable a point more, 4 rows less.",
        "- On one foot the forces of the other do not exist here; the paper gives one count for every knot.",
        "- The paper does not say what its rows count, and its sums differ in kind: 78 = 6 + 24 + 48 would be c, v, the forces",
        "  of 8 corners and psi, whereas 12 = 6 + 6 has no room for the 12 psi of two point feet, and 18 = 6 + 12 none for",
        "  more than the forces of one foot. Its convex rows would be the 6 steps of c and v for `com`, but the bounds on psi",
        "  alone, 48 and 12, for the others; ours are 6 steps, 3 accelerations and 48 or 12 bounds.",
        "",
        "Checked against the programs of the first cycle on rubbles: what a second predicted step adds, and how many rows",
        "more than `com`'s it adds (friction of corners, reach and footholds cancel; empty where they do not).",
        "",
        "| method | psi | variables, 1-step PH | 2-step PH | added | by formula | rows, 1-step PH | 2-step PH | more than com's "
        "| by formula |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in sizes:
        relaxed = row["method"] in ("rectangle", "point")
        psi = ("variables" if row["lifted_psi"] else "eliminated") if relaxed else ""
        keys = [key for key in row if key not in ("method", "lifted_psi")]
        lines.append(f"| {row['method']} | {psi} | {' | '.join(str(row[key]) for key in keys)} |")
    return lines
