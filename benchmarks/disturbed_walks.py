"""Walks of robots and on ground that are not as planned, with a push: how many of the seeds stay up?

    python benchmarks/disturbed_walks.py flat stairs_broad [--robot talos] [--seeds 20] [--newtons 100] [--jobs 2]
    python benchmarks/disturbed_walks.py stairs_broad --ground heights --newtons 0       # treads 3 cm higher or lower
    python benchmarks/disturbed_walks.py stairs_broad --ground slippery --newtons 0      # one tread with friction 0.1
    python benchmarks/disturbed_walks.py rubbles --engine rhp

A seed draws mass, friction, height of all the ground, a push of up to 40 N, motors and sensors, as for `mcplan run --seed`, and
when and in which direction a push of `--newtons` acts for 0.2 s; with `--ground heights` the height of each surface, too, but for
those on which the walk begins and ends, with `--ground slippery` which surface is slippery. Latency is fixed, so that a seed
gives the same run on every machine. Exit code 1 after a fall.
"""

from __future__ import annotations

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np

import mcplan as mp

PUSH_S = 0.2
#: Heights by which surfaces differ [m], and friction of the slippery one.
HEIGHT_M, SLIPPERY = 0.03, 0.1


@dataclass(frozen=True)
class Case:
    """One walk."""

    scene: str
    robot: str
    engine: str
    ground: str
    seed: int
    newtons: float
    latency_s: float


def first_plan(case: Case) -> mp.Plan:
    """What the run begins with."""
    if case.engine == "rhp":
        return mp.walk(case.scene, case.robot, fidelity="point", lookahead=3).plan
    return mp.plan(case.scene, case.robot).plan


def true_scene(plan: mp.Plan, ground: str, random: np.random.Generator) -> mp.Scene:
    """The plan's scene with other heights, or one slippery surface."""
    scene = plan.scene.__copy__()
    ends = {*dict(scene.start.contacts).values(), *dict(scene.goal.contacts).values()}
    surfaces = [surface.__copy__() for surface in scene.surfaces]
    between = [surface for surface in surfaces if surface.name not in ends]
    if not between:
        raise SystemExit(f"--ground {ground}: the walk begins and ends on the only surfaces of the scene")
    if ground == "slippery":
        between[random.integers(len(between))].friction = SLIPPERY
    else:
        for surface in between:
            shift = HEIGHT_M * random.choice([-1.0, 1.0])
            surface.vertices_W = [[x, y, z + shift] for x, y, z in surface.vertices_W]
    scene.surfaces = surfaces
    return scene


def run(case: Case) -> dict[str, Any]:
    """One walk: what came of it."""
    plan, random = first_plan(case), np.random.default_rng(case.seed)
    named: dict[str, Any] = {"latency": case.latency_s, "engine": case.engine, "seed": case.seed}
    at_s, direction_deg = random.uniform(0.5, max(1.0, 0.8 * plan.duration())), random.uniform(0.0, 360.0)
    if case.newtons > 0.0:
        named["push"] = (case.newtons, PUSH_S, float(at_s), float(direction_deg))
    if case.ground != "as_planned":
        named["true_scene"] = true_scene(plan, case.ground, random)
    result = mp.run(plan, **named)
    measures, online = result.measures, result.online
    return {
        "up": not measures.fell,
        "seconds": measures.completed_s,
        "off_goal_m": online.goal_off_m,
        "com_max_mm": 1e3 * measures.com_max_m,
        "replans": online.replans,
        "used": online.replans_used,
        "stops": online.stops,
    }


def main() -> int:
    """Run the seeds of each scene."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--robot", default="talos")
    parser.add_argument("--engine", choices=["ddp", "rhp"], default="ddp")
    parser.add_argument("--ground", choices=["as_planned", "heights", "slippery"], default="as_planned")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--newtons", type=float, default=100.0)
    parser.add_argument("--latency", type=float, default=0.02)
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    fell = 0
    for scene in arguments.scenes:
        cases = [
            Case(scene, arguments.robot, arguments.engine, arguments.ground, seed, arguments.newtons, arguments.latency)
            for seed in range(1, arguments.seeds + 1)
        ]
        up = 0
        with ProcessPoolExecutor(arguments.jobs) as pool:
            for case, row in zip(cases, pool.map(run, cases), strict=True):
                up += row["up"]
                told = ", ".join(
                    f"{key} {value:.3g}" if isinstance(value, float) else f"{key} {value}" for key, value in row.items()
                )
                print(f"{scene}, seed {case.seed}: {told}", flush=True)
        print(
            f"{scene}, {arguments.robot}, {arguments.newtons:g} N, ground {arguments.ground}: {up} of {len(cases)} up"
        )
        fell += len(cases) - up
    return 1 if fell else 0


if __name__ == "__main__":
    sys.exit(main())
