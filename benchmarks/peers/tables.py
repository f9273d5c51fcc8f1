"""The page of run.py: a table for each peer, and what each is given."""

from __future__ import annotations

from typing import Any

Row = dict[str, Any]

HEAD = """# Beside other planners

Made by `benchmarks/peers/run.py` ({machine}, two shared cores that were busy, CPU times of one thread), each table in one run on
its date. The same goals for all; what each planner must be told is in the tables, since that differs more than the times.
`hpp-python` is on PyPI, but its contact planner (`hpp-rbprm`) is not; no other planner that searches a contact sequence could be
installed.
"""

SECTIONS = {
    "towr": """## Centroidal motions: TOWR

[TOWR](https://github.com/ethz-adrl/towr) optimises motion, footholds, forces and, if asked, times over a given order of steps. It
gets mass, inertia, start and goal of ours, and a reach box as large as ours allows (one size for all feet), centred where ours
are; friction pyramids inside the cone; feet are points, without moments and yaw. Its ground is a height map: between treads it
is that of the lower side, in the gap a pit of 0.5 m, and it may step there (*beside* infinite). The number of steps is mcplan's.

All rows are measured by the same code each millisecond, not at the instants at which the planner looks (TOWR: each 0.1 s for the
dynamics, 0.08 s for reach): residual of Newton's and Euler's laws, force beyond the cone, reach beyond the box, depth of a foot
under a surface, distance of a standing foot from any.
""",
    "sl1m": """## Surfaces and footholds: sl1m

[sl1m](https://github.com/loco-3d/sl1m) finds surfaces and footholds of a given number of steps by a relaxation of a
mixed-integer program, with quasi-static reach of its own robot; no motion, forces or times. mcplan's time is that of a plan with
all of these for Talos, whose number of steps sl1m gets, as it gets start and goal surface.
""",
    "fatrop": """## Cycles of the receding horizon: CasADi with fatrop

The same nonlinear programs from the same states, ten cycles: see [benchmarks](../benchmarks/README.md#fatrop) for what is in
whose time.
""",
    "motions": """## Whole-body motions: Crocoddyl

Both get the same plan. [Crocoddyl](https://github.com/loco-3d/crocoddyl) gets it as `mcplan export --to crocoddyl` writes it: its
soft limits, nodes of 20 ms, a start from inverse kinematics, FDDP to its own tolerance. All figures are the largest of instants a
millisecond apart: mcplan's are those of its certificate, *check* being its time; Crocoddyl's motion goes on between nodes as its
integrator has it, with the node's torques and forces held. *Joints*, *cone* and *CoP* are what is beyond joint limits, friction
cones and soles (of loads above 10 N), *drift* how far a sole in contact is from where it is planned, *base* what no contact
gives. mcplan's time has the inverse kinematics of its start in it, Crocoddyl's has not.
""",
}

TITLES = {
    "cpu_s": "CPU [s]",
    "mcplan_s": "mcplan [s]",
    "certificate_s": "check [s]",
    "force_N": "Newton [N]",
    "moment_Nm": "Euler [N m]",
    "cone_N": "cone [N]",
    "reach_mm": "reach [mm]",
    "under_mm": "under [mm]",
    "beside_mm": "beside [mm]",
    "median_ms": "CPU [ms]",
    "max_ms": "most [ms]",
    "torque_use": "torque use",
    "velocity_use": "speed use",
    "position_over_mrad": "joints [mrad]",
    "pressure_mm": "CoP [mm]",
    "drift_mm": "drift [mm]",
    "base_residual_N": "base [N]",
    "base_residual_Nm": "base [N m]",
}

COLUMNS = {
    "towr": (
        "case",
        "planner",
        "given",
        "answer",
        "cpu_s",
        "force_N",
        "moment_Nm",
        "cone_N",
        "reach_mm",
        "under_mm",
        "beside_mm",
    ),
    "sl1m": ("scene", "steps", "answer", "cpu_s", "mcplan_s"),
    "fatrop": ("case", "planner", "solved", "iterations", "median_ms", "max_ms"),
    "motions": (
        "case",
        "planner",
        "answer",
        "iterations",
        "cpu_s",
        "certificate_s",
    ),
}

#: Of a second table, where one would be too wide.
MORE_COLUMNS = {
    "motions": (
        "case",
        "planner",
        "torque_use",
        "velocity_use",
        "position_over_mrad",
        "cone_N",
        "pressure_mm",
        "drift_mm",
        "base_residual_N",
        "base_residual_Nm",
    ),
}


def cell(value: Any) -> str:
    """A number with three digits, a text as it is."""
    if value is None:
        return ""
    if isinstance(value, float):
        return "0" if abs(value) < 5e-4 else f"{value:.3g}" if abs(value) < 1e3 else f"{value:.0f}"
    return str(value)


def table(columns: tuple[str, ...], rows: list[Row]) -> str:
    """Markdown."""
    lines = ["| " + " | ".join(TITLES.get(name, name) for name in columns) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(cell(row.get(name)) for name in columns) + " |" for row in rows]
    return "\n".join(lines)


def page(kept: dict[str, list[Row] | str], dates: dict[str, str], machine: str) -> str:
    """The whole page; a peer that could not be had is named with the reason."""
    parts = [HEAD.format(machine=machine)]
    for name, text in SECTIONS.items():
        if name not in kept:
            continue
        rows = kept[name]
        parts.append(text)
        parts.append(f"Measured on {dates[name]}.\n")
        parts.append(f"Not on this machine: {rows}\n" if isinstance(rows, str) else table(COLUMNS[name], rows) + "\n")
        if name in MORE_COLUMNS and not isinstance(rows, str):
            parts.append(table(MORE_COLUMNS[name], rows) + "\n")
    return "\n".join(parts)
