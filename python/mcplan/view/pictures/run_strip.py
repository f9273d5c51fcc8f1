"""Snapshots of a run: side by side, or several postures in one picture. Rendered with the robot's meshes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput, shown_path
from mcplan.extras import require
from mcplan.files.outputs import whole_file
from mcplan.view.colours import COM
from mcplan.view.runs import AnyRun, times_between_s

from .rendering import FIELD, Eye, Renderer
from .rendering import Path as Line
from .run_layout import RunScene
from .run_scene import scene_of

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]

#: [1/s] instants that can be chosen from.
RATE = 100.0
#: Ratios of height to width that a frame may have, and of the margin around the robot to its size.
ASPECTS = (0.7, 1.9)
ROOM = 0.06
#: Frames in a row at most, and those that are wider than tall, as of robots on four feet.
IN_A_ROW, WIDE_IN_A_ROW = 8, 4
INK = (34, 38, 43)


def save_run_strip(
    run: AnyRun,
    path: str | Path,
    frames: int | Sequence[float] = 8,
    columns: int | None = None,
    width: int = 1920,
    lay_out: Callable[[Any, float], RunScene] = scene_of,
) -> Path:
    """Write a PNG of the robot at several instants, side by side at one scale, with the time under each.

    Every frame shows all of the robot, in its middle.

    Args:
        run: A recording, or the result of tracking.
        path: File to write.
        frames: Number of instants, equally spaced from start to end, or the instants [s].
        columns: Frames in a row; None: up to eight, of a robot that is wider than tall up to four.
        width: Width of the picture in pixels.
        lay_out: What lays the run out for rendering, at a rate [1/s]; of a planar robot: planar_scene_of.

    Raises:
        InvalidInput: No frame, or an instant outside of the run; a file that is not a .png.
        MissingExtra: MuJoCo, Pinocchio or Pillow is not installed.
        NoGraphics: No graphics context can be made; the message names the Debian packages.
        OSError: The file cannot be written.
    """
    path = _png(path)
    scene, chosen = _laid_out(run, "frames", frames, lay_out)
    from PIL import Image, ImageDraw, ImageFont

    if columns is None:
        most = IN_A_ROW if framed(scene, chosen, width)[1] > width else WIDE_IN_A_ROW
        rows = -(-len(chosen) // most)
        columns = -(-len(chosen) // rows)
    columns = max(1, min(columns, len(chosen)))
    gap = max(2, width // 240)
    cell = (width - (columns - 1) * gap) // columns
    eyes, height = framed(scene, chosen, cell)
    ink = max(12, cell // 14)
    line = round(1.9 * ink)
    rows = -(-len(chosen) // columns)
    sheet = Image.new("RGB", (width, rows * (height + line)), "white")
    font, draw = ImageFont.load_default(ink), ImageDraw.Draw(sheet)
    with Renderer(scene.figure, scene.drawings, (cell, height), scene.sun_W, scene.footholds) as renderer:
        for number, (n, eye) in enumerate(zip(chosen, eyes, strict=True)):
            row, column = divmod(number, columns)
            pixels = renderer.picture([n], eye, scene.arrows[n])
            x, y = column * (cell + gap), row * (height + line)
            sheet.paste(Image.fromarray(pixels), (x, y))
            place = (x + cell // 2, y + height + line // 2)
            draw.text(place, f"{scene.times_s[n]:.2f} s", fill=INK, font=font, anchor="mm")
    return _saved(sheet, path)


def save_run_postures(
    run: AnyRun,
    path: str | Path,
    postures: int | Sequence[float] = 6,
    size: tuple[int, int] = (1920, 860),
    lay_out: Callable[[Any, float], RunScene] = scene_of,
) -> Path:
    """Write a PNG of several postures in one scene: earlier ones paler; with the paths of the CoM and of its plan.

    Args:
        run: A recording, or the result of tracking.
        path: File to write.
        postures: Number of instants, equally spaced from start to end, or the instants [s].
        size: Width and height in pixels.
        lay_out: What lays the run out for rendering, at a rate [1/s]; of a planar robot: planar_scene_of.

    Raises:
        InvalidInput, MissingExtra, NoGraphics, OSError: As save_run_strip does.
    """
    path = _png(path)
    scene, chosen = _laid_out(run, "postures", postures, lay_out)
    from PIL import Image

    height = scene.height_m
    points = scene.reach_W[chosen].reshape(-1, 3)
    eye = fitted(points, scene.eye(np.zeros(3), 1.0, ahead=0.25), size, margin=0.35 * height)
    last = max(len(chosen) - 1, 1)
    fades = [0.0 if i == last else 0.6 - 0.3 * i / last for i in range(len(chosen))]
    path_W = Line(scene.com_W, COM, 0.008 * height)
    with Renderer(scene.figure, scene.drawings, size, scene.sun_W, scene.footholds) as renderer:
        pixels = renderer.picture(chosen, eye, scene.arrows[chosen[-1]], [path_W], fades)
    return _saved(Image.fromarray(pixels), path)


def _saved(image: Any, path: Path) -> Path:
    with whole_file(path) as temporary:
        image.save(temporary, format="PNG")
    return path


def framed(scene: RunScene, chosen: Sequence[int], width: int) -> tuple[list[Eye], int]:
    """Eyes that see all of the robot at each of the chosen instants, at one scale, and the height of their pictures.

    Args:
        scene: The run.
        chosen: Indices of the instants.
        width: Width of a picture in pixels; its height suits the robot, within bounds.
    """
    plain = scene.eye(np.zeros(3), 1.0)
    points = [scene.figure.points_W(n) for n in chosen]
    spreads = [np.array([np.ptp(p @ axis) for axis in _axes(plain)[:2]]) for p in points]
    wide, tall = np.max(spreads, axis=0)
    height = round(width * float(np.clip(tall / max(wide, 1e-9), *ASPECTS)))
    height -= height % 2
    eyes = [fitted(p, plain, (width, height), margin=ROOM * float(max(wide, tall))) for p in points]
    distance = max(eye.distance_m for eye in eyes)
    return [replace(eye, distance_m=distance) for eye in eyes], height


def _axes(eye: Eye) -> tuple[Array, Array, Array]:
    """To the right in a picture, upwards, and into it: unit vectors (3,)."""
    a, e = np.radians(eye.azimuth_deg), np.radians(eye.elevation_deg)
    ahead = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([np.sin(a), -np.cos(a), 0.0])
    return right, np.cross(right, ahead), ahead


def fitted(points_W: Array, eye: Eye, size: tuple[int, int], margin: float) -> Eye:
    """The nearest eye that looks as the given one does and sees all points (n, 3), with a margin [m] around."""
    right, up, ahead = _axes(eye)
    tall = np.tan(np.radians(0.5 * FIELD))
    wide = tall * size[0] / size[1]
    target = np.zeros(3)
    for axis in (right, up, ahead):
        along = points_W @ axis
        target = target + 0.5 * (along.min() + along.max()) * axis
    away = points_W - target
    distance = max(
        float(np.max((np.abs(away @ axis) + margin) / spread - away @ ahead))
        for axis, spread in ((right, wide), (up, tall))
    )
    return Eye(target, distance, eye.azimuth_deg, eye.elevation_deg)


def _with_pushes(times_s: Array, run: AnyRun) -> Array:
    """Instants of which those nearest to a push are moved into it, but for the first and the last."""
    out = times_s.copy()
    for push in getattr(getattr(run, "options", None), "pushes", ()):
        middle = push.at_s + 0.5 * push.duration_s
        if len(out) < 3 or not out[0] < middle < out[-1]:
            continue
        nearest = 1 + int(np.argmin(np.abs(times_s[1:-1] - middle)))
        out[nearest] = middle
    return np.sort(out)


def _png(path: str | Path) -> Path:
    if Path(path).suffix.lower() != ".png":
        raise InvalidInput("path", "must end in .png", shown_path(path))
    return Path(path)


def _laid_out(
    run: AnyRun, name: str, chosen: Any, lay_out: Callable[[Any, float], RunScene]
) -> tuple[RunScene, list[int]]:
    """The run, and the indices of the instants asked for."""
    require("rendering a run", "sim", "mujoco", "pinocchio", "PIL")
    first, last = times_between_s(run)
    if isinstance(chosen, int):
        if chosen < 1:
            raise InvalidInput(name, "must be at least 1", str(chosen))
        times = _with_pushes(np.linspace(first, last, chosen), run)
    else:
        times = np.asarray(list(chosen), float)
        if not len(times):
            raise InvalidInput(name, "needs at least one instant", "none")
        for i, t in enumerate(times):
            if not first - 1e-9 <= t <= last + 1e-9:
                raise InvalidInput(f"{name}[{i}]", f"must lie in the run, from {first:.6g} to {last:.6g} s", f"{t:g}")
    scene = lay_out(run, RATE)
    return scene, [scene.nearest(float(t)) for t in times]
