"""TOWR (Winkler et al. 2018) on the goals of tasks.py.

Its sources are not on PyPI or in Debian: they are cloned from GitHub at fixed commits, or taken from folders `towr` and
`ifopt` that are there already, and compiled with Debian's Ipopt.

What it is given beyond scene, robot, start and goal: how many steps each foot takes, in which order, and a first guess of
when. Feet are points without moments, the ground is a height map along x. Friction pyramids are those inside the cone.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from environments import run, sources
from measures import Samples
from tasks import Answer, Task

HERE = Path(__file__).resolve().parent
SOURCES = {
    "ifopt": ("https://github.com/ethz-adrl/ifopt", "4d6267b", "."),
    "towr": ("https://github.com/ethz-adrl/towr", "d6c6787a", "towr"),
}
#: Depth of the middle of what TOWR gets where the scene has nothing to stand on at the height of both sides [m].
PIT = 0.5
#: Bounds of a phase where its duration is free [s].
SHORTEST_S, LONGEST_S = 0.1, 1.5
TIME_LIMIT_S = 60.0


def build(folder: Path, given: Path | None) -> Path:
    """The program that asks TOWR, compiled if it is not there.

    Raises:
        Unavailable: Its sources cannot be had or compiled.
    """
    program = folder / "peer/towr_peer"
    if program.exists():
        return program
    prefix = folder / "prefix"
    for name, (url, commit, under) in SOURCES.items():
        tree = sources(folder, given, name, url, commit)
        _cmake(tree / under, folder / f"build_{name}", prefix, "--target", "install")
    _cmake(HERE / "towr", folder / "peer", prefix)
    return program


def _cmake(source: Path, build_folder: Path, prefix: Path, *options: str) -> None:
    flags = [f"-D{name}={prefix}" for name in ("CMAKE_PREFIX_PATH", "CMAKE_INSTALL_PREFIX")]
    run("cmake", "-S", source, "-B", build_folder, "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTS=OFF", *flags)
    run("cmake", "--build", build_folder, "--parallel", "2", *options)


@dataclass(frozen=True)
class Gait:
    """Stances and swings of each foot in turn, stance first [s]."""

    name: str
    durations: list[list[float]]
    free: bool  #: whether TOWR may change the durations


def gaits_of(answer: Answer) -> list[Gait]:
    """mcplan's own contact sequence and timing, kept and as a first guess, and a regular gait of as many steps."""
    ours = _durations(answer.samples)
    total = sum(ours[0])
    regular = _regular(ours, total)
    return [
        Gait("sequence and times of mcplan", ours, free=False),
        Gait("sequence of mcplan, times free", ours, free=True),
        Gait("regular gait", regular, free=False),
    ]


def _durations(samples: Samples) -> list[list[float]]:
    """Times between changes of contact, by foot."""
    found = []
    for contact in samples.contacts.T:
        changes = np.flatnonzero(contact[1:] != contact[:-1]) + 1
        times = np.concatenate([[0.0], samples.times[changes], [samples.times[-1]]])
        found.append(np.diff(times).tolist())
    return found


def _regular(ours: list[list[float]], total: float) -> list[list[float]]:
    """As many swings by foot, in the order of ours, of equal length and evenly spaced over the same time.

    Swings of ours that begin together, as in a jump, begin together here too.
    """
    begins = sorted({round(sum(each[:k]), 3) for each in ours for k in range(1, len(each), 2)})
    slot = total / (len(begins) + 1.0)
    regular = []
    for each in ours:
        row, last = [], 0.0
        for k in range(1, len(each), 2):
            begin = slot * (begins.index(round(sum(each[:k]), 3)) + 0.5)
            row += [begin - last, 0.8 * slot]
            last = begin + 0.8 * slot
        regular.append([*row, total - last])
    return regular


def problem_of(task: Task, gait: Gait) -> dict[str, Any]:
    """What towr_peer reads."""
    limits = task.limits
    deviation = ((limits.reach_max - limits.reach_min) / 2.0).min(axis=0)
    return {
        "mass": limits.mass,
        "inertia": task.inertia.tolist(),
        "friction": limits.friction / np.sqrt(2.0),  # the pyramid inside the cone
        "deviation": deviation.tolist(),
        "max_force": task.max_force,
        "start": task.start_com_W.tolist(),
        "goal": task.goal_com_W.tolist(),
        "terrain": _terrain(limits.profile),
        "feet": [
            {"nominal": nominal.tolist(), "start": start.tolist(), "durations": durations}
            for nominal, start, durations in zip(task.nominal, task.start_feet_W, gait.durations, strict=True)
        ],
        "free_timing": gait.free,
        "shortest_s": SHORTEST_S,
        "longest_s": min(LONGEST_S, 0.9 * sum(gait.durations[0])),
        "time_limit_s": TIME_LIMIT_S,
    }


def _terrain(profile: list[tuple[float, float, float]]) -> list[dict[str, float]]:
    """Level pieces, and what lies between: the lower side's height, or a parabolic pit between sides of one height."""
    pieces = [{"from": begin, "to": end, "height": z, "depth": 0.0} for begin, end, z in profile]
    for before, after in zip(profile, profile[1:], strict=False):
        depth = PIT if before[2] == after[2] else 0.0
        pieces.append({"from": before[1], "to": after[0], "height": min(before[2], after[2]), "depth": depth})
    return pieces


def plan(program: Path, task: Task, gait: Gait, folder: Path) -> tuple[dict[str, Any], Samples]:
    """TOWR's report and its motion, each millisecond."""
    folder.mkdir(parents=True, exist_ok=True)
    problem, rows, report = folder / "problem.json", folder / "samples.csv", folder / "report.json"
    problem.write_text(json.dumps(problem_of(task, gait), indent=1))
    run(program, problem, rows, report)
    table = np.loadtxt(rows, delimiter=",")
    feet = table[:, 13:].reshape(len(table), len(task.feet), 7)
    samples = Samples(
        times=table[:, 0],
        com_W=table[:, 1:4],
        com_acceleration_W=table[:, 4:7],
        base_rpy=table[:, 7:10],
        angular_momentum_W=table[:, 10:13],
        contacts=feet[:, :, 0] > 0.5,
        feet_W=feet[:, :, 1:4],
        forces_W=feet[:, :, 4:7],
        moments_W=np.zeros_like(feet[:, :, 4:7]),
    )
    return json.loads(report.read_text()), samples
