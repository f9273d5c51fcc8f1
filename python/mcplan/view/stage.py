"""Objects of a page as meshcat commands: three.js JSON with binary arrays, a clip per moving node."""

from __future__ import annotations

import gzip
import struct
from typing import Any
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.kinematics.rotations import quat_xyzw

from .colours import rgb
from .shapes import Mesh

Array = NDArray[np.float64]

#: Codes under which meshcat's decoder makes typed arrays of msgpack extensions.
UINT32, FLOAT32 = 0x16, 0x17
#: Half of the angle that the camera of meshcat's page sees, and the colour behind everything.
HALF_VIEW, BACKDROP = np.radians(37.5), "#eef1f5"


def node(name: str) -> str:
    """A name from a file as a part of a node's path: plain ones as they are, without blanks and slashes in any."""
    return quote(name, safe="")


def decimals(size_m: float) -> int:
    """Decimals of lengths [m] on a page: micrometres and less, in proportion for what is smaller than a robot is."""
    return 5 + max(0, int(np.ceil(-np.log10(max(size_m, 1e-9)))))


class Stage:
    """Collects what a page shows. Nodes are named by paths such as "plan/forces/left_foot".

    Args:
        size_m: Size of the robot, which says how finely lengths are stored.
    """

    def __init__(self, size_m: float = 1.0) -> None:
        require("mcplan.show", "view", "meshcat")
        import umsgpack  # type: ignore[import-untyped]  # comes with meshcat

        self._umsgpack = umsgpack
        self._commands: list[dict[str, Any]] = []
        self._clips: dict[str, list[dict[str, Any]]] = {}
        self._ids = 0
        self._decimals = decimals(size_m)
        self.duration_s = 0.0

    def mesh(
        self,
        path: str,
        mesh: Mesh,
        colour: str,
        opacity: float = 1.0,
        *,
        glow: float = 0.0,
        on_top: bool = False,
    ) -> None:
        """Add a solid.

        Args:
            path: Node that carries it.
            mesh: Its shape, in the frame of the node.
            colour: "#rrggbb".
            opacity: 1 is solid.
            glow: Share of the colour that needs no light.
            on_top: Seen through whatever lies in front.
        """
        material: dict[str, Any] = {
            "type": "MeshPhongMaterial",
            "color": _number(colour),
            "emissive": _number(colour) if glow else 0,
            "emissiveIntensity": glow,
            "specular": 0x222222,
            "shininess": 18,
            "opacity": opacity,
            "transparent": opacity < 1.0 or on_top,
            "depthWrite": opacity == 1.0,
            "depthTest": not on_top,
            "flatShading": not mesh.smooth,
            "side": 2 if opacity < 1.0 or mesh.two_sided else 0,  # three.js: 0 front, 2 both
        }
        self._object(path, "Mesh", mesh.vertices, mesh.faces, material, render_order=10 if on_top else 0)

    def lines(self, path: str, segments: Array, colour: str, opacity: float = 1.0) -> None:
        """Add hairlines between pairs of points, segments (n, 2, 3) [m]."""
        material = {
            "type": "LineBasicMaterial",
            "color": _number(colour),
            "opacity": opacity,
            "transparent": opacity < 1.0,
        }
        self._object(path, "LineSegments", np.asarray(segments).reshape(-1, 3), None, material)

    def place(self, path: str, pose: Array) -> None:
        """Put a node at a pose (4, 4) in its parent's frame."""
        self._commands.append(_transform(_full(path), pose))

    def backdrop(self) -> None:
        """Show what there is on plain ground: for the server's own page, which has a sky and a grid."""
        for name, value in (("top_color", BACKDROP), ("bottom_color", BACKDROP)):
            self._commands.append(_property("/Background", name, [*rgb(value)]))
        self._commands.append(_property("/Grid", "visible", False))

    def look(self, points_W: Array, direction_W: Array) -> None:
        """Put the camera of the server's own page where all points are seen.

        Args:
            points_W: (n, 3) [m].
            direction_W: (3,) from there towards the camera.
        """
        low, high = points_W.min(axis=0), points_W.max(axis=0)
        radius = 0.5 * float(np.linalg.norm(high - low))
        away = np.asarray(direction_W, float) / np.linalg.norm(direction_W) * radius / np.sin(HALF_VIEW)
        to_origin = np.eye(4)  # where that camera looks, whatever its node's pose is
        to_origin[:3, 3] = -0.5 * (low + high)
        for path in ("/meshcat", "/Axes"):
            self._commands.append(_transform(path, to_origin))
        upright = [float(away[0]), float(away[2]), float(-away[1])]  # the camera's own frame has y up
        self._commands.append(_property("/Cameras/default/rotated/<object>", "position", upright))

    def remove(self, path: str) -> None:
        """Take a node away, and all below it."""
        self._commands.append({"type": "delete", "path": _full(path)})

    def move(
        self,
        path: str,
        times_s: Array,
        poses: Array | None = None,
        scales: Array | None = None,
        visible: NDArray[np.bool_] | None = None,
    ) -> None:
        """Animate a node.

        Args:
            path: Node.
            times_s: Times [s], (n,), increasing, the same first and last for all nodes.
            poses: Poses in the parent's frame, (n, 4, 4).
            scales: Scales along the node's axes, (n, 3).
            visible: Whether it is seen from each time on, (n,).
        """
        tracks = self._clips.setdefault(path, [])
        if poses is not None:
            tracks.append(self._track("position", "vector3", times_s, poses[:, :3, 3]))
            tracks.append(self._track("quaternion", "quaternion", times_s, quat_xyzw(poses[:, :3, :3])))
        if scales is not None:
            tracks.append(self._track("scale", "vector3", times_s, scales))
        if visible is not None:
            change = np.concatenate([[True], visible[1:] != visible[:-1]])
            values = [bool(v) for v in visible[change]]
            times = [float(t) for t in times_s[change]]
            tracks.append({"name": ".visible", "type": "bool", "times": times, "values": values})
        self.duration_s = max(self.duration_s, float(times_s[-1]))

    def payload(self) -> bytes:
        """All commands, each behind its length (uint32, little endian), gzipped; always the same bytes."""
        packed = [self._umsgpack.packb(command) for command in [*self._commands, *self._animation()]]
        return gzip.compress(b"".join(struct.pack("<I", len(p)) + p for p in packed), compresslevel=9, mtime=0)

    def taken(self) -> list[tuple[bytes, bytes, bytes]]:
        """Type, path and packed text of each command so far, which are forgotten: for a server that shows them at once."""
        commands = [*self._commands, *self._animation()]
        self._commands, self._clips, self.duration_s = [], {}, 0.0
        return [(c["type"].encode(), c["path"].encode(), self._umsgpack.packb(c)) for c in commands]

    def _animation(self) -> list[dict[str, Any]]:
        """The command that sets all clips going, if there are any."""
        animations = [
            {"path": _full(path), "clip": {"name": path, "fps": 1, "duration": self.duration_s, "tracks": tracks}}
            for path, tracks in self._clips.items()
        ]
        options = {"play": True, "repetitions": 1_000_000_000}
        command = {"type": "set_animation", "path": "", "animations": animations, "options": options}
        return [command] if animations else []

    def _track(self, name: str, kind: str, times_s: Array, values: Array) -> dict[str, Any]:
        if np.ptp(values, axis=0).max() < 10.0 ** (-2 - self._decimals):
            times_s, values = times_s[[0, -1]], values[[0, -1]]
        # Micrometres and a few microradians: below what is seen, and far better to compress.
        values = np.round(values, self._decimals) + 0.0
        return {
            "name": "." + name,
            "type": kind,
            "times": self._floats(times_s),
            "values": self._floats(values),
        }

    def _object(
        self,
        path: str,
        kind: str,
        vertices: Array,
        faces: Any,
        material: dict[str, Any],
        render_order: int = 0,
    ) -> None:
        attributes = {
            "position": {
                "itemSize": 3,
                "type": "Float32Array",
                "array": self._floats(np.round(vertices, self._decimals) + 0.0),
                "normalized": False,
            }
        }
        data: dict[str, Any] = {"attributes": attributes}
        if faces is not None:
            index = self._umsgpack.Ext(UINT32, np.ascontiguousarray(faces, "<u4").tobytes())
            data["index"] = {"itemSize": 3, "type": "Uint32Array", "array": index, "normalized": False}
        geometry = {"uuid": self._id(), "type": "BufferGeometry", "data": data}
        material = {"uuid": self._id(), **material}
        instance = {
            "uuid": self._id(),
            "type": kind,
            "geometry": geometry["uuid"],
            "material": material["uuid"],
            "matrix": [float(x) for x in np.eye(4).ravel()],
            "renderOrder": render_order,
        }
        lowered = {
            "metadata": {"version": 4.5, "type": "Object"},
            "geometries": [geometry],
            "materials": [material],
            "object": instance,
        }
        self._commands.append({"type": "set_object", "path": _full(path), "object": lowered})

    def _floats(self, values: Array) -> Any:
        return self._umsgpack.Ext(FLOAT32, np.ascontiguousarray(values, "<f4").tobytes())

    def _id(self) -> str:
        # three.js wants distinct identifiers; counting keeps the page the same from run to run.
        self._ids += 1
        return f"mcplan-{self._ids}"


def _transform(path: str, pose: Array) -> dict[str, Any]:
    return {"type": "set_transform", "path": path, "matrix": [float(x) for x in np.asarray(pose).T.ravel()]}


def _property(path: str, name: str, value: Any) -> dict[str, Any]:
    return {"type": "set_property", "path": path, "property": name, "value": value}


def _full(path: str) -> str:
    return "/meshcat/" + path


def _number(colour: str) -> int:
    red, green, blue = (round(255 * c) for c in rgb(colour))
    return (red << 16) + (green << 8) + blue
