"""The contacts of each phase of a motion file: all of them, or what changes against the phase before."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mcplan._core import PlanarContact, PlanarRobot, PlanarTask
from mcplan.errors import InvalidMotion, shown
from mcplan.files.planar_robots import index_of, require_unique

_TURN = 2.0 * math.pi


class Stances:
    """Walks through the phases of a file and remembers where each contact was written.

    Contacts of a phase come in the order of the robot's end-effectors, whatever their order in the file.
    """

    def __init__(self, robot: PlanarRobot, surfaces: Sequence[Mapping[str, Any]]) -> None:
        self._ends = [end.name for end in robot.end_effectors]
        self._surfaces = surfaces
        self._names = [surface["name"] for surface in surfaces]
        require_unique(self._names, "surfaces", InvalidMotion)
        self._current: dict[int, tuple[PlanarContact, str, bool]] = {}  # end-effector -> contact, its field, by `at`
        self._written: list[list[tuple[int, str, bool]]] = []  # of each phase: end-effector, field, by `at`

    def next(self, phase: Mapping[str, Any]) -> list[PlanarContact]:
        """Contacts of the next phase.

        Args:
            phase: Plain data of the phase, with contacts, lift and place.

        Raises:
            InvalidMotion: Names that do not exist, end-effectors lifted that were not in contact, or the like.
        """
        field = f"phases[{len(self._written)}]"
        if phase["contacts"]:
            for key in ("lift", "place"):
                if phase[key]:
                    raise InvalidMotion(f"{field}.{key}", "may not stand beside contacts, which say it all")
            self._current = {}
            self._place(phase["contacts"], f"{field}.contacts")
        elif not phase["lift"] and not phase["place"]:
            first = not self._written
            raise InvalidMotion(f"{field}.contacts", "is required" + ("" if first else ", or lift or place"))
        else:
            if not self._written:
                raise InvalidMotion(f"{field}.contacts", "is required of the first phase")
            for i, name in enumerate(phase["lift"]):
                self._lift(name, f"{field}.lift[{i}]")
            self._place(phase["place"], f"{field}.place")
            if not self._current:
                raise InvalidMotion(f"{field}.lift", "must leave one contact at least")
        self._written.append([(end, *self._current[end][1:]) for end in sorted(self._current)])
        return [self._current[end][0] for end in sorted(self._current)]

    def locate(self, phase: int, contact: int, attribute: str, rule: str) -> tuple[str, str]:
        """Field and rule of an error at a contact that next() has returned, for the file.

        What is wrong with a contact that stood in the phase before already lies in what is new against that.
        """
        end, where, by_at = self._written[phase][contact]
        if not where.startswith(f"phases[{phase}]."):
            return f"phases[{phase}].place", f"{self._ends[end]} {rule}"
        return f"{where}.{'at' if by_at and attribute == 'position' else attribute}", rule

    def end_effector(self, name: str, field: str) -> int:
        """Index of an end-effector by name, or InvalidMotion."""
        return index_of(name, self._ends, field, "an end-effector of the robot", InvalidMotion)

    def surface(self, name: str, field: str) -> int:
        """Index of a surface by name, or InvalidMotion."""
        return index_of(name, self._names, field, "one of the surfaces", InvalidMotion)

    def _lift(self, name: str, field: str) -> None:
        end = self.end_effector(name, field)
        if end not in self._current:
            raise InvalidMotion(field, "must be in contact in the phase before", shown(name))
        del self._current[end]

    def _place(self, contacts: Sequence[Mapping[str, Any]], field: str) -> None:
        for i, entry in enumerate(contacts):
            where = f"{field}[{i}]"
            contact = self._contact(entry, where)
            if contact.end_effector in self._current:
                rule = "is in contact already" + (": lift it first" if field.endswith("place") else "")
                raise InvalidMotion(f"{where}.end_effector", rule, shown(entry["end_effector"]))
            self._current[contact.end_effector] = (contact, where, entry["at"] is not None)

    def _contact(self, entry: Mapping[str, Any], field: str) -> PlanarContact:
        end = self.end_effector(entry["end_effector"], f"{field}.end_effector")
        index = self.surface(entry["surface"], f"{field}.surface")
        surface = self._surfaces[index]
        if (entry["at"] is None) == (entry["position"] is None):
            rule = "is required, or position" if entry["at"] is None else "may not stand beside position"
            raise InvalidMotion(f"{field}.at", rule)
        if entry["turns"] is not None and entry["angle"] is not None:
            raise InvalidMotion(f"{field}.turns", "may not stand beside angle")
        position, angle = entry["position"], entry["angle"]
        if position is None:
            position = _point_on(surface["origin"], surface["angle"], entry["at"])
        if angle is None:
            angle = surface["angle"] + _TURN * (entry["turns"] or 0)
        return PlanarContact(end_effector=end, surface=index, position_W=position, angle=angle)


def contact_to_dict(contact: PlanarContact, motion: PlanarTask) -> dict[str, Any]:
    """A contact by `at` and `turns` if they give exactly the same numbers, else by `position` and `angle`."""
    surface = motion.surfaces[contact.surface]
    data: dict[str, Any] = {
        "end_effector": motion.robot.end_effectors[contact.end_effector].name,
        "surface": surface.name,
    }
    tangent = np.array([math.cos(surface.angle), math.sin(surface.angle)])
    at = float(tangent @ (contact.position_W - surface.origin_W))
    at = round(at, 12) if _is_at(contact, surface, round(at, 12)) else at
    if _is_at(contact, surface, at):
        data["at"] = at
    else:
        data["position"] = contact.position_W.tolist()
    turns = round((contact.angle - surface.angle) / _TURN)
    if surface.angle + _TURN * turns != contact.angle:
        data["angle"] = contact.angle
    elif turns:
        data["turns"] = turns
    return data


def _is_at(contact: PlanarContact, surface: Any, at: float) -> bool:
    return _point_on(surface.origin_W, surface.angle, at) == contact.position_W.tolist()


def _point_on(origin: Sequence[float], angle: float, at: float) -> list[float]:
    return [float(origin[0] + at * math.cos(angle)), float(origin[1] + at * math.sin(angle))]
