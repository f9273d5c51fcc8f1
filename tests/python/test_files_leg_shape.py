"""mcplan.files.leg_shape: how thick legs are, from the shapes of a URDF."""

from __future__ import annotations

import struct

import numpy as np
import pytest

import mcplan as mp
from mcplan.files.leg_geometry import legs_of
from mcplan.files.leg_shape import add_leg_shapes
from mcplan.files.urdf import load_model
from mcplan.files.urdf_limbs import contact_frame, limb_of
from mcplan.files.urdf_setups import SETUPS
from mcplan.files.urdf_shapes import corners_of, visuals_of


def shaped(name, source=None):
    """The built-in robot with the legs that its URDF says, less what it says of how thick they are."""
    source, robot = source or name, mp.load_robot(name)
    ends = SETUPS[name].ends
    model, nominal, _ = load_model(source, ends)
    for end in ends:
        contact_frame(model, end)
    limbs = {end.name: limb_of(model, nominal, end, ends, source) for end in ends}
    listed = list(robot.end_effectors)
    for end in listed:
        limb = end.limb
        limb.radius = limb.beside = 0.0
        end.limb = limb
    robot.end_effectors = listed
    legs = legs_of(model, nominal, ends, limbs)
    add_leg_shapes(robot, legs, source)
    return robot


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_legs_of_shipped_robots_are_as_thick_as_in_their_urdf(name):
    made, shipped = shaped(name), mp.load_robot(name)
    for one, other in zip(made.end_effectors, shipped.end_effectors, strict=True):
        assert (one.limb.radius, one.limb.beside) == (other.limb.radius, other.limb.beside)
    feet = [end for end in shipped.end_effectors if end.limb.given]
    assert len(feet) == 2
    assert all(0.03 < end.limb.radius < 0.1 for end in feet)
    # The capsules of the right leg lie where those of the left one do, mirrored.
    assert feet[0].limb.beside == -feet[1].limb.beside
    assert all(end.limb.beside * end.nominal_B[1] >= 0.0 for end in feet)


def test_a_robot_whose_shapes_cannot_be_read_has_thin_legs(monkeypatch):
    monkeypatch.setattr("mcplan.files.leg_shape.visuals_of", lambda *_: None)
    assert all(end.limb.radius == 0.0 for end in shaped("g1").end_effectors)


def write_tetrahedron(path, size):
    """An STL file of a tetrahedron with edges of this length along the axes."""
    corners = size * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    faces = [corners[list(face)] for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))]
    triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *face.ravel(), 0) for face in faces)
    path.write_bytes(bytes(80) + struct.pack("<I", len(faces)) + triangles)


@pytest.mark.parametrize("scale", [(0.001, 0.001, 0.001), (0.001, -0.001, 0.001)])
def test_meshes_are_as_large_as_the_urdf_scales_them(tmp_path, scale):
    import pinocchio as pin

    write_tetrahedron(tmp_path / "mesh.stl", 300.0)
    urdf = tmp_path / "one.urdf"
    text = " ".join(map(str, scale))
    urdf.write_text(
        f"""<robot name="one"><link name="base"><inertial><mass value="1"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
        <visual><geometry><mesh filename="mesh.stl" scale="{text}"/></geometry></visual></link></robot>"""
    )
    model = pin.buildModelFromUrdf(str(urdf), pin.JointModelFreeFlyer())
    geometry = visuals_of(model, str(urdf))
    points = corners_of(geometry.geometryObjects[0], pin.SE3.Identity())
    ends = 300.0 * np.array(scale)
    np.testing.assert_allclose(points.min(axis=0), np.minimum(ends, 0.0), atol=1e-6)
    np.testing.assert_allclose(points.max(axis=0), np.maximum(ends, 0.0), atol=1e-6)


def beside_a_post(x, low, high, height):
    """`flat` with a post on the way."""
    scene = mp.load_scene("flat")
    post = mp.model.Surface(name="post", thickness=height, end_effectors=["hand"])
    post.vertices_W = [[x, low, height], [x + 0.2, low, height], [x + 0.2, high, height], [x, high, height]]
    scene.surfaces = [*scene.surfaces, post]
    return scene


@pytest.mark.parametrize(("low", "high"), [(-0.2, 0.1), (0.02, 0.12)])
def test_talos_walks_round_a_post_and_neither_knee_nor_thigh_touches_it_in_simulation(low, high):
    result = mp.plan(beside_a_post(0.7, low, high, 0.8), "talos")
    assert result.report.status == mp.Status.solved, result.report.message
    recording = mp.track(result.plan).recording
    legs = [touch for touch in recording.touches if "leg" in str(touch) and "post" in str(touch)]
    assert legs == []


def test_the_checker_tells_a_leg_in_a_post_that_the_plan_does_not_know_of():
    result = mp.plan("flat", "talos")
    assert result.report.status == mp.Status.solved
    state = result.plan.at(3.0)
    foot = np.asarray(state.end_effectors[1].position_W)
    scene = beside_a_post(float(foot[0]) - 0.1, float(foot[1]) + 0.15, float(foot[1]) + 0.3, 0.7)
    found = {violation.name: violation for violation in mp.check(result.plan, scene=scene).violations()}
    assert found["limb"].end_effector == "left_foot"
