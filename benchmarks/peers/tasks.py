"""The goals that every planner of centroidal motions gets, and mcplan's own answer to them."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from measures import Array, Limits, Samples

import mcplan as mp

#: Scene, robot. The ground of each changes along x only, which is what a height map for feet can say.
TASKS = (("flat", "humanoid44"), ("stairs", "humanoid44"), ("gap", "humanoid44"), ("flat", "anymal"))


@dataclass(frozen=True)
class Task:
    """A scene and a robot, as numbers that any planner of centroidal motions takes."""

    name: str
    feet: list[int]  #: end-effectors of the robot that are feet
    limits: Limits
    inertia: Array  #: (3) [kg m^2]
    nominal: Array  #: (E, 3), centre of the reach box [m]
    max_force: float  #: [N]
    start_com_W: Array
    start_feet_W: Array  #: (E, 3)
    goal_com_W: Array


@dataclass(frozen=True)
class Answer:
    """What mcplan finds."""

    plan: Any
    samples: Samples
    status: str
    wall_s: float
    cpu_s: float


def answer_of(scene_name: str, robot_name: str) -> tuple[Task, Answer]:
    """mcplan's plan with default options, on one thread, and the task in numbers."""
    scene, robot = mp.load_scene(scene_name), mp.load_robot(robot_name)
    wall, cpu = time.perf_counter(), time.process_time()
    result = mp.plan(scene, robot, threads=1)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    feet = [e for e, each in enumerate(robot.end_effectors) if each.kind == "foot"]
    samples = samples_of(result.plan, feet)
    lower = np.array([robot.end_effectors[e].reach_min_B for e in feet])
    upper = np.array([robot.end_effectors[e].reach_max_B for e in feet])
    limits = Limits(
        mass=robot.mass,
        gravity=scene.gravity,
        friction=min(surface.friction for surface in scene.surfaces),
        reach_min=lower,
        reach_max=upper,
        profile=profile_of(scene),
    )
    task = Task(
        name=f"{scene_name}/{robot_name}",
        feet=feet,
        limits=limits,
        inertia=np.array(robot.inertia),
        nominal=(lower + upper) / 2.0,
        max_force=min(robot.end_effectors[e].max_force for e in feet),
        start_com_W=samples.com_W[0],
        start_feet_W=samples.feet_W[0],
        goal_com_W=samples.com_W[-1],
    )
    return task, Answer(result.plan, samples, result.report.status.name, wall, cpu)


def samples_of(plan: Any, feet: list[int]) -> Samples:
    """A plan each millisecond, its feet alone."""
    found = plan.sample(np.arange(0.0, plan.duration(), 1e-3))
    return Samples(
        times=found.times,
        com_W=found.com_W,
        com_acceleration_W=found.com_acceleration_W,
        base_rpy=found.base_rpy,
        angular_momentum_W=found.angular_momentum_W,
        contacts=found.surfaces[:, feet] >= 0,
        feet_W=found.end_effectors_W[:, feet],
        forces_W=found.forces_W[:, feet],
        moments_W=found.moments_W[:, feet],
    )


def profile_of(scene: Any) -> list[tuple[float, float, float]]:
    """Level surfaces of a scene by their extent along x."""
    pieces = []
    for surface in scene.surfaces:
        corners = np.array(surface.vertices_W)
        pieces.append((float(corners[:, 0].min()), float(corners[:, 0].max()), float(corners[0, 2])))
    return sorted(pieces)
