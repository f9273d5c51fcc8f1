"""A robot and a scene as a MuJoCo model that agrees with Pinocchio's of the same URDF."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot, shown
from mcplan.extras import require
from mcplan.kinematics.srdf import disabled_pairs, srdf_beside
from mcplan.kinematics.urdf_model import UrdfModel, load_model

from .actuators import TorqueSpeed
from .link_shapes import LinkShape, link_shapes
from .options import Options
from .terrain import LINK_BIT, ROBOT_BIT, TERRAIN_BIT, add_terrain
from .urdf_text import rewrite

if TYPE_CHECKING:
    from mcplan._core import EndEffector, Robot, Scene

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

#: Half height of the box that a sole is [m]; its bottom is the sole.
SOLE_HALF_HEIGHT_M = 0.01
#: Radius of the ball that makes contact where an end-effector has no sole [m].
BALL_RADIUS_M = 0.02
#: Time constant [s] and damping ratio of contacts: stiffer than MuJoCo's default of 0.02 s, with which soles sink in by
#: millimetres.
CONTACT_SOLREF = (0.005, 1.0)
#: How much harder contacts are tangentially than along the normal (MuJoCo's impratio). With its default of 1 point feet that
#: press sideways creep by 4 mm in a contact of two seconds, with 10 by 1 mm.
FRICTION_HARDNESS = 10.0
#: Height at which a robot is away from its terrain [m].
FAR_UP_M = 1e3


@dataclass(frozen=True)
class SimulationModel:
    """A robot on a scene's terrain; e end-effectors, s surfaces, nj joints in Pinocchio's order.

    Attributes:
        urdf_model: Pinocchio's model, with the scene's gravity.
        mj: mujoco.MjModel; qpos and qvel begin with those of the base.
        joints: Their names.
        qpos_index, dof_index, actuator_index: (nj,) where each joint is in qpos, qvel and ctrl.
        torque_limits: (nj,) [N m].
        motors: Torques that the motors have at a speed.
        base_body: MuJoCo's rigid body of the base.
        end_geoms: Geoms of each end-effector.
        surface_geoms: Geom of each surface.
        geom_names: Names of the links of geoms of the robot, and of surfaces, by geom.
        link_pairs: Number of pairs of rigid bodies of the robot that make contact with each other.
    """

    urdf_model: UrdfModel
    mj: Any
    joints: tuple[str, ...]
    qpos_index: Indices
    dof_index: Indices
    actuator_index: Indices
    torque_limits: Array
    motors: TorqueSpeed
    base_body: int
    end_geoms: tuple[tuple[int, ...], ...]
    surface_geoms: tuple[int, ...]
    geom_names: Mapping[int, str]
    link_pairs: int


def build(robot: Robot, scene: Scene, options: Options | None = None, visual: bool = False) -> SimulationModel:
    """Make the MuJoCo model of a robot on a scene's terrain.

    Joints have no damping and no dry friction, but the inertia of their rotors; motors give torques up to the URDF's
    limits, less of them near to its velocity limits. An end-effector makes contact with the terrain by a box whose bottom
    is the sole, or by a ball through the contact point (above it for feet, towards the wrist for hands). Other links do by
    convex hulls of the URDF's collision shapes, with the terrain and with each other (``link_shapes``), but for pairs
    that one joint connects, that the robot's SRDF disables, or that meet in the nominal posture.

    Args:
        robot: With a URDF.
        scene: Surfaces and gravity.
        options: Step, and factors of mass, friction and height; None: the defaults.
        visual: Keep the robot's visual meshes, for pictures; they make no contact.

    Raises:
        MissingExtra: mujoco or Pinocchio is not installed.
        InvalidRobot: The URDF cannot be simulated; the message says why.
        InvalidOptions: An option is out of its range.
    """
    require(f"the simulation of {robot.name}", "sim", "mujoco", "pinocchio")
    options = options or Options()
    options.validate()
    urdf_model = load_model(robot)
    model = urdf_model.model
    model.gravity.linear = np.array([0.0, 0.0, -scene.gravity])
    shapes = link_shapes(urdf_model) if options.self_contacts else []
    try:
        mj, pairs, root = _compiled(urdf_model, scene, options, shapes, visual)
    except ValueError as error:
        raise InvalidRobot(
            "urdf", "must be a URDF that MuJoCo can simulate", f"{shown(robot.urdf)} ({error})"
        ) from error

    joints, limits = tuple(list(model.names)[2:]), np.asarray(model.effortLimit[6:], float)
    dofs = np.array([mj.joint(name).dofadr[0] for name in joints], dtype=np.int64)
    _set_constants(mj, dofs, model.armature[6:], options.mass_scale)
    return SimulationModel(
        urdf_model=urdf_model,
        mj=mj,
        joints=joints,
        qpos_index=np.array([mj.joint(name).qposadr[0] for name in joints], dtype=np.int64),
        dof_index=dofs,
        actuator_index=np.array([mj.actuator(name).id for name in joints], dtype=np.int64),
        torque_limits=limits,
        motors=TorqueSpeed.of(limits, model.velocityLimit[6:], options.speed_limits),
        base_body=mj.body(root).id,
        end_geoms=tuple((mj.geom(f"end/{end.name}").id,) for end in robot.end_effectors),
        surface_geoms=tuple(mj.geom(f"surface/{i}").id for i in range(len(scene.surfaces))),
        geom_names={
            **{mj.geom(f"link/{i}").id: shape.link for i, shape in enumerate(shapes)},
            **{mj.geom(f"end/{end.name}").id: end.frame for end in robot.end_effectors},
            **{mj.geom(f"surface/{i}").id: surface.name for i, surface in enumerate(scene.surfaces)},
        },
        link_pairs=pairs,
    )


def _compiled(
    urdf_model: UrdfModel, scene: Scene, options: Options, shapes: list[LinkShape], visual: bool
) -> tuple[Any, int, str]:
    """MuJoCo's model, the number of pairs of bodies that make contact with each other, and the name of the base's body.

    Raises:
        ValueError: MuJoCo refuses it.
    """
    import mujoco

    text, root = rewrite(urdf_model, visual)
    spec = mujoco.MjSpec.from_string(text)
    _only_look(spec)
    base = spec.body(root)
    base.add_freejoint()
    _add_end_effectors(spec, urdf_model, base)
    add_terrain(spec, scene, options.friction_scale, options.ground_shift_m)
    model = urdf_model.model
    for name, limit in zip(list(model.names)[2:], np.asarray(model.effortLimit[6:], float), strict=True):
        _add_motor(spec, name, limit)
    spec.compiler.fusestatic = True
    _settings(spec, scene, options)
    _add_links(spec, urdf_model, base, shapes)
    pairs = _add_exclusions(spec, urdf_model, base, shapes)
    return spec.compile(), pairs, root


def _set_constants(mj: Any, dofs: NDArray[np.int64], armature: Array, mass_scale: float) -> None:
    """Hardness of contacts, inertia of rotors, and the factor on masses and inertias."""
    import mujoco

    mj.geom_solref[:] = CONTACT_SOLREF
    mj.dof_damping[:] = 0.0
    mj.dof_frictionloss[:] = 0.0
    mj.dof_armature[:6] = 0.0
    mj.dof_armature[dofs] = armature
    mj.body_mass[:] *= mass_scale
    mj.body_inertia[:] *= mass_scale
    mujoco.mj_setConst(mj, mujoco.MjData(mj))


def _only_look(spec: Any) -> None:
    """Make the robot's visual shapes without contact and mass."""
    for geom in spec.geoms:
        geom.contype = geom.conaffinity = 0
        geom.density, geom.group = 0.0, 1


def _add_end_effectors(spec: Any, urdf_model: UrdfModel, base: Any) -> None:
    import mujoco
    import pinocchio as pin  # type: ignore[import-untyped]

    for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True):
        joint, placement = urdf_model.model.frames[frame].parentJoint, urdf_model.model.frames[frame].placement
        body = _body_of(spec, urdf_model, base, joint)
        x, y, z, w = pin.Quaternion(placement.rotation).coeffs()
        geom = body.add_geom(name=f"end/{end.name}", quat=[w, x, y, z])
        if np.asarray(end.half_size).all():
            geom.type = mujoco.mjtGeom.mjGEOM_BOX
            geom.size = [*end.half_size, SOLE_HALF_HEIGHT_M]
            geom.pos = placement.act(np.array([0.0, 0.0, SOLE_HALF_HEIGHT_M]))
        else:
            geom.type = mujoco.mjtGeom.mjGEOM_SPHERE
            geom.size = [BALL_RADIUS_M, 0.0, 0.0]
            geom.pos = placement.translation + BALL_RADIUS_M * _inwards(end, placement)
        geom.contype, geom.conaffinity = ROBOT_BIT, TERRAIN_BIT
        geom.density, geom.group = 0.0, 3


def _body_of(spec: Any, urdf_model: UrdfModel, base: Any, joint: int) -> Any:
    """MuJoCo's body that a joint of Pinocchio's carries."""
    return base if joint == 1 else spec.joint(urdf_model.model.names[joint]).parent


def _add_links(spec: Any, urdf_model: UrdfModel, base: Any, shapes: list[LinkShape]) -> None:
    """Give each body the shapes of its links, and let end-effectors make contact with them."""
    import mujoco

    for i, shape in enumerate(shapes):
        mesh = spec.add_mesh(name=f"link/{i}")
        mesh.uservert = shape.points.ravel().tolist()
        body = _body_of(spec, urdf_model, base, shape.joint)
        geom = body.add_geom(name=f"link/{i}", type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"link/{i}")
        geom.contype, geom.conaffinity = LINK_BIT, LINK_BIT | (TERRAIN_BIT if shape.on_terrain else 0)
        geom.density, geom.group = 0.0, 3
    for end in urdf_model.robot.end_effectors if shapes else ():
        geom = spec.geom(f"end/{end.name}")
        geom.contype, geom.conaffinity = ROBOT_BIT | LINK_BIT, TERRAIN_BIT | LINK_BIT


def _add_exclusions(spec: Any, urdf_model: UrdfModel, base: Any, shapes: list[LinkShape]) -> int:
    """Exclude pairs of bodies of which no contact is to be made; how many pairs are left.

    A pair is excluded if one joint connects them, if the SRDF disables all pairs of their links, or if they meet in the
    nominal posture, where a robot that stands well has no contact with itself.
    """
    if not shapes:
        return 0
    parents = urdf_model.model.parents
    links: dict[int, set[str]] = {}
    for shape in shapes:
        links.setdefault(shape.joint, set()).add(shape.link)
    for end, frame in zip(urdf_model.robot.end_effectors, urdf_model.frames, strict=True):
        links.setdefault(int(urdf_model.model.frames[frame].parentJoint), set()).add(end.frame)
    srdf = srdf_beside(urdf_model.path)
    disabled = disabled_pairs(srdf, urdf_model.robot.name) if srdf is not None else set()
    bodies = {joint: _body_of(spec, urdf_model, base, joint).name for joint in links}
    meeting = _meeting(spec, urdf_model, set(bodies.values()))
    left = 0
    for a, b in itertools.combinations(sorted(links), 2):
        if parents[b] == a or parents[a] == b:
            continue  # MuJoCo leaves them out by itself
        never = all(frozenset(pair) in disabled for pair in itertools.product(links[a], links[b]))
        if never or frozenset((bodies[a], bodies[b])) in meeting:
            spec.add_exclude(bodyname1=bodies[a], bodyname2=bodies[b])
        else:
            left += 1
    return left


def _meeting(spec: Any, urdf_model: UrdfModel, bodies: set[str]) -> set[frozenset[str]]:
    """Pairs of bodies, by name, that meet in the nominal posture."""
    import mujoco

    mj = spec.compile()
    data = mujoco.MjData(mj)
    for joint in range(2, urdf_model.model.njoints):
        data.qpos[mj.joint(urdf_model.model.names[joint]).qposadr[0]] = urdf_model.neutral[
            urdf_model.model.idx_qs[joint]
        ]
    data.qpos[2] += FAR_UP_M  # from the terrain
    mujoco.mj_fwdPosition(mj, data)
    names = [tuple(mj.body(mj.geom_bodyid[geom]).name for geom in pair) for pair in data.contact.geom]
    return {frozenset(pair) for pair in names if set(pair) <= bodies}


def _inwards(end: EndEffector, placement: Any) -> Array:
    """Direction from a contact point to the centre of its ball, in the axes of the joint that carries it.

    Feet make contact with what is below them. Hands do in many postures, mostly with what is farthest from the wrist.
    """
    distance = np.linalg.norm(placement.translation)
    if end.kind == "foot" or distance < BALL_RADIUS_M:
        return np.asarray(placement.rotation[:, 2])
    return np.asarray(-placement.translation / distance)


def _add_motor(spec: Any, joint: str, limit: float) -> None:
    import mujoco

    motor = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    if np.isfinite(limit):
        motor.ctrllimited = motor.forcelimited = True
        motor.ctrlrange = motor.forcerange = [-max(limit, 1e-9), max(limit, 1e-9)]  # MuJoCo takes no empty range
    motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE  # for motors at full voltage, see Simulation


def _settings(spec: Any, scene: Scene, options: Options) -> None:
    import mujoco

    spec.option.timestep = options.simulation_step_s
    spec.option.gravity = [0.0, 0.0, -scene.gravity]
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = FRICTION_HARDNESS
    # A run that blows up must be seen as such, not start again at the origin.
    spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    # MuJoCo has it always on from 4.0: several contacts of a box on a mesh, without which soles rock.
    several = getattr(mujoco.mjtEnableBit, "mjENBL_MULTICCD", 0)
    spec.option.enableflags |= int(several)
