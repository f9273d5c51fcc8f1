"""How the time of an iteration grows with the number of phases, of end-effectors and of surfaces."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from .speed import iterations

if TYPE_CHECKING:
    from mcplan import Robot, Scene

PHASES = (18, 36, 72, 144, 288)
FEET = (2, 3, 4, 6, 8)
TILES = (1, 2, 4, 8, 16, 32)

#: The first iterations of every solve, all with the sequence free.
ITERATIONS = 10


def measure(
    quick: bool = False, repeats: int = 5, threads: int = 1, progress: Callable[[str], None] | None = None
) -> list[dict[str, Any]]:
    """Rows of what was varied, its amount, the sizes that follow from it and the times per iteration.

    Args:
        quick: Only the first two amounts of each.
        repeats: Solves behind each median.
        threads: Of the search.
        progress: Called with a line for each row.
    """
    rows = []
    for varied, amount, scene, robot, phases in cases(quick):
        options = {"phases": phases, "max_iterations": ITERATIONS, "restarts": 0, "threads": threads}
        timing, _ = iterations(scene, robot, repeats, options)
        value = sum(timing.parts_ms[name] for name in ("value_backward", "value_forward", "value_update"))
        rows.append(
            {
                "varied": varied,
                "amount": amount,
                "phases": phases,
                "end_effectors": len(robot.end_effectors),
                "surfaces": len(scene.surfaces),
                "neighbours": timing.neighbours,
                "iteration_ms": timing.ms,
                "iteration_per_phase_us": 1e3 * timing.ms / phases,
                "linearise_ms": timing.parts_ms["linearise"],
                "value_functions_ms": value,
                "pricing_ms": timing.parts_ms["pricing"],
                "line_search_ms": timing.parts_ms["line_search"],
                "pricing_us": timing.pricing_us,
            }
        )
        if progress is not None:
            progress(f"{varied} {amount}: {timing.ms:.3f} ms per iteration, {timing.neighbours:.0f} neighbours")
    return rows


def cases(quick: bool = False) -> Iterator[tuple[str, int, Scene, Robot, int]]:
    """What is varied, its amount, scene, robot, phases."""
    import mcplan

    count = 2 if quick else None
    robot = mcplan.load_robot("humanoid44")
    for phases in PHASES[:count]:
        yield "phases", phases, long_floor(phases), robot, phases
    for feet in FEET[:count]:
        yield "end_effectors", feet, long_floor(18), with_feet(robot, feet), 18
    for tiles in TILES[:count]:
        yield "surfaces", tiles, tiled_floor(tiles), robot, 18


def long_floor(phases: int) -> Scene:
    """flat with its path of 2 m in 18 phases stretched in proportion to the phases."""
    import mcplan

    scene = mcplan.load_scene("flat")
    displacement = 2.0 * phases / 18.0
    scene.goal.position_W = np.array([displacement, 0.0, 0.0])
    surface = scene.surfaces[0]
    surface.vertices_W = [
        [-1.0, -5.0, 0.0],
        [displacement + 3.0, -5.0, 0.0],
        [displacement + 3.0, 5.0, 0.0],
        [-1.0, 5.0, 0.0],
    ]
    return scene


def tiled_floor(tiles: int) -> Scene:
    """flat with its floor cut across the path into so many surfaces, from 0.5 m behind the start to 0.5 m past the goal."""
    import mcplan

    scene = mcplan.load_scene("flat")
    cuts = np.linspace(-0.5, 2.5, tiles + 1)
    surfaces = []
    for i, (begin, end) in enumerate(zip(cuts, cuts[1:], strict=False)):
        tile = scene.surfaces[0].__copy__()
        tile.name = f"tile_{i}"
        tile.vertices_W = [[begin, -1.0, 0.0], [end, -1.0, 0.0], [end, 1.0, 0.0], [begin, 1.0, 0.0]]
        surfaces.append(tile)
    scene.surfaces = surfaces
    scene.steps = []  # they name the floor that was cut
    for stance in (scene.start, scene.goal):
        at = min(int(np.searchsorted(cuts, stance.position_W[0], side="right")) - 1, tiles - 1)
        stance.contacts = {who: f"tile_{at}" for who in stance.contacts}
    return scene


def with_feet(robot: Robot, feet: int) -> Robot:
    """The robot with so many feet and no hands: its own two, then copies of them to the front and to the back."""
    out = robot.__copy__()
    own = [end for end in robot.end_effectors if end.kind == "foot"]
    end_effectors = []
    for i in range(feet):
        row = i // len(own)
        end = own[i % len(own)].__copy__()
        shift = np.array([0.25 * ((row + 1) // 2) * (-1.0 if row % 2 else 1.0), 0.0, 0.0])
        end.name = f"{end.name}_{row}"
        for field in ("nominal_B", "reach_min_B", "reach_max_B"):
            setattr(end, field, getattr(end, field) + shift)
        if end.reach_cut.given:
            A, b = np.asarray(end.reach_cut.A), np.asarray(end.reach_cut.b)
            end.reach_cut = type(end.reach_cut)(A=A, b=b + A @ shift)
        end_effectors.append(end)
    out.end_effectors = end_effectors
    return out


def exponent(rows: Sequence[dict[str, Any]], varied: str, of: str, by: str) -> float:
    """Slope of log(of) over log(by) by least squares, among the rows where `varied` was varied."""
    chosen = [row for row in rows if row["varied"] == varied and row[of] > 0.0 and row[by] > 0.0]
    if len({row[by] for row in chosen}) < 2:
        return float("nan")
    slope, _ = np.polyfit(np.log([row[by] for row in chosen]), np.log([row[of] for row in chosen]), 1)
    return float(slope)


def exponents(rows: Sequence[dict[str, Any]]) -> dict[str, float]:
    """What the theory predicts to be 1 (but for the Riccati recursion over end-effectors, up to 3)."""
    return {
        "iteration_over_phases": exponent(rows, "phases", "iteration_ms", "phases"),
        "linearise_over_phases": exponent(rows, "phases", "linearise_ms", "phases"),
        "value_functions_over_phases": exponent(rows, "phases", "value_functions_ms", "phases"),
        "pricing_over_neighbours_phases": exponent(rows, "phases", "pricing_ms", "neighbours"),
        "iteration_over_end_effectors": exponent(rows, "end_effectors", "iteration_ms", "end_effectors"),
        "iteration_over_surfaces": exponent(rows, "surfaces", "iteration_ms", "surfaces"),
    }
