"""``save`` and ``load`` of plans, ``save`` of scenes and robots: compiled classes, to which these methods are given here.

The front imports this, so that they are there whenever ``mcplan`` is; what reads and writes comes when it is first used.
Annotations are types here, not texts, because those who ask the classes for signatures would look for their names in ``_core``.
"""

import os
from collections.abc import Callable
from inspect import cleandoc
from pathlib import Path
from typing import Any

from mcplan._core import Plan, PlanarPlan, Robot, Scene
from mcplan.arguments import require_or_path
from mcplan.errors import InvalidInput, shown

_Files = tuple[Callable[[Any, str | Path], None], Callable[[str | Path], Any]]


def _of_plans() -> _Files:
    from mcplan.files.plans import load_plan, save_plan

    return save_plan, load_plan


def _of_planar_plans() -> _Files:
    from mcplan.files.whole_body_plans import load_whole_body_plan, save_whole_body_plan

    return save_whole_body_plan, load_whole_body_plan


def _save_scene(scene: Scene, path: str | Path) -> None:
    from mcplan.files.scenes import save_scene

    save_scene(scene, path)


def _save_robot(robot: Robot, path: str | Path) -> None:
    from mcplan.files.robots import save_robot

    save_robot(robot, path)


def _require_path(path: Any) -> str:
    require_or_path("path", path)
    text: str = os.fspath(path)
    if "\0" in text:
        raise InvalidInput("path", "must have no null character", shown(text))
    return text


def _require_file(path: Any) -> None:
    if _require_path(path).endswith("/"):
        raise InvalidInput("path", "must be that of a file, not of a folder", shown(path))


def _named(method: Any, owner: Any) -> Any:
    """The method as one that the class has always had."""
    method.__qualname__, method.__doc__ = f"{owner.__name__}.{method.__name__}", cleandoc(method.__doc__ or "")
    return method


def _give(owner: Any, files: Callable[[], _Files]) -> None:
    """Make methods of a class that write and read its objects as `files` does."""

    def save(self: Any, path: str | Path) -> None:
        """Write the plan to an .npz or a .json file, which is complete or not there at all; C++ reads the latter.

        Raises:
            InvalidArgument: It is no path.
            InvalidInput: The name promises another kind of file, is empty or that of a folder.
            OSError: The file cannot be written.
            InvalidPlan: Its sizes do not fit together or a number is not finite.
        """
        _require_file(path)
        files()[0](self, path)

    def load(path: str | Path) -> Any:
        """Read a plan that was written by save(), or by save in C++.

        Raises:
            InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
            FileNotFoundError: There is no such file.
            InvalidArgument: It is no path.
        """
        _require_path(path)
        return files()[1](path)

    save.__annotations__["self"] = load.__annotations__["return"] = owner
    owner.save, owner.load = _named(save, owner), staticmethod(_named(load, owner))


def _give_save(owner: Any, write: Callable[[Any, str | Path], None]) -> None:
    """Make a method of a class that writes its objects."""

    def save(self: Any, path: str | Path) -> None:
        """Write a TOML file, which is complete or not there at all; mcplan.load_scene and load_robot, and C++, read it.

        Raises:
            InvalidArgument: It is no path.
            InvalidInput: The name has another ending, is empty or that of a folder.
            InvalidScene, InvalidRobot: A field is out of its range; the message names it.
            OSError: The file cannot be written.
        """
        _require_file(path)
        write(self, path)

    save.__annotations__["self"] = owner
    owner.save = _named(save, owner)


_give(Plan, _of_plans)
_give(PlanarPlan, _of_planar_plans)
_give_save(Scene, _save_scene)
_give_save(Robot, _save_robot)
