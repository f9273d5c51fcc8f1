"""A robot's URDF rewritten for MuJoCo.

MuJoCo reads URDF, with traps: it looks for meshes beside the file, reads no ``package://`` and no .dae, refuses
massless links, and merges a root link without a joint into the world, its mass lost. So the text is rewritten: links
that move get the inertia that Pinocchio has worked out for them and what is fixed to them, meshes get absolute paths,
and only what is asked for is kept.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mcplan.errors import InvalidRobot
from mcplan.files.urdf_reading import read_xml

if TYPE_CHECKING:
    from mcplan.kinematics.urdf_model import UrdfModel

#: File types of meshes that MuJoCo reads.
MESHES = (".stl", ".obj", ".msh")


def rewrite(urdf_model: UrdfModel, visual: bool = False) -> tuple[str, str]:
    """URDF text that MuJoCo reads as Pinocchio read the file.

    Args:
        urdf_model: The robot's model.
        visual: Keep visual shapes, but for meshes of types that MuJoCo does not read.

    Returns:
        The text, and the name of the root link.

    Raises:
        InvalidRobot: The joints of the file are not those of the model.
    """
    root = read_xml(urdf_model.path, InvalidRobot, "urdf", urdf_model.robot.name).root
    for item in list(root):
        if item.tag not in ("link", "joint", "material"):
            root.remove(item)
    joints = root.findall("joint")
    children = {_link(joint, "child"): joint for joint in joints}
    roots = [link.get("name", "") for link in root.findall("link") if link.get("name") not in children]
    moving = {joint.get("name", ""): link for link, joint in children.items() if joint.get("type") != "fixed"}
    model = urdf_model.model
    expected = list(model.names)[2:]
    if len(roots) != 1 or sorted(moving) != sorted(expected) or any(model.nqs[j] != 1 for j in range(2, model.njoints)):
        odd = sorted(set(moving) ^ set(expected)) or [n for n in expected if model.nqs[model.getJointId(n)] != 1]
        raise InvalidRobot(
            "urdf", "must have one root and joints of one degree of freedom with limits", ", ".join(odd) or str(roots)
        )
    carriers = {moving[name]: model.getJointId(name) for name in moving} | {roots[0]: 1}
    for joint in joints:
        for mimic in joint.findall("mimic"):  # Pinocchio has these joints free
            joint.remove(mimic)
    for link in root.findall("link"):
        for item in link.findall("inertial") + link.findall("collision"):
            link.remove(item)
        for item in link.findall("visual"):
            if not (visual and _resolve_mesh(item, urdf_model.path)):
                link.remove(item)
        if link.get("name") in carriers:
            link.append(_inertial(model.inertias[carriers[link.get("name", "")]]))
    extension = ET.SubElement(root, "mujoco")
    flag = "false" if visual else "true"
    ET.SubElement(extension, "compiler", strippath="false", fusestatic="false", discardvisual=flag)
    return ET.tostring(root, encoding="unicode"), roots[0]


def _link(joint: ET.Element, role: str) -> str:
    found = joint.find(role)
    return found.get("link", "") if found is not None else ""


def _resolve_mesh(visual: ET.Element, urdf: Path) -> bool:
    """Give a visual's mesh its absolute path; False if it is of no use to MuJoCo."""
    mesh = visual.find("geometry/mesh")
    if mesh is None:
        return visual.find("geometry/*") is not None
    name = mesh.get("filename", "")
    path = _find(name, urdf)
    if path is None or path.suffix.lower() not in MESHES:
        return False
    mesh.set("filename", str(path))
    return True


def _find(name: str, urdf: Path) -> Path | None:
    """A mesh named by package://, file:// or a path relative to the URDF; packages lie in the folders above it."""
    if name.startswith("package://"):
        inside = name[len("package://") :]
        candidates = [folder / inside for folder in urdf.parents]
    else:
        candidates = [urdf.parent / name.removeprefix("file://")]
    return next((path.resolve() for path in candidates if path.is_file()), None)


def _inertial(inertia: Any) -> ET.Element:
    """Mass, centre and inertia of a Pinocchio inertia as URDF has them."""
    out = ET.Element("inertial")
    ET.SubElement(out, "origin", xyz=" ".join(repr(float(x)) for x in inertia.lever), rpy="0 0 0")
    ET.SubElement(out, "mass", value=repr(float(inertia.mass)))
    matrix, axes = inertia.inertia, "xyz"
    terms = {f"i{axes[i]}{axes[j]}": repr(float(matrix[i, j])) for i in range(3) for j in range(i, 3)}
    ET.SubElement(out, "inertia", terms)
    return out
