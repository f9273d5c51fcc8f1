"""Tables I to IV of Lengagne et al. from the runs, beside the published ones."""

from __future__ import annotations

from typing import Any

from . import lengagne_paper as paper
from .lengagne_runs import Run, best_of, find
from .lengagne_settings import FREE_FLYER, KERNEL, NEQ, STEEP, Config

Row = dict[str, Any]

TITLES = {"cartwheel": "1 `cartwheel`", "climbing": "2 `climbing`", "walking": "3 `walking`", STEEP: f"`{STEEP}`"}
CASE_TITLES = {"uniform": "1 `uniform`", "per_body": "2 `per_body`", "per_point": "3 `per_point`"}


def _published(row: Any) -> Row:
    """Columns of the paper; empty where it has no such row."""
    keys = ("parameters", "constraints", "iterations", "time_s", "criterion", "status")
    return {f"paper_{key}": getattr(row, key, "") for key in keys}


def _measured(kept: Run | None) -> Row:
    """Columns of a run; empty where it was not run."""
    keys = ("parameters", "constraints", "iterations", "time_s", "cpu_s", "repeats", "load")
    out: Row = {key: "" if kept is None else getattr(kept, key) for key in keys}
    out["status"] = "" if kept is None else kept.verdict
    out["checker"] = "" if kept is None else kept.status
    out["drift_mm"] = "" if kept is None else 1e3 * kept.drift_m
    out["drift_mrad"] = "" if kept is None else 1e3 * kept.drift_rad
    out["clearance"] = "" if kept is None else kept.config.clearance
    out["depth_mm"] = "" if kept is None else max(1e3 * kept.beyond.get("clearance", 0.0), 0.0)
    return out


def figure(value: float) -> str:
    """Two digits, without exponents of ten for large numbers."""
    return f"{value:.0f}" if value >= 100.0 else f"{value:.2g}"


def deep(row: Row) -> str:
    """Millimetres for which feet are inside solids, marked where they are not kept out."""
    return figure(row["depth_mm"]) + ("" if row["clearance"] else " (not asked)")


def kinematic_rows(runs: list[Run], table: int) -> list[Row]:
    """Table I or II: a row per motion and N_eq, and one per motion for the tube."""
    out = []
    for motion in paper.MOTIONS:
        for neq in (*NEQ, -1):
            kept = find(runs, Config(table, motion, "band" if neq >= 0 else "tube", neq))
            if kept is None:
                continue
            published = (paper.TABLE_1 if table == 1 else paper.TABLE_2).get((motion, neq))
            row: Row = {
                "motion": motion,
                "neq": neq if neq >= 0 else "tube",
                **_published(published),
                **_measured(kept),
            }
            strict = find(runs, Config(table, motion, "strict", neq)) if neq >= 0 else None
            row["strict_equalities"] = equalities(motion, table, neq) if neq >= 0 else ""
            row |= {f"strict_{key}": value for key, value in _measured(strict).items() if key in STRICT}
            out.append(row)
    return out


STRICT = ("iterations", "time_s", "cpu_s", "status", "drift_mm", "drift_mrad")


def equalities(name: str, table: int, neq: int) -> int:
    """Rows of strict contact constraints: x, y and angle of each contact, of all but one where the base is computed."""
    import mcplan

    phases = mcplan.load_planar_task(name).phases
    left_out = FREE_FLYER[table] == "computed"
    return 3 * (neq + 1) * sum((len(phase.contacts) - left_out) * phase.intervals for phase in phases)


def kinematic_table(rows: list[Row]) -> list[str]:
    """Table I or II as Markdown."""
    lines = [
        "| motion | $N_{eq}$ | N: paper | here | rows: paper | here | iterations: paper | here | time [s]: paper | here "
        "| processor | status: paper | here | drift [mm] | [mrad] | depth [mm] | strict: equalities | status | iterations |",
        "|---" * 19 + "|",
    ]
    for row in rows:
        lines.append(
            f"| {TITLES[row['motion']]} | {row['neq']} | {row['paper_parameters']} | {row['parameters']} "
            f"| {row['paper_constraints']} | {row['constraints']} | {row['paper_iterations']} | {row['iterations']} "
            f"| {row['paper_time_s']} | {row['time_s']:.2f} | {row['cpu_s']:.2f} "
            f"| {row['paper_status']} | {row['status']} | {figure(row['drift_mm'])} | {figure(row['drift_mrad'])} "
            f"| {deep(row)} | {row['strict_equalities']} | {row['strict_status']} | {row['strict_iterations']} |"
        )
    return lines


def grid_rows(runs: list[Run]) -> list[Row]:
    """Tables I and II on a time grid and at extrema: what was asked at instants, and how far the motion is beyond it."""
    out = []
    for kept in runs:
        config = kept.config
        if config.continuous == "hull":
            continue
        out.append(
            {
                "table": config.table,
                "motion": config.motion,
                "continuous": config.continuous,
                "contacts": config.hold,
                "neq": config.neq if config.neq >= 0 else "",
                **_measured(kept),
                "position_beyond": max(kept.beyond.get("position", 0.0), 0.0),
                "velocity_beyond": max(kept.beyond.get("velocity", 0.0), 0.0),
            }
        )
    return out


def grid_table(rows: list[Row]) -> list[str]:
    """The grid as Markdown."""
    lines = [
        "| table | motion | inequalities | contacts | rows | iterations | time [s] | status | drift [mm] | [mrad] "
        "| position beyond | velocity beyond |",
        "|---" * 12 + "|",
    ]
    for row in rows:
        held = row["contacts"] if row["neq"] == "" else f"{row['contacts']} 0..{row['neq']}"
        lines.append(
            f"| {'I' * row['table']} | {TITLES[row['motion']]} | {row['continuous']} | {HELD.get(held, held)} "
            f"| {row['constraints']} | {row['iterations']} | {row['time_s']:.2f} | {row['status']} "
            f"| {figure(row['drift_mm'])} | {figure(row['drift_mrad'])} | {percent(row['position_beyond'])} "
            f"| {percent(row['velocity_beyond'])} |"
        )
    return lines


HELD = {"tube": "tube, 1 mm, 5 mrad", "equal": "0.01 mm, 0.01 mrad"}


def percent(ratio: float) -> str:
    """For cells; less than a hundredth of a percent is a tolerance of the solver."""
    return "-" if ratio < 1e-4 else f"{100 * ratio:.2g} %"


def dynamic_rows(runs: list[Run]) -> list[Row]:
    """Table III: band and tube for every motion and case, then forces as parameters."""
    out = []
    for motion in (*paper.MOTIONS, STEEP):
        for case, forces in paper.CASES.items():
            out += _held(runs, motion, forces, case, _published(paper.TABLE_3.get((motion, case))))
    published = _published(None) | {f"paper_{key}": value for key, value in paper.FORCES_AS_PARAMETERS.items()}
    return out + _held(runs, "cartwheel", "parameters", "", published)


def _held(runs: list[Run], motion: str, forces: str, case: int | str, published: Row) -> list[Row]:
    out = []
    for hold in ("band", "tube"):
        kept = best_of(runs, 3, motion, forces, hold)
        if kept is not None:
            row = {"motion": motion, "case": case, "forces": forces, "contacts": hold, **published, **_measured(kept)}
            row |= {"duration_s": kept.duration_s, "balance_N": max(kept.beyond.get("balance", 0.0), 0.0)}
            out.append(row)
    return out


def dynamic_table(rows: list[Row]) -> list[str]:
    """Table III as Markdown: band and tube side by side."""
    lines = [
        "| motion | case | N: paper | here | rows: paper | band | tube | iterations: paper | band | tube "
        "| time [s]: paper | band | tube | processor: band | tube | status: paper | band | tube | drift [mm]: band | tube "
        "| depth [mm]: band | tube |",
        "|---" * 22 + "|",
    ]
    for band, tube in paired(rows):
        case = CASE_TITLES.get(band["forces"], f"`{band['forces']}`")
        lines.append(
            f"| {TITLES[band['motion']]} | {case} | {band['paper_parameters']} | {band['parameters']} "
            f"| {band['paper_constraints']} | {band['constraints']} | {tube['constraints']} "
            f"| {band['paper_iterations']} | {band['iterations']} | {tube['iterations']} "
            f"| {band['paper_time_s']} | {band['time_s']:.2f} | {tube['time_s']:.2f} "
            f"| {band['cpu_s']:.2f} | {tube['cpu_s']:.2f} "
            f"| {band['paper_status']} | {band['status']} | {tube['status']} "
            f"| {figure(band['drift_mm'])} | {figure(tube['drift_mm'])} | {deep(band)} | {deep(tube)} |"
        )
    return lines


def solver_rows(runs: list[Run], table: int) -> list[Row]:
    """Rows of Table III (tube) or IV that both Ipopt and the kernel were run with, each one's best."""
    out = []
    for motion in (*paper.MOTIONS, STEEP):
        for forces in paper.CASES.values():
            ours = best_of(runs, table, motion, forces, solver=KERNEL)
            theirs = best_of(runs, table, motion, forces)
            if ours is None or theirs is None:
                continue
            row: Row = {"table": table, "motion": motion, "forces": forces}
            for name, kept in (("ipopt", theirs), (KERNEL, ours)):
                row |= {f"{name}_{key}": getattr(kept, key) for key in COMPARED}
            out.append(row)
    return out


#: Of the solvers side by side; `status` is the planner's, with the checker's word in it.
COMPARED = ("iterations", "time_s", "cpu_s", "cost", "status", "certified")


def solver_table(rows: list[Row]) -> list[str]:
    """Ipopt and the kernel side by side, as Markdown; costs of Table IV alone, where they are minimised."""
    lines = [
        "| table | motion | case | iterations: Ipopt | kernel | time [s]: Ipopt | kernel | processor: Ipopt | kernel "
        "| criterion [N² m² s]: Ipopt | kernel | status: Ipopt | kernel |",
        "|---" * 13 + "|",
    ]
    for row in rows:
        pairs = [
            [str(row[f"{name}_iterations"]) for name in ("ipopt", KERNEL)],
            [f"{row[f'{name}_time_s']:.2f}" for name in ("ipopt", KERNEL)],
            [f"{row[f'{name}_cpu_s']:.2f}" for name in ("ipopt", KERNEL)],
            [f"{row[f'{name}_cost']:.1f}" if row["table"] == 4 else "" for name in ("ipopt", KERNEL)],
            [row[f"{name}_status"] for name in ("ipopt", KERNEL)],
        ]
        cells = " | ".join(cell for pair in pairs for cell in pair)
        case = CASE_TITLES[row["forces"]]
        lines.append(f"| {'I II III IV'.split()[row['table'] - 1]} | {TITLES[row['motion']]} | {case} | {cells} |")
    return lines


def paired(rows: list[Row]) -> list[tuple[Row, Row]]:
    """Band and tube of each motion and case; rows of which one is missing are left out."""
    tubes = {(row["motion"], row["forces"]): row for row in rows if row["contacts"] == "tube"}
    bands = [row for row in rows if row["contacts"] == "band"]
    return [(row, tubes[row["motion"], row["forces"]]) for row in bands if (row["motion"], row["forces"]) in tubes]


def full_rows(runs: list[Run]) -> list[Row]:
    """Table IV: every run of every case, the one from P = 0 first."""
    out = []
    for motion in paper.MOTIONS:
        for case, forces in paper.CASES.items():
            best = best_of(runs, 4, motion, forces)
            for kept in runs:
                config = kept.config
                if (config.table, config.motion, config.forces, config.solver) != (4, motion, forces, "ipopt"):
                    continue
                row: Row = {"motion": motion, "case": case, "forces": forces, "start": kept.start or "P = 0"}
                row |= _published(paper.TABLE_4.get((motion, case)))
                row |= _measured(kept)
                row |= {"cost": kept.cost, "kept": kept is best, "duration_s": kept.duration_s}
                row |= {"certified": kept.certified, "certify_s": kept.certify_s}
                row["evaluation_s"], row["linear_solver_s"] = kept.evaluation_s, kept.linear_solver_s
                out.append(row)
    return out


def full_table(rows: list[Row]) -> list[str]:
    """Table IV as Markdown."""
    lines = [
        "| motion | case | start | N | rows | iterations: paper | here | time [s]: paper | here | processor "
        "| criterion: paper | here [N² m² s] | status: paper | here | checker | certified | drift [mm] | depth [mm] "
        "| duration [s] |",
        "|---" * 19 + "|",
    ]
    for row in rows:
        cost = f"{row['cost']:.1f}" + ("" if row["kept"] else " (not kept)")
        proved = {True: "proved", False: "not proved", None: ""}[row["certified"]]
        start = row["start"] if row["start"] == "P = 0" else f"solution of `{row['start']}`"
        lines.append(
            f"| {TITLES[row['motion']]} | {CASE_TITLES[row['forces']]} | {start} | {row['parameters']} "
            f"| {row['constraints']} | {row['paper_iterations']} | {row['iterations']} | {row['paper_time_s']} "
            f"| {row['time_s']:.2f} | {row['cpu_s']:.2f} | {row['paper_criterion']} | {cost} "
            f"| {row['paper_status']} | {row['status']} | {row['checker']} | {proved} | {figure(row['drift_mm'])} "
            f"| {deep(row)} | {row['duration_s']:.2f} |"
        )
    return lines


def unordered(rows: list[Row]) -> list[str]:
    """Motions of Table IV where a richer case costs more than a poorer one."""
    out = []
    for motion in paper.MOTIONS:
        costs = [row["cost"] for row in rows if row["motion"] == motion and row["kept"]]
        if any(after > before for before, after in zip(costs, costs[1:], strict=False)):
            out.append(motion)
    return out
