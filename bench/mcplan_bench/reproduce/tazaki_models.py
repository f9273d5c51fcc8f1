"""The paper's model of contact forces against ours: the same scenes by both, measured from the forces alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from mcplan._core import may_touch
from mcplan.kinematics.rotations import polygon_normal
from mcplan_bench.contact_measures import ContactMeasures, measure_contacts
from mcplan_bench.contact_replay import Array, contacts, replay
from mcplan_bench.criteria import comparable_cost
from mcplan_bench.sections import ABSENT, number, table_lines

from .tazaki_names import PREFIX

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mcplan import Plan, Robot, Scene
    from mcplan.ddp import Result

#: The paper's, and ours.
MODELS: tuple[Literal["lipm", "wrench"], ...] = ("lipm", "wrench")
TITLES = {"lipm": "paper's", "wrench": "ours"}
#: Coefficient of friction of all surfaces, and of pads that are not grasped.
FRICTION = 0.7
#: The scene with hands: its pads grasped, for the paper's model does not cross it otherwise, and with friction alone.
RAIL = "gap_with_rail"
HELD, TOUCHED = "held", "friction"


def compare_models(
    names: Sequence[str], robot: Robot, progress: Callable[[str], None]
) -> tuple[list[dict[str, Any]], dict[tuple[str, str], Result]]:
    """Plan scenes with both models and measure the plans.

    Args:
        names: Built-in scenes; of `gap_with_rail` both with pads that are held and with friction.
        robot: For all of them.
        progress: Called with a line for each plan.

    Returns:
        A row for each scene and model; and the results on the rail by pads and model.
    """
    import mcplan

    rows: list[dict[str, Any]] = []
    rail: dict[tuple[str, str], Result] = {}
    for name in names:
        for pads in (HELD, TOUCHED) if name == RAIL else ("",):
            scene = with_pads(mcplan.load_scene(name), pads == HELD)
            for model in MODELS:
                result = mcplan.plan(scene, robot, model=model)
                rows.append(row_of(name, pads, model, result))
                if name == RAIL:
                    rail[pads, model] = result
                progress(f"models, {name}{' ' if pads else ''}{pads}, {model}: {rows[-1]['status']}")
    return rows, rail


def with_pads(scene: Scene, grasped: bool) -> Scene:
    """The scene with friction 0.7 everywhere; surfaces for hands alone are grasped, without a cone, or are not."""
    import mcplan

    foot = mcplan.model.EndEffector(name="foot", kind="foot")
    surfaces = list(scene.surfaces)
    for surface in surfaces:
        surface.friction = FRICTION
        surface.grasp = grasped and not may_touch(surface, foot)
    scene.surfaces = surfaces
    return scene


def row_of(scene: str, pads: str, model: str, result: Result) -> dict[str, Any]:
    """What the table says of one plan; None where there is no plan to measure."""
    report = result.report
    row: dict[str, Any] = {"scene": scene, "pads": pads, "model": model, "status": str(report.status)}
    found: ContactMeasures | None = measure_contacts(result.plan) if result.plan.phases else None
    row["cost"] = comparable_cost(report) if found else None
    for kind in ("foot", "hand"):
        in_contact = found is not None and bool(found.surfaces(kind))
        row[f"friction_{kind}"] = found.largest("tangent_circle", kind) if found and in_contact else None
        row[f"peak_{kind}"] = found.largest("peak", kind) if found and in_contact else None
    row["hands_only"] = len(found.hands_only) if found else None
    row["momentum_Nms"] = found.momentum_peak_Nms if found else None
    for where in ("knots_m", "m"):
        low, high = getattr(found, f"com_height_{where}") if found else (None, None)
        row |= {f"com_low_{where}": low, f"com_high_{where}": high}
    for name in ("com_m", "momentum_Nms", "orientation_deg", "orientation_from_start_deg"):
        row[f"replay_{name}"] = getattr(found.replay, name) if found else None
    return row


def _tables(rows: Sequence[dict[str, Any]]) -> list[str]:
    """Friction and forces, then the motion of the base."""
    head = ["scene", "model", "ended", "J", "friction needed, feet", "hands", "peak force, foot", "hand", "hands only"]
    cells = [
        [
            *_plan(row),
            row["status"],
            number(row["cost"], ".3g"),
            *(_friction(row[f"friction_{kind}"]) for kind in ("foot", "hand")),
            *(number(row[f"peak_{kind}"], ".2f") for kind in ("foot", "hand")),
            number(row["hands_only"], "d"),
        ]
        for row in rows
    ]
    motion_head = [
        "scene",
        "model",
        "angular momentum",
        "CoM, lowest at knots",
        "between",
        "highest at knots",
        "between",
    ]
    motion_head += ["replay: CoM", "momentum", "base", "from the start"]
    motion_cells = [
        [
            *_plan(row),
            number(row["momentum_Nms"], ".2f", unit=" N m s"),
            *(number(row[f"com_{which}_{where}"], ".3f") for which in ("low", "high") for where in ("knots_m", "m")),
            number(row["replay_com_m"], ".0e", unit=" m"),
            number(row["replay_momentum_Nms"], ".0e", unit=" N m s"),
            *(
                number(row[f"replay_{name}_deg"], ".2g", unit=" deg")
                for name in ("orientation", "orientation_from_start")
            ),
        ]
        for row in rows
    ]
    return [*table_lines(head, cells), "", *table_lines(motion_head, motion_cells)]


def section_lines(rows: Sequence[dict[str, Any]], figure: str = "") -> list[str]:
    """The part of the page: table, what it shows, and the figure of that name.

    Args:
        rows: Of ``compare_models``.
        figure: File beside the page; "": none.
    """
    lines = [
        "## The paper's model of contacts against ours",
        "",
        '"paper\'s": `model="lipm"`, where every force points from its end-effector to the CoM. "ours": `model="wrench"`, the',
        "default, where it acts inside the sole and may pass the CoM at a distance. Both by our search, with a friction of",
        f"{FRICTION:g} everywhere.",
        "",
        *_tables(rows),
        "",
        "J is the cost without the constants for flights and changes of contacts; the two models weigh different things, so",
        "that a difference by a few hundredths says little and one by thousands that limits are violated. All else is measured",
        "at 1 kHz from the forces alone. Friction needed: largest tangential over normal force. Peak forces over the weight,",
        "CoM heights in m. Replay: largest difference between a knot and the phase before it, integrated from its forces; base,",
        "from the start: its turning integrated over the whole plan.",
    ]
    if any(row["pads"] for row in rows):
        lines += [
            "",
            "A plan that is not solved is the best that was found, and what it violates is in its numbers: forces through the",
            "CoM ask of pads beside the body for a friction that no pad has, with as much of it as there is the hands are of",
            "no use. With a distance between the line of force and the CoM the hands press down, and the body leans.",
        ]
    if figure:
        lines += [
            "",
            f"![Forces of the hands on the pads by both models]({figure})",
            "",
            "Each point is the force of a hand on its pad at one millisecond, its tangential part signed by the side it points",
            f"to; shaded is the cone of a friction of {FRICTION:g}. On the left the pads are held, on the right they are not.",
        ]
    return lines


def _plan(row: dict[str, Any]) -> list[str]:
    pads = {"": "", HELD: ", pads held", TOUCHED: ", pads with friction"}[row["pads"]]
    return [row["scene"] + pads, TITLES[row["model"]]]


def _friction(value: float | None) -> str:
    if value is None:
        return ABSENT
    return f"{value:.2f}" if np.isfinite(value) else "pulls"


def plot_hand_forces(paper: Plan, ours: Plan) -> Figure:
    """Tangential and normal force of the hands in contact, at 1 kHz, in the cone of friction 0.7.

    Args:
        paper: Plan of the paper's model.
        ours: Plan of ours.
    """
    from mcplan.view.colours import end_effector_colours
    from mcplan.view.sheets import label, legend, sheet

    figure, axes = sheet(1, 2, size=(10.0, 4.6), sharex=True, sharey=True)
    clouds = [hand_forces(plan) for plan in (paper, ours)]
    everything = np.concatenate([points for cloud in clouds for points in cloud.values()] or [np.ones((1, 2))])
    wide = 1.1 * float(np.abs(everything[:, 0]).max(initial=1.0))
    low, high = min(0.0, 1.1 * float(everything[:, 1].min())), 1.1 * float(everything[:, 1].max(initial=1.0))
    for chart, plan, cloud, title in zip(axes[0], (paper, ours), clouds, ("the paper's model", "ours"), strict=True):
        colours = end_effector_colours(plan.robot)
        edge = np.array([0.0, max(high, wide / FRICTION)])
        cone = f"friction cone, {FRICTION:g}"
        chart.fill_betweenx(edge, -FRICTION * edge, FRICTION * edge, color="#DDE7DD", linewidth=0, label=cone)
        for name, points in cloud.items():
            colour = colours[plan.robot.end_effector_index(name)]
            chart.plot(points[:, 0], points[:, 1], ".", color=colour, markersize=3.0, label=name.replace("_", " "))
        chart.set_xlim(-wide, wide)
        chart.set_ylim(low, high)
        label(chart, x="tangential force, signed by its side [N]", title=title)
    label(axes[0, 0], y="normal force [N]")
    handles, names = axes[0, 0].get_legend_handles_labels()
    legend(figure, handles=handles, labels=names, loc="outside lower center", ncol=max(len(names), 1))
    return figure


def hand_forces(plan: Plan) -> dict[str, Array]:
    """Tangential force, with the sign of its part along y, and normal force (n, 2) [N] of each hand in contact."""
    given, replayed = contacts(plan), replay(plan)
    out = {}
    for e, end in enumerate(plan.robot.end_effectors):
        found = []
        for k in np.flatnonzero(given.surfaces[:, e] >= 0) if end.kind == "hand" else ():
            normal = polygon_normal(np.asarray(plan.scene.surfaces[given.surfaces[k, e]].vertices_W))
            forces = replayed.forces_W[k, :, e]
            pressing = forces @ normal
            sideways = forces - pressing[:, None] * normal
            signed = np.copysign(np.linalg.norm(sideways, axis=1), sideways[:, 1])
            found.append(np.column_stack([signed, pressing]))
        if found:
            out[end.name] = np.concatenate(found)
    return out


def save_hand_forces(out: Path, rail: dict[tuple[str, str], Result]) -> Path | None:
    """Write the figure beside the page: pads held in the paper's model, pads with friction in ours; None without them."""
    paper, ours = (rail.get(key) for key in ((HELD, "lipm"), (TOUCHED, "wrench")))
    if paper is None or ours is None or not paper.plan.phases or not ours.plan.phases:
        return None
    from mcplan.view.sheets import save_figure

    path = out / f"{PREFIX}hand_forces.png"
    save_figure(plot_hand_forces(paper.plan, ours.plan), path)
    return path
