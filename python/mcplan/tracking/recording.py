"""What a robot did in a run, sampled: all that pictures, plots and measures are made from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.files.plans import plan_from_bytes
from mcplan.files.robots import robot_from_dict
from mcplan.files.scenes import scene_from_dict

from .run_files import RUN, Arrays, Header, columns_of, load_run
from .touches import Touch

if TYPE_CHECKING:
    from mcplan._core import Plan, Robot, Scene, Surface

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Recording:
    """A run: n instants, one a control step; nv velocities, nj joints, e end-effectors in the order of the robot's.

    World frame W, z up, SI units. `_plan` says what the plan asks for at that instant.

    Attributes:
        plan: What was tracked; it carries scene and robot.
        joints: Names of the nj joints, in the order of configuration[7:].
        times_s: (n,) from 0, or later if the end of the run alone was kept.
        configurations: (n, 7 + nj) base position [m], base quaternion xyzw, joint positions [rad]: Pinocchio's order.
        velocities: (n, 6 + nj) as Pinocchio has them: base linear and angular in the base's axes, joints [rad/s].
        torques: (n, nj) applied [N m].
        torque_limits: (nj,) [N m].
        com_W, com_plan_W: (n, 3) [m].
        angular_momentum_W, angular_momentum_plan_W: (n, 3) about the CoM [kg m^2/s].
        base_quat_xyzw_plan: (n, 4).
        end_effectors_W, end_effectors_plan_W: (n, e, 3) contact points [m].
        forces_W, forces_plan_W: (n, e, 3) contact forces on the robot [N]: the simulator's, and the plan's.
        contacts: (n, e) whether the simulator's contact force exceeds a few newtons.
        contacts_plan: (n, e) surface index, -1: free.
        assist: (n, 6) wrench of the assistance on the base: force, moment [N, N m].
        pushes_W: (n, 3) [N].
        fell_at_s: Time at which the robot fell; infinite: it did not.
        robot: What was simulated, with the plan's end-effectors in the plan's order; None: the plan's own.
        velocity_limits: (nj,) [rad/s]; 0: the URDF knows none. Empty in files of earlier versions.
        touches: Contacts of links with each other, and of links other than end-effectors with the terrain.
        true_scene: What was simulated, where it is another than the plan knows; None: the plan's own.
    """

    plan: Plan
    joints: tuple[str, ...]
    times_s: Array
    configurations: Array
    velocities: Array
    torques: Array
    torque_limits: Array
    com_W: Array
    com_plan_W: Array
    angular_momentum_W: Array
    angular_momentum_plan_W: Array
    base_quat_xyzw_plan: Array
    end_effectors_W: Array = field(metadata={"in_file": "ends_W"})
    end_effectors_plan_W: Array = field(metadata={"in_file": "ends_plan_W"})
    forces_W: Array
    forces_plan_W: Array
    contacts: NDArray[np.bool_]
    contacts_plan: NDArray[np.int64]
    assist: Array
    pushes_W: Array
    fell_at_s: float
    robot: Robot | None = None
    velocity_limits: Array = field(default_factory=lambda: np.zeros(0))
    touches: tuple[Touch, ...] = ()
    true_scene: Scene | None = None

    @property
    def scene(self) -> Scene:
        """The scene that was simulated."""
        return self.true_scene if self.true_scene is not None else self.plan.scene

    @property
    def scene_by_plan(self) -> Scene:
        """The scene that was simulated, its surfaces numbered as in the plan; what was not there is as the plan has it."""
        return self.plan.scene if self.true_scene is None else numbered_as(self.plan.scene, self.true_scene)

    @property
    def simulated_robot(self) -> Robot:
        """The robot that was simulated."""
        return self.robot if self.robot is not None else self.plan.robot

    @property
    def body(self) -> Robot:
        """Earlier name of ``simulated_robot``, for one release."""
        return self.simulated_robot

    @property
    def ends_W(self) -> Array:
        """Earlier name of ``end_effectors_W``, for one release."""
        return self.end_effectors_W

    @property
    def ends_plan_W(self) -> Array:
        """Earlier name of ``end_effectors_plan_W``, for one release."""
        return self.end_effectors_plan_W

    @staticmethod
    def load(path: str | Path) -> Recording:
        """The recording of a run that ``TrackingResult.save`` or ``mcplan track --save`` wrote.

        Raises:
            InvalidInput: No such file; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        return load_run(path, {RUN: recording_from})


def numbered_as(planned: Scene, true: Scene, absent: Callable[[Surface], Surface] = lambda surface: surface) -> Scene:
    """The planned scene with each surface as it truly is, by name.

    Args:
        planned: Whose numbers surfaces keep: plans and recordings go by them.
        true: Where surfaces are; it may lack some.
        absent: What becomes of a surface that it lacks.
    """
    there = {surface.name: surface for surface in true.surfaces}
    numbered = planned.__copy__()
    numbered.surfaces = [there.get(surface.name) or absent(surface) for surface in planned.surfaces]
    return numbered


def recording_from(header: Header, arrays: Arrays) -> Recording:
    """The recording that the file of a run contains."""
    plan = plan_from_bytes(arrays["plan"].tobytes())
    robot = None if header["robot"] is None else robot_from_dict(header["robot"])
    true_scene = header.get("true_scene")  # files of earlier versions have none
    columns = columns_of(Recording, arrays)
    touches = tuple(Touch(**{**item, "links": tuple(item["links"])}) for item in header.get("touches", ()))
    return Recording(
        plan=plan,
        joints=tuple(header["joints"]),
        fell_at_s=float(header["ended_at_s"]),
        robot=robot,
        touches=touches,
        true_scene=None if true_scene is None else scene_from_dict(true_scene),
        **columns,
    )
