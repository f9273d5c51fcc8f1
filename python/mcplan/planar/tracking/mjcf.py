"""A planar robot and its ground as a MuJoCo model.

The robot's plane (x forward, y up) becomes MuJoCo's x-z plane. Anti-clockwise in the former is about -y in the latter, which
is the axis of all hinges. The base is on two slides and a hinge, so that nothing can leave the plane and MuJoCo's velocities
and accelerations are the planar robot's. Their order is not: MuJoCo numbers a limb to its end before the next one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.tracking.options import Options

from .settings import ContactSettings, Feedback

if TYPE_CHECKING:
    import mujoco

    from mcplan._core import PlanarConfiguration, PlanarRobot, PlanarSurface, PlanarTask

Array = NDArray[np.float64]

#: Radius of the spheres at the points of end-effectors [m]; a force acts off its point by less than this.
POINT_RADIUS_M = 5e-4
#: Depth of the solids under surfaces that end somewhere, and half their width across the plane [m].
SOLID_DEPTH_M = 0.1
SOLID_HALF_WIDTH_M = 0.2
#: Length for surfaces without an end on one side [m].
ENDLESS_M = 50.0

_AXIS = (0.0, -1.0, 0.0)
_ROBOT, _GROUND = 1, 2  # collision bits: robots make contact with the ground and not with themselves


@dataclass(frozen=True)
class PlanarModel:
    """A planar robot in MuJoCo.

    Attributes:
        task: Robot and ground that it was made from.
        mj: The model.
        stiffness, damping: Gains of its motors [N m/rad, N m s/rad].
        dofs: (3 + j,) indices of base x, y, angle and the joints in MuJoCo's qpos and qvel.
        point_geoms: For each end-effector the geoms of its points.
        surface_geoms: The geom of each surface of the task.
    """

    task: PlanarTask
    mj: mujoco.MjModel
    stiffness: float
    damping: float
    dofs: NDArray[np.int64]
    point_geoms: tuple[tuple[int, ...], ...]
    surface_geoms: tuple[int, ...]


def build(
    task: PlanarTask,
    options: Options | None = None,
    contacts: ContactSettings | None = None,
    feedback: Feedback | None = None,
) -> PlanarModel:
    """The robot of a task on the task's ground, in MuJoCo.

    Args:
        task: Robot and surfaces; it must be valid.
        options: Time step of the simulation, factors on masses and friction, and height of the ground; default: Options().
        contacts: Hardness of the contacts; default: ContactSettings().
        feedback: Feedback of the joints, as part of their motors; default: Feedback().

    Raises:
        InvalidOptions: Contacts or feedback out of their range.
        MissingExtra: MuJoCo is not installed.
    """
    require("tracking of planar robots", "sim", "mujoco")
    import mujoco

    options = options or Options()
    contacts = contacts or ContactSettings()
    contacts.validate()
    feedback = feedback or Feedback()
    feedback.validate()
    gains = feedback.gains(task.robot)
    spec = _empty(task.robot, options.simulation_step_s, contacts)
    _add_ground(spec, task, contacts, options.friction_scale, options.ground_shift_m)
    _add_bodies(spec, task.robot, gains, options.mass_scale)
    model = spec.compile()

    def geom(name: str) -> int:
        return int(mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, name))

    hinges = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, f"joint {b}") for b in range(len(task.robot.bodies))]

    end_effectors = task.robot.end_effectors
    return PlanarModel(
        task=task,
        mj=model,
        stiffness=gains[0],
        damping=gains[1],
        dofs=np.array([0, 1, *(model.jnt_dofadr[hinge] for hinge in hinges)]),
        point_geoms=tuple(
            tuple(geom(f"point {e} {i}") for i in range(len(end.points))) for e, end in enumerate(end_effectors)
        ),
        surface_geoms=tuple(geom(f"surface {i}") for i in range(len(task.surfaces))),
    )


def set_state(model: PlanarModel, data: mujoco.MjData, configuration: PlanarConfiguration) -> None:
    """Put MuJoCo's robot where a configuration is, with its velocity and acceleration."""
    data.qpos[model.dofs] = np.r_[configuration.base, configuration.q]
    data.qvel[model.dofs] = np.r_[configuration.base_velocity, configuration.velocity]
    data.qacc[model.dofs] = np.r_[configuration.base_acceleration, configuration.acceleration]


def _empty(robot: PlanarRobot, step_s: float, contacts: ContactSettings) -> Any:
    """A model's specification with its settings, and nothing in it."""
    import mujoco

    spec = mujoco.MjSpec()
    spec.modelname = robot.name or "planar"
    spec.option.gravity = [0.0, 0.0, -robot.gravity]
    spec.option.timestep = step_s
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = contacts.friction_impedance
    spec.option.tolerance = 1e-12
    spec.option.iterations = 200
    return spec


def _add_ground(
    spec: mujoco.MjSpec, task: PlanarTask, contacts: ContactSettings, friction_scale: float, shift_m: float
) -> None:
    import mujoco

    for i, surface in enumerate(task.surfaces):
        endless = bool(np.isinf([surface.from_, surface.to]).all())
        middle, size = _half_space(surface) if endless else _slab(surface)
        spec.worldbody.add_geom(
            name=f"surface {i}",
            type=mujoco.mjtGeom.mjGEOM_PLANE if endless else mujoco.mjtGeom.mjGEOM_BOX,
            size=size,
            pos=[middle[0], 0.0, middle[1] + shift_m],
            quat=_rotation_wxyz(surface.angle),
            friction=[friction_scale * surface.friction, 0.0, 0.0],
            condim=3,
            priority=1,  # friction and hardness are the ground's
            solref=[contacts.time_constant_s, 1.0],
            solimp=[contacts.impedance, contacts.impedance, 0.001, 0.5, 2.0],
            contype=_GROUND,
            conaffinity=_ROBOT,
        )


def _half_space(surface: PlanarSurface) -> tuple[Array, list[float]]:
    """Middle and MuJoCo's size of the plane that is a surface without ends."""
    return surface.origin_W, [0.0, 0.0, 1.0]


def _slab(surface: PlanarSurface) -> tuple[Array, list[float]]:
    """Middle and half lengths of the box whose top is a surface that ends."""
    ends = np.clip([surface.from_, surface.to], -ENDLESS_M, ENDLESS_M)
    middle = surface.origin_W + ends.mean() * surface.tangent_W - SOLID_DEPTH_M / 2 * surface.normal_W
    return middle, [float(ends[1] - ends[0]) / 2, SOLID_HALF_WIDTH_M, SOLID_DEPTH_M / 2]


def _add_bodies(spec: mujoco.MjSpec, robot: PlanarRobot, gains: tuple[float, float], mass_scale: float) -> None:
    import mujoco

    bodies: list[Any] = []
    for number, body in enumerate(robot.bodies):
        parent = bodies[body.parent] if number else spec.worldbody
        made = parent.add_body(
            name=f"{number} {body.name}",
            pos=[body.joint_P[0], 0.0, body.joint_P[1]] if number else [0.0, 0.0, 0.0],
            quat=_rotation_wxyz(body.offset if number else 0.0),
            mass=mass_scale * body.mass,
            ipos=[body.com_B[0], 0.0, body.com_B[1]],
            inertia=[mass_scale * body.inertia] * 3,  # only the one about y acts
            explicitinertial=True,
        )
        if number == 0:
            slide = mujoco.mjtJoint.mjJNT_SLIDE
            made.add_joint(name="base x", type=slide, axis=[1.0, 0.0, 0.0])
            made.add_joint(name="base y", type=slide, axis=[0.0, 0.0, 1.0])
        hinge = made.add_joint(name=f"joint {number}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=_AXIS)
        if number:
            _add_motor(spec, hinge.name, body.torque_max, gains)
        bodies.append(made)
    for e, end in enumerate(robot.end_effectors):
        along, into = _axes(end.angle_B)
        for i, point in enumerate(end.points):
            at = np.asarray(end.position_B) + point * along + POINT_RADIUS_M * into
            bodies[end.body].add_geom(
                name=f"point {e} {i}",
                type=mujoco.mjtGeom.mjGEOM_SPHERE,
                size=[POINT_RADIUS_M, 0.0, 0.0],
                pos=[at[0], 0.0, at[1]],
                contype=_ROBOT,
                conaffinity=_GROUND,
            )


def _add_motor(spec: mujoco.MjSpec, joint: str, torque_max: float, gains: tuple[float, float]) -> None:
    import mujoco

    motor = spec.add_actuator(name=f"motor of {joint}", target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
    motor.biasprm[:3] = [0.0, -gains[0], -gains[1]]
    if np.isfinite(torque_max):
        motor.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
        motor.forcerange = [-torque_max, torque_max]


def _axes(angle: float) -> tuple[Array, Array]:
    """Unit vectors of a frame rotated by an angle [rad]."""
    return np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])


def _rotation_wxyz(angle: float) -> list[float]:
    """Quaternion wxyz of a rotation in the plane."""
    return [float(np.cos(angle / 2)), 0.0, float(-np.sin(angle / 2)), 0.0]
