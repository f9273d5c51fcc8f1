"""What a page shows, read back from its HTML."""

import base64
import gzip
import re
import struct

import numpy as np


def commands_of(html: str) -> list[dict]:
    """All commands to the viewer, in order."""
    import umsgpack

    raw = gzip.decompress(base64.b64decode(re.search(r'id="commands">([^<]*)<', html)[1]))
    commands, at = [], 0
    while at < len(raw):
        (size,) = struct.unpack_from("<I", raw, at)
        commands.append(umsgpack.unpackb(raw[at + 4 : at + 4 + size]))
        at += 4 + size
    return commands


def clips_of(html: str) -> dict[str, dict]:
    """Clip of every node that moves, by its path."""
    (animation,) = [c for c in commands_of(html) if c["type"] == "set_animation"]
    return {a["path"].removeprefix("/meshcat/"): a["clip"] for a in animation["animations"]}


def floats(values) -> np.ndarray:
    """Numbers of a typed array."""
    return np.frombuffer(values.data, "<f4").astype(float)


def track(clip: dict, name: str) -> dict:
    """The one track of a clip that is called "position", "quaternion", "scale" or "visible"."""
    (found,) = [t for t in clip["tracks"] if t["name"] == "." + name]
    return found
