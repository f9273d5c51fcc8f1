"""URDF and SRDF files, looked through before Pinocchio gets them.

Its parser walks trees by recursion, expands and opens what it is told to, and takes any number. So the XML is read here
first, within limits, and what is handed on is text that has been looked at.
"""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path
from typing import Any
from xml.parsers import expat

from mcplan.errors import InvalidInput, shown, together, written
from mcplan.files.reading import MAX_MESH, MAX_URDF, read_file, require_regular_file

#: Links of a robot, and of a chain of them from the root.
MAX_LINKS, MAX_CHAIN = 1000, 200
_MAX_ELEMENTS, _MAX_DEPTH, _MAX_FINDINGS = 200_000, 32, 1000
#: Of a length, a mass or an inertia, in SI units.
_MAX_NUMBER = 1e9
_MESH_TYPES = (".stl", ".dae", ".obj", ".msh", ".ply", ".glb", ".gltf", ".off", ".3ds", ".stlb")
_FOLDERS_ABOVE = 5  # in which packages are looked for

#: How many finite numbers an attribute holds; what is left out has a default.
_NUMBERS = {
    "origin": {"xyz": 3, "rpy": 3},
    "axis": {"xyz": 3},
    "mass": {"value": 1},
    "inertia": {"ixx": 1, "ixy": 1, "ixz": 1, "iyy": 1, "iyz": 1, "izz": 1},
    "limit": {"lower": 1, "upper": 1, "effort": 1, "velocity": 1},
    "dynamics": {"damping": 1, "friction": 1},
    "box": {"size": 3},
    "cylinder": {"radius": 1, "length": 1},
    "capsule": {"radius": 1, "length": 1},
    "sphere": {"radius": 1},
    "mesh": {"scale": 3},
}


@dataclass(frozen=True)
class Xml:
    """An XML file within the limits.

    Attributes:
        root: Its root element.
        text: The same as text, without comments and declarations.
    """

    root: ElementTree.Element
    text: str


def read_urdf(path: str | Path, error: type[InvalidInput], field: str = "", source: str | None = None) -> Xml:
    """Read a URDF.

    Args:
        path: Of the file.
        error: Class of the errors.
        field: Where another file names this one, for messages.
        source: File named in messages; None: this one.

    Raises:
        InvalidInput: Of the given class: it cannot be read, is no XML or no URDF, is too large or nested too deep, its
            joints are no tree, a number is none, or a mesh is no regular file in the robot's package. All findings.
    """
    source = str(path) if source is None else source
    xml = read_xml(path, error, field, source)
    prefix = f"{field}: " if field else ""
    if xml.root.tag != "robot":
        rule = f"{prefix}must be a URDF file, with the root element robot"
        raise error("", rule, written(xml.root.tag), source)
    found = chain(_tree_findings(xml.root), _number_findings(xml.root), _mesh_findings(xml.root, Path(path)))
    findings = [error(f"{prefix}{where}", rule, value, source) for where, rule, value in islice(found, _MAX_FINDINGS)]
    if findings:
        raise together(findings)
    return xml


def read_xml(path: str | Path, error: type[InvalidInput], field: str = "", source: str | None = None) -> Xml:
    """Read an XML file, such as an SRDF.

    Raises:
        InvalidInput: Of the given class: it cannot be read, is no XML, is too large, or nested too deep.
    """
    source = str(path) if source is None else source
    data = read_file(path, MAX_URDF, error, field, source)
    try:
        _require_small(data)
        root = ElementTree.fromstring(data)
    except (expat.ExpatError, ElementTree.ParseError) as bad:
        raise error(field, f"is not XML: {bad}", source=source) from None
    except (ValueError, LookupError) as bad:  # what _require_small says; encodings that nobody knows
        raise error(field, f"is not XML of ours: {bad}", source=source) from None
    return Xml(root, ElementTree.tostring(root, encoding="unicode"))


def build_model(xml: Xml, error: type[InvalidInput], source: str) -> Any:
    """Pinocchio's model of a URDF, with a free base.

    Raises:
        InvalidInput: Of the given class: Pinocchio cannot read it, or it has no mass that a robot can have.
    """
    import pinocchio as pin  # type: ignore[import-untyped]

    try:
        model = pin.buildModelFromXML(xml.text, pin.JointModelFreeFlyer())
    except Exception as found:  # it raises classes of its own, of Boost and of the standard library
        reason = (str(found).splitlines() or [type(found).__name__])[0]
        raise error("", "must be a URDF that Pinocchio reads", shown(reason, 200), source) from None
    for joint in range(1, model.njoints):
        inertia = model.inertias[joint]
        if not math.isfinite(inertia.mass) or not all(map(math.isfinite, [*inertia.lever, *inertia.inertia.flat])):
            raise error(f"joint {model.names[joint]}", "must carry a finite mass and inertia", source=source)
    return model


def package_folders(path: Path) -> list[str]:
    """Folders in which the packages of a URDF are looked for: its own and those above."""
    return [str(folder) for folder in list(path.parents)[:_FOLDERS_ABOVE]]


def _require_small(data: bytes) -> None:
    """Count elements and depth without building anything."""
    parser = expat.ParserCreate()
    depth = count = 0

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal depth, count
        depth, count = depth + 1, count + 1
        if depth > _MAX_DEPTH:
            raise ValueError(f"may be nested {_MAX_DEPTH} deep at most")
        if count > _MAX_ELEMENTS:
            raise ValueError(f"may have {_MAX_ELEMENTS} elements at most")

    def end(tag: str) -> None:
        nonlocal depth
        depth -= 1

    def doctype(*_: Any) -> None:
        raise ValueError("may not declare a document type or entities")

    parser.StartElementHandler, parser.EndElementHandler, parser.StartDoctypeDeclHandler = start, end, doctype
    parser.Parse(data, True)


_Found = tuple[str, str, str]  # field, rule, value


def _tree_findings(root: ElementTree.Element) -> Iterator[_Found]:
    """Joints that do not make a tree of few links."""
    links = [link.get("name", "") for link in root.findall("link")]
    if len(links) > MAX_LINKS:
        yield "link", f"may be {MAX_LINKS} at most", str(len(links))
        return
    for name in sorted({name for name in links if not name or links.count(name) > 1}):
        yield f"link {name}".strip(), "must have a name of its own", written(name)
    parents: dict[str, str] = {}
    broken = False
    for joint in root.findall("joint"):
        field = f"joint {joint.get('name')}"
        found = list(_joint_findings(joint, field, set(links), parents))
        broken |= bool(found)
        yield from found
    if not broken:
        yield from _chain_findings(links, parents)


def _joint_findings(joint: Any, field: str, links: set[str], parents: dict[str, str]) -> Iterator[_Found]:
    """What is wrong with a joint; if nothing, it is put among the parents."""
    ends = {}
    for key in ("parent", "child"):
        element = joint.find(key)
        ends[key] = "" if element is None else element.get("link", "")
        if not ends[key]:
            yield f"{field}.{key}", "is required", ""
            return
        if ends[key] not in links:
            yield f"{field}.{key}", "must name a link", written(ends[key])
            return
    parent, child = ends["parent"], ends["child"]
    if child in parents:
        yield field, "must be the only joint that carries its link (no loops)", written(child)
        return
    above, steps = parent, 0
    while above in parents and above != child and steps <= len(parents):
        above, steps = parents[above], steps + 1
    if above == child:
        yield field, "may not close a loop", written(child)
        return
    parents[child] = parent


def _chain_findings(links: list[str], parents: dict[str, str]) -> Iterator[_Found]:
    roots = [name for name in links if name not in parents]
    if len(roots) != 1:
        yield "link", "must be one without a joint above it, the root", f"{len(roots)}: {written(roots)}"
        return
    depth = {roots[0]: 1}
    for link in links:
        upward = [link]
        while upward[-1] not in depth:
            upward.append(parents[upward[-1]])
        for below in reversed(upward[:-1]):
            depth[below] = depth[parents[below]] + 1
    deepest = max(depth, key=lambda name: depth[name])
    if depth[deepest] > MAX_CHAIN:
        yield f"link {deepest}", f"may be at most the link number {MAX_CHAIN} of its chain", str(depth[deepest])


def _number_findings(root: ElementTree.Element) -> Iterator[_Found]:
    for part in root:
        if part.tag not in ("link", "joint"):
            continue
        for element in part.iter():
            for name, count in _NUMBERS.get(str(element.tag), {}).items():
                value = element.get(name)
                if value is not None and not _are_numbers(value, count, element.tag == "limit"):
                    rule = "must be a finite number" if count == 1 else f"must be {count} finite numbers"
                    yield f"{part.tag} {part.get('name')}: {element.tag}.{name}", rule, written(value)
        for limit in part.findall("limit"):
            ends = [limit.get("lower", "0"), limit.get("upper", "0")]
            if all(_are_numbers(end, 1, True) for end in ends) and float(ends[0]) > float(ends[1]):
                yield f"{part.tag} {part.get('name')}: limit.lower", "must not be above upper", " > ".join(ends)
        for inertial in part.findall("inertial"):
            yield from _inertial_findings(inertial, f"{part.tag} {part.get('name')}")
        for mass in part.findall("inertial/mass"):
            if _are_numbers(mass.get("value", "0"), 1, False) and float(mass.get("value", "0")) < 0.0:
                yield f"{part.tag} {part.get('name')}: mass.value", "must not be negative", written(mass.get("value"))


def _inertial_findings(inertial: Any, field: str) -> Iterator[_Found]:
    """What an inertial lacks: Pinocchio's parser would take the link as one without mass."""
    for tag, attributes in {"mass": _NUMBERS["mass"], "inertia": _NUMBERS["inertia"]}.items():
        element = inertial.find(tag)
        missing = [tag] if element is None else [f"{tag}.{name}" for name in attributes if element.get(name) is None]
        for name in missing:
            yield f"{field}: inertial.{name}", "is required", ""


def _are_numbers(text: str, count: int, any_size: bool) -> bool:
    words = text.split()
    try:
        values = [float(word) for word in words if "_" not in word]
    except ValueError:
        return False
    return len(words) == len(values) == count and all(
        math.isfinite(value) and (any_size or abs(value) <= _MAX_NUMBER) for value in values
    )


def _mesh_findings(root: ElementTree.Element, urdf: Path) -> Iterator[_Found]:
    """Meshes that may not be read. One that is not there is left to who needs it."""
    path = Path(os.path.abspath(urdf))
    for link in root.findall("link"):
        for mesh in link.iter("mesh"):
            name = mesh.get("filename", "")
            field = f"link {link.get('name')}: mesh.filename"
            for candidate, home in _mesh_candidates(name, path):
                if not os.path.lexists(candidate):
                    continue
                if not candidate.is_relative_to(home):
                    yield (
                        field,
                        "must lie in the robot's package: in the folder above the URDF's, or below",
                        written(name),
                    )
                elif candidate.suffix.lower() not in _MESH_TYPES:
                    yield field, f"must end in {', '.join(_MESH_TYPES)}", written(name)
                else:
                    try:
                        require_regular_file(candidate, MAX_MESH, InvalidInput, field)
                    except InvalidInput as found:
                        yield found.field, found.rule, found.value


def _mesh_candidates(name: str, urdf: Path) -> Iterator[tuple[Path, Path]]:
    """Where a mesh may be found, and the folder that it may not leave."""
    if "\0" in name or len(name) > 4096:
        return
    own = urdf.parent.parent
    for folder in map(Path, package_folders(urdf)):
        if name.startswith("package://"):
            inside = name.removeprefix("package://")
            package = folder / inside.split("/", 1)[0]
            home = own if package in (folder / "..", folder) else package
            yield Path(os.path.normpath(folder / inside)), home
        elif not name.startswith("file://") and not os.path.isabs(name):
            yield Path(os.path.normpath(folder / name)), own
    if name.startswith("file://") or os.path.isabs(name):
        yield Path(os.path.normpath(urdf.parent / name.removeprefix("file://"))), own
