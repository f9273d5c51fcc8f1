"""The picture of theory/ipm.md: what a cycle of a walk costs with each solver, over the look-ahead, and its parts."""

from __future__ import annotations

import statistics
import time
from collections.abc import Mapping
from dataclasses import dataclass

STEPS = range(2, 11)  # with one step there is no walk over this terrain
CYCLES = 3
SOLVERS = {"ipopt": "Ipopt", "ipm": "kernel"}
COLOURS = {"ipopt": "tab:orange", "ipm": "tab:blue"}
PARTS = {"linear systems": "tab:purple", "functions and the rest": "tab:green"}
BARS = (3, 10)  # look-aheads whose parts are shown
INCHES, DPI = (10.0, 3.8), 110


@dataclass(frozen=True)
class Cycle:
    """Medians over the cycles of a walk: CPU time [s], the parts of an iteration [s], and iterations."""

    cpu_s: float
    parts_s: Mapping[str, float]
    iterations: float


def measured(terrain: str, solver: str, steps: int) -> Cycle:
    """Walk a few cycles with `point` forces and look `steps` steps ahead.

    Args:
        terrain: Name of a scene with steps.
        solver: "ipopt" or "ipm".
        steps: Look-ahead, the executed step included.
    """
    import mcplan
    from mcplan import rhp

    scene, robot = mcplan.load_scene(terrain), mcplan.load_robot("talos_wang")
    planner = rhp.receding_horizon(scene, robot, fidelity="point", lookahead=steps, solver=solver, cycles=CYCLES)
    cpu, iterations = [], []
    parts: dict[str, list[float]] = {name: [] for name in PARTS}
    for _ in range(CYCLES):
        begin = time.thread_time()
        cycle = planner.step()
        cpu.append(time.thread_time() - begin)
        iterations.append(cycle.iterations)
        each = cpu[-1] / cycle.iterations
        # Clocks of the parts are wall clocks: what of the cycle is each one's holds on a loaded machine, too.
        linear = cycle.linear_solver_s / cycle.time_s
        for name, share in zip(PARTS, (linear, 1.0 - linear), strict=True):
            parts[name].append(share * each)
    return Cycle(
        statistics.median(cpu),
        {name: statistics.median(values) for name, values in parts.items()},
        statistics.median(iterations),
    )


def save(terrain: str, picture: str) -> None:
    """Measure and draw; what is drawn is printed, too.

    Args:
        terrain: Name of a scene with steps.
        picture: Path of the PNG file.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    found = {}
    for steps in STEPS:
        for solver in SOLVERS:
            found[solver, steps] = one = measured(terrain, solver, steps)
            inside = ", ".join(f"{name} {1e3 * value:.2f}" for name, value in one.parts_s.items())
            print(
                f"{steps:2} {SOLVERS[solver]:6} {1e3 * one.cpu_s:6.0f} ms, {one.iterations:3.0f} iterations of [ms]: {inside}",
                flush=True,
            )
    figure, (times, bars) = pyplot.subplots(1, 2, figsize=INCHES, width_ratios=(3, 2), layout="constrained")
    for solver, name in SOLVERS.items():
        times.plot(STEPS, [found[solver, n].cpu_s for n in STEPS], "o-", color=COLOURS[solver], label=name)
    times.set(xlabel="steps ahead", ylabel="CPU time of a cycle [s]", xticks=list(STEPS), ylim=(0.0, None))
    times.set_title(f"{terrain}, point forces, medians of {CYCLES} cycles")
    times.legend()
    labels = []
    for place, (steps, solver) in enumerate((n, s) for n in BARS for s in SOLVERS):
        labels.append(f"{SOLVERS[solver]}\n{steps} steps")
        below = 0.0
        for part, colour in PARTS.items():
            height = 1e3 * found[solver, steps].parts_s[part]
            bars.bar(place, height, bottom=below, color=colour, label=part if place == 0 else None)
            below += height
    bars.set(
        xticks=range(len(labels)), xticklabels=labels, ylabel="CPU time of an iteration [ms]", title="and its parts"
    )
    bars.set_ylim(0.0, 1.3 * bars.get_ylim()[1])  # room for the legend
    bars.legend(loc="upper left")
    figure.savefig(picture, dpi=DPI)
