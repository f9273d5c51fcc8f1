"""mcplan.tracking.link_clearance: links of postures in solids, as `mcplan check --robot` tells them."""

from __future__ import annotations

import copy

import numpy as np
import pytest

import mcplan as mp
from mcplan.kinematics.inverse_kinematics import follow
from mcplan.kinematics.samples import knots_and_between, sample_at
from mcplan.kinematics.urdf_model import load_model
from mcplan.tracking.feasibility import assess
from mcplan.tracking.link_clearance import LINK_DEPTH, link_findings


@pytest.fixture(scope="module")
def walk():
    return mp.plan("flat", "talos", phases=26).plan


def with_block(plan, x, y, z):
    """The plan's scene, and a solid between these heights that only hands may touch [m]."""
    scene = mp.load_scene("flat")
    block = mp.model.Surface(name="block", thickness=z[1] - z[0], end_effectors=["hand"])
    block.vertices_W = [[x[0], y[0], z[1]], [x[1], y[0], z[1]], [x[1], y[1], z[1]], [x[0], y[1], z[1]]]
    scene.surfaces = [*scene.surfaces, block]
    return scene


@pytest.fixture(scope="module")
def postures(walk):
    model = load_model(walk.robot)
    samples = sample_at(walk, walk.scene, walk.robot, knots_and_between(walk, 4.0))
    return model, samples, follow(model, samples)


@pytest.mark.parametrize("x", [(0.9, 1.0), (0.4, 1.6)])
@pytest.mark.parametrize("lowered_m", [0.005, 0.02])
def test_the_head_is_as_deep_in_a_beam_as_its_highest_point(walk, postures, lowered_m, x):
    """Against all corners of the links' shapes in all postures."""
    import pinocchio as pin

    from mcplan.tracking.link_shapes import link_shapes

    model, samples, configurations = postures
    data, top = model.model.createData(), -np.inf
    shapes = [shape for shape in link_shapes(model) if shape.link.startswith("head")]
    for q in configurations.configurations:
        pin.forwardKinematics(model.model, data, q)
        for shape in shapes:
            place = data.oMi[shape.joint]
            points = shape.points @ place.rotation.T + place.translation
            inside = points[(points[:, 0] > x[0]) & (points[:, 0] < x[1])]
            top = max(top, inside[:, 2].max(initial=-np.inf))
    scene = with_block(walk, x, (-1.0, 1.0), (top - lowered_m, top + 0.5))
    found = {f.where: f for f in link_findings(scene, model, samples, configurations)}
    assert set(found) <= {shape.link for shape in shapes} | {"rgbd_link"}
    deepest = max(found.values(), key=lambda f: f.value)
    assert deepest.value == pytest.approx(lowered_m, abs=1e-3) and deepest.note == "surface block"
    assert (
        link_findings(with_block(walk, x, (-1.0, 1.0), (top + 0.002, top + 0.5)), model, samples, configurations) == []
    )


def test_ground_and_what_a_robot_stands_on_are_no_matter_of_links(walk, postures):
    assert link_findings(walk.scene, *postures) == []


def test_a_plan_that_leads_head_and_arms_into_a_beam_cannot_be_followed(walk):
    assert not assess(walk).of("link")
    blocked = copy.deepcopy(walk)
    blocked.scene = with_block(walk, (0.9, 1.0), (-1.0, 1.0), (1.3, 1.5))
    found = assess(blocked)
    worst = max(found.of("link").values(), key=lambda f: f.use)
    assert worst.value > LINK_DEPTH and not found.ok()
    assert any("arm" in where for where in found.of("link")) and any("head" in where for where in found.of("link"))


@pytest.mark.parametrize("thickness", [1e-9, 1e-3, 1e6])
def test_solids_of_any_thickness_have_a_depth(walk, postures, thickness):
    """Of what is flat there is no convex hull: it once ended Python."""
    scene = with_block(walk, (0.9, 1.0), (-1.0, 1.0), (1.3, 1.5))
    scene.surfaces[-1].thickness = thickness
    found = link_findings(scene, *postures)
    assert found and all(0.0 < f.value < 1.0 for f in found)


def test_solids_far_away_change_nothing_and_take_no_time(walk):
    scene = mp.load_scene("flat")
    far = [mp.model.Surface(name=f"s{i}", thickness=0.1, end_effectors=["hand"]) for i in range(300)]
    for i, surface in enumerate(far):
        surface.vertices_W = [[x + 20 + i, y, 1.0] for x, y in ((0, 0), (0.5, 0), (0.5, 0.5), (0, 0.5))]
    plan = copy.deepcopy(walk)
    plan.scene.surfaces = [*scene.surfaces, *far]
    assert assess(plan) == assess(walk)
