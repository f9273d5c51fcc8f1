"""JSON schemas of scene, robot, planar task and sweep files, for editors and other programs.

python -m mcplan.files.schema        # writes mcplan/data/schema/*.json from the tables of fields, and of sweeps from their models
"""

from __future__ import annotations

from pathlib import Path

from mcplan._core import schema_text
from mcplan.files.builtin import DATA

#: Kinds of files that have a schema.
KINDS = ("scene", "robot", "planar_robot", "planar_task")


def path_of(kind: str) -> Path:
    """Where the schema of a kind of file is.

    Args:
        kind: One of KINDS.
    """
    return DATA / "schema" / f"{kind}.json"


def main() -> None:
    for name in KINDS:
        path = path_of(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(schema_text(name), encoding="utf-8")
        print(path)
    from mcplan.files.sweep_specs import schema_text as sweep_schema_text

    path = DATA / "schema" / "sweep.json"
    path.write_text(sweep_schema_text(), encoding="utf-8")
    print(path)


if __name__ == "__main__":
    main()
