"""Shape of planar robot and motion files: which keys there are, their types and ranges.

What relates several fields is checked where names are looked up (planar_robots.py, motions.py) and by ``validate()`` of
the C++ classes. Descriptions here end up in the JSON schema.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mcplan.files.models import Name, Names, NotNegative, Number, Positive, Table

Point2 = Annotated[list[Number], Field(min_length=2, max_length=2)]
Bound = Annotated[list[float], Field(min_length=2, max_length=2)]  # either end may be infinite


class CapsuleModel(Table):
    """A segment with a radius, in the body's frame."""

    from_: Point2 = Field(alias="from", description="[m] One end of the segment.")
    to: Point2 = Field(description="[m] The other end; the same: a disc.")
    radius: Positive = Field(description="[m]")


class PlanarBodyModel(Table):
    """A rigid body and the revolute joint that carries it. Its frame has its origin at the joint."""

    name: Name = Field(description="Unique name.")
    parent: Name | None = Field(None, description="Name of a body above; left out for the first one, the base, alone.")
    joint: Point2 = Field([0.0, 0.0], description="[m] Position of the joint in the parent's frame.")
    offset: Number = Field(0.0, description="[rad] Angle against the parent at joint position 0.")
    mass: Positive = Field(description="[kg]")
    com: Point2 = Field([0.0, 0.0], description="[m] Centre of mass.")
    inertia: Positive = Field(description="[kg m^2] About the centre of mass.")
    position_min: Number | None = Field(None, description="[rad] Of the joint; left out: no limit.")
    position_max: Number | None = Field(None, description="[rad] Of the joint; left out: no limit.")
    velocity_max: Positive | None = Field(None, description="[rad/s] Of the joint; left out: no limit.")
    torque_max: Positive | None = Field(None, description="[N m] Of the joint; left out: no limit.")
    capsules: list[CapsuleModel] = Field([], max_length=100, description="Shape, for drawing and self-collision.")


class PlanarEndEffectorModel(Table):
    """A contact frame of a body: x axis in the sole, y axis from the ground into the robot."""

    name: Name = Field(description="Unique name.")
    body: Name = Field(description="Name of the body that carries it.")
    position: Point2 = Field([0.0, 0.0], description="[m] Origin of the frame, in the body's frame.")
    angle: Number = Field(0.0, description="[rad] Of the frame's x axis in the body's frame.")
    points: list[Number] = Field(min_length=1, max_length=100, description="[m] Where forces act, along the x axis.")


class PlanarRobotModel(Table):
    """A tree of rigid bodies in a vertical plane (x forward, y up) on a free base. SI units."""

    name: Name | None = Field(None, description="Default: the name of the file.")
    description: str = Field("", description="One line.")
    gravity: NotNegative = Field(9.81, description="[m/s^2] Along -y.")
    bodies: list[PlanarBodyModel] = Field(
        min_length=1, max_length=100, description="The base first, each one after its parent."
    )
    end_effectors: list[PlanarEndEffectorModel] = Field(min_length=1, max_length=100)
    collision_pairs: list[Annotated[Names, Field(min_length=2, max_length=2)]] = Field(
        [], max_length=10_000, description="Pairs of bodies whose capsules may not touch."
    )


class PlanarSurfaceModel(Table):
    """A straight piece of the ground or of a wall; what lies behind it is solid."""

    name: Name = Field(description="Unique name.")
    origin: Point2 = Field([0.0, 0.0], description="[m] A point of it, from which distances along it count.")
    angle: Number = Field(
        0.0, description="[rad] Of its tangent; its outward normal is 90 degrees to the left of that."
    )
    friction: Positive = Field(1.0, description="[-] Coulomb coefficient.")
    extent: Bound | None = Field(
        None, description="[m] From where to where along the tangent; inf and -inf are legal. Left out: no ends."
    )


class PlanarContactModel(Table):
    """An end-effector that stands still on a surface."""

    end_effector: Name = Field(description="Name.")
    surface: Name = Field(description="Name.")
    at: Number | None = Field(None, description="[m] Place of the frame's origin along the surface, from its origin.")
    position: Point2 | None = Field(None, description="[m] The same as a point of the world, instead of `at`.")
    turns: Annotated[int, Field(ge=-1000, le=1000)] | None = Field(
        None, description="[-] Whole turns by which the end-effector is turned more (default 0)."
    )
    angle: Number | None = Field(None, description="[rad] Of the end-effector's x axis, instead of `turns`.")


class PlanarClearanceModel(Table):
    """The points of a swinging end-effector stay outside the solid behind a surface."""

    end_effector: Name = Field(description="Name.")
    surface: Name = Field(description="Name.")
    first_interval: Annotated[int, Field(ge=0, le=1000)] = Field(
        0, description="[-] First interval of the phase that counts."
    )
    end_interval: Annotated[int, Field(ge=-1, le=1000)] = Field(
        -1, description="[-] First interval that no longer counts; -1: to the end of the phase."
    )
    middle_height: Number | None = Field(
        None, description="[m] Least height when interval n / 2 of the phase's n begins; left out: none."
    )


class PlanarPoseModel(Table):
    """Bounds on where a body is at an instant of a phase."""

    body: Name = Field(description="Name.")
    fraction: Annotated[float, Field(ge=0, le=1)] = Field(description="[-] Of the phase, 0 to 1.")
    x: Bound | None = Field(None, description="[m] From, to: of the origin of the body's frame. Left out: free.")
    y: Bound | None = Field(None, description="[m] From, to.")
    angle: Bound | None = Field(None, description="[rad] From, to.")


class PlanarPhaseModel(Table):
    """A stretch of time with constant contacts: all of them, or what changes against the phase before."""

    contacts: list[PlanarContactModel] = Field([], max_length=100, description="All contacts of the phase.")
    lift: Names = Field([], description="End-effectors that leave their contact, instead of `contacts`.")
    place: list[PlanarContactModel] = Field(
        [], max_length=100, description="Contacts that are new, instead of `contacts`."
    )
    intervals: Annotated[int, Field(ge=1, le=1000)] | None = Field(
        None, description="[-] Pieces of the joints' splines. Default: 3 for the first and last phase, else 4."
    )
    min_duration: NotNegative = Field(0.0, description="[s]")
    max_duration: Positive | None = Field(None, description="[s] Left out: no limit.")
    clearances: list[PlanarClearanceModel] = Field([], max_length=1000)
    poses: list[PlanarPoseModel] = Field([], max_length=1000)


class MotionModel(Table):
    """A task for whole-body planning: planar robot, ground, and the sequence of contact stances. SI units."""

    name: Name | None = Field(None, description="Default: the name of the file.")
    description: str = Field("", description="One line.")
    robot: Name | PlanarRobotModel = Field(
        description="Built-in name, path relative to this file, or the robot itself as a table."
    )
    surfaces: list[PlanarSurfaceModel] = Field(min_length=1, max_length=1000)
    phases: list[PlanarPhaseModel] = Field(min_length=1, max_length=1000)
