"""Soles of postures against solids: a sole held by hand over, beside and in a box."""

from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan.kinematics.samples import Interval
from mcplan.tracking.sole_clearance import clearance_findings

pin = pytest.importorskip("pinocchio")
HALF = (0.1, 0.05)


def box_scene() -> mp.Scene:
    ground = np.array([[-2.0, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]])
    box = np.array([[0.5, -0.5, 0.2], [1.0, -0.5, 0.2], [1.0, 0.5, 0.2], [0.5, 0.5, 0.2]])
    return mp.Scene(
        name="box",
        surfaces=[
            mp.model.Surface(name="ground", vertices_W=ground, friction=0.8, thickness=1.0),
            mp.model.Surface(name="box", vertices_W=box, friction=0.8, thickness=0.2),
        ],
    )


def sole_that_moves(
    path: np.ndarray, surfaces: list[int], scene: mp.Scene | None = None, final: int = -1
) -> dict[str, object]:
    """Findings by name, for a body that is nothing but a sole: poses (n, 3) a tenth of a second apart."""
    model = pin.Model()
    joint = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "base")
    frame = model.addFrame(pin.Frame("sole", joint, 0, pin.SE3.Identity(), pin.FrameType.OP_FRAME))
    foot = mp.model.EndEffector(name="foot", kind="foot", half_size=HALF)
    urdf_model = SimpleNamespace(model=model, frames=[frame], robot=SimpleNamespace(end_effectors=[foot]))
    times = 0.1 * np.arange(len(path))
    intervals, start = [], 0
    for n in range(1, len(path) + 1):
        if n == len(path) or surfaces[n] != surfaces[start]:
            if surfaces[start] >= 0:
                intervals.append(Interval(0, surfaces[start], times[start], times[n - 1], path[start], np.eye(3)))
            start = n
    samples = SimpleNamespace(times_s=times, count=len(path), intervals=intervals)
    postures = SimpleNamespace(configurations=np.hstack([path, np.tile([0, 0, 0, 1.0], (len(path), 1))]))
    return {
        found.name: found for found in clearance_findings(scene or box_scene(), urdf_model, samples, postures, [final])
    }


def test_a_sole_that_goes_through_an_edge_is_told_where_and_when():
    """At 0.15 m above the ground: its toe (0.1 m ahead) enters the box of 0.2 m at x = 0.4, after 0.3 s."""
    x = np.linspace(0.1, 0.7, 7)
    path = np.column_stack([x, np.zeros(7), np.full(7, 0.15)])
    path[0, 2] = 0.0
    found = sole_that_moves(path, [0, -1, -1, -1, -1, -1, -1])["clearance"]
    assert found.note == "surface box" and found.where == "foot"
    assert found.value == pytest.approx(0.05) and found.value > found.limit
    assert 0.3 <= found.time_s <= 0.4


def test_a_sole_above_the_box_has_its_clearance_told():
    x = np.linspace(0.1, 0.7, 13)
    path = np.column_stack([x, np.zeros(13), np.full(13, 0.23)])
    path[0, 2] = 0.0
    path[-1, 2] = 0.2
    found = sole_that_moves(path, [0, *[-1] * 11, 1])
    # From its first position on the sole climbs to 0.23 m in a tenth of a second.
    assert found["clearance"].value == pytest.approx(-0.03, abs=0.02) and found["clearance"].value < 0.0
    assert found["foothold"].value < found["foothold"].limit


def test_an_edge_between_the_corners_is_seen():
    """A rail 2 cm wide below the middle of the sole: no corner is in it."""
    scene = box_scene()
    rail = np.array([[0.38, -0.01, 0.2], [0.46, -0.01, 0.2], [0.46, 0.01, 0.2], [0.38, 0.01, 0.2]])
    scene.surfaces = [scene.surfaces[0], mp.model.Surface(name="rail", vertices_W=rail, friction=0.8, thickness=0.1)]
    path = np.tile([0.42, 0.0, 0.193], (5, 1))
    found = sole_that_moves(path, [0, -1, -1, -1, -1], scene)["clearance"]
    assert found.value == pytest.approx(0.007) and found.note == "surface rail"


def test_a_toe_that_stands_in_a_riser_is_a_bad_foothold():
    found = sole_that_moves(np.tile([0.42, 0.0, 0.0], (4, 1)), [0, 0, 0, 0])
    assert set(found) == {"foothold"}
    assert found["foothold"].value == pytest.approx(0.02) and found["foothold"].note == "surface box"
    assert sole_that_moves(np.tile([0.39, 0.0, 0.0], (4, 1)), [0, 0, 0, 0])["foothold"].value < 0.006


def test_what_a_foot_leaves_counts_only_in_the_middle_of_the_swing():
    path = np.tile([0.0, 0.0, 0.0], (12, 1))
    path[2:-2, 2] = 0.05
    path[1, 2] = -0.01  # in the ground, 5 % into the swing
    assert sole_that_moves(path, [0, *[-1] * 10, 0])["clearance"].value <= 0.0
    path[5, 2] = -0.01
    assert sole_that_moves(path, [0, *[-1] * 10, 0])["clearance"].value == pytest.approx(0.01)


def test_what_a_foot_reaches_at_the_very_end_is_known_from_the_final_contacts():
    path = np.tile([0.0, 0.0, 0.05], (12, 1))
    path[-1, 2] = -0.01
    surfaces = [*[-1] * 12]
    assert sole_that_moves(path, surfaces)["clearance"].value == pytest.approx(0.01)
    assert sole_that_moves(path, surfaces, final=0)["clearance"].value < 0.0
