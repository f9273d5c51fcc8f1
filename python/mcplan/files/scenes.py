"""Scenes from and to TOML files and plain dicts."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan import _core
from mcplan._core import Scene
from mcplan.errors import InvalidOptions, UnknownScene
from mcplan.files import builtin
from mcplan.files.geometry import warn_of_geometry
from mcplan.files.outputs import TOML, require_suffix, write_whole
from mcplan.files.toml import toml_text

#: Factors on a scene's lengths: between robots as small as a grain and as high as a mountain.
SCALES = (1e-3, 1e3)


def list_scenes() -> list[str]:
    """Names of the built-in scenes."""
    return builtin.names("scenes")


def load_scene(source: str | Path) -> Scene:
    """Load a scene by its built-in name or from a TOML file; see mcplan.load_scene."""
    path = builtin.find(source, "scenes", UnknownScene)
    scene = _core.read_scene(path)
    warn_of_geometry(scene, str(path))
    return scene


def save_scene(scene: Scene, path: str | Path, header: str = "") -> None:
    """Write a scene to a TOML file.

    Args:
        scene: A valid scene.
        path: Where to; it ends in .toml.
        header: Comment to put on top.

    Raises:
        InvalidInput: The path has another ending.
        InvalidScene: A field is out of range.
    """
    require_suffix("path", path, TOML)
    scene.validate()
    write_whole(toml_text(scene_to_dict(scene), header), path)


def scene_to_dict(scene: Scene) -> dict[str, Any]:
    """Plain data with the keys of a scene file; what is at its default is left out."""
    return _core.scene_to_dict(scene)


def scene_from_dict(data: Mapping[str, Any], source: str = "") -> Scene:
    """The scene of plain data with the keys of a scene file.

    Args:
        data: As from scene_to_dict, or read from a file.
        source: Named in errors.

    Raises:
        InvalidScene: A key is unknown or missing, or a value has the wrong type or is out of range.
    """
    return _core.scene_from_dict(data, source)


def scaled(scene: Scene, factor: float) -> Scene:
    """The scene with all its lengths times a factor, for robots of another size.

    Corners, thicknesses, start and goal are scaled about the world's origin; angles, friction and gravity stay.

    Args:
        scene: Stays as it is.
        factor: E.g. the ratio of two robots' CoM heights.

    Raises:
        InvalidOptions: The factor is out of the range of SCALES.
    """
    if not SCALES[0] <= factor <= SCALES[1]:
        raise InvalidOptions("scale", f"must lie in [{SCALES[0]:g}, {SCALES[1]:g}]", str(factor))
    out = scene.__copy__()
    for surface in out.surfaces:
        surface.vertices_W = factor * surface.vertices_W
        surface.thickness = factor * surface.thickness
    for stance in (out.start, out.goal):
        stance.position_W = factor * stance.position_W
    return out
