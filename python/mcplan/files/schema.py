"""JSON schemas of scene, robot and motion files, for editors and other programs.

python -m mcplan.files.schema        # writes mcplan/data/schema/*.json from the models
"""

from __future__ import annotations

import json

from pydantic import BaseModel

from mcplan.files.builtin import DATA
from mcplan.files.models import RobotModel, SceneModel
from mcplan.files.planar_models import MotionModel, PlanarRobotModel

MODELS: dict[str, type[BaseModel]] = {
    "scene": SceneModel,
    "robot": RobotModel,
    "planar_robot": PlanarRobotModel,
    "motion": MotionModel,
}


def schema_text(name: str) -> str:
    """The JSON schema of a kind of file (a key of MODELS) as it stands in ``mcplan/data/schema``."""
    schema = {"$schema": "https://json-schema.org/draft/2020-12/schema", **MODELS[name].model_json_schema()}
    return json.dumps(schema, indent=2) + "\n"


def main() -> None:
    for name in MODELS:
        path = DATA / "schema" / f"{name}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(schema_text(name), encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main()
