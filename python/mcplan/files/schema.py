"""JSON schemas of scene, robot, planar robot, planar task and sweep files, for editors and other programs.

python -m mcplan.files.schema        # writes mcplan/data/schema/*.json from the tables of fields, and of sweeps from their models
"""

from __future__ import annotations

from pathlib import Path

from mcplan._core import schema_text
from mcplan.files.builtin import DATA

#: Kinds of files that have a schema.
KINDS = ("scene", "robot", "planar_robot", "planar_task", "sweep")


def path_of(kind: str) -> Path:
    """Where the schema of a kind of file is.

    Args:
        kind: One of KINDS.
    """
    return DATA / "schema" / f"{kind}.json"


def text_of(kind: str) -> str:
    """What the schema of a kind of file has to be.

    Args:
        kind: One of KINDS.
    """
    if kind == "sweep":
        from mcplan.files import sweep_specs

        return sweep_specs.schema_text()
    return schema_text(kind)


def main() -> None:
    for name in KINDS:
        path = path_of(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text_of(name), encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
