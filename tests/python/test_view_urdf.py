"""Pages carry a URDF's meshes where its joints can follow the plan, and a stick robot where they cannot."""

import copy
import gzip

import numpy as np
import pytest

import mcplan as mp
import plans_by_hand as by_hand
from mcplan.errors import SimplerDrawing
from mcplan.kinematics.samples import sample
from mcplan.kinematics.urdf_model import load_model
from mcplan.view import show
from mcplan.view.colours import end_effector_colours, mix
from mcplan.view.figure_choice import figure_of
from mcplan.view.robot_urdf import TINT, CannotFollow, mesh_figure, own_vertices, urdf_robot

pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")


@pytest.fixture(scope="module")
def talos():
    return by_hand.talos()


def test_page_carries_the_meshes(talos):
    pytest.importorskip("meshcat")
    plan = by_hand.walk(by_hand.flat(), talos)
    shown = gzip.decompress(show(plan).payload)
    for part in (b"robot/leg_left_4_joint/", b"robot/arm_right_4_joint/", b"robot/head_2_joint/"):
        assert part in shown
    assert b"robot/left_foot_upper" not in shown


def test_a_plan_out_of_reach_falls_back_to_the_stick_robot(talos):
    pytest.importorskip("meshcat")
    tall = copy.copy(talos)
    tall.com_height += 0.2  # more than the legs are long
    plan = by_hand.walk(by_hand.flat(), tall)
    with pytest.raises(CannotFollow, match=r"misses .* at \d"):
        urdf_robot(sample(plan, plan.scene, talos, 10.0), talos)
    with pytest.warns(SimplerDrawing, match="stick robot instead"):
        page = show(plan)
    assert b"robot/left_foot_upper" in gzip.decompress(page.payload)


def test_links_at_the_ends_have_the_colours_of_their_end_effectors_as_in_motions(talos):
    plan = by_hand.walk(by_hand.flat(), talos)
    samples, tints = sample(plan, plan.scene, talos, 2.0), end_effector_colours(talos)
    usual, tinted = (
        {part.name: part.colour for part in figure.parts}
        for figure in (urdf_robot(samples, talos), figure_of(samples, talos, tints))
    )
    other = {name for name in usual if usual[name] != tinted[name]}
    assert {name.partition("/")[0] for name in other} >= {"leg_left_6_joint", "leg_right_6_joint"}
    right = next(end for end, e in enumerate(talos.end_effectors) if e.name == "right_foot")
    name = next(name for name in other if name.startswith("leg_right_6_joint"))
    assert tinted[name] == mix(usual[name], tints[right], TINT)


def test_parts_of_a_mesh_are_drawn_between_their_own_vertices():
    square, tent = [[0, 1, 2], [2, 1, 3]], [[0, 1, 2], [0, 2, 3], [0, 3, 4]]
    read = np.array(square + tent + square)
    assert own_vertices(read, 13).tolist() == square + (np.array(tent) + 4).tolist() + (np.array(square) + 9).tolist()
    for count in (4, 12, 14):  # one part alone; vertices that do not come out even
        assert own_vertices(read, count) is read
    assert own_vertices(np.array(square), 4).tolist() == square


def test_no_vertex_of_go2_is_left_out():
    model = load_model(mp.load_robot("go2"))
    figure = mesh_figure(model, np.array([model.neutral]))
    for part in figure.parts:
        assert len(np.unique(part.mesh.faces)) == len(part.mesh.vertices), part.name
