"""mcplan.files.polytopes: files of polytopes are read from beside the robot's file, and what is wrong in them is named."""

from __future__ import annotations

import json

import numpy as np
import pytest

import malformed
import mcplan as mp
from mcplan.files.builtin import DATA
from mcplan.files.robots import load_robot, robot_from_dict, robot_to_dict
from mcplan.files.toml import toml_text

REFERENCE = {"file": "reach.json", "name": "com"}
SET = {"A": [[0.0, 0.0, 1.0]], "b": [0.6]}


@pytest.fixture
def file(tmp_path):
    data = malformed.broken(malformed.ROBOT, ("end_effectors", 0, "com_reach"), REFERENCE)
    path = tmp_path / "hopper.toml"
    path.write_text(toml_text(data))
    return path


def test_a_reference_is_replaced_by_what_it_names(file):
    (file.parent / "reach.json").write_text(json.dumps({"polytopes": {"com": SET, "other": {}}}))
    robot = load_robot(file)
    assert robot_to_dict(robot)["end_effectors"][0]["com_reach"] == SET
    assert not robot.end_effectors[1].com_reach.given
    np.testing.assert_array_equal(robot.end_effectors[0].partner_reach["arm"].A, [[1.0, 0.0, 0.0]])


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("{", "hopper.toml: end_effectors[0].com_reach.file: must be a JSON file, got reach.json: "),
        ("[1, 2]", 'hopper.toml: end_effectors[0].com_reach.file: must hold an object `polytopes`, got "reach.json"'),
        (
            '{"polytopes": {"con": {}, "foot": {}}}',
            "end_effectors[0].com_reach.name: must be in reach.json (con, foot). Did you mean 'con'?, got \"com\"",
        ),
        ('{"polytopes": {"com": 3}}', "reach.json: com: "),
        ('{"polytopes": {"com": {"A": [[0, 0]], "b": [1]}}}', "reach.json: com: A[0]: needs at least 3 entries, got 2"),
        (
            '{"polytopes": {"com": {"A": [[0, 0, 1]], "b": [0.4]}}}',
            "hopper.toml: end_effectors[0].com_reach: must hold the nominal stance",
        ),
    ],
)
def test_a_malformed_file_is_named(content, message, file):
    (file.parent / "reach.json").write_text(content)
    with pytest.raises(mp.errors.InvalidRobot) as found:
        load_robot(file)
    assert message in str(found.value)


def test_plain_data_name_no_files():
    data = malformed.broken(malformed.ROBOT, ("end_effectors", 0, "com_reach"), REFERENCE)
    with pytest.raises(mp.errors.InvalidRobot, match=r"com_reach.file: may be used in files alone"):
        robot_from_dict(data)


def test_polytopes_cannot_be_written_into():
    reach = load_robot("talos_wang").end_effectors[0].com_reach
    with pytest.raises(ValueError, match="read-only"):
        reach.b[0] = 1.0


def test_talos_wang_has_all_published_faces_and_ranges():
    """Faces and ranges in the height of the published meshes; the CoM's refer to the sole, 0.105 m below the ankle."""
    ends = {end.name: end for end in load_robot("talos_wang").end_effectors}
    left, right = ends["left_foot"], ends["right_foot"]
    published = [
        (left.com_reach, 57, [-0.8135, -0.4199, 0.4286], [0.6405, 0.0490, 1.1821]),
        (right.com_reach, 62, [-0.7482, -0.0414, 0.4336], [0.6471, 0.3368, 1.1714]),
        (left.partner_reach["right_foot"], 48, [-0.3186, -0.9169, -0.6736], [0.3244, -0.1904, 0.5470]),
        (right.partner_reach["left_foot"], 44, [-0.3330, 0.1905, -0.5625], [0.3280, 0.9006, 0.6176]),
    ]
    from scipy.optimize import linprog

    for polytope, faces, low, high in published:
        assert polytope.A.shape == (faces, 3)
        np.testing.assert_allclose(np.linalg.norm(polytope.A, axis=1), 1.0, atol=2e-6)
        for axis in range(3):
            for sign, end in ((1, low), (-1, high)):
                found = linprog(sign * np.eye(3)[axis], polytope.A, polytope.b, bounds=(None, None))
                assert found.x[axis] == pytest.approx(end[axis], abs=2e-4)


def test_reach_boxes_of_talos_wang_hold_its_polytopes():
    from scipy.spatial import HalfspaceIntersection

    for end in load_robot("talos_wang").end_effectors:
        reach = end.com_reach
        inside = -end.nominal_B
        corners = HalfspaceIntersection(np.hstack([reach.A, -reach.b[:, None]]), inside).intersections
        assert (-corners >= end.reach_min_B - 1e-9).all() and (-corners <= end.reach_max_B + 1e-9).all()


def test_the_data_file_states_its_licence():
    content = json.loads((DATA / "robots" / "talos_wang_reach.json").read_text())
    assert "BSD-2-Clause" in content["licence"] and "LAAS-CNRS" in content["licence"]
