"""Ground that is simulated and not as planned: what fits a plan, and what the planner is told."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.errors import InvalidInput
from mcplan.online.known_ground import KnownGround
from mcplan.online.options import OnlineOptions
from mcplan.online.true_scene import NOBODY, as_told, require_goal, require_known


def scene_without(*names, planned=None):
    planned = planned or mp.load_scene("stairs_broad")
    scene = planned.__copy__()
    scene.surfaces = [surface for surface in planned.surfaces if surface.name not in names]
    return scene


def test_surfaces_keep_their_numbers_and_nobody_touches_those_that_are_not_there():
    planned, true = mp.load_scene("stairs_broad"), scene_without("tread_2")
    moved = true.surfaces[1].__copy__()
    moved.vertices_W = np.asarray(moved.vertices_W) + [0.0, 0.0, -0.03]
    true.surfaces = [true.surfaces[0], moved, *true.surfaces[2:]]
    told = as_told(true, planned)
    assert [s.name for s in told.surfaces] == [s.name for s in planned.surfaces]
    assert list(told.surfaces[2].end_effectors) == [NOBODY] and told.surfaces[3] == planned.surfaces[3]
    assert told.surfaces[1] == moved and told.goal == planned.goal


def test_what_is_told_is_known_from_its_time_on():
    planned, true = mp.load_scene("stairs_broad"), scene_without("tread_3")
    ground = KnownGround(planned, true, OnlineOptions(told_at_s=0.5), 4, 20.0)
    assert not ground.told(0.49) and ground.scene is planned
    assert ground.told(0.5) and list(ground.scene.surfaces[3].end_effectors) == [NOBODY]
    assert not ground.told(0.6)  # once is enough
    assert not KnownGround(planned, true, OnlineOptions(), 4, 20.0).told(1e3)


def test_ground_that_does_not_fit_the_plan_is_refused_by_name():
    planned = mp.load_scene("stairs_broad")
    with pytest.raises(InvalidInput, match=r"true_scene\.surfaces: must have 'ground', on which"):
        require_known(scene_without("ground"), planned)
    other = planned.__copy__()
    strange = planned.surfaces[1].__copy__()
    strange.name = "moon"
    other.surfaces = [*planned.surfaces, strange]
    with pytest.raises(InvalidInput, match=r'true_scene\.surfaces\[4\]\.name: must be the name of a surface.*"moon"'):
        require_known(other, planned)
    light = planned.__copy__()
    light.gravity = 1.62
    with pytest.raises(InvalidInput, match=r"true_scene\.gravity: must be that of the plan, 9\.8.*1\.62"):
        require_known(light, planned)


def test_a_planner_is_told_of_no_ground_without_its_goal():
    planned = mp.load_scene("stairs_broad")
    on = next(iter(dict(planned.goal.contacts).values()))
    require_goal(scene_without("tread_1"), planned)
    with pytest.raises(InvalidInput, match=rf"true_scene\.surfaces: must have '{on}', on which .* stands at the goal"):
        require_goal(scene_without(on), planned)


@pytest.mark.slow
@pytest.mark.parametrize("stone", ["right_1", "left_4"])
def test_a_stone_that_is_missing_is_walked_round_to_the_goal(stone):
    scene = mp.load_scene("stepping_stones")
    plan, missing = mp.plan(scene, "talos").plan, [s.name for s in scene.surfaces].index(stone)
    sequence = [list(contacts) for contacts in plan.contact_sequence()]
    lands_s = next(t for t, c in zip(plan.knot_times(), sequence, strict=False) if missing in c)
    true = scene_without(stone, planned=scene)
    run = mp.run(plan, true_scene=true, told_at_s=lands_s - 0.5, latency=0.02)
    assert not run.measures.fell and run.online.goal_off_m < 0.02
    # Where its feet are at the end, and that it did not wait for another way, no plan says.
    assert run.recording.com_W[-1, :2] == pytest.approx(scene.goal.position_W[:2], abs=0.02)
    assert run.measures.completed_s < plan.duration() + 3.0
    for followed in run.plans:
        if followed.begins_s > lands_s - 0.4:
            assert all(missing not in contacts for contacts in followed.plan.contact_sequence())
