"""Names of end-effectors that a scene has and the robot at hand has not, warned of where they can hardly be meant.

A scene serves several robots, so names of limbs that one of them lacks are legal: nobody touches that surface. Misspelt,
they are passed over just as silently.
"""

from __future__ import annotations

import difflib
import warnings
from collections.abc import Iterator, Sequence

from mcplan._core import Robot, Scene
from mcplan.errors import InvalidInput, SuspiciousName, did_you_mean, written

#: Similarity from which a name is taken for another one misspelt, of names as short as "foot" and of longer ones: "left_fot"
#: is "left_foot", which to a robot with "lf_foot" is a limb of other robots.
_SIMILAR_SHORT, _SIMILAR, _SHORT = 0.75, 0.88, 5
#: Names of a scene that are compared with those of a robot.
_MAX_NAMES = 100


def warn_of_names(scene: Scene, robot: Robot) -> None:
    """Warn of names in permissions and rules that are almost those of the robot, or of which it has none at all.

    Args:
        scene: A valid one.
        robot: A valid one.
    """
    known = list(
        dict.fromkeys([*(end.name for end in robot.end_effectors), *(end.kind for end in robot.end_effectors)])
    )
    meant: dict[str, str] = {}
    warned: set[str] = set()
    kinds = {end.name: end.kind for end in robot.end_effectors}
    for field, names, is_permission in _lists(scene):
        for i, name in enumerate(names):
            if name not in meant:
                meant[name] = name if name in known else _meant(name, known) if len(meant) < _MAX_NAMES else ""
            near = meant[name]
            if near in ("", name) or name in warned:
                continue
            if not (is_permission and (near in names or kinds.get(near) in names)):  # who is permitted anyway
                warned.add(name)
                rule = f"{robot.name} has no such end-effector. {did_you_mean(near, [near]).rstrip()}"
                _warn(scene, f"{field}[{i}]", rule, written(name))
    permitting = [(i, surface.end_effectors) for i, surface in enumerate(scene.surfaces) if surface.end_effectors]
    if permitting and not any(meant[name] for _, names in permitting for name in names):
        first, names = permitting[0]
        rule = f"{robot.name} has none that a surface permits; it has {', '.join(known)}"
        _warn(scene, f"surfaces[{first}].end_effectors", rule, written(list(names)))
    for i, rule_of_scene in enumerate(scene.rules):
        lacking = [name for name in rule_of_scene.require if not meant[name]]  # all of them would have to be in contact
        if lacking and any(meant[name] for name in rule_of_scene.when_free):
            rule = (
                f"{robot.name} has no such end-effector, so one of when_free is never free; it has {', '.join(known)}"
            )
            _warn(scene, f"rules[{i}].require", rule, written(lacking))


def _lists(scene: Scene) -> Iterator[tuple[str, Sequence[str], bool]]:
    """Where names stand, the names, and whether they permit to touch a surface."""
    for i, surface in enumerate(scene.surfaces):
        yield f"surfaces[{i}].end_effectors", surface.end_effectors, True
    for i, contact_rule in enumerate(scene.rules):
        yield f"rules[{i}].when_free", contact_rule.when_free, False
        yield f"rules[{i}].require", contact_rule.require, False


def _meant(name: str, known: Sequence[str]) -> str:
    """The name that was probably meant, or ""."""
    found = {entry.lower(): entry for entry in known}
    cutoff = _SIMILAR_SHORT if len(name) <= _SHORT else _SIMILAR
    near = difflib.get_close_matches(name[:60].lower(), found, n=1, cutoff=cutoff)
    return found[near[0]] if near else ""


def _warn(scene: Scene, field: str, rule: str, value: str) -> None:
    finding = InvalidInput(field, rule, value, scene.name)
    warnings.warn(str(finding), SuspiciousName, stacklevel=3)
