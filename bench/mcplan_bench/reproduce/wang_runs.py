"""The walks behind the tables and figures of Wang et al.: which are run, what is kept of them, and their file."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan.errors import InvalidInput
from mcplan_bench import records

if TYPE_CHECKING:
    from mcplan import Plan
    from mcplan._core.rhp import RecedingHorizon, State

TERRAINS = ("up_and_down", "v_shape", "rubbles")
METHODS = ("single", "com", "rectangle", "point")

ROBOT = "talos_wang"

#: Predicted steps of the methods in Table III.
TABLE_3 = (("single", 1), ("single", 2), ("rectangle", 2), ("point", 2))

#: Those with noisy starts: of Table III, and of Table II with the horizon at which the paper's controller fails.
NOISY = (*TABLE_3, ("rectangle", 1), ("point", 1))

#: Longest horizon at which `com` is tried: it fails in the same cycle whatever the horizon.
COM_PREDICTED = 2

#: Wall clock of a cycle [s]: `com` spends hundreds of iterations to say that it fails.
TIME_LIMIT_S = {"single": 120.0, "com": 10.0, "rectangle": 120.0, "point": 120.0}

#: The solver of our own, with which the walks of Table III are made once more.
KERNEL = "ipm"

NOISE = 0.05
#: What the noise of a start is a ratio to: lengths of a step ahead, between the feet and from the floor to the CoM [m],
#: and the bounds of velocity [m/s] and angular momentum [kg m^2/s].
LENGTHS_M = np.array([0.3, 0.2, 0.75])
VELOCITY = 1.5
MOMENTUM = 2.5

FILE = "runs.json"


@dataclass(frozen=True)
class Config:
    """One walk to be made."""

    terrain: str
    method: str
    predicted: int  #: steps in the prediction horizon (PH); lookahead is one more
    seed: int = 0  #: 0: from the scene's start; else of the noise on it
    transcription: str = "euler"  #: the paper's; or "trapezoidal", whose motion is the integral of its forces
    solver: str = "ipopt"  #: of the programs; or "ipm", mcplan's own

    @property
    def title(self) -> str:
        """For lines of progress."""
        seed = f", seed {self.seed}" if self.seed else ""
        form = "" if self.transcription == "euler" else f", {self.transcription}"
        kernel = "" if self.solver == "ipopt" else f", {self.solver}"
        return f"{self.terrain}, {self.method}, {self.predicted}-step PH{seed}{form}{kernel}"


@dataclass
class Run:
    """What is kept of a walk."""

    config: Config
    asked: int  #: cycles
    load: float = 0.0  #: of the machine, processes that want to run, at the end
    cycles: list[dict[str, Any]] = field(default_factory=list)

    @property
    def success(self) -> bool:
        """Every cycle converged, within the program's constraints."""
        return len(self.cycles) == self.asked and all(cycle["converged"] for cycle in self.cycles)

    @property
    def distance_m(self) -> float:
        return float(sum(cycle["distance_m"] for cycle in self.cycles))

    @property
    def acc_per_m(self) -> float:
        return self._per_m("acceleration_cost")

    @property
    def momentum_per_m(self) -> float:
        return self._per_m("momentum_cost")

    @property
    def cost_per_m(self) -> float:
        """The paper's accumulated cost: running cost of the executed steps over the distance."""
        return self.acc_per_m + self.momentum_per_m

    def _per_m(self, key: str) -> float:
        return float(sum(cycle[key] for cycle in self.cycles)) / max(abs(self.distance_m), 1e-9)

    @property
    def failure(self) -> str:
        """Status and number of the cycle that failed, counted from 1, or ""."""
        bad = [cycle for cycle in self.cycles if not cycle["converged"]]
        return f"{bad[0]['status']} in cycle {bad[0]['index'] + 1}" if bad else ""


def configs(
    lookahead_max: int, seeds: int, terrains: Iterable[str] = TERRAINS, trapezoidal: bool = True
) -> list[Config]:
    """The walks of all tables and figures, those that the tables need first.

    Args:
        lookahead_max: Longest horizon in steps, the executed one included; at least 2.
        seeds: Noisy starts of the walks of Tables II and III with one and two predicted steps.
        terrains: Where they are made.
        trapezoidal: With those of Table II whose motion is the integral of their forces.
    """
    out: list[Config] = []

    def add(method: str, predicted: int, seed: int = 0, transcription: str = "euler", solver: str = "ipopt") -> None:
        out.extend(Config(terrain, method, predicted, seed, transcription, solver) for terrain in terrains)

    longest = lookahead_max - 1
    first = [cell for cell in TABLE_3 if cell[1] <= longest]
    first += [("point", 1), ("rectangle", 1)]
    first += [("com", predicted) for predicted in range(1, min(longest, COM_PREDICTED) + 1)]
    longer = [(m, p) for p in range(2, longest + 1) for m in ("point", "single", "rectangle") if (m, p) not in first]
    for method, predicted in first:
        add(method, predicted)
    for method, predicted in TABLE_3:
        if predicted <= longest:
            add(method, predicted, solver=KERNEL)
    for method, predicted in NOISY:
        if trapezoidal and predicted <= longest:
            add(method, predicted, transcription="trapezoidal")
    for method, predicted in longer:
        add(method, predicted)
    for seed in range(1, seeds + 1):
        for method, predicted in NOISY:
            if predicted <= longest:
                add(method, predicted, seed)
    return out


def planner(config: Config, **more: Any) -> RecedingHorizon:
    """The paper's form, with its CoM box and friction pyramid; `more` are further options."""
    import mcplan
    from mcplan._core import rhp

    options = rhp.Options()
    options.fidelity = getattr(rhp.Fidelity, config.method)
    options.lookahead = config.predicted + 1
    options.transcription = getattr(rhp.Transcription, config.transcription)
    options.solver = rhp.Solver.__members__[config.solver]
    options.paper = True
    options.time_limit_s = TIME_LIMIT_S[config.method]
    for name, value in more.items():
        setattr(options, name, value)
    return rhp.RecedingHorizon(mcplan.load_scene(config.terrain), mcplan.load_robot(ROBOT), options)


def walk(config: Config, cycles: int) -> tuple[Run, Plan]:
    """Run one walk until it is done or a cycle fails.

    Returns:
        What is kept of it, and its plan.
    """
    horizon = planner(config)
    run = Run(config, cycles)
    for index in range(cycles):
        before = time.thread_time()
        if index == 0 and config.seed:
            cycle = horizon.step(noisy(horizon.state(), config.seed))
        else:
            cycle = horizon.step()
        cpu_s = time.thread_time() - before
        status = str(cycle.status)
        run.cycles.append(
            {
                "index": cycle.index,
                "status": status,
                "message": cycle.message,
                "converged": bool(cycle.executed) and status in ("solved", "acceptable"),
                "iterations": cycle.iterations,
                "time_s": cycle.time_s,
                "cpu_s": cpu_s,
                "evaluation_s": cycle.evaluation_s,
                "linear_solver_s": cycle.linear_solver_s,
                "variables": cycle.variables,
                "constraints": cycle.constraints,
                "acceleration_cost": cycle.acceleration_cost,
                "momentum_cost": cycle.momentum_cost,
                "distance_m": cycle.distance_m,
                "duration_s": cycle.duration_s,
                "defect": cycle.defect,
                "drift_com_m": cycle.drift_com_m,
                "drift_momentum": cycle.drift_momentum,
            }
        )
        if not cycle.executed:
            break
    run.load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    return run, horizon.result().plan


def noisy(start: State, seed: int) -> State:
    """A start near the nominal one: each number moved by up to 5 % of its scale, the feet on their surface."""
    random = np.random.default_rng(seed)

    def draw(scale: Any) -> Any:
        return NOISE * random.uniform(-1.0, 1.0, 3) * scale

    start.com_W = start.com_W + draw(LENGTHS_M)
    start.com_velocity_W = start.com_velocity_W + draw(VELOCITY)
    start.angular_momentum_W = start.angular_momentum_W + draw(MOMENTUM)
    # The terrains start on a level floor.
    start.feet_W = np.array([foot + draw(LENGTHS_M) * [1.0, 1.0, 0.0] for foot in start.feet_W])
    return start


def collect(
    requested: list[Config], cycles: int, out: Path, resume: bool, say: Callable[[str], None]
) -> tuple[list[Run], dict[str, Any]]:
    """Run the walks, saving after each, until all are done or Ctrl-C.

    Args:
        requested: The walks.
        cycles: Of each walk.
        out: Folder; runs.json and the plans are saved in it.
        resume: Keep what its runs.json has of the same number of cycles and run the rest.
        say: Called with a line for each walk.

    Returns:
        The runs and what they were measured with.

    Raises:
        InvalidInput: Walks are missing and those in the file are of another version.
    """
    import mcplan

    runs, about = load(out / FILE) if resume and (out / FILE).exists() else ([], {})
    runs = [run for run in runs if run.asked == cycles]
    done = {run.config for run in runs}
    missing = [config for config in requested if config not in done]
    if missing or not about:
        if runs and about["version"] != mcplan.__version__:
            rule = f"must be of version {mcplan.__version__} to be added to; use another --out"
            raise InvalidInput(f"{out / FILE}: version", rule, about["version"])
        about = {**records.machine(), "date": time.strftime("%Y-%m-%d"), "cycles": cycles, "interrupted": False}
    for number, config in enumerate(missing, start=1):
        try:
            run, plan = walk(config, cycles)
        except KeyboardInterrupt:
            about["interrupted"] = True
            say(f"Interrupted in {config.title}; what is done is saved, --resume goes on")
            break
        runs.append(run)
        if plan.phases:
            path = plan_path(out, config)
            path.parent.mkdir(exist_ok=True)
            plan.save(path)
        save(out / FILE, runs, about)
        times = [cycle["time_s"] for cycle in run.cycles]
        end = run.failure or f"{run.distance_m:.2f} m, cost {run.cost_per_m:.2f} per metre"
        say(f"{number}/{len(missing)}  {config.title}: {end}, {np.mean(times):.2f} s a cycle")
    save(out / FILE, runs, about)
    return runs, about


def plan_path(out: Path, config: Config) -> Path:
    """Where the plan of a walk is saved."""
    start = f"_seed_{config.seed}" if config.seed else ""
    form = "" if config.transcription == "euler" else f"_{config.transcription}"
    kernel = "" if config.solver == "ipopt" else f"_{config.solver}"
    return out / "walks" / f"{config.terrain}_{config.method}_{config.predicted}{start}{form}{kernel}.npz"


def save(path: Path, runs: list[Run], about: dict[str, Any]) -> Path:
    """Write all numbers as JSON."""
    return records.write_json(path, {**about, "runs": [asdict(run) for run in runs]})


def load(path: Path) -> tuple[list[Run], dict[str, Any]]:
    """Read what save() wrote."""
    about = json.loads(path.read_text(encoding="utf-8"))
    runs = [Run(**{**entry, "config": Config(**entry["config"])}) for entry in about.pop("runs")]
    return runs, about


def rows(runs: list[Run]) -> list[dict[str, Any]]:
    """One row a cycle, for a CSV file."""
    return [{**asdict(run.config), "load": run.load, **cycle} for run in runs for cycle in run.cycles]
