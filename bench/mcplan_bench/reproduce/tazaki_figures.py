"""Figures 1, 3 and 4 of Tazaki's paper from the runs."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.view.colours import COM, COOL, TEXT, WARM, end_effector_colours, surface_colours
from mcplan.view.sheets import label, legend, save_figure, sheet

from .tazaki_names import METHODS, PREFIX, TITLES

if TYPE_CHECKING:
    from mcplan import Robot, Scene
    from mcplan.ddp import Result

#: Results by scene and method.
Results = Mapping[str, Mapping[str, "Result"]]

#: [1/inch] of pictures: small enough for a page.
DPI = 100
#: Height of the legend below pictures of plans, which is drawn once here.
LEGEND_PIXELS = 63
#: Iterations of ours that Figure 4 shows.
SHOWN = 100
FREE = "#F3F5F7"
#: Of the lines of scenes in Figure 4.
LINES = (COM, COOL[0], WARM[0], "#4C8C4A")


def figure_1(out: Path, results: Results) -> Path:
    """The first guess from the side, and the motions that both forms find, a row for each scene."""
    from matplotlib.image import imread
    from matplotlib.lines import Line2D

    from mcplan.view.pictures.picture import picture

    still = out / f"{PREFIX}motion.png"
    figure, axes = sheet(len(results), 1 + len(METHODS), size=(15.0, 3.6 * len(results)), width_ratios=(0.8, 1.0, 1.0))
    for row, (name, by_method) in enumerate(results.items()):
        first = next(iter(by_method.values()))
        _first_guess(axes[row, 0], first.plan.scene, first.plan.robot)
        label(axes[row, 0], x="x [m]", y="z [m]", title=f"({'abcd'[row]}) {name}: first guess")
        for column, method in enumerate(METHODS, 1):
            chart, result = axes[row, column], by_method[method]
            chart.axis("off")
            label(chart, title=f"{name}, {TITLES[method]}")
            if result.plan.phases:
                picture(result.plan, path=still)
                chart.imshow(imread(still)[:-LEGEND_PIXELS])
                still.unlink()
    colours = zip(first.plan.robot.end_effectors, end_effector_colours(first.plan.robot), strict=True)
    lines = [Line2D([], [], color=COM, linewidth=3.5, label="CoM")]
    lines += [Line2D([], [], color=colour, linewidth=1.6, label=end.name.replace("_", " ")) for end, colour in colours]
    legend(figure, handles=lines, loc="outside lower center", ncol=5)
    path = out / f"{PREFIX}figure_1.png"
    save_figure(figure, path, dpi=DPI)
    return path


def _first_guess(chart: Any, scene: Scene, robot: Robot) -> None:
    """Cubic from start to goal at rest, of the CoM and of feet and hands at their nominal places, as in the paper."""
    s = np.linspace(0.0, 1.0, 60)[:, None]
    start, goal = (np.asarray(stance.position_W) for stance in (scene.start, scene.goal))
    base = start + (3.0 * s**2 - 2.0 * s**3) * (goal - start) + [0.0, 0.0, robot.com_height]
    for surface in scene.surfaces:
        vertices = np.asarray(surface.vertices_W)
        wide = np.clip([vertices[:, 0].min(), vertices[:, 0].max()], start[0] - 0.4, goal[0] + 0.4)
        chart.plot(wide, [vertices[:, 2].mean()] * 2, color="#8C949E", linewidth=3.0, solid_capstyle="butt")
    # The CoM first: from the side hands lie on it.
    chart.plot(base[:, 0], base[:, 2], color=COM, linewidth=3.5)
    for end, colour in zip(robot.end_effectors, end_effector_colours(robot), strict=True):
        path = base + np.asarray(end.nominal_B)
        chart.plot(path[:, 0], path[:, 2], color=colour, linewidth=1.6)
    chart.set_aspect("equal")


def figure_3(out: Path, results: Results) -> Path:
    """Contact sequence over the number of switches, a row for each scene and a column for each form."""
    from matplotlib.patches import Patch

    heights = [_shown_ends(by_method) for by_method in results.values()]
    size = (15.0, 0.6 + sum(0.9 + 1.0 * len(ends) for ends in heights))
    ratios = [0.5 + len(ends) for ends in heights]
    figure, axes = sheet(len(results), len(METHODS), size=size, height_ratios=ratios)
    surfaces: dict[str, list[str]] = {FREE: ["free"]}
    for row, (name, by_method) in enumerate(results.items()):
        for column, method in enumerate(METHODS):
            chart, result = axes[row, column], by_method[method]
            _sequences(chart, result, heights[row])
            label(chart, x="contact switches", title=f"({'abcd'[row]}) {name}, {TITLES[method]}")
        scene = next(iter(by_method.values())).plan.scene
        for surface, colour in zip(scene.surfaces, surface_colours(scene), strict=True):
            known = surfaces.setdefault(colour, [])
            known += [] if surface.name in known else [surface.name]
    patches = [Patch(facecolor=c, edgecolor="#C5CAD1", label=", ".join(names)) for c, names in surfaces.items()]
    legend(figure, handles=patches, loc="outside lower center", ncol=5)
    path = out / f"{PREFIX}figure_3.png"
    save_figure(figure, path, dpi=DPI)
    return path


def _shown_ends(by_method: Mapping[str, Result]) -> list[int]:
    """End-effectors that touch anything in any sequence of a scene."""
    from mcplan.view.plots.report import has_sequences, sequences_by_switches

    touched: set[int] = set()
    for result in by_method.values():
        if has_sequences(result.report):
            grid = sequences_by_switches(result.report)[1]
            touched |= set(np.flatnonzero((grid >= 0).any(axis=(0, 1))).tolist())
    return sorted(touched)


def _sequences(chart: Any, result: Result, ends: list[int]) -> None:
    """Surfaces by switches and steps, the end-effectors above each other."""
    from matplotlib.colors import BoundaryNorm, ListedColormap

    from mcplan.view.plots.report import has_sequences, sequences_by_switches

    chart.grid(False)
    chart.set_yticks([])
    if not has_sequences(result.report) or not ends:
        return
    edges, grid = sequences_by_switches(result.report)
    palette = surface_colours(result.plan.scene)
    colours = ListedColormap([FREE, *palette])
    norm = BoundaryNorm(np.arange(-1.5, len(palette) + 0.5), colours.N)
    steps = grid.shape[1]
    for rank, end in enumerate(ends):
        bottom = (len(ends) - 1 - rank) * (steps + 2)
        chart.pcolormesh(edges, bottom + np.arange(steps + 1), grid[:, :, end].T, cmap=colours, norm=norm)
    middles = [(len(ends) - 1 - rank) * (steps + 2) + 0.5 * steps for rank in range(len(ends))]
    robot = result.plan.robot
    chart.set_yticks(middles, [robot.end_effectors[end].name.replace("_", " ") for end in ends], color=TEXT)
    chart.tick_params(axis="y", length=0)
    chart.set_ylim(-1.0, len(ends) * (steps + 2) - 1.0)


def figure_4(out: Path, results: Results) -> Path:
    """Weight of the complementarity terms, and cost at that weight, over the iterations; a column for each form."""
    figure, axes = sheet(2, len(METHODS), size=(15.0, 6.4), height_ratios=(1, 2), sharey="row", sharex="col")
    for column, method in enumerate(METHODS):
        for colour, (name, by_method) in zip(LINES, results.items(), strict=False):
            history = by_method[method].report.history[: SHOWN if method == "standard" else None]
            index = [entry.index for entry in history]
            weight, cost = axes[:, column]
            weight.step(index, [entry.contact_weight for entry in history], where="mid", color=colour, linewidth=1.6)
            cost.plot(index, [entry.cost for entry in history], color=colour, linewidth=1.6, label=name)
        for chart in axes[:, column]:
            chart.set_yscale("log")
        label(axes[0, column], y="" if column else "weight [-]", title=f"(a) complementarity weight, {TITLES[method]}")
        label(axes[1, column], x="iteration", y="" if column else "cost [-]", title=f"(b) cost, {TITLES[method]}")
    lines = axes[1, 0].get_legend_handles_labels()
    legend(figure, handles=lines[0], labels=lines[1], loc="outside lower center", ncol=4)
    path = out / f"{PREFIX}figure_4.png"
    save_figure(figure, path, dpi=DPI)
    return path
