"""Plans and runs as files that other tools read: references for learning, and problems for other solvers.

    import mcplan as mp

    mp.export("run.npz", "mjlab", "motion.npz")
    for entry in mcplan.export.FORMATS.values(): ...

Each format is a module of its own; docs/export.md has the table of what they contain and of their conventions.
Importing this loads NumPy and nothing heavier.
"""

from __future__ import annotations

from mcplan.files.export_formats import FORMATS, Format

from .exporting import export

__all__ = ["FORMATS", "Format", "export"]
