"""Which SRDF is a URDF's, and which pairs of links it disables."""

import pytest

import folding
from mcplan.kinematics.srdf import disabled_pairs, srdf_beside

TEXT = """<robot name="r"><disable_collisions link1="a" link2="b" reason="Never"/><disable_collisions link1="a"/></robot>"""


def test_the_srdf_of_a_urdf_has_its_name_or_what_its_name_begins_with(tmp_path):
    urdf = tmp_path / "robots" / "walker_small.urdf"
    urdf.parent.mkdir()
    (tmp_path / "srdf").mkdir()
    assert srdf_beside(urdf) is None
    for name in ("other", "walk", "walker"):
        (tmp_path / "srdf" / f"{name}.srdf").write_text(TEXT)
    assert srdf_beside(urdf) == tmp_path / "srdf" / "walker.srdf"
    (urdf.parent / "walker_small.srdf").write_text(TEXT)
    assert srdf_beside(urdf) == urdf.parent / "walker_small.srdf"
    assert srdf_beside(tmp_path / "robots" / "climber.urdf") is None


def test_pairs_are_read(tmp_path):
    (tmp_path / "r.srdf").write_text(TEXT)
    assert disabled_pairs(tmp_path / "r.srdf", "r") == {frozenset(("a", "b"))}


def test_rotors_are_those_of_the_srdf_beside_the_urdf(tmp_path):
    pytest.importorskip("pinocchio")
    from mcplan.kinematics.urdf_model import ARMATURE, load_model

    robot = folding.robot(tmp_path)
    assert load_model(robot).model.armature[6:].tolist() == [ARMATURE, ARMATURE]
    (tmp_path / "folding.srdf").write_text(
        """<robot name="folding"><rotor_params>
        <joint name="hinge" mass="2e-5" gear_ratio="50"/></rotor_params></robot>"""
    )
    model = load_model(robot).model
    armature = dict(zip(list(model.names)[2:], model.armature[6:], strict=True))
    assert armature == {"swivel": ARMATURE, "hinge": pytest.approx(50.0**2 * 2e-5)}
