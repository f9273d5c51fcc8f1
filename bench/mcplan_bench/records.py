"""Tables of measurements as files."""

from __future__ import annotations

import contextlib
import csv
import io
import json
import math
import os
import platform
import time
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import Any

import mcplan
from mcplan.files.outputs import write_whole

Row = dict[str, Any]


def write_csv(path: Path, rows: Sequence[Row]) -> Path:
    """Write rows as CSV; the columns are those of the first row. No rows: an empty file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    text = io.StringIO(newline="")
    if rows:
        writer = csv.DictWriter(text, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return write_whole(text.getvalue(), path)


def write_json(path: Path, content: Row) -> Path:
    """Write one JSON object; numbers that are not finite become null."""
    path.parent.mkdir(parents=True, exist_ok=True)
    return write_whole(json.dumps(plain(content), indent=1) + "\n", path)


def plain(value: Any) -> Any:
    """The value with everything in it that JSON cannot represent replaced by null."""
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def machine() -> Row:
    """What the numbers were measured on, and when (UTC)."""
    return {
        "version": mcplan.__version__,
        "cpu": cpu_name(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "date": time.strftime("%Y-%m-%d", time.gmtime()),
    }


def versions(*packages: str) -> Row:
    """Versions of those of the packages that are installed, by name."""
    found = {}
    for name in packages:
        with contextlib.suppress(metadata.PackageNotFoundError):
            found[name] = metadata.version(name)
    return found


def cpu_name() -> str:
    """Name of the processor."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()
