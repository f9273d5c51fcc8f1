"""A robot in a browser while it is simulated: a meshcat server, and poses sent to it as they come."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.kinematics.samples import sample_at
from mcplan.kinematics.urdf_model import load_model
from mcplan.view.colours import COM, end_effector_colours
from mcplan.view.extent import extent_of, scale_of
from mcplan.view.robot_urdf import mesh_figure
from mcplan.view.scene_drawing import draw_surfaces, surface_drawings
from mcplan.view.stage import Stage, node
from mcplan.view.viewpoint import camera_direction, view_points

from .server import LiveServer

if TYPE_CHECKING:
    from types import TracebackType

    from mcplan._core import Plan, Robot

Array = NDArray[np.float64]

#: Pictures a second, and instants at which a plan's CoM is drawn.
RATE_HZ, INSTANTS = 20.0, 60


class LiveView:
    """Shows a robot that moves, at real time at most, in every browser that has opened ``url``.

        with LiveView(plan) as view:
            print(view.url)
            view.wait()  # until a browser has opened it
            mp.run(plan, watch=view)

    Args:
        plan: Its scene is drawn, and its CoM.
        robot: The robot that moves, which has a URDF; None: the plan's own.
        real_time: Whether calls wait until the clock has come as far as the simulated time.

    Attributes:
        url: What to open.

    Raises:
        MissingExtra: meshcat or Pinocchio is not installed.
        InvalidRobot: The robot has no URDF, or it cannot be read.
    """

    def __init__(self, plan: Plan, robot: Robot | None = None, real_time: bool = True) -> None:
        require("mcplan.view.LiveView", "view", "meshcat", "pinocchio")
        import pinocchio as pin  # type: ignore[import-untyped]

        robot = robot or plan.robot
        self._urdf_model = load_model(robot)
        self._data = self._urdf_model.model.createData()
        self._pin, self._real_time = pin, real_time
        self._began_s: float | None = None
        self._next_s = 0.0
        self._plan: Plan | None = None
        self._stage = Stage(scale_of(robot))
        self._draw_robot(robot)
        samples = sample_at(plan, plan.scene, robot, np.linspace(0.0, plan.duration(), INSTANTS))
        extent = extent_of(plan.scene, robot, samples, 1.0, 1.0)
        drawings = surface_drawings(plan.scene, extent)
        draw_surfaces(self._stage, drawings)
        self._stage.backdrop()
        self._stage.look(view_points(drawings, samples, robot), camera_direction(extent))
        self._server = LiveServer()
        self.url: str = self._server.url
        self._draw_plan(plan)
        self._show(self._standing(plan))

    def wait(self) -> None:
        """Return when a browser has opened the page; Ctrl-C ends it."""
        self._server.wait()

    def __call__(self, time_s: float, configuration: Array, plan: Plan) -> None:
        """Show an instant, if the last picture is old enough.

        Args:
            time_s: Simulated time [s].
            configuration: (nq,) in Pinocchio's order, free-flyer first.
            plan: The one that is followed; drawn when it is another one.
        """
        if time_s < self._next_s:
            return
        self._next_s = time_s + 1.0 / RATE_HZ
        if plan is not self._plan:
            self._draw_plan(plan)
        self._show(configuration)
        now_s = time.perf_counter()
        if self._began_s is None:
            self._began_s = now_s - time_s
        elif self._real_time:
            time.sleep(max(0.0, self._began_s + time_s - now_s))

    def close(self) -> None:
        """End the server; what a browser shows stays."""
        self._server.close()

    def __enter__(self) -> LiveView:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        self.close()

    def _draw_robot(self, robot: Robot) -> None:
        """The meshes of each joint below a node of its own, which moves."""
        figure = mesh_figure(self._urdf_model, self._urdf_model.neutral[None], end_effector_colours(robot))
        names = list(self._urdf_model.model.names)
        self._joints = sorted({names.index(part.name.partition("/")[0]) for part in figure.parts})
        for part in figure.parts:
            joint, _, item = part.name.partition("/")
            self._stage.mesh(f"robot/{node(joint)}/{node(item)}", part.mesh, part.colour)

    def _draw_plan(self, plan: Plan) -> None:
        """The path of the CoM."""
        self._plan = plan
        com_W = plan.sample(np.linspace(0.0, plan.duration(), INSTANTS)).com_W
        self._stage.lines("plan/com", np.stack([com_W[:-1], com_W[1:]], axis=1), COM)

    def _standing(self, plan: Plan) -> Array:
        """The nominal posture at the plan's start."""
        q: Array = self._urdf_model.neutral.copy()
        self._pin.forwardKinematics(self._urdf_model.model, self._data, q)
        com = self._pin.centerOfMass(self._urdf_model.model, self._data, q)
        q[:3] += np.asarray(plan.knots[0].com_W) - com
        return q

    def _show(self, configuration: Array) -> None:
        self._pin.forwardKinematics(self._urdf_model.model, self._data, configuration)
        names = self._urdf_model.model.names
        for joint in self._joints:
            self._stage.place(f"robot/{node(names[joint])}", self._data.oMi[joint].homogeneous)
        self._server.show(self._stage)
