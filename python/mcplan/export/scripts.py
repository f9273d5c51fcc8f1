"""Scripts that carry their data: a module of this package with arrays in it, for an environment without mcplan."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from typing import Any

import numpy as np

#: The line of a script that is replaced.
EMPTY = 'DATA = ""\n'


def script(name: str, arrays: dict[str, Any]) -> str:
    """The text of a script of this package with arrays, no pickles, as the text of an .npz file.

    Args:
        name: File of the script.
        arrays: By name.
    """
    text = (Path(__file__).parent / name).read_text(encoding="utf-8")
    if text.count(EMPTY) != 1:
        raise RuntimeError(f"{name} has no place for its data")
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    encoded = base64.b64encode(buffer.getvalue()).decode("ascii")
    lines = [encoded[i : i + 116] for i in range(0, len(encoded), 116)]
    return text.replace(EMPTY, 'DATA = """\n' + "\n".join(lines) + '\n"""\n')
