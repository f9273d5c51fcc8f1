"""Robots of example-robot-data are read without meshes, and are otherwise those that its loader gives."""

from pathlib import Path

import numpy as np
import pytest

from mcplan.files.urdf_packages import packaged_robot, packaged_visuals

pytest.importorskip("pinocchio")
example_robot_data = pytest.importorskip("example_robot_data")

#: With rotors, with a reference posture, without an SRDF, without a free base, and cut from another robot.
NAMES = ["talos", "go2", "g1", "anymal", "ur5", "talos_legs"]
SLOW = {"g1", "anymal", "talos_legs"}


@pytest.mark.parametrize("name", [pytest.param(n, marks=[pytest.mark.slow] if n in SLOW else []) for n in NAMES])
def test_a_robot_is_the_one_that_the_loader_gives(name):
    found, expected = packaged_robot(name), example_robot_data.load(name)
    assert found.model == expected.model
    np.testing.assert_array_equal(found.model.armature, expected.model.armature)
    np.testing.assert_array_equal(found.posture, expected.q0)
    assert found.path.samefile(Path(expected.urdf))
    ours, theirs = (
        [(item.name, item.parentJoint, item.meshPath) for item in visual.geometryObjects]
        for visual in (packaged_visuals(name), expected.visual_model)
    )
    assert ours == theirs and ours


def test_names_that_are_none_are_refused_as_by_the_loader():
    with pytest.raises(ValueError, match="Robot 'taloss' not found"):
        packaged_robot("taloss")
