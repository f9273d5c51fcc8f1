"""The shapes of a URDF, as corners of meshes and boxes: what is as large as the robot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput
from mcplan.files.urdf_packages import packaged_visuals
from mcplan.files.urdf_reading import package_folders, read_urdf

Array = NDArray[np.float64]


def visuals_of(model: Any, source: str) -> Any:
    """The visual shapes; None where they cannot be read: a robot can be planned for without."""
    import pinocchio as pin

    path = Path(source)
    try:
        if not path.is_file():
            return packaged_visuals(source)
        text = read_urdf(path, InvalidInput).text
        return pin.buildGeomFromUrdfString(model, text, pin.GeometryType.VISUAL, None, package_folders(path))
    except Exception:  # of the file system or of Pinocchio's parsers
        return None


def corners_of(item: Any, placement: Any) -> Array:
    """Corners of a shape: those of its mesh, or of the box about it."""
    shape = item.geometry
    if hasattr(shape, "vertices"):
        corners = np.asarray(shape.vertices(), float)  # scaled as the URDF says when they were read
    else:
        shape.computeLocalAABB()
        box = np.array([shape.aabb_local.min_, shape.aabb_local.max_], float)
        corners = np.array([[box[i, 0], box[j, 1], box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    return corners @ placement.rotation.T + placement.translation
