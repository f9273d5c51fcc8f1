"""Walks of Wang et al. tracked by a simulated robot: which are, what is kept of each run, and their file."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mcplan
from mcplan.errors import Interrupted, InvalidInput
from mcplan.files.outputs import write_whole
from mcplan.files.plans import load_plan
from mcplan_bench import records

from .wang_runs import Config, Run, plan_path

if TYPE_CHECKING:
    from mcplan import Plan

#: That tracks the walks: the numbers of TALOS, whose reach and mass talos_wang has as published.
ROBOT = "talos"

#: Longest prediction horizon of the walks that are tracked: from the scene's start, and from noisy starts.
LONGEST, LONGEST_SEEDED = 3, 2

FILE = "tracked.jsonl"


@dataclass(frozen=True)
class Tracked:
    """A walk that was tracked.

    Attributes:
        config: Of the walk.
        limits: Motors lost torque with speed and links made contact; False: neither, for the paper states neither of its
            simulation.
        version: Of mcplan.
        duration_s: Of the plan.
        refused: Why the robot could not take up the plan, or "".
        completed_s: Time until it fell, or the whole run; NaN where refused, as all measures are.
        fell: Whether it fell.
        measures: Those of the run, by name, that the page or its tables show.
    """

    config: Config
    limits: bool
    version: str
    duration_s: float
    refused: str = ""
    completed_s: float = float("nan")
    fell: bool = False
    measures: dict[str, Any] | None = None

    @property
    def followed(self) -> bool:
        """To the end, without a fall."""
        return not (self.refused or self.fell)

    @property
    def ending(self) -> str:
        """In words."""
        if self.refused:
            return f"refused: {self.refused}"
        return f"falls at {self.completed_s:.1f} s of {self.duration_s:.1f} s" if self.fell else "followed"


MEASURES = (
    "com_rms_m",
    "com_max_m",
    "orientation_rms_deg",
    "final_base_error_m",
    "slip_m",
    "torque_use",
    "velocity_use",
    "torque_step_use",
    "qp_failures",
    "simulator_warnings",
    "self_contacts",
    "terrain_contacts",
)


def wanted(runs: Iterable[Run], seeds: int, longest: int = LONGEST) -> list[Config]:
    """The walks to be tracked: those that ended well, all horizons of a start before the next start.

    Args:
        runs: What was planned.
        seeds: Noisy starts that are tracked beside the scene's.
        longest: Longest prediction horizon from the scene's start.
    """

    def within(config: Config) -> bool:
        return config.predicted <= (LONGEST_SEEDED if config.seed else longest) and config.seed <= seeds

    good = [run.config for run in runs if run.success and within(run.config)]
    return sorted(good, key=lambda c: (c.seed, c.predicted > LONGEST_SEEDED, c.transcription, c.predicted, c.method))


def follow(config: Config, plan: Plan, limits: bool) -> Tracked:
    """Track a walk."""
    from mcplan.tracking import Options
    from mcplan.tracking.runner import track

    duration_s = float(plan.duration())
    try:
        result = track(plan, ROBOT, Options(speed_limits=limits, self_contacts=limits))
    except Interrupted:
        raise KeyboardInterrupt from None
    except InvalidInput as error:
        return Tracked(config, limits, mcplan.__version__, duration_s, refused=str(error))
    m = result.measures
    kept = {name: getattr(m, name) for name in MEASURES}
    return Tracked(config, limits, mcplan.__version__, duration_s, "", m.completed_s, m.fell, kept)


def collect(configs: list[Config], out: Path, resume: bool, say: Callable[[str], None]) -> tuple[list[Tracked], bool]:
    """Track walks whose plans `out` has, until all are done or Ctrl-C; a line of the file is added after each.

    Args:
        configs: The walks.
        out: Folder with their plans.
        resume: Keep what its file has of this version and run the rest.
        say: Called with a line for each run.

    Returns:
        What came of them, and whether Ctrl-C ended it.
    """
    path = out / FILE
    done = [entry for entry in load(path) if entry.version == mcplan.__version__] if resume else []
    write_whole("".join(map(_line, done)), path)
    known = {(entry.config, entry.limits): entry for entry in done}
    out_of_them: list[Tracked] = []
    for number, config in enumerate(configs, start=1):
        for limits in (True, False):
            entry = known.get((config, limits))
            if entry is None and not plan_path(out, config).exists():
                break
            if entry is None:
                began = time.process_time()
                try:
                    entry = follow(config, load_plan(plan_path(out, config)), limits)
                except KeyboardInterrupt:
                    say(f"Interrupted in {config.title}; what is done is saved, --resume goes on")
                    return out_of_them, True
                with path.open("a", encoding="utf-8") as file:
                    file.write(_line(entry))
                how = "" if limits else ", without limits of speed and contacts of links"
                spent = time.process_time() - began
                say(f"{number}/{len(configs)}  {config.title}{how}: {entry.ending}, {spent:.0f} s of processor")
            out_of_them.append(entry)
            if entry.followed or entry.refused:
                break
    return out_of_them, False


def _line(entry: Tracked) -> str:
    return json.dumps(records.plain(asdict(entry))) + "\n"


def load(path: Path) -> list[Tracked]:
    """Read what collect() wrote; a last line that was cut off is left out."""
    if not path.exists():
        return []
    entries = []
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            entry = json.loads(line)
        except json.JSONDecodeError:
            continue
        entry["completed_s"] = float("nan") if entry["completed_s"] is None else entry["completed_s"]
        entries.append(Tracked(**{**entry, "config": Config(**entry["config"])}))
    return entries
