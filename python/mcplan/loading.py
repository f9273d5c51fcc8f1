"""mcplan.load_scene and its kin: built-in names, or paths of TOML files."""

from __future__ import annotations

from pathlib import Path

from mcplan._core import PlanarRobot, PlanarTask, Robot, Scene


def load_scene(source: str | Path) -> Scene:
    """Load a scene by its built-in name or from a TOML file.

    Args:
        source: Name listed by ``mcplan scenes``, or path of a file.

    Returns:
        The scene: surfaces (vertices in [m], world frame W, z up), start and goal.

    Raises:
        InvalidScene: A field is missing or out of range; the message names file, field, value and rule.
        UnknownScene: No such name and no such file; the message lists the names that exist.
    """
    from mcplan.files.scenes import load_scene as load

    return load(source)


def load_robot(source: str | Path) -> Robot:
    """Load a robot by its built-in name or from a TOML file.

    Args:
        source: Name listed by ``mcplan robots``, or path of a file.

    Returns:
        The robot: mass [kg], inertia [kg m^2], end-effectors with reach boxes relative to the CoM [m].

    Raises:
        InvalidRobot: A field is missing or out of range; the message names file, field, value and rule.
        UnknownRobot: No such name and no such file; the message lists the names that exist.
    """
    from mcplan.files.robots import load_robot as load

    return load(source)


def load_planar_robot(source: str | Path) -> PlanarRobot:
    """Load a planar robot by its built-in name or from a TOML file.

    Args:
        source: Name listed by ``mcplan robots`` as planar, or path of a file.

    Returns:
        The robot: a tree of rigid bodies (masses [kg], lengths [m], angles [rad]) and its end-effectors.

    Raises:
        InvalidRobot: A field is missing or out of range; the message names file, field, value and rule.
        UnknownRobot: No such name and no such file; the message lists the names that exist.
    """
    from mcplan.files.planar_robots import load_planar_robot as load

    return load(source)


def load_planar_task(source: str | Path) -> PlanarTask:
    """Load a planar task by its built-in name or from a TOML file.

    Args:
        source: Name listed by ``mcplan tasks``, or path of a file.

    Returns:
        The task: its planar robot, surfaces (world frame W, x forward, y up, [m]) and one stance for each phase.

    Raises:
        InvalidPlanarTask: A field is missing or out of range; the message names file, field, value and rule.
        InvalidRobot: The same of its robot.
        UnknownPlanarTask, UnknownRobot: No such name and no such file; the message lists the names that exist.
    """
    from mcplan.files.planar_tasks import load_planar_task as load

    return load(source)
