"""Scenes from and to TOML files and plain dicts."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from mcplan._core import ContactRule, Scene, Stance, Step, Surface
from mcplan.errors import InvalidInput, InvalidOptions, InvalidScene, UnknownScene, apart
from mcplan.files import builtin
from mcplan.files.geometry import require_meant
from mcplan.files.outputs import write_whole
from mcplan.files.sound_parts import elsewhere, name_of, replaced
from mcplan.files.toml import read_toml, toml_text


def list_scenes() -> list[str]:
    """Names of the built-in scenes."""
    return builtin.names("scenes")


def load_scene(source: str | Path) -> Scene:
    """Load a scene by its built-in name or from a TOML file; see mcplan.load_scene."""
    path = builtin.find(source, "scenes", UnknownScene)
    data = read_toml(path, InvalidScene)
    data.setdefault("name", path.stem)
    scene = scene_from_dict(data, source=str(path))
    require_meant(scene, str(path))
    return scene


def save_scene(scene: Scene, path: str | Path, header: str = "") -> None:
    """Write a scene to a TOML file.

    Args:
        scene: A valid scene.
        path: Where to.
        header: Comment to put on top.

    Raises:
        InvalidScene: A field is out of range.
    """
    scene.validate()
    write_whole(toml_text(scene_to_dict(scene), header), path)


def scene_to_dict(scene: Scene) -> dict[str, Any]:
    """Plain data with the keys of a scene file; what is at its default is left out."""
    data: dict[str, Any] = {"name": scene.name}
    if scene.description:
        data["description"] = scene.description
    data["gravity"] = scene.gravity
    data["start"] = _stance_to_dict(scene.start)
    data["goal"] = _stance_to_dict(scene.goal)
    data["surfaces"] = [_surface_to_dict(surface) for surface in scene.surfaces]
    if scene.rules:
        data["rules"] = [{"when_free": list(r.when_free), "require": list(r.require)} for r in scene.rules]
    if scene.steps:
        data["steps"] = [{"end_effector": step.end_effector, "surface": step.surface} for step in scene.steps]
    return data


def scene_from_dict(data: Mapping[str, Any], source: str = "") -> Scene:
    """The scene of plain data with the keys of a scene file.

    Args:
        data: As from scene_to_dict, or read from a file.
        source: Named in errors.

    Raises:
        InvalidScene: A key is unknown or missing, or a value has the wrong type or is out of range.
    """
    from mcplan.files.fields import validated
    from mcplan.files.models import SceneModel

    model = validated(SceneModel, dict(data), InvalidScene, source, _besides)
    scene = rebuild_scene(model.model_dump())
    try:
        scene.validate()
    except InvalidScene as found:
        raise found.moved(source=source) from None
    return scene


def _besides(data: Any, locations: list[tuple[Any, ...]]) -> list[InvalidInput]:
    """What is wrong with the parts of a scene that have their keys and types right."""
    from pydantic import ValidationError

    from mcplan.files.models import SceneModel

    square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    surfaces = data.get("surfaces")
    first = name_of(surfaces[0], 0) if isinstance(surfaces, list) and surfaces else name_of(None, 0)
    stance = {"position": [0.0, 0.0, 0.0], "contacts": {"foot": first}}
    sound, fields = replaced(
        data,
        locations,
        {
            "surfaces": lambda value, i: {"name": name_of(value, i), "vertices": square} if i >= 0 else [],
            "start": lambda value, i: stance,
            "goal": lambda value, i: stance,
            "rules": lambda value, i: {"when_free": ["foot"], "require": ["hand"]} if i >= 0 else [],
            "steps": lambda value, i: {"end_effector": "foot", "surface": first} if i >= 0 else [],
        },
    )
    if "surfaces" in fields or not isinstance(surfaces, list):
        return []  # what the others name is not known
    try:
        rebuild_scene(SceneModel.model_validate(sound).model_dump()).validate()
    except InvalidScene as found:
        named = all(name_of(value, i) != name_of(None, i) for i, value in enumerate(surfaces))
        others = [each for each in apart(found) if elsewhere(each, fields)]
        return [each for each in others if named or not each.rule.startswith("must name a surface")]
    except ValidationError:
        pass
    return []


def rebuild_scene(data: Mapping[str, Any]) -> Scene:
    """Inverse of scene_to_dict without checks, for pickles."""
    return Scene(
        name=data.get("name") or "",
        description=data.get("description", ""),
        gravity=data.get("gravity", Scene().gravity),
        surfaces=[_surface_from_dict(surface) for surface in data["surfaces"]],
        start=_stance_from_dict(data["start"]),
        goal=_stance_from_dict(data["goal"]),
        rules=[ContactRule(**rule) for rule in data.get("rules", [])],
        steps=[Step(**step) for step in data.get("steps", [])],
    )


def scaled(scene: Scene, factor: float) -> Scene:
    """The scene with all its lengths times a factor, for robots of another size.

    Corners, thicknesses, start and goal are scaled about the world's origin; angles, friction and gravity stay.

    Args:
        scene: Stays as it is.
        factor: E.g. the ratio of two robots' CoM heights.

    Raises:
        InvalidOptions: The factor is not a positive number.
    """
    if not (math.isfinite(factor) and factor > 0.0):
        raise InvalidOptions("scale", "must be a positive number", str(factor))
    data = scene_to_dict(scene)
    for surface, plain in zip(scene.surfaces, data["surfaces"], strict=True):
        plain["vertices"] = (factor * surface.vertices_W).tolist()
        plain["thickness"] = factor * surface.thickness
    for stance in (data["start"], data["goal"]):
        stance["position"] = [factor * x for x in stance["position"]]
    return rebuild_scene(data)


def _surface_to_dict(surface: Surface) -> dict[str, Any]:
    default = Surface()
    data: dict[str, Any] = {"name": surface.name, "vertices": surface.vertices_W.tolist()}
    for key in ("friction", "grasp", "thickness"):
        if getattr(surface, key) != getattr(default, key):
            data[key] = getattr(surface, key)
    if surface.end_effectors:
        data["end_effectors"] = list(surface.end_effectors)
    return data


def _surface_from_dict(data: Mapping[str, Any]) -> Surface:
    rest = {key: value for key, value in data.items() if key != "vertices"}
    return Surface(vertices_W=data["vertices"], **rest)


def _stance_to_dict(stance: Stance) -> dict[str, Any]:
    data: dict[str, Any] = {"position": stance.position_W.tolist()}
    if stance.yaw:
        data["yaw"] = stance.yaw
    data["contacts"] = dict(stance.contacts)
    return data


def _stance_from_dict(data: Mapping[str, Any]) -> Stance:
    return Stance(position_W=data["position"], yaw=data.get("yaw", 0.0), contacts=data["contacts"])
