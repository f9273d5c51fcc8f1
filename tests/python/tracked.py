"""What several tests of the controller and its runs share: robots, references and their dynamics worked out anew."""

from __future__ import annotations

import functools
import re
from pathlib import Path

import numpy as np

import mcplan as mp
from mcplan.kinematics.urdf_model import UrdfModel, load_model
from mcplan.tracking.quadratic_program import Problem, QuadraticProgram
from mcplan.tracking.references import References, references
from standing import standing_plan
from stepping import stepping_plan


@functools.cache
def urdf_model(name: str) -> UrdfModel:
    return load_model(mp.load_robot(name))


@functools.cache
def still(name: str = "talos") -> tuple[mp.Plan, References]:
    """A plan to stand still, and what it asks for every 2 ms."""
    robot = mp.load_robot(name)
    plan = standing_plan(phases=2, duration_s=0.3, robot=robot)
    return plan, references(plan, robot, 0.002, 0.2)


@functools.cache
def step_ahead(name: str = "talos") -> mp.Plan:
    """A plan of one step."""
    return stepping_plan(steps=1, robot=mp.load_robot(name))


def random_state(model, neutral: np.ndarray, rng: np.random.Generator, speed: float = 1.0):
    """Configuration and velocity far from the nominal posture, whatever the limits of joints."""
    import pinocchio as pin

    return pin.integrate(model, neutral, 0.7 * rng.normal(size=model.nv)), speed * rng.normal(size=model.nv)


class Watched(QuadraticProgram):
    """Keeps the last program and its solution."""

    problem: Problem
    solution: np.ndarray | None

    def solve(self, problem: Problem, structure: object) -> np.ndarray | None:
        self.problem, self.solution = problem, super().solve(problem, structure)
        return self.solution


def two_lanes() -> mp.Scene:
    """Level ground, its right half and its left half two surfaces, with one step of the left foot on the latter."""
    scene = mp.load_scene("flat")
    right = mp.model.Surface(name="right", vertices_W=[[-2, -2, 0], [4, -2, 0], [4, 0, 0], [-2, 0, 0]])
    left = mp.model.Surface(name="left", vertices_W=[[-2, 0, 0], [4, 0, 0], [4, 2, 0], [-2, 2, 0]])
    scene.surfaces = [right, left]
    scene.start = mp.model.Stance(contacts={"right_foot": "right", "left_foot": "left"})
    scene.goal = scene.start
    scene.steps = [mp.model.Step(end_effector="left_foot", surface="left")]
    return scene


def weakened(robot: mp.Robot, share: float, folder: Path) -> mp.Robot:
    """The robot with motors of a share of their strength."""
    whole = load_model(robot)
    text = whole.path.read_text()
    text = re.sub(r"<(visual|collision)\b.*?</\1>", "", text, flags=re.DOTALL)
    text = re.sub(r'effort="([^"]*)"', lambda m: f'effort="{share * float(m[1])}"', text)
    path = folder / "weak.urdf"
    path.write_text(text)
    model = whole.model
    weak = mp.load_robot(robot.name)
    weak.urdf = str(path)
    weak.posture = {model.names[j]: float(whole.neutral[model.joints[j].idx_q]) for j in range(2, model.njoints)}
    return weak
