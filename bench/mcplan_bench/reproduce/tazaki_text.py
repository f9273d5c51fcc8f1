"""The page of Tazaki's paper: what is said around tables and figures, with the numbers of the runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan_bench.sections import ABSENT, table_lines, text_lines

from . import tazaki_robot, tazaki_settings, tazaki_tracking
from .tazaki_figures import SHOWN
from .tazaki_names import PREFIX, TITLES

if TYPE_CHECKING:
    from mcplan.ddp import Result

#: Cost of the published form below which its last iterate is called a motion: ours are below it on every scene.
LOW_COST = 3.0

Row = dict[str, Any]
Results = Mapping[str, Mapping[str, "Result"]]


def head(machine: Row, results: Results, loads: Sequence[float]) -> list[str]:
    """Title, machine and load, and what the two forms are."""
    phases = max(len(result.plan.phases) for by_method in results.values() for result in by_method.values())
    load = float(np.mean(loads))
    busy = ", more than the cores: wall clocks are longer than on an idle machine" if load > machine["cores"] else ""
    return [
        "# Table II and Figures 1 to 4 of Tazaki",
        "",
        *text_lines(
            f"mcplan {machine['version']}, {machine['date']}, on {machine['cpu']}, {machine['cores']} cores; load average "
            f"while Table II was measured: {load:.1f}{busy}. Robot humanoid44, {phases} phases. Written by "
            "`mcplan reproduce tazaki`, which also writes the tables as CSV and the robot of Figure 2 as URDF and TOML."
        ),
        "",
        *text_lines(
            "Y. Tazaki: *Fast Multi-Contact Motion Planning Based on Best-Neighbor Search of Contact Sequences*. The theory and "
            'what was changed in it: docs/theory/ddp.md. *paper\'s form*: `method="paper"`, `stiffness_input="lambda_"`, the '
            "published algorithm with the author's robot and scenes, as far as his program tells them, which the paper does not; "
            "*ours*: the defaults."
        ),
        "",
    ]


def table_2(rows: Sequence[Row], threads: int, crowded: bool) -> list[str]:
    """Table II with what differs, and what threads did; crowded: they had no cores of their own."""
    ratio = float(np.median([row["paper_1_ms"] / row["standard_1_ms"] for row in rows]))
    columns = [
        "scene",
        "published, parallel",
        "not",
        f"paper's form here, {threads} threads",
        "one",
        "loops shared out",
    ]
    columns += [f"ours, {threads} threads", "one", "with the frozen iterations"]
    keys = ("published_parallel_ms", "published_1_ms", "paper_parallel_ms", "paper_1_ms", "paper_parallel_loops")
    cells = [
        [
            row["scene"],
            *(cell(row, key) for key in (*keys, "standard_parallel_ms", "standard_1_ms", "standard_all_ms")),
        ]
        for row in rows
    ]
    return [
        "## Table II: average time of an iteration [ms]",
        "",
        *table_lines(columns, cells),
        "",
        *text_lines(
            "What is counted: linearisation, value functions, pricing of the neighbours and line search, by wall clock, divided "
            "by the number of iterations; median over repeats. The paper averages 100 iterations, its form runs 60 here. Of "
            "ours, the iterations in which the sequence is free; the last column averages over all, also those that polish a "
            "frozen sequence. The first sequence, closing the defects of the dynamics and the checker come once a plan and "
            "are left out. The published times are of a Ryzen 9 5950X with 16 cores."
        ),
        "",
        *text_lines(
            f"On one thread here an iteration of the paper's form takes {ratio:.1f} times as long as one of ours (median of the "
            "scenes). Where it comes from: the published form computes all value functions anew for each switch and starts each "
            "iteration with J* at infinity, so that it makes at least one switch whether or not that pays; a neighbour costs it "
            "a Riccati step and a minimisation. Ours starts from the cost of staying, updates value functions from the switched "
            "step on, prices neighbours by their low rank and leaves out end-effectors that may touch nothing in the scene. "
            "That the paper's form takes less time here than published says nothing of the algorithm: machine, compiler and "
            "program are others, and the paper tells of none of them but the processor."
        ),
        "",
        *threads_text(rows, threads, crowded),
        "",
    ]


def cell(row: Row, key: str) -> str:
    """A time or a number; a dash where threads were asked for and none was started."""
    if key.endswith("_loops"):
        return str(row[key])
    started = not key.endswith("_parallel_ms") or row.get(key.replace("_ms", "_loops"), 1) > 0
    return f"{row[key]:.2f}" if started else "–"


def threads_text(rows: Sequence[Row], threads: int, crowded: bool) -> list[str]:
    """What threads did, of the forms of which any were started."""
    text = 'Threads: the paper runs its loop over neighbours as a "parallel for", and found OpenMP to be slower by 7 to 23.5 %. '
    for method, whose in (("paper", "The published form here"), ("standard", "Ours")):
        entered = [row for row in rows if row.get(f"{method}_parallel_loops", 0) > 0]
        if not entered:
            why = (
                "there is one processor, or no OpenMP"
                if method == "paper"
                else "it shares out loops of 400 neighbours or more, which none of these scenes has"
            )
            text += f"{whose} started no thread: {why}; there is nothing to compare (–). "
            continue
        loops = sum(row[f"{method}_parallel_loops"] for row in entered)
        ratios = [row[f"{method}_parallel_ms"] / row[f"{method}_1_ms"] for row in entered]
        text += (
            f"{whose} shared out {loops} loops over neighbours among {threads} threads at most, in a run of each scene: an "
            f"iteration takes {np.median(ratios):.2f} times as long as with one (median of the scenes; {min(ratios):.2f} to "
            f"{max(ratios):.2f}). "
        )
        if crowded:
            text += "Threads waited for cores that other work had: the ratio says little of an idle machine. "
    return text_lines(text + "One thread is the default.")


def solved(rows: Sequence[Row], results: Results) -> list[str]:
    """What either form solves: from its defaults, then from 15 settings."""
    columns = ["scene", "form", "by the checker", "J", "iterations", "switches", "in the last 10 iterations"]
    columns += ["worst constraint", "by its own measures"]
    cells = []
    for name, by_method in results.items():
        for method, result in by_method.items():
            report = result.report
            own = f"J {report.paper_cost:.3g}, {report.paper_verdict}" if report.paper_verdict else ABSENT
            late = sum(row.switches for row in report.history[-10:])
            numbers = [f"{report.cost:.3g}", str(report.iterations), str(report.switches), str(late)]
            cells.append([name, TITLES[method], str(report.status), *numbers, str(report.worst_violation), own])
    settings = max(row["settings"] for row in rows)
    accepted = {form: sum(row["solved"] for row in rows if row["form"] == form) for form in tazaki_settings.FORMS}
    tried = {form: sum(row["settings"] for row in rows if row["form"] == form) for form in tazaki_settings.FORMS}
    counts = "; ".join(f"{form} {accepted[form]} of {tried[form]}" for form in tazaki_settings.FORMS)
    return [
        "## What the paper's form solves, and ours",
        "",
        *table_lines(columns, cells),
        "",
        *text_lines(
            "From the defaults of each. *by the checker*, J and the worst constraint are those of the plan that was made of the "
            "last iterate, whose contacts were made exact; the checker looks between the knots, at friction and at the paths "
            "of the feet, too, which the published form does not. *by its own measures* is its cost at the last iterate with "
            "its own terms, and whether that had come to rest: at the full weight, and within 1 % over ten iterations."
        ),
        "",
        *text_lines(_own_costs(results)),
        "",
        *text_lines(
            f"From {settings} settings each (first weight on the change of the inputs times first guess of the durations):"
        ),
        "",
        *tazaki_settings.table(rows),
        "",
        *text_lines(
            f"Accepted by the checker over all scenes: {counts}. J of the published form is its own cost at the last of its 60 "
            "iterations; of ours it is without the constants for flights and changes of contacts, by the plan. J counts violated "
            "limits and open contacts with weights of 1e4: where it is in the hundreds or more, the motion floats, slips or "
            "overstretches its legs, also where it is at rest. The paper shows one run of each scene and no number of its costs."
        ),
        "",
    ]


def _own_costs(results: Results) -> str:
    """On which scenes the published form ends with a low cost of its own, from its defaults."""
    costs = {name: by_method["paper"].report.paper_cost for name, by_method in results.items()}
    low = [name for name, cost in costs.items() if cost < LOW_COST]
    high = [f"{name} ({cost:.3g})" for name, cost in costs.items() if cost >= LOW_COST]
    rest = f" It does not on {', '.join(high)}." if high else ""
    return (
        f"By its own measures the published form ends below J = {LOW_COST:g} on {len(low)} of {len(costs)} scenes from its "
        f"defaults{': ' + ', '.join(low) if low else ''}.{rest}"
    )


def figures(pictures: Sequence[str]) -> list[str]:
    """Figures 1, 3 and 4."""
    said = {
        1: (
            "the motions found",
            "The paper shows the first guess above and the motion found below. Left: the first guess from the side, a cubic from "
            "start to goal along which feet slide and hands hang, as high as the CoM. Middle and right: the motions found; the "
            "middle ones are what the published form ends with, also where the table above says that it is no motion.",
        ),
        3: (
            "contact sequence over the number of switches",
            "Each column is the sequence after so many switches, each band an end-effector with step 0 at its bottom; bands of "
            "hands that touch nothing in either form are left out. The published form goes on switching to the end, there and "
            "back within an iteration, which does not show here and which the paper calls persistent chattering; ours stops "
            "when its cost no longer falls. Its columns go on through polish, refinement and all first guesses.",
        ),
        4: (
            "complementarity weight and cost over the iterations",
            "Costs are those at the weight of each iteration, so that they rise with it. Of ours the first "
            f"{SHOWN} iterations are drawn: where the weight falls another first guess begins, where the cost jumps at the full "
            "weight another candidate does (docs/theory/ddp.md, Search).",
        ),
    }
    lines = []
    for number, (title, text) in said.items():
        name = f"{PREFIX}figure_{number}.png"
        if name in pictures:
            lines += [f"## Figure {number}: {title}", "", *text_lines(text), "", f"![{title}]({name})", ""]
    return lines


def figure_2(rows: Sequence[Row], pictures: Sequence[str], missing: str) -> list[str]:
    """The robot, how plans were followed, and what fell."""
    lines = ["## Figure 2: plans followed in simulation", "", *_robot_text(), ""]
    if not rows:
        return [*lines, *text_lines(f"No plan was followed: {missing}"), ""]
    lines += [*tazaki_tracking.table(rows), "", *_followed_text(rows), ""]
    fallen = tazaki_tracking.falls(rows)
    lines += [*fallen, ""] if fallen else []
    for row in (row for row in rows if row["plan"] == "ours"):
        name = tazaki_tracking.picture_name(row["scene"], row["setup"])
        if name in pictures:
            helped = "with the paper's help" if row["setup"] == "held" else "without help"
            told = f"{row['scene']}, our plan, {helped}: {tazaki_tracking.ending(row)}"
            lines += [f"{told}.", "", f"![{told}]({name})", ""]
    return lines + ([*text_lines(f"Pictures are missing: {missing}"), ""] if missing else [])


def _robot_text() -> list[str]:
    robot = tazaki_robot
    bodies = robot.parts()
    mass = sum(body.mass for body in bodies)
    joints = sum(bool(body.parent) for body in bodies)
    cells = [
        [name.replace("_", " "), f"{low:g} to {high:g}", f"{torque:g}", f"{speed:g}"]
        for name, (low, high, torque, speed) in robot.LIMITS.items()
    ]
    return [
        *text_lines(
            f"The paper says of its robot that it has 30 joints and 44 kg. `{robot.NAME}`, which code writes as a URDF, has "
            f"{joints} joints and {mass:g} kg: legs of six, arms of seven, two in waist and neck each. Soles (0.20 x 0.10 m), "
            "the height of the CoM (0.70 m) and the places of feet and hands in the nominal posture are those of `humanoid44`, "
            "the numbers for planning, too. All else is chosen: bodies are boxes of even density, the trunk put where the CoM "
            f"lies above the middle of the soles; thigh and shank {robot.THIGH:g} m, upper arm {robot.UPPER_ARM:g} m, "
            f"forearm {robot.FOREARM:g} m and {robot.HAND:g} m to the palm; rotors of 0.01 kg m² at every joint, as wherever a "
            "URDF gives none. Left limbs have these limits, right ones their mirror images; arms are made strong for the rail. "
            "Boxes, lengths of legs and speeds were changed a few times after runs such as those below had been seen."
        ),
        "",
        *table_lines(["joint", "range [rad]", "torque [N m]", "speed [rad/s]"], cells),
    ]


def _followed_text(rows: Sequence[Row]) -> list[str]:
    counts = []
    for setup, said in (("held", "With the paper's help"), ("free", "without it,")):
        tried = [row for row in rows if row["setup"] == setup and row["fell"] is not None]
        scenes = list(dict.fromkeys(row["scene"] for row in tried))
        ours = [s for s in scenes if any(r["scene"] == s and r["plan"] == "ours" and not r["fell"] for r in tried)]
        if tried:
            upright = sum(not row["fell"] for row in tried)
            which = f" ({', '.join(ours)})" if ours else ""
            counts.append(
                f"{said} our plans come to their end on {len(ours)} of {len(scenes)} scenes{which}, all plans in "
                f"{upright} of {len(tried)} runs"
            )
    plans = tazaki_tracking.PLANS
    return [
        *text_lines(
            'The paper: "we conducted simulation in an assisted setup in which very large values are assigned to the base link '
            f'inertia". Help *inertia* is that: {tazaki_tracking.HELD_INERTIA:g} kg m² more about each axis of the pelvis, which '
            "the controller knows of; the robot's whole inertia is 5.5 kg m² at most. *none*: the robot as it is. All else is as "
            "in docs/tracking.md: torques within limits that fall with speed, links that touch each other and the terrain, no "
            "disturbance, no gain changed. Plans: *"
            f"{plans['ours']}*, for `humanoid44` by default; *{plans['margin']}*, with the numbers that built-in robots with "
            "joints have (phases of 0.3 to 0.6 s, whole soles on their surface, centres of pressure within 0.75 of the sole, an "
            f'upright base); *{plans["lipm"]}*, `model="lipm"` by our search. Torque and speed are the largest over their limits.'
        ),
        "",
        *text_lines(f"{'; '.join(counts)}. {_rotation(rows)}".strip()),
        "",
        *text_lines(
            "mcplan's own `--assist` was not used: its moment is too stiff for this robot's light pelvis "
            "(docs/tracking.md, Limits)."
        ),
    ]


def _rotation(rows: Sequence[Row]) -> str:
    """How far the base was off in runs that fell, and in those of the same plans with help."""
    fallen = [row for row in rows if row["fell"] and row["setup"] == "free"]
    keys = {(row["scene"], row["plan"]) for row in fallen}
    held = [row for row in rows if (row["scene"], row["plan"]) in keys and row["setup"] == "held" and not row["fell"]]
    if not fallen or not held:
        return ""
    off, on = ([row["orientation_rms_deg"] for row in some] for some in (fallen, held))
    return (
        f"In the runs that fell the base was {min(off):.1f} to {max(off):.1f} degrees off its plan, with the help and the same "
        f"plans {min(on):.1f} to {max(on):.1f}. No gain was tuned against these falls, and what begins them was looked into no "
        "further than the list below says."
    )
