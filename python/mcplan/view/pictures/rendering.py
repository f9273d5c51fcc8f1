"""Off-screen pictures of a figure on its terrain: MuJoCo's renderer, in a graphics context without a window.

MuJoCo only draws here: the figure's parts are put where its poses say, and nothing is simulated.
"""

from __future__ import annotations

import importlib
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.extras import require
from mcplan.view.colours import OUTLINE, mix, rgb
from mcplan.view.figure import Figure
from mcplan.view.scene_drawing import SurfaceDrawing, edges
from mcplan.view.shapes import Mesh
from mcplan.view.winding import both_sides

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]

PACKAGES = "libegl1 libgl1-mesa-dri"
#: Groups by which MuJoCo shows and hides.
TERRAIN, ROBOT = 0, 1
#: Geoms that a picture may have: postures, grid lines, arrows.
MAX_GEOMS = 20000
#: [pixel]
LINE_WIDTH = 1.5
#: Half width of the square in which there are shadows, over the distance of the eye.
SHADOWED = 0.35
#: [degree] field of view from top to bottom.
FIELD = 30.0


class NoGraphics(RuntimeError):
    """No graphics context can be made; the message says which packages to install."""


@dataclass(frozen=True)
class Eye:
    """Where a picture is seen from.

    Attributes:
        target_W: (3,) [m] the point in the middle of the picture.
        distance_m: From there to the camera.
        azimuth_deg: Direction in which the camera looks, from x of the world towards y.
        elevation_deg: Below 0: from above.
    """

    target_W: Array
    distance_m: float
    azimuth_deg: float
    elevation_deg: float


@dataclass(frozen=True)
class Arrow:
    """An arrow from one point to another (3,) [m]."""

    start_W: Array
    end_W: Array
    colour: str
    radius_m: float


@dataclass(frozen=True)
class Path:
    """A line of points (n, 3) [m], as thin capsules."""

    points_W: Array
    colour: str
    radius_m: float
    opacity: float = 1.0


class Renderer:
    """Draws a figure at any of its samples. Use it as a context manager: graphics contexts want to be closed.

    Args:
        figure: The robot.
        drawings: The terrain.
        size: Width and height in pixels.
        sun_W: (3,) from the drawing towards the light.
        marks: Lines on the terrain beside its own: segments (n, 2, 3) [m] and their colour.
        shadows: Draw them; without, a picture takes less than half the time.

    Raises:
        MissingExtra: MuJoCo is not installed.
        NoGraphics: There is no graphics context to be had.
    """

    def __init__(
        self,
        figure: Figure,
        drawings: list[SurfaceDrawing],
        size: tuple[int, int],
        sun_W: Array,
        marks: list[tuple[Array, str]] | None = None,
        shadows: bool = True,
    ) -> None:
        require("rendering a run", "sim", "mujoco", "OpenGL")
        self._context = _graphics(size)
        import mujoco

        self._mj = mujoco
        self.figure, self.size = figure, size
        self._sun_W = np.asarray(sun_W, float) / np.linalg.norm(sun_W)
        self._target_W = np.zeros(3)
        self.model = _model(mujoco, figure, drawings, size, sun_W)
        self.data = mujoco.MjData(self.model)
        self.scene = mujoco.MjvScene(self.model, MAX_GEOMS)
        self.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        self.scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        self._painter = mujoco.MjrContext(self.model, mujoco.mjtFontScale.mjFONTSCALE_100)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._painter)
        marks = list(marks or [])
        for drawing in drawings:
            marks.append((drawing.grid + 0.003 * drawing.normal, mix(drawing.colour, "#ffffff", 0.6)))
            marks.append((edges(drawing), OUTLINE))
        self._lines = [(pair, colour) for segments, colour in marks for pair in segments]

    def __enter__(self) -> Renderer:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the graphics context; a second time does nothing."""
        if self._context is not None:
            self._context.make_current()
            self._painter.free()
            self._context.free()
            self._context = None

    def picture(
        self,
        samples: list[int],
        eye: Eye,
        arrows: list[Arrow] | None = None,
        paths: list[Path] | None = None,
        fades: list[float] | None = None,
    ) -> Pixels:
        """Draw the robot at some samples, all in one picture.

        Args:
            samples: Indices of the figure's poses.
            eye: Where it is seen from.
            arrows: Forces, for instance.
            paths: Lines.
            fades: Share of white in the robot at each of the samples; None: 0.

        Returns:
            (height, width, 3) red, green, blue.
        """
        mj, scene = self._mj, self.scene
        self._context.make_current()
        option = mj.MjvOption()
        camera = mj.MjvCamera()
        camera.lookat, camera.distance = eye.target_W, eye.distance_m
        camera.azimuth, camera.elevation = eye.azimuth_deg, eye.elevation_deg
        perturbation = mj.MjvPerturb()
        self._target_W = np.asarray(eye.target_W, float)
        # Shadows are drawn in a square of so many metres around the target: small, they are sharp.
        self._painter.shadowClip = SHADOWED * eye.distance_m
        for number, sample in enumerate(samples):
            self._place(sample)
            first = 0 if number == 0 else scene.ngeom
            if number == 0:
                mj.mjv_updateScene(
                    self.model, self.data, option, perturbation, camera, mj.mjtCatBit.mjCAT_ALL.value, scene
                )
            else:
                option.geomgroup[TERRAIN] = False
                mj.mjv_addGeoms(self.model, self.data, option, perturbation, mj.mjtCatBit.mjCAT_ALL.value, scene)
            self._fade(first, fades[number] if fades else 0.0)
        for pair, colour in self._lines:
            self._connect(mj.mjtGeom.mjGEOM_LINE, LINE_WIDTH, pair[0], pair[1], colour)
        for path in paths or []:
            for a, b in zip(path.points_W[:-1], path.points_W[1:], strict=True):
                self._connect(mj.mjtGeom.mjGEOM_CAPSULE, path.radius_m, a, b, path.colour, path.opacity)
        pixels = self._pixels()
        if arrows:
            # Legs would hide them: arrows are drawn once more by themselves, on black, and laid over the picture.
            scene.ngeom = 0
            for arrow in arrows:
                self._connect(mj.mjtGeom.mjGEOM_ARROW, arrow.radius_m, arrow.start_W, arrow.end_W, arrow.colour)
            flags = scene.flags.copy()
            scene.flags[mj.mjtRndFlag.mjRND_SKYBOX] = scene.flags[mj.mjtRndFlag.mjRND_SHADOW] = False
            over = self._pixels()
            scene.flags[:] = flags
            seen = over.max(axis=2) > 60
            pixels[seen] = over[seen]
        return pixels

    def _pixels(self) -> Pixels:
        width, height = self.size
        window = self._mj.MjrRect(0, 0, width, height)
        self._mj.mjr_render(window, self.scene, self._painter)
        pixels = np.empty((height, width, 3), np.uint8)
        self._mj.mjr_readPixels(pixels, None, window, self._painter)
        return pixels[::-1].copy()

    def _place(self, sample: int) -> None:
        for number, part in enumerate(self.figure.parts):
            pose = part.poses[sample]
            self.data.mocap_pos[number] = pose[:3, 3]
            self._mj.mju_mat2Quat(self.data.mocap_quat[number], pose[:3, :3].ravel())
        # MuJoCo draws the shadows of a directional light around its position.
        self.model.light_pos[0] = self._target_W + 4.0 * self._sun_W
        self._mj.mj_kinematics(self.model, self.data)
        self._mj.mj_camlight(self.model, self.data)

    def _fade(self, first: int, fade: float) -> None:
        if fade <= 0.0:
            return
        for geom in self.scene.geoms[first : self.scene.ngeom]:
            if geom.objtype == self._mj.mjtObj.mjOBJ_GEOM and self.model.geom_group[geom.objid] == ROBOT:
                geom.rgba[:3] = (1.0 - fade) * np.asarray(geom.rgba[:3]) + fade

    def _connect(self, kind: Any, width: float, start: Array, end: Array, colour: str, opacity: float = 1.0) -> None:
        if self.scene.ngeom >= self.scene.maxgeom:
            return
        geom = self.scene.geoms[self.scene.ngeom]
        rgba = np.array([*rgb(colour), opacity], np.float32)
        self._mj.mjv_initGeom(geom, kind, np.zeros(3), np.zeros(3), np.zeros(9), rgba)
        self._mj.mjv_connector(geom, kind, width, np.asarray(start, float), np.asarray(end, float))
        geom.emission = 0.0 if kind == self._mj.mjtGeom.mjGEOM_LINE else 0.3
        self.scene.ngeom += 1


def require_graphics() -> None:
    """Raise NoGraphics if nothing can be rendered here."""
    _graphics((16, 16)).free()


def _graphics(size: tuple[int, int]) -> Any:
    """A current OpenGL context: EGL's, or that of the environment variable MUJOCO_GL.

    MuJoCo reads that variable when it is imported, which may have happened long ago: so its context is asked for by
    name.
    """
    kind = os.environ.get("MUJOCO_GL", "").lower()
    kind = kind if kind in ("egl", "osmesa", "glfw") else "egl"
    os.environ.setdefault("MUJOCO_GL", kind)  # else importing MuJoCo looks for a screen
    try:
        context = importlib.import_module(f"mujoco.{kind}").GLContext(*size)
        context.make_current()
    except Exception as error:  # PyOpenGL raises AttributeError, ImportError and its own, as libraries are missing
        raise NoGraphics(
            f"no graphics context for off-screen rendering ({kind}: {error}): apt-get install {PACKAGES}"
        ) from error
    return context


def _model(mj: Any, figure: Figure, drawings: list[SurfaceDrawing], size: tuple[int, int], sun_W: Array) -> Any:
    spec = mj.MjSpec()
    spec.visual.global_.offwidth, spec.visual.global_.offheight = size
    spec.visual.global_.fovy = FIELD
    spec.visual.quality.shadowsize = 4096 if max(size) > 800 else 2048
    spec.visual.quality.offsamples = 4
    spec.visual.headlight.ambient = [0.42, 0.42, 0.42]
    spec.visual.headlight.diffuse = [0.22, 0.22, 0.22]
    spec.visual.headlight.specular = [0.05, 0.05, 0.05]
    spec.visual.map.znear = 0.01
    spec.visual.map.zfar = 300.0  # far: it also scales the bias that keeps surfaces from shading themselves
    spec.stat.extent = 2.0
    spec.add_texture(
        name="sky",
        type=mj.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mj.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=rgb("#EAF1F8"),
        rgb2=rgb("#C3D5E8"),
        width=256,
        height=1536,
    )
    world = spec.worldbody
    sun = world.add_light(
        name="sun", type=mj.mjtLightType.mjLIGHT_DIRECTIONAL, dir=-np.asarray(sun_W, float), castshadow=True
    )
    sun.diffuse, sun.ambient, sun.specular = [0.55] * 3, [0.0] * 3, [0.15] * 3
    for number, drawing in enumerate(drawings):
        _add_mesh(mj, spec, f"surface{number}", drawing.mesh)
        rgba = [*rgb(drawing.colour), 1.0 if drawing.opacity == 1.0 else 0.5]
        _add_geom(mj, world, f"surface{number}", rgba, TERRAIN)
    for number, part in enumerate(figure.parts):
        _add_mesh(mj, spec, f"part{number}", part.mesh)
        body = world.add_body(name=f"part{number}", mocap=True)
        _add_geom(mj, body, f"part{number}", [*rgb(part.colour), 1.0], ROBOT)
    return spec.compile()


def _add_mesh(mj: Any, spec: Any, name: str, mesh: Mesh) -> None:
    added = spec.add_mesh(name=name)
    mesh = both_sides(mesh)  # MuJoCo draws fronts alone
    added.uservert = mesh.vertices.ravel()
    added.userface = mesh.faces.ravel().astype(np.int32)
    # Open and flat meshes have no volume, which MuJoCo asks for even where nothing has mass.
    added.inertia = mj.mjtMeshInertia.mjMESH_INERTIA_SHELL


def _add_geom(mj: Any, body: Any, name: str, rgba: list[float], group: int) -> None:
    body.add_geom(
        name=name,
        type=mj.mjtGeom.mjGEOM_MESH,
        meshname=name,
        rgba=rgba,
        group=group,
        contype=0,
        conaffinity=0,
        mass=0.0,
    )
