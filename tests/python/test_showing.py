"""One way for plans and runs of both kinds: loaded, asked, drawn."""

import copy
import inspect

import numpy as np
import pytest

import mcplan as mp
import planar_recordings
import plans_by_hand
import recordings
import tracked_cartwheel
from mcplan import showing
from mcplan.tracking import Options, TrackingResult
from mcplan.view.pages.show import show_scene
from mcplan.view.pictures.picture import picture
from reference_solutions import reference_plan


def plans() -> list[mp.Plan | mp.PlanarPlan]:
    return [
        plans_by_hand.walk(plans_by_hand.flat(), plans_by_hand.humanoid()),
        reference_plan("walking", "optimised_uniform"),
    ]


@pytest.mark.parametrize("plan", plans(), ids=lambda plan: type(plan).__name__)
def test_both_kinds_of_plan_answer_alike(plan, tmp_path):
    asked: showing.AnyPlan = plan
    for time_s in (0.0, asked.duration()):
        assert np.isfinite(asked.at(time_s).com_W).all()
    asked.save(str(tmp_path / "plan.npz"))
    again = showing.load(tmp_path / "plan.npz")
    assert type(again) is type(plan) and again.duration() == plan.duration()
    assert mp.check(again).ok() == mp.check(plan).ok()
    assert mp.show(tmp_path / "plan.npz").html() == mp.show(plan).html()
    assert not showing.is_run(plan)
    methods = [name for name, _ in inspect.getmembers(showing.AnyPlan, inspect.isfunction) if name[0] != "_"]
    assert sorted(methods) == ["at", "duration", "save"]


def test_runs_of_both_kinds_come_back_as_they_are(tmp_path):
    runs = [TrackingResult(recordings.walking(), recordings.measures(), Options()), tracked_cartwheel.tracked()]
    for number, run in enumerate(runs):
        run.save(tmp_path / f"{number}.npz")
        again = showing.load(tmp_path / f"{number}.npz")
        assert type(again) is type(run) and showing.is_run(again)
        assert str(again) == str(run)


@pytest.mark.parametrize("content", [b"", b"no archive", b"PK"])
def test_another_file_is_told_from_plans_and_runs(content, tmp_path):
    (tmp_path / "other.npz").write_bytes(content)
    with pytest.raises(mp.InvalidInput, match="other.npz: must be an .npz or .json file written by mcplan"):
        showing.load(tmp_path / "other.npz")
    with pytest.raises(FileNotFoundError):
        showing.load(tmp_path / "absent.npz")


def test_runs_are_shown_as_plans_are():
    pytest.importorskip("meshcat")
    recording = planar_recordings.walking()
    assert "simulated" in mp.show(recording).title
    with pytest.raises(mp.InvalidInput, match='scene: a run is drawn with its own plan, got "flat"'):
        mp.show(recording, mp.load_scene("flat"))


def test_a_scene_or_robot_that_was_edited_out_of_its_ranges_is_refused_by_name(tmp_path):
    plan = plans_by_hand.walk(plans_by_hand.flat(), plans_by_hand.humanoid())
    scene, robot = copy.deepcopy(plan.scene), copy.deepcopy(plan.robot)
    scene.surfaces[0].vertices_W = np.zeros((0, 3))
    robot.mass = float("nan")
    for draw in (mp.show, lambda *args: picture(*args, path=tmp_path / "a.png")):
        with pytest.raises(mp.errors.InvalidScene, match=r"surfaces\[0\].vertices"):
            draw(plan, scene, plan.robot)
        with pytest.raises(mp.errors.InvalidRobot, match="mass"):
            draw(plan, plan.scene, robot)
    with pytest.raises(mp.errors.InvalidScene, match=r"surfaces\[0\].vertices"):
        show_scene(scene)
    assert not list(tmp_path.iterdir())
