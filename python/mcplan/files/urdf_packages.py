"""Robots of example-robot-data without their meshes, which take up to two seconds to read."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from os.path import join
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class PackagedRobot:
    """A robot of example-robot-data. It is kept: nobody changes its members, but copies of them.

    Attributes:
        model: Pinocchio model, with the free-flyer, rotors and joint limits that the package gives it.
        posture: (nq,) configuration that the package calls its reference.
        path: The URDF file.
        packages: Folder in which the packages of its meshes are; None if the loader has to read them.
    """

    model: Any
    posture: NDArray[np.float64]
    path: Path
    packages: str | None


@lru_cache(maxsize=16)
def packaged_robot(name: str) -> PackagedRobot:
    """Read what `example_robot_data.load(name)` does, but for meshes and pairs of collisions.

    Raises:
        ValueError: example-robot-data has no robot of that name.
        Exception: What the file system or the parser happen to raise.
    """
    import example_robot_data  # type: ignore[import-untyped]
    import pinocchio as pin  # type: ignore[import-untyped]
    from example_robot_data.robots_loader import RobotLoader  # type: ignore[import-untyped]

    loader = example_robot_data.ROBOTS.get(name)
    if loader is None or loader.__init__ is not RobotLoader.__init__ or not loader.urdf_filename:
        robot = example_robot_data.load(name)  # cut from another one, or no URDF: the loader knows how
        return PackagedRobot(robot.model, robot.q0, Path(robot.urdf), None)
    inside = join(loader.path, loader.urdf_subpath, loader.urdf_filename)
    folder = loader.model_path or example_robot_data.getModelPath(inside)
    urdf = join(folder, inside)
    model = pin.buildModelFromUrdf(urdf, *([pin.JointModelFreeFlyer()] if loader.free_flyer else []))
    if loader.srdf_filename:
        srdf = join(folder, loader.path, loader.srdf_subpath, loader.srdf_filename)
        rotors, reference = loader.has_rotor_parameters, loader.ref_posture
        posture = example_robot_data.readParamsFromSrdf(model, srdf, False, rotors, reference)
    else:
        posture = pin.neutral(model)
    if loader.free_flyer:
        lower, upper = model.lowerPositionLimit, model.upperPositionLimit
        lower[:7], upper[:7] = -1.0, 1.0
        model.lowerPositionLimit, model.upperPositionLimit = lower, upper
    return PackagedRobot(model, posture, Path(urdf), join(folder, "../.."))


@lru_cache(maxsize=2)
def packaged_visuals(name: str) -> Any:
    """The visual geometry of a robot of example-robot-data; what is returned is not to be changed."""
    import example_robot_data
    import pinocchio as pin

    robot = packaged_robot(name)
    if robot.packages is None:
        return example_robot_data.load(name).visual_model
    return pin.buildGeomFromUrdf(robot.model, str(robot.path), pin.GeometryType.VISUAL, None, [robot.packages])
