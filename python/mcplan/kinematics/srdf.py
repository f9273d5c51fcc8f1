"""The SRDF of a robot: rotors of its motors, and which links need not be looked at for collisions."""

from __future__ import annotations

from pathlib import Path

from mcplan.errors import InvalidRobot
from mcplan.files.urdf_reading import read_xml


def srdf_beside(urdf: Path) -> Path | None:
    """The SRDF of a URDF file: in its folder or in a folder `srdf` beside that one, of the URDF's name or of what its name
    begins with, the longest first; None: there is none."""
    candidates = [*urdf.parent.glob("*.srdf"), *urdf.parent.parent.glob("srdf/*.srdf")]
    own = [path for path in candidates if urdf.stem.startswith(path.stem)]
    return max(own, key=lambda path: (len(path.stem), path.parent == urdf.parent), default=None)


def disabled_pairs(srdf: Path, robot: str) -> set[frozenset[str]]:
    """Pairs of links between which an SRDF disables collisions.

    Raises:
        InvalidRobot: The file cannot be read.
    """
    root = read_xml(srdf, InvalidRobot, "srdf", robot).root
    pairs = ((item.get("link1", ""), item.get("link2", "")) for item in root.iter("disable_collisions"))
    return {frozenset(pair) for pair in pairs if all(pair)}
