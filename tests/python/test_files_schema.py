"""mcplan.files.schema: the checked-in JSON schemas are those of the models."""

from __future__ import annotations

import json

import jsonschema
import pytest

import malformed
import malformed_planar
from mcplan.files.builtin import DATA
from mcplan.files.schema import MODELS, schema_text


@pytest.mark.parametrize("name", MODELS)
def test_schemas_are_current(name):
    current = (DATA / "schema" / f"{name}.json").read_text()
    assert current == schema_text(name), "run: python -m mcplan.files.schema"


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("scene", malformed.SCENE),
        ("robot", malformed.ROBOT),
        ("planar_robot", malformed_planar.ROBOT),
        ("motion", malformed_planar.MOTION),
    ],
)
def test_a_schema_accepts_valid_data_and_rejects_an_unknown_key(name, data):
    schema = json.loads(schema_text(name))
    jsonschema.validate(data, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**data, "colour": "red"}, schema)
