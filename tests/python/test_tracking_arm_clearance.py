"""Which shapes belong to arms, and bounds of how far they are from the terrain."""

import numpy as np
import pytest

import mcplan as mp
import simulated

mujoco = pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.tracking.arm_clearance import ArmPairs  # noqa: E402
from mcplan.tracking.mujoco_model import build  # noqa: E402
from mcplan.tracking.states import to_mujoco  # noqa: E402


def blocks():
    """The floor, a ramp and two blocks about the robot."""
    scene = simulated.level()
    for i, (x, y, z, rise) in enumerate([(0.6, 0.0, 1.0, 0.0), (-0.2, 0.7, 0.8, 0.0), (1.0, -1.0, 0.2, 0.5)]):
        surface = scene.surfaces[0].__copy__()
        surface.name, surface.thickness = f"block{i}", 0.4
        surface.vertices_W = [[x, y, z], [x + 0.5, y, z], [x + 0.5, y + 0.4, z + rise], [x, y + 0.4, z + rise]]
        scene.surfaces = [*scene.surfaces, surface]
    return scene


@pytest.mark.parametrize(("name", "hands"), [("talos", 2), ("g1", 2), ("go2", 0)])
def test_arms_are_what_moves_a_hand_alone(name, hands):
    model = build(mp.load_robot(name), simulated.level())
    found = ArmPairs(model, True)
    assert len(set(found.hands.tolist())) == hands
    for (geom, surface), hand in zip(found.pairs.tolist(), found.hands.tolist(), strict=True):
        side = model.urdf_model.robot.end_effectors[hand].name.split("_")[0]
        assert surface in model.surface_geoms and side in model.geom_names[geom]
        assert not any(part in model.geom_names[geom] for part in ("leg", "hip", "knee", "ankle", "torso", "head"))
    assert not len(ArmPairs(model, False).pairs)


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_bounds_are_no_larger_than_distances_and_rule_most_pairs_out(name):
    model = build(mp.load_robot(name), blocks())
    found, data = ArmPairs(model, True), mujoco.MjData(model.mj)
    rng, ruled_out = np.random.default_rng(3), 0
    for _ in range(5):
        configuration = model.urdf_model.neutral.copy()
        configuration[:2] += 0.3 * rng.normal(size=2)
        configuration[7:] += 0.3 * rng.normal(size=len(configuration) - 7)
        data.qpos[:], _ = to_mujoco(model, configuration, np.zeros(model.urdf_model.model.nv))
        mujoco.mj_kinematics(model.mj, data)
        bounds = found.at_least(data, np.arange(len(found.pairs)))
        exact = np.array([mujoco.mj_geomDistance(model.mj, data, a, b, 50.0, None) for a, b in found.pairs.tolist()])
        assert (bounds <= exact + 1e-6).all()
        ruled_out += (bounds > 0.1).sum()
    assert ruled_out > 2.5 * len(found.pairs)


def test_talos_walks_between_walls_nearer_than_its_arms_are_wide_and_touches_none():
    scene = mp.load_scene("flat").__copy__()
    for side in (-1.0, 1.0):
        wall = scene.surfaces[0].__copy__()
        wall.name, wall.thickness, wall.end_effectors = f"wall{side:.0f}", 1.4, ["nobody"]
        y = (0.5 * side, 0.6 * side)
        wall.vertices_W = [[0.3, min(y), 1.4], [2.0, min(y), 1.4], [2.0, max(y), 1.4], [0.3, max(y), 1.4]]
        scene.surfaces = [*scene.surfaces, wall]
    goal = scene.goal.__copy__()
    goal.position_W = [0.8, 0.0, 0.0]
    scene.goal = goal
    planned = mp.plan(scene, "talos")
    assert planned.report.status == mp.Status.solved
    tracked = mp.track(planned.plan)
    assert not tracked.measures.fell
    assert tracked.measures.terrain_contacts == 0 and tracked.measures.self_contacts == 0
