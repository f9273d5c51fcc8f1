"""The search for a plan in a browser while it goes on: iterates, and the plan that comes of them."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np

from mcplan.extras import require
from mcplan.kinematics.samples import sample, sample_at
from mcplan.view.colours import COM, end_effector_colours
from mcplan.view.extent import extent_of, require_drawable, scale_of
from mcplan.view.figure_choice import figure_of
from mcplan.view.pages.stances import draw_stances
from mcplan.view.plan_drawing import draw_footprint, draw_plan
from mcplan.view.scene_drawing import draw_surfaces, surface_drawings
from mcplan.view.shapes import tube
from mcplan.view.stage import Stage, node
from mcplan.view.viewpoint import camera_direction

from .server import LiveServer

if TYPE_CHECKING:
    from types import TracebackType

    from mcplan._core import Plan, Robot, Scene

#: Instants at which paths are drawn, and frames a second of the plan that is shown at the end.
INSTANTS, FRAME_RATE = 80, 30.0
#: Nodes of draw_plan.
OF_PLAN = ("robot", "com", "paths", "contacts", "forces")


class PlanningView:
    """Shows the iterates of a search in every browser that has opened ``url``: paths of CoM and end-effectors, footholds.

        with PlanningView(scene, robot) as view:
            print(view.url)
            view.wait()  # until a browser has opened it
            view.show(mp.plan(scene, robot, watch=view).plan)

    Args:
        scene: The scene.
        robot: The robot; it stands at the start, and pale at the goal.
        hold_s: How long a picture stays at least [s]. A new contact sequence is always shown, so the search goes on no
            faster than that; other iterates are left out meanwhile.

    Attributes:
        url: What to open.
        iterates, pictures: How many iterates there were, and how many were shown.

    Raises:
        MissingExtra: meshcat is not installed, or Pinocchio for a robot with a URDF.
        InvalidScene, InvalidRobot: The robot cannot stand at start or goal, or something cannot be drawn.
    """

    def __init__(self, scene: Scene, robot: Robot, hold_s: float = 0.05) -> None:
        require("mcplan.view.PlanningView", "view", "meshcat")
        require_drawable(scene)
        robot.validate()
        self._scene, self._robot, self._hold_s = scene, robot, hold_s
        self._colours = end_effector_colours(robot)
        self._sequence: list[list[int]] = []
        self._next_s = 0.0
        self.iterates = self.pictures = 0
        self._stage = Stage(scale_of(robot))
        extent = extent_of(scene, robot, None, length=0.9, width=0.9)
        draw_surfaces(self._stage, surface_drawings(scene, extent))
        standing, _ = draw_stances(self._stage, scene, robot, 1.0)
        self._stage.backdrop()
        self._stage.look(standing, camera_direction(extent))
        self._server = LiveServer()
        self.url: str = self._server.url
        self._server.show(self._stage)

    def wait(self) -> None:
        """Return when a browser has opened the page; Ctrl-C ends it."""
        self._server.wait()

    def __call__(self, plan: Plan) -> None:
        """Show an iterate: the option ``watch`` of mcplan.plan and mcplan.replan.

        Args:
            plan: The iterate.
        """
        self.iterates += 1
        sequence = plan.contact_sequence()
        left_s = self._next_s - time.perf_counter()
        if left_s > 0.0:
            if sequence == self._sequence:
                return
            time.sleep(left_s)
        self._sequence = sequence
        samples = sample_at(plan, plan.scene, self._robot, np.linspace(0.0, plan.duration(), INSTANTS))
        scale = scale_of(self._robot)
        self._stage.remove("iterate")
        self._stage.mesh("iterate/com", tube(samples.com_W, 0.011 * scale), COM, glow=0.25)
        for end, colour in enumerate(self._colours):
            path = f"iterate/{node(self._robot.end_effectors[end].name)}"
            self._stage.mesh(path, tube(samples.positions_W[:, end], 0.005 * scale, sides=6), colour, glow=0.25)
        for number, interval in enumerate(samples.intervals):
            draw_footprint(self._stage, number, interval, self._robot, self._colours[interval.end_effector], "iterate")
        self._server.show(self._stage)
        self.pictures += 1
        self._next_s = time.perf_counter() + self._hold_s

    def show(self, plan: Plan) -> None:
        """Show the plan that has been found: the robot walks it, over and over.

        Args:
            plan: The plan; one without phases leaves the last iterate as it is.

        Raises:
            InvalidPlan: The plan's arrays do not fit together.
        """
        if not plan.phases:
            return
        plan.validate()
        for path in ("iterate", "stances", *OF_PLAN):
            self._stage.remove(path)
        samples = sample(plan, plan.scene, plan.robot, FRAME_RATE)
        figure = figure_of(samples, plan.robot, self._colours)
        draw_plan(self._stage, samples, plan.scene, plan.robot, figure, self._colours)
        self._server.show(self._stage)

    def close(self) -> None:
        """End the server; what a browser shows stays."""
        self._server.close()

    def __enter__(self) -> PlanningView:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        self.close()
