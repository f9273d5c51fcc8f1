"""A self-contained page: meshcat's viewer, the scene and the animation in one HTML file."""

from __future__ import annotations

import base64
import importlib.util
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import printable
from mcplan.extras import require
from mcplan.files.outputs import PAGE, require_suffix, write_whole
from mcplan.view.stage import decimals

from .snapshot import screenshot

if TYPE_CHECKING:
    from .annotations import Label

#: Parts of the page's script, in the order in which they run.
SCRIPTS = ("page_setup.js", "page_camera.js", "page_labels.js", "page_player.js", "page.js")


@dataclass(frozen=True)
class Page:
    """A drawing for the browser. Needs no server and no network.

    Attributes:
        title: Title of the page.
        payload: What it shows, from Stage.payload().
        overlay: HTML in front of the drawing.
        points_W: Points that the first view must show, (n, 3) [m].
        direction_W: From the drawing towards the camera, (3,).
        sun_W: From the drawing towards the light, (3,).
        duration_s: Length of the animation, 0 for none.
        knots_s: Instants between which one steps by whole phases, first and last included.
        labels: Texts at points of the drawing.
        axes: Names of the world's axes; one that means nothing is empty.
        rate_hz: Rate of the frames by which one steps.
    """

    title: str
    payload: bytes
    overlay: str
    points_W: NDArray[np.float64]
    direction_W: NDArray[np.float64]
    sun_W: NDArray[np.float64]
    duration_s: float
    knots_s: Sequence[float] = ()
    labels: Sequence[Label] = ()
    axes: tuple[str, str, str] = ("x", "y", "z")
    rate_hz: float = 30.0

    def html(self) -> str:
        """The page as text. The same drawing gives the same text."""
        size = float(np.ptp(self.points_W, axis=0).max())
        digits = decimals(size) - 1
        settings = {
            "points": np.round(self.points_W, digits).tolist(),
            "direction": np.round(self.direction_W, 4).tolist(),
            "sun": np.round(self.sun_W, 4).tolist(),
            "duration": self.duration_s,
            "rate": self.rate_hz,
            "knots": np.round(np.asarray(self.knots_s, float), 6).tolist(),
            "axes": list(self.axes),
            "labels": [label.settings(digits) for label in self.labels],
        }
        return _fill(
            _asset("page.html"),
            title=escape(printable(self.title)),
            style=_asset("page.css"),
            overlay=self.overlay,
            meshcat=_viewer(),
            commands=base64.b64encode(self.payload).decode("ascii"),
            # Names come from files: none may end the script element that they are in.
            settings=json.dumps(settings).replace("<", "\\u003c"),
            script="\n".join(_asset(name) for name in SCRIPTS),
        )

    def save_html(self, path: str | Path) -> Path:
        """Write the page to a file, UTF-8, which is complete or not there at all.

        In a browser the space bar plays and pauses, left and right step by frames, with shift (or up and down) by
        phases, + and - change the speed, l hides the legend and r goes back to the first view. "#t=1.5" behind the
        page's address opens it at 1.5 s, standing still; "#speed=0.25" plays it slowly, "#folded" opens it without the
        legend, "#menu" with meshcat's own menu.

        Raises:
            InvalidInput: The path ends neither in .html nor in .htm.
            OSError: The file cannot be written.
        """
        require_suffix("path", path, PAGE)
        return write_whole(self.html(), path)

    def save_png(self, path: str | Path, time_s: float | None = None, size: tuple[int, int] = (1280, 720)) -> Path:
        """Write a picture of the page, taken with Chromium without a window.

        Args:
            path: File to write.
            time_s: Instant of the animation [s]; None: its start.
            size: Width and height in pixels.

        Raises:
            MissingExtra: There is no Chromium or Chrome; the message says what to install.
            RuntimeError: It did not take the picture; the message carries its last words.
        """
        return screenshot(self.html(), Path(path), f"t={time_s or 0.0:g}&bare", size)

    def __repr__(self) -> str:
        return f"<Page {self.title!r}: {self.duration_s:.2f} s>"


def _fill(template: str, **parts: str) -> str:
    # One pass: what is filled in may itself contain dollars.
    return re.sub(r"\$(\w+)", lambda match: parts[match[1]], template)


def _asset(name: str) -> str:
    return (files("mcplan.view.pages") / name).read_text(encoding="utf-8")


def _viewer() -> str:
    """meshcat's viewer, taken from the package without importing it (which would start its networking)."""
    require("mcplan.show", "view", "meshcat")
    spec: Any = importlib.util.find_spec("meshcat")
    script = Path(spec.submodule_search_locations[0]) / "viewer" / "dist" / "main.min.js"
    return script.read_text(encoding="utf-8").replace("</script", "<\\/script")
