"""Panel of a page with what joints do over time: maps of torque and speed, and lines of distances."""

from __future__ import annotations

import base64
import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mcplan.view.colours import PUSH, rgb

from .overlay import as_shown

Array = NDArray[np.float64]

#: Columns of a map, at most; each has the largest value of its stretch of time.
COLUMNS = 480
#: Colours of ratios from 0 to 1, and of what is beyond.
STOPS = ((0.0, "#F0F2F4"), (0.35, "#BBD4E8"), (0.6, "#5E9BC7"), (0.85, "#2B4C7E"), (1.0, "#1B1F3B"))
OVER = PUSH


@dataclass(frozen=True)
class JointMap:
    """Ratios (n, j) of joints over time to their limits, and what they are."""

    title: str
    ratios: Array


@dataclass(frozen=True)
class Line:
    """A quantity over time.

    Attributes:
        title: What it is, with its least or largest value.
        times_s: (n,) [s].
        values: (n,), NaN where there is none.
        top: Upper end of the axis; the lower one is 0.
        limit: Drawn as a thin line.
        colour: "#rrggbb".
    """

    title: str
    times_s: Array
    values: Array
    top: float
    limit: float
    colour: str


def joint_panel(joints: Sequence[str], maps: Sequence[JointMap], lines: Sequence[Line], duration_s: float) -> str:
    """The panel in HTML; its cursors follow the timeline's."""
    names = "".join(f"<div>{as_shown(short(joint))}</div>" for joint in joints)
    columns = "".join(_map(each) for each in maps)
    charts = "".join(_chart(line, duration_s) for line in lines)
    ramp = ", ".join(f"{colour} {100.0 * at:g}%" for at, colour in STOPS)
    scale = (
        f'<div class="ramp"><span>0</span><i style="background: linear-gradient(90deg, {ramp})"></i><span>limit</span>'
        f'<i class="over" style="background: {OVER}"></i><span>over</span></div>'
    )
    return (
        '<div class="panel" id="maps"><button id="foldmaps" title="joints (j)" aria-label="joints">&#10005;</button>'
        f'<div id="mapbody">{scale}<div class="maps"><div class="mapnames"><b>&nbsp;</b>{names}</div>{columns}</div>'
        f"{charts}</div></div>"
    )


def _map(each: JointMap) -> str:
    height = each.ratios.shape[1]
    title = as_shown(each.title)
    return (
        f'<div class="mapcolumn"><b>{title}</b><div class="map" style="height: {11 * height}px">'
        f'<img alt="{title}" src="data:image/png;base64,{base64.b64encode(map_png(each.ratios)).decode("ascii")}">'
        '<div class="now"></div></div></div>'
    )


def _chart(line: Line, duration_s: float) -> str:
    x, y = 1000.0 * line.times_s / duration_s, 100.0 * (1.0 - np.clip(line.values / line.top, 0.0, 1.0))
    known = np.isfinite(line.values)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], known, [False]]).astype(int)))
    paths = "".join(
        "M" + "L".join(f"{a:.1f},{b:.1f}" for a, b in zip(x[start:stop], y[start:stop], strict=True))
        for start, stop in zip(edges[::2], edges[1::2], strict=True)
    )
    limit = 100.0 * (1.0 - min(line.limit / line.top, 1.0))
    return (
        f'<div class="chart"><b>{as_shown(line.title)}</b><div class="map"><svg viewBox="0 0 1000 100" '
        f'preserveAspectRatio="none"><path class="limit" d="M0,{limit:.1f}L1000,{limit:.1f}"/>'
        f'<path d="{paths}" style="stroke: {line.colour}"/></svg><div class="now"></div></div></div>'
    )


def map_png(ratios: Array) -> bytes:
    """A PNG of ratios (n, j): a row for each joint, time to the right."""
    count = min(len(ratios), COLUMNS)
    starts = np.linspace(0, len(ratios), count, endpoint=False).astype(int)
    largest = np.maximum.reduceat(np.nan_to_num(ratios, nan=np.inf, posinf=np.inf), starts, axis=0).T
    at = [stop for stop, _ in STOPS]
    colours = np.array([rgb(colour) for _, colour in STOPS])
    pixels = np.stack([np.interp(largest, at, colours[:, i]) for i in range(3)], axis=2)
    pixels[largest > 1.0] = rgb(OVER)
    rows = np.round(255.0 * pixels).astype(np.uint8)
    return _png(rows)


def _png(pixels: NDArray[np.uint8]) -> bytes:
    """A PNG of (rows, columns, 3) red, green, blue: signature, header, one block of deflated rows, end."""
    height, width = pixels.shape[:2]
    raw = b"".join(b"\0" + row.tobytes() for row in pixels)
    blocks = (
        (b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)),
        (b"IDAT", zlib.compress(raw, 9)),
        (b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in blocks
    )


def short(joint: str) -> str:
    """A joint's name for a narrow column."""
    return joint.removesuffix("_joint").replace("_", " ")
