"""What a sweep consists of: one task for each scene, robot, value of the options and seed, always in the same order."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

from mcplan.errors import InvalidArgument, InvalidSweep, shown

if TYPE_CHECKING:
    from mcplan.files.sweep_specs import SceneEntry, SweepSpec

_SHARD = "must be i/n with 1 <= i <= n"
#: Tasks in a folder of records or plans.
_PER_FOLDER = 1000


@dataclass(frozen=True)
class Task:
    """One solve: plain data, which alone decides what comes of it.

    Attributes:
        index: Its place in the sweep.
        entry: Name of its entry among the scenes.
        generator: Terrain; None: the scene is loaded.
        source: What the scene is loaded by.
        parameters: Of the scene.
        robot: Name or file of the robot, as the sweep says it.
        robot_source: What it is loaded by.
        engine: The planner.
        options: Of the planner.
        seed: Of the planner.
        motion: Joints of the whole-body motion that is found along a solved plan; "": none is.
        exports: Formats in which the certified motion is exported, or the solved plan of a sweep without motions.
    """

    index: int
    entry: str
    generator: str | None
    source: str
    parameters: Mapping[str, Any]
    robot: str
    robot_source: str
    engine: str
    options: Mapping[str, Any] = field(default_factory=dict)
    seed: int = 0
    motion: str = ""
    exports: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """What it is called in messages: the number and what is needed to find it in the tables."""
        parameters = "".join(f" {name}={_short(value)}" for name, value in self.parameters.items())
        options = "".join(f" {name}={_short(value)}" for name, value in self.options.items())
        seed = f" seed {self.seed}" if self.seed else ""
        return f"task {self.index}: {self.entry}{parameters}, {self.robot}{options}{seed}"

    @property
    def stem(self) -> str:
        """Its files, without folder of their kind and ending."""
        return f"{self.index // _PER_FOLDER:04d}/{self.index:07d}"


def tasks_of(spec: SweepSpec, folder: Path = Path(".")) -> list[Task]:
    """All tasks of a sweep.

    What is drawn for a parameter depends on the sweep's seed, the name of the entry, the number of the sample and the name
    of the parameter alone: the same scenes for every robot and every value in a grid, which can so be compared in pairs,
    and draws that stay when another parameter is added.

    Args:
        spec: The sweep.
        folder: From which its paths are seen.

    Raises:
        InvalidSweep: There are more than MAX_TASKS.
    """
    from mcplan.files.sweep_specs import MAX_TASKS, number_of_tasks

    if (number := number_of_tasks(spec)) > MAX_TASKS:
        raise InvalidSweep("scenes", f"must give at most {MAX_TASKS} tasks", str(number))
    out: list[Task] = []
    for entry in spec.scenes:
        source = located(entry.scene, folder) if entry.scene is not None else ""
        for robot, parameters, options, seed in _combinations(spec, entry):
            robot_source = located(robot, folder)
            out.append(
                Task(
                    len(out), entry.title, entry.generator, source, parameters, robot, robot_source, spec.engine,
                    options, seed, spec.motion or "", tuple(spec.exports),
                )
            )  # fmt: skip
    return out


def located(source: str, folder: Path) -> str:
    """What a scene or robot is loaded by, wherever a worker has been started: a built-in name or an absolute path."""
    from mcplan.files.robots import list_robots
    from mcplan.files.scenes import list_scenes
    from mcplan.files.sweep_specs import place

    found = place(source, folder)
    return found if found in (*list_scenes(), *list_robots()) else str(Path(found).absolute())


def share_of(tasks: Sequence[Task], shard: tuple[int, int] | None) -> list[Task]:
    """The tasks of a shard (i, n), 1 <= i <= n: every n-th from the i-th on, so that each has some of every entry.

    Raises:
        InvalidArgument: There is no such shard.
    """
    require_shard(shard)
    return list(tasks) if shard is None else list(tasks[shard[0] - 1 :: shard[1]])


def require_shard(shard: Any) -> None:
    """Refuse what is no shard.

    Raises:
        InvalidArgument: It is neither None nor (i, n) with 1 <= i <= n.
    """
    if shard is None:
        return
    whole = isinstance(shard, tuple | list) and len(shard) == 2 and all(type(part) is int for part in shard)
    if not whole:
        raise InvalidArgument("shard", "must be None or (i, n) with whole numbers 1 <= i <= n", shown(shard))
    if not 1 <= shard[0] <= shard[1]:
        raise InvalidArgument("shard", _SHARD, f"{shard[0]}/{shard[1]}")


def parse_shard(text: str) -> tuple[int, int]:
    """The shard of "i/n".

    Raises:
        InvalidArgument: It is something else.
    """
    first, slash, second = text.partition("/")
    if not (slash and text.isascii() and first.isdecimal() and second.isdecimal() and len(text) < 20):
        raise InvalidArgument("shard", _SHARD, shown(text))
    shard = int(first), int(second)
    require_shard(shard)
    return shard


def _combinations(spec: SweepSpec, entry: SceneEntry) -> Iterator[tuple[str, dict[str, Any], dict[str, Any], int]]:
    """Robot, parameters, options and seed of each task of an entry."""
    grids, drawn = _apart(entry.parameters)
    defaults = _defaults(entry)
    option_grids, option_drawn = _apart(spec.options)
    for robot, point in itertools.product(entry.robots or spec.robots, _product(grids)):
        for sample in range(entry.samples):
            key = f"{spec.seed}/{entry.title}/{sample}"
            parameters = defaults | point | {n: v.draw(Random(f"{key}/{n}")) for n, v in drawn.items()}
            if "seed" in parameters and parameters["seed"] is None:
                parameters["seed"] = Random(f"{key}/seed").randrange(2**31)
            for options, seed in itertools.product(_product(option_grids), spec.seeds):
                chosen = options | {n: v.draw(Random(f"{key}/options.{n}")) for n, v in option_drawn.items()}
                yield robot, parameters, chosen, seed


def _defaults(entry: SceneEntry) -> dict[str, Any]:
    """Of the terrain; a seed that is to be drawn is None."""
    from mcplan.files.sweep_terrains import GENERATORS

    own = GENERATORS[entry.generator].parameters if entry.generator else {}
    return {name: parameter.default for name, parameter in own.items()}


def _apart(values: Mapping[str, Any]) -> tuple[dict[str, list[Any]], dict[str, Any]]:
    """What stands in grids, single values included, and what is drawn."""
    grids: dict[str, list[Any]] = {}
    drawn: dict[str, Any] = {}
    for name, value in values.items():
        points = value.points() if hasattr(value, "points") else [value]
        if points is None:
            drawn[name] = value
        else:
            grids[name] = points
    return grids, drawn


def _product(grids: Mapping[str, list[Any]]) -> Iterator[dict[str, Any]]:
    for values in itertools.product(*grids.values()):
        yield dict(zip(grids, values, strict=True))


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
