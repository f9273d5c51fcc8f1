"""Shape of scene and robot files: which keys there are, their types and ranges.

What relates several fields (convexity, names that must exist, a box around its nominal point) is checked by
``validate()`` of the C++ classes. Descriptions here end up in the JSON schema.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Number = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Name = Annotated[str, Field(min_length=1)]
Point = Annotated[list[Number], Field(min_length=3, max_length=3)]
Names = Annotated[list[Name], Field(max_length=1000)]


class Table(BaseModel):
    model_config = ConfigDict(strict=True, extra="forbid")


class SurfaceModel(Table):
    """A flat patch of the world that end-effectors may touch."""

    name: Name = Field(description="Unique name.")
    vertices: list[Point] = Field(
        min_length=3,
        max_length=1000,
        description="[m] Corners of a convex polygon, world frame, counter-clockwise about the outward normal.",
    )
    friction: Positive = Field(0.7, description="[-] Coulomb coefficient.")
    grasp: bool = Field(False, description="May be held: no friction cone, only the end-effector's force cap.")
    end_effectors: Names = Field([], description="Names or kinds of those that may touch it; empty: all.")
    thickness: Positive = Field(0.05, description="[m] Solid below the surface that swings must clear.")


class StanceModel(Table):
    """Where the robot is at the start or the goal. Heights come from the robot."""

    position: Point = Field(description="[m] Point of the ground below the CoM, world frame.")
    yaw: Number = Field(0.0, description="[rad] Heading.")
    contacts: dict[Name, Name] = Field(description="End-effector or kind -> surface. A name beats its kind.")


class RuleModel(Table):
    """If none of `when_free` is in contact, all of `require` must be."""

    when_free: Names = Field(min_length=1, description="Names or kinds of end-effectors.")
    require: Names = Field(min_length=1, description="Names or kinds of end-effectors.")


class StepModel(Table):
    """One step of a walk."""

    end_effector: Name = Field(description="Name of the end-effector that swings.")
    surface: Name = Field(description="Name of the surface on which it lands.")


class SceneModel(Table):
    """The world: surfaces, start and goal. World frame with z up, SI units."""

    name: Name | None = Field(None, description="Default: the name of the file.")
    description: str = Field("", description="One line.")
    gravity: Positive = Field(9.81, description="[m/s^2]")
    surfaces: list[SurfaceModel] = Field(min_length=1, max_length=10_000)
    start: StanceModel
    goal: StanceModel
    rules: list[RuleModel] = Field([], max_length=1000)
    steps: list[StepModel] = Field(
        [], max_length=10_000, description="Contact sequence of a walk, for planners that want it given."
    )


class PolytopeModel(Table):
    """Convex set {x : A x <= b}: given by A and b, or by the file that holds them."""

    A: list[Point] = Field([], max_length=10_000, description="Outward normals of the faces, of length 1 within 0.001.")
    b: list[Number] = Field([], max_length=10_000, description="[m] Distance of each face from the origin.")
    file: str = Field("", description="JSON file with A and b, relative to the robot's file.")
    name: str = Field("", description="Key of the polytope among the file's `polytopes`.")


class EndEffectorModel(Table):
    """A contact link. Positions relative to the CoM, in axes that turn with the base (x forward, y left, z up)."""

    name: Name = Field(description="Unique name.")
    kind: Name = Field("foot", description="Group that scenes may address as a whole, e.g. foot, hand.")
    frame: str = Field("", description="URDF frame.")
    frame_offset: Point = Field([0.0, 0.0, 0.0], description="[m] Contact point in the axes of the URDF frame.")
    half_size: Annotated[list[NotNegative], Field(min_length=2, max_length=2)] = Field(
        [0.0, 0.0], description="[m] Half length and half width of the sole; zero: point contact."
    )
    nominal: Point = Field(description="[m] Position in the nominal stance.")
    reach_min: Point = Field(description="[m] Lower corner of the box of reachable positions.")
    reach_max: Point = Field(description="[m] Upper corner of the box of reachable positions.")
    max_force: Annotated[float, Field(gt=0)] = Field(
        float("inf"),
        description="[N] Largest norm of the contact force.",
        json_schema_extra={"default": None},
    )
    max_moment: Annotated[list[NotNegative], Field(min_length=3, max_length=3)] = Field(
        [0.0, 0.0, 0.0], description="[N m] Largest contact moment about each world axis."
    )
    yaw_range: Annotated[list[Number], Field(min_length=2, max_length=2)] | None = Field(
        None, description="[rad] How far the sole may be turned against the base, right and left; left out: any way."
    )
    com_reach: PolytopeModel | None = Field(
        None, description="[m] Where the CoM may be relative to the sole's centre. Axes: level, x along the heading."
    )
    partner_reach: dict[Name, PolytopeModel] = Field(
        {}, description="[m] Where other end-effectors may stand relative to it, by name. Same axes."
    )


class RobotModel(Table):
    """What a planner needs to know of a robot: lumped inertia and where its limbs reach. SI units."""

    name: Name | None = Field(None, description="Default: the name of the file.")
    description: str = Field("", description="One line.")
    mass: Positive = Field(description="[kg]")
    inertia: Annotated[list[Positive], Field(min_length=3, max_length=3)] = Field(
        description="[kg m^2] Diagonal, about the CoM, in the nominal posture."
    )
    com_height: Positive = Field(description="[m] Of the CoM above the ground in the nominal stance.")
    swing_height: Positive = Field(
        0.10, description="[m] Clearance of a swinging end-effector. The default goes with the robot's size."
    )
    phase_duration: Annotated[list[Positive], Field(min_length=2, max_length=2)] = Field(
        [0.15, 0.5],
        description="[s] Shortest and longest phase of a contact sequence. The default goes with the robot's size.",
    )
    sole_support: Annotated[float, Field(ge=0, le=1)] = Field(
        0.0, description="[-] Share of a sole that a contact sequence keeps on its surface; 0: its centre."
    )
    pressure_share: Annotated[float, Field(gt=0, le=1)] = Field(
        1.0, description="[-] Share of a sole's half size within which a plan keeps the centre of pressure."
    )
    tracked: bool = Field(
        False,
        description="Whether a controller follows the plans with limbs whose momentum they do not know of: contact sequences "
        "keep the base upright and the centre of pressure near the middle of the sole.",
    )
    urdf: str = Field("", description='Path, or "example-robot-data:NAME".')
    posture: dict[Name, Number] = Field({}, description="[rad] Nominal joint positions by URDF joint name.")
    end_effectors: list[EndEffectorModel] = Field(min_length=1, max_length=8)
