"""The runs behind the tables of Lengagne et al.: what is kept of them, and their file."""

from __future__ import annotations

import copy
import json
import math
import os
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.errors import InvalidInput
from mcplan_bench import records

from .lengagne_paper import CASES
from .lengagne_settings import Config

if TYPE_CHECKING:
    from mcplan import PlanarPlan, sip

#: A run that takes less [s of processor time] is repeated, and medians are kept.
CHEAP_S = 1.0

#: Constraints of the checker of which the amount is kept: positions and velocities relative, balance in [N], depth in
#: solids in [m].
BEYOND = ("position", "velocity", "balance", "clearance")

FILE = "runs.json"


@dataclass
class Run:
    """What is kept of a row."""

    config: Config
    parameters: int
    constraints: int
    status: str
    message: str
    iterations: int
    time_s: float  #: wall clock, median over repeats
    cpu_s: float  #: processor time of the thread, median over repeats
    evaluation_s: float
    linear_solver_s: float
    repeats: int
    load: float  #: of the machine, processes that want to run
    duration_s: float
    cost: float | None  #: integral of squared torques [N^2 m^2 s]; None: no dynamics
    drift_m: float
    drift_rad: float
    beyond: dict[str, float]  #: what the checker measures beyond limits, by name, negative within; those of BEYOND
    certified: bool | None = None  #: None: not asked
    certify_s: float | None = None
    start: str = ""  #: empty: from P = 0; else what it was started from
    phases_s: list[float] = field(default_factory=list)

    @property
    def converged(self) -> bool:
        """The solver converged within the constraints that it was given: the paper's OK.

        The planner says `acceptable` where the checker disagrees, as it does about coarse contact constraints.
        """
        return self.status == "solved" or (self.status == "acceptable" and self.message.startswith("converged, but"))

    @property
    def verdict(self) -> str:
        """In the paper's words where they fit."""
        if self.converged:
            return "OK"
        if "more equalities than" in self.message:
            return "REFUSED"
        return {"iteration_limit": "MAX ITER", "time_limit": "TIME LIMIT"}.get(self.status, "FAILED")


def solve(config: Config, warm_start: PlanarPlan | None = None) -> tuple[sip.Result, float]:
    """One run: its result, and the processor time of the thread [s]."""
    import mcplan

    before = time.thread_time()
    result = mcplan.whole_body(config.motion, warm_start=warm_start, **config.options())
    return result, time.thread_time() - before


def run(
    config: Config, repeats: int = 1, warm_start: PlanarPlan | None = None, start: str = ""
) -> tuple[Run, PlanarPlan]:
    """Run a row, several times if it is quick; a solution of Table IV is certified.

    Args:
        config: The row.
        repeats: Runs of a quick row.
        warm_start: Plan to start from; None: P = 0.
        start: What that plan is.

    Returns:
        What is kept of it, and the plan.
    """
    import mcplan

    result, cpu_s = solve(config, warm_start)
    times, cpus = [result.report.time_s], [cpu_s]
    while len(times) < repeats and cpu_s < CHEAP_S:
        again, more_s = solve(config, warm_start)
        times.append(again.report.time_s)
        cpus.append(more_s)
    report, plan = result.report, result.plan
    certificate = mcplan.sip.certify(plan) if config.table == 4 and str(report.status) == "solved" else None
    found = {v.name: float(v.value) for v in mcplan.check(without_heights(plan)).constraints if v.name in BEYOND}
    return (
        Run(
            config=config,
            parameters=result.parameters,
            constraints=result.constraints,
            status=str(report.status),
            message=report.message,
            iterations=report.iterations,
            time_s=float(np.median(times)),
            cpu_s=float(np.median(cpus)),
            evaluation_s=report.timing_s.get("evaluation", 0.0),
            linear_solver_s=report.timing_s.get("linear_solver", 0.0),
            repeats=len(times),
            load=os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan"),
            duration_s=plan.duration(),
            cost=report.cost_terms.get("torque"),
            drift_m=result.drift_m,
            drift_rad=result.drift_rad,
            beyond=found,
            certified=None if certificate is None else certificate.proved(),
            certify_s=None if certificate is None else certificate.time_s,
            start=start,
            phases_s=list(plan.durations),
        ),
        plan,
    )


def without_heights(plan: PlanarPlan) -> PlanarPlan:
    """A copy whose swinging limbs need not be high in the middle of a phase, only out of solids."""
    out = copy.deepcopy(plan)
    task = out.task
    phases = list(task.phases)
    for phase in phases:
        clearances = list(phase.clearances)
        for clearance in clearances:
            clearance.middle_height = -math.inf
        phase.clearances = clearances
    task.phases = phases
    out.task = task
    return out


def collect(
    requested: Sequence[Config], out: Path, repeats: int, resume: bool, say: Callable[[str], None]
) -> tuple[list[Run], dict[str, Any]]:
    """Run the rows, saving after each, until all are done or Ctrl-C. Plans of Table IV are saved beside runs.json.

    Raises:
        InvalidInput: Rows are missing and those in the file are of another version.
    """
    import mcplan

    runs, about = load(out / FILE) if resume and (out / FILE).exists() else ([], {})
    done = {kept.config for kept in runs}
    missing = [config for config in requested if config not in done]
    if missing or not about:
        if runs and about["version"] != mcplan.__version__:
            rule = f"must be of version {mcplan.__version__} to be added to; use another --out"
            raise InvalidInput(f"{out / FILE}: version", rule, about["version"])
        about = {**records.machine(), "date": time.strftime("%Y-%m-%d"), "interrupted": False}
    for number, config in enumerate(missing, start=1):
        try:
            made = [run(config, repeats)]
            if config.table == 4:
                made += from_poorer(made[0][0], runs, out, say)
        except KeyboardInterrupt:
            about["interrupted"] = True
            say(f"Interrupted in {config.title}; what is done is saved, --resume goes on")
            break
        runs += [kept for kept, _ in made]
        if config.table == 4:
            best = min(made, key=lambda pair: merit(pair[0]))
            best[1].save(out / f"{config.key}.npz")
        save(out / FILE, runs, about)
        for kept, _ in made:
            say(f"{number}/{len(missing)}  {line(kept)}")
    save(out / FILE, runs, about)
    return runs, about


def from_poorer(cold: Run, runs: list[Run], out: Path, say: Callable[[str], None]) -> list[tuple[Run, PlanarPlan]]:
    """A second run of a richer case, from the poorer case's solution, where that is better than what P = 0 led to.

    The forces of a poorer case are among those of a richer one, so its solution can only be improved on.
    """
    import mcplan
    from mcplan.files.whole_body_plans import load_whole_body_plan

    order = list(CASES.values())
    for forces in reversed(order[: order.index(cold.config.forces)]):
        poorer = best_of(runs, 4, cold.config.motion, forces, solver=cold.config.solver)
        if poorer is None or not poorer.converged:
            continue
        if merit(cold) <= merit(poorer):
            return []
        say(f"{cold.config.title}: from P = 0 not better than {forces}; once more from there")
        plan: mcplan.PlanarPlan = load_whole_body_plan(out / f"{poorer.config.key}.npz")
        return [run(cold.config, 1, plan, forces)]
    return []


def merit(kept: Run) -> float:
    """Its cost, if it is a solution."""
    return kept.cost if kept.status == "solved" and kept.cost is not None else float("inf")


def best_of(
    runs: list[Run], table: int, motion: str, forces: str, hold: str = "tube", solver: str = "ipopt"
) -> Run | None:
    """The run of a row with dynamics, the cheaper one where there are two."""
    requested = (table, motion, forces, hold, solver)
    here = [
        r
        for r in runs
        if (r.config.table, r.config.motion, r.config.forces, r.config.hold, r.config.solver) == requested
    ]
    return min(here, key=merit, default=None)


def find(runs: list[Run], config: Config) -> Run | None:
    """The first run of a row."""
    return next((kept for kept in runs if kept.config == config), None)


def line(kept: Run) -> str:
    """For progress."""
    cost = f", cost {kept.cost:.5g}" if kept.config.table == 4 and kept.cost is not None else ""
    start = f" from {kept.start}" if kept.start else ""
    drift = f"drift {1e3 * kept.drift_m:.2g} mm"
    took = f"{kept.iterations} iterations, {kept.time_s:.2f} s ({kept.cpu_s:.2f} s processor)"
    return f"{kept.config.title}{start}: {kept.verdict}, {took}{cost}, {drift}"


def save(path: Path, runs: list[Run], about: dict[str, Any]) -> Path:
    """Write all numbers as JSON."""
    return records.write_json(path, {**about, "runs": [asdict(kept) for kept in runs]})


def load(path: Path) -> tuple[list[Run], dict[str, Any]]:
    """Read what save() wrote."""
    about = json.loads(path.read_text(encoding="utf-8"))
    runs = [Run(**{**entry, "config": Config(**entry["config"])}) for entry in about.pop("runs")]
    return runs, about
