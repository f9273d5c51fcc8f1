"""mcplan.files.trunk: capsules of a robot's trunk from the shapes of its URDF."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.trunk import trunk_of
from mcplan.files.urdf import load_model
from mcplan.files.urdf_limbs import own_joints
from mcplan.files.urdf_setups import SETUPS

#: A box of 0.4 x 0.2 x 0.6 m for a trunk, and a leg on each side.
URDF = """<robot name="box"><link name="base"><inertial><mass value="10"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
<visual><origin xyz="0 0 0.3"/><geometry>{shape}</geometry></visual></link>
<link name="left"/><link name="right"/>
<joint name="l" type="revolute"><parent link="base"/><child link="left"/><origin xyz="0 0.1 0"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
<joint name="r" type="revolute"><parent link="base"/><child link="right"/><origin xyz="0 -0.1 0"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="9" velocity="9"/></joint></robot>"""


def parts_of(source, ends):
    model, nominal, _ = load_model(str(source), ends)
    return trunk_of(model, nominal, ends, {end.name: own_joints(model, end, ends) for end in ends}, str(source))


def two_feet():
    end = type(SETUPS["talos"].ends[0])
    return end("left", "left", "foot", (0.0, 0.0), "right"), end("right", "right", "foot", (0.0, 0.0), "left")


@pytest.mark.parametrize("name", ["talos", "g1", "anymal", "go2"])
def test_trunks_of_shipped_robots_are_those_of_their_urdf(name):
    made, shipped = parts_of(name, SETUPS[name].ends), mp.load_robot(name).trunk
    assert len(made) == len(shipped) > 0
    for one, other in zip(made, shipped, strict=True):
        assert (one.radius, *one.from_B, *one.to_B) == (other.radius, *other.from_B, *other.to_B)


def test_a_box_has_a_capsule_along_its_longer_side_as_thick_as_the_thinner_way(tmp_path):
    urdf = tmp_path / "box.urdf"
    urdf.write_text(URDF.format(shape='<box size="0.4 0.2 0.6"/>'))
    (part,) = parts_of(urdf, two_feet())
    assert part.radius == pytest.approx(0.1, abs=1e-3)
    # The CoM is the base's, at the box's lower side.
    np.testing.assert_allclose(part.from_B, [0.0, 0.0, 0.1], atol=2e-3)
    np.testing.assert_allclose(part.to_B, [0.0, 0.0, 0.5], atol=2e-3)


@pytest.mark.parametrize("shape", ['<mesh filename="package://nowhere/none.stl"/>', '<mesh filename="none.stl"/>'])
def test_a_robot_whose_shapes_cannot_be_read_has_no_trunk(tmp_path, shape):
    urdf = Path(tmp_path) / "box.urdf"
    urdf.write_text(URDF.format(shape=shape))
    model, nominal, _ = load_model("talos")
    assert trunk_of(model, nominal, two_feet(), {"left": [], "right": []}, str(urdf)) == []


def under_a_beam(bottom_m):
    """`flat` with a beam across the way, 2 m wide, between this height and 0.2 m more."""
    scene = mp.load_scene("flat")
    beam = mp.model.Surface(name="beam", thickness=0.2, end_effectors=["hand"])
    beam.vertices_W = [[x, y, bottom_m + 0.2] for x, y in ((0.9, -1.0), (1.0, -1.0), (1.0, 1.0), (0.9, 1.0))]
    scene.surfaces = [*scene.surfaces, beam]
    return scene


@pytest.mark.parametrize(("name", "bottom_m"), [("talos", 1.6), ("talos", 1.3), ("g1", 1.05), ("anymal", 0.65)])
def test_a_beam_is_ducked_under_or_walked_round_and_touched_by_nothing_in_simulation(name, bottom_m):
    result = mp.plan(under_a_beam(bottom_m), name)
    assert result.report.status == mp.Status.solved, result.report.message
    measures = mp.track(result.plan).measures
    assert not measures.fell and measures.terrain_contacts == 0


def test_the_checker_tells_a_head_in_a_beam_where_the_ball_about_the_com_is_in_none():
    robot = mp.load_robot("talos")
    trunk, robot.trunk = robot.trunk, []
    result = mp.plan(under_a_beam(1.3), robot)
    assert result.report.status == mp.Status.solved and mp.check(result.plan).ok()
    result.plan.robot.trunk = trunk
    violations = {violation.name for violation in mp.check(result.plan).violations()}
    assert violations == {"trunk"}
