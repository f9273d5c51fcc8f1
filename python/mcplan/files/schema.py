"""JSON schemas of scene, robot and motion files, for editors and other programs.

python -m mcplan.files.schema        # writes mcplan/data/schema/*.json from the tables of fields
"""

from __future__ import annotations

import json

from pydantic import BaseModel

from mcplan import _core
from mcplan.files.builtin import DATA
from mcplan.files.planar_models import MotionModel, PlanarRobotModel

#: Kinds of files whose tables of fields stand in C++.
TABLES = ("scene", "robot")
MODELS: dict[str, type[BaseModel]] = {
    "planar_robot": PlanarRobotModel,
    "motion": MotionModel,
}


def schema_text(name: str) -> str:
    """The JSON schema of a kind of file (of TABLES or MODELS) as it stands in ``mcplan/data/schema``."""
    if name in TABLES:
        return _core.schema_text(name)
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", **MODELS[name].model_json_schema()}
    return json.dumps(schema, indent=2) + "\n"


def main() -> None:
    for name in (*TABLES, *MODELS):
        path = DATA / "schema" / f"{name}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(schema_text(name), encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
