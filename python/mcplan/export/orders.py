"""Orders of joints and rigid bodies: depth first as MuJoCo and Unitree have them, breadth first as PhysX has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from mcplan.errors import InvalidRobot
from mcplan.files.urdf_reading import read_urdf

if TYPE_CHECKING:
    from mcplan.kinematics.urdf_model import UrdfModel


@dataclass(frozen=True)
class Order:
    """Joints, and the rigid bodies that they move.

    Attributes:
        joints: Names of the nj joints.
        bodies: Names of the 1 + nj bodies, the base first, then the body of each joint: links that fixed joints hang on
            others are part of those.
    """

    joints: list[str]
    bodies: list[str]


def order_of(urdf_model: UrdfModel, breadth_first: bool) -> Order:
    """The order of a URDF's joints; children of one link are in the order of the file."""
    root = read_urdf(urdf_model.path, InvalidRobot).root
    children: dict[str, list[tuple[str, str]]] = {}
    inner = set()
    for element in root.findall("joint"):
        parent, child = (end.get("link", "") for tag in ("parent", "child") for end in element.findall(tag))
        children.setdefault(parent, []).append((element.get("name", ""), child))
        inner.add(child)
    base = next(link.get("name", "") for link in root.findall("link") if link.get("name") not in inner)
    moving = set(list(urdf_model.model.names)[2:])

    def moved_by(link: str) -> list[tuple[str, str]]:
        """The next joints that move, through fixed ones."""
        found = []
        for joint, child in children.get(link, ()):
            found += [(joint, child)] if joint in moving else moved_by(child)
        return found

    joints: list[str] = []
    bodies = [base]
    pending = moved_by(base)
    while pending:
        joint, link = pending.pop(0)
        joints.append(joint)
        bodies.append(link)
        pending = pending + moved_by(link) if breadth_first else moved_by(link) + pending
    return Order(joints, bodies)
