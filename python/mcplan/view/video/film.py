"""Videos of runs: the robot with its meshes on its terrain, rendered by MuJoCo without a screen."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidInput
from mcplan.extras import require
from mcplan.view.pictures.rendering import Renderer
from mcplan.view.pictures.run_layout import RunScene
from mcplan.view.pictures.run_scene import scene_of
from mcplan.view.runs import AnyRun

from .files import check_target, write_video

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]

#: [s] over which the camera's path is smoothed.
SMOOTHING = 1.0
#: Ratio of the camera's distance to the CoM height.
DISTANCE = 5.6


def save_video(
    run: AnyRun,
    path: str | Path,
    size: tuple[int, int] = (960, 540),
    rate_hz: float = 25.0,
    shadows: bool = True,
    progress: Callable[[int, int], None] | None = None,
    lay_out: Callable[[Any, float], RunScene] = scene_of,
) -> Path:
    """Render a run in real time; the camera goes with the robot.

    Contact forces are green arrows (as long as 0.55 of the CoM height for the robot's weight), pushes red ones;
    outlines on the ground are the planned footholds.

    Args:
        run: A recording, or the result of tracking.
        path: File to write: .mp4 (needs ffmpeg), .webp or .gif.
        size: Width and height in pixels, even.
        rate_hz: Pictures in a second.
        shadows: Draw them; without, a picture takes less than half the time.
        progress: Called with the number of pictures that are done and that of all.
        lay_out: What lays the run out for rendering, at a rate [1/s]; of a planar robot: planar_scene_of.

    Raises:
        InvalidInput: The path or the size is not one of those above.
        MissingExtra: MuJoCo, Pinocchio, ffmpeg or Pillow is not installed; the message says what to install.
        NoGraphics: No graphics context can be made; the message names the Debian packages.
        RuntimeError: ffmpeg failed.
        OSError: The file cannot be written.
    """
    path = Path(path)
    check_target(path)
    if min(size) < 16 or max(size) > 8192 or size[0] % 2 or size[1] % 2:
        raise InvalidInput("size", "must be even, 16 to 8192 pixels", f"{size[0]}x{size[1]}")
    if not 1.0 <= rate_hz <= 120.0:
        raise InvalidInput("rate_hz", "must lie in 1 to 120", f"{rate_hz:g}")
    require("rendering a run", "sim", "mujoco", "pinocchio", "PIL")
    scene = lay_out(run, rate_hz)
    with Renderer(scene.figure, scene.drawings, size, scene.sun_W, scene.footholds, shadows) as renderer:
        write_video(_pictures(scene, renderer, rate_hz, progress), path, rate_hz)
    return path


def _pictures(
    scene: RunScene, renderer: Renderer, rate_hz: float, progress: Callable[[int, int], None] | None
) -> Iterator[Pixels]:
    path = smoothed(scene.com_W, SMOOTHING * rate_hz)
    count = len(scene.times_s)
    for n in range(count):
        pixels = renderer.picture([n], scene.eye(path[n], DISTANCE * scene.height_m), scene.arrows[n])
        yield stamped(pixels, f"{scene.times_s[n]:.2f} s")
        if progress is not None:
            progress(n + 1, count)


def smoothed(points: Array, width: float) -> Array:
    """Points (n, 3) under a Gaussian window of a standard deviation of half of `width` samples."""
    half = max(1, round(1.5 * width))
    window = np.exp(-0.5 * (np.arange(-half, half + 1) / max(0.5 * width, 1e-9)) ** 2)
    padded = np.vstack([np.repeat(points[:1], half, axis=0), points, np.repeat(points[-1:], half, axis=0)])
    columns = [np.convolve(padded[:, i], window / window.sum(), mode="valid") for i in range(3)]
    return np.column_stack(columns)


def stamped(pixels: Pixels, text: str) -> Pixels:
    """A picture with a text at the lower left."""
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(pixels)
    size = max(11, pixels.shape[0] // 26)
    place = (round(0.7 * size), pixels.shape[0] - round(0.7 * size))
    ImageDraw.Draw(image).text(place, text, fill=(34, 38, 43), font=ImageFont.load_default(size), anchor="ls")
    return np.asarray(image)
