"""mcplan.files.schema: the checked-in JSON schemas are those of the tables of fields, and say what the reader says."""

from __future__ import annotations

import json
import math

import jsonschema
import pytest

import malformed
import malformed_planar
from mcplan.errors import InvalidInput
from mcplan.files.builtin import DATA
from mcplan.files.planar_robots import planar_robot_from_dict
from mcplan.files.planar_tasks import planar_task_from_dict
from mcplan.files.robots import robot_from_dict
from mcplan.files.scenes import scene_from_dict
from mcplan.files.schema import KINDS, schema_text, text_of


@pytest.mark.parametrize("name", KINDS)
def test_schemas_are_current(name):
    if name == "sweep":
        pytest.importorskip("pydantic")
    current = (DATA / "schema" / f"{name}.json").read_text()
    assert current == text_of(name), "run: python -m mcplan.files.schema"


def test_the_schema_of_sweeps_takes_weights_in_a_table_of_their_own():
    pytest.importorskip("pydantic")
    from mcplan.files.sweep_specs import sweep_spec

    schema = json.loads(text_of("sweep"))
    for weight in (0.1, {"grid": [0.1, 0.2]}):
        data = {"name": "s", "options": {"weights": {"flight": weight}}, "scenes": [{"scene": "flat"}]}
        jsonschema.validate(data, schema)
        assert "weights.flight" in sweep_spec(data).options
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**data, "options": {"weights": {"flight": {"grids": [1.0]}}}}, schema)


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("scene", malformed.SCENE),
        ("robot", malformed.ROBOT),
        ("planar_robot", malformed_planar.ROBOT),
        ("planar_task", malformed_planar.TASK),
    ],
)
def test_a_schema_accepts_valid_data_and_rejects_an_unknown_key(name, data):
    schema = json.loads(schema_text(name))
    jsonschema.validate(data, schema)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate({**data, "colour": "red"}, schema)


#: Rules that relate fields, look names up, or ask for files: a schema knows them not.
RELATIONS = (
    "must be unique", "must lie", "must name", "must put", "must hold", "must exceed", "must have", "must span", "must run",
    "must be more than", "must be a corner", "must be two", "more than 0.1 mm", "area of", "corner of", "strictly convex",
    "the first <= 0", "is required, or", "must stand alone", "cannot be read", "must be left out", "is required of",
    "must come before", "no body may be", "Did you mean", "must differ", "must be bodies", "may not stand", "must leave",
    "must be in contact", "lift it first", "already", "must keep", "must be that of", "right_foot must", "not below",
    "must not be in contact", "one of the surfaces", "must be -1", "must be an interval", "from not above",
    "must not be there twice", "must be a leg", "must be at most half of upper", "must not be in no_clearance",
)  # fmt: skip


def can_be_said(case: malformed.Break) -> bool:
    """Whether a JSON schema can reject it: a relation it does not know, and JSON has no numbers that are not finite."""
    path, value, field, rule = case
    if field.endswith(".contacts") and rule == "is required":
        return False  # of the first phase alone
    finite = not (isinstance(value, float) and not math.isfinite(value)) and not (
        isinstance(value, list) and any(isinstance(x, float) and not math.isfinite(x) for x in value)
    )
    return bool(rule) and finite and not rule.startswith(RELATIONS)


@pytest.mark.parametrize(
    ("name", "valid", "read", "case"),
    [
        (name, valid, read, case)
        for name, valid, read, breaks in (
            ("scene", malformed.SCENE, scene_from_dict, malformed.SCENE_BREAKS),
            ("robot", malformed.ROBOT, robot_from_dict, malformed.ROBOT_BREAKS),
            ("planar_robot", malformed_planar.ROBOT, planar_robot_from_dict, malformed_planar.ROBOT_BREAKS),
            ("planar_task", malformed_planar.TASK, planar_task_from_dict, malformed_planar.TASK_BREAKS),
        )
        for case in breaks
        if can_be_said(case)
    ],
    ids=lambda value: malformed.label(value) if isinstance(value, tuple) else None,
)
def test_what_the_reader_rejects_its_schema_rejects(name, valid, read, case):
    data = malformed.broken(valid, case[0], case[1])
    with pytest.raises(InvalidInput):
        read(data)
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(data, json.loads(schema_text(name)))
