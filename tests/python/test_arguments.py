"""mcplan.arguments: every verb names the argument that is of the wrong type, and says what is expected."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mcplan as mp
from mcplan.arguments import require, require_number, require_or_path
from standing import standing_plan

RESULT_TEXT = "got a PlanResult; its plan is result.plan"


@pytest.fixture(scope="module")
def result() -> mp.ddp.Result:
    return mp.plan("flat", phases=6, max_iterations=2, restarts=0)


WRONG: list[tuple[str, Callable[[Any], Any]]] = [
    (f"plan: must be a Plan, a PlanarPlan, a Motion or a path, {RESULT_TEXT}", lambda r: mp.check(r)),
    ("scene: must be a Scene, a name, a path or None, got 3", lambda r: mp.check(r.plan, 3)),
    ("robot: must be a Robot, a name, a path or None, got a Scene", lambda r: mp.check(r.plan, robot=r.plan.scene)),
    ("tolerances: must be a Tolerances, got 0.1", lambda r: mp.check(r.plan, None, None, 0.1)),
    ("scene: must be a Scene, a name or a path, got 3", lambda r: mp.plan(3, r.plan.robot)),
    ("robot: must be a Robot, a name or a path, got a Scene", lambda r: mp.plan("flat", r.plan.scene)),
    (f"warm_start: must be a Plan or None, {RESULT_TEXT}", lambda r: mp.plan("flat", warm_start=r)),
    ("logger: must be a function or None, got 3", lambda r: mp.plan("flat", logger=3)),
    ("weights.3: no such option. Options: com, ", lambda r: mp.plan("flat", weights={3: 1.0})),
    (f"previous: must be a Plan, {RESULT_TEXT}", lambda r: mp.replan(r, 0.0, r.plan.knots[0])),
    ('t: must be a number, got "now"', lambda r: mp.replan(r.plan, "now", r.plan.knots[0])),
    ("measured: must be a Knot, got a Phase", lambda r: mp.replan(r.plan, 0.0, r.plan.phases[0])),
    ('scene: must be a Scene or None, got "flat"', lambda r: mp.replan(r.plan, 0.0, r.plan.knots[0], scene="flat")),
    ("robot: must be a Robot or None, got 0", lambda r: mp.replan(r.plan, 0.0, r.plan.knots[0], robot=0)),
    ("scene: must be a Scene, a name or a path, got b'flat'", lambda r: mp.walk(b"flat")),
    (f"sequence: must be a Plan or a path, {RESULT_TEXT}", lambda r: mp.receding_horizon("flat", sequence=r)),
    ("task: must be a PlanarTask, a name or a path, got a Plan", lambda r: mp.whole_body(r.plan)),
    (
        "warm_start: must be a PlanarPlan or a path, got a Plan",
        lambda r: mp.whole_body("chimney", warm_start=r.plan),
    ),
    ("minimise: must be one of torque, time, none, got []", lambda r: mp.whole_body("chimney", minimise=[])),
    ("dynamics: must be of type bool, got array", lambda r: mp.whole_body("chimney", dynamics=np.zeros(2))),
    ("certify: must be a bool, got an ndarray", lambda r: mp.whole_body("chimney", certify=np.zeros(2))),
    (f"plan: must be a Plan, a PlanarPlan, a Motion, a run or a path, {RESULT_TEXT}", lambda r: mp.show(r)),
    ("joints: must be a string or a list of strings, got an ndarray", lambda r: mp.motion(r.plan, joints=np.zeros(2))),
    ("joints: must be a string or a list of strings, got a list", lambda r: mp.motion(r.plan, joints=[3])),
    ("start: must be one of follow, stand, got array", lambda r: mp.motion(r.plan, start=np.zeros(2))),
    ("tolerances: must be a MotionTolerances or None, got 3", lambda r: mp.motion(r.plan, tolerances=3)),
    ('report: must be a Report or None, got "solved"', lambda r: mp.show(r.plan, report="solved")),
    (f"plan: must be a Plan, a PlanarPlan, a Motion or a path, {RESULT_TEXT}", lambda r: mp.track(r)),
    ("robot: must be a Robot, a name, a path or None, got 3", lambda r: mp.track(r.plan, 3)),
    ("path: must be a path, got 3", lambda r: r.plan.scene.save(3)),
    ("path: must end in .toml", lambda r: r.plan.robot.save("my.json")),
    ("path: must be that of a file, not of a folder", lambda r: r.plan.scene.save("my.toml/")),
    ("source: must be a name or a path, got None", lambda r: mp.load_scene(None)),
    ("source: must be a name or a path, got 3", lambda r: mp.load_robot(3)),
    ("source: must be a name or a path, got b'climber9'", lambda r: mp.load_planar_robot(b"climber9")),
    ("source: must be a name or a path, got a list", lambda r: mp.load_planar_task([])),
]


def test_scenes_and_robots_are_written_as_they_are_read(tmp_path):
    scene, robot = mp.load_scene("flat"), mp.load_robot("humanoid44")
    scene.goal.position_W = [1.0, 0.4, 0.0]
    scene.save(tmp_path / "my.toml")
    robot.save(str(tmp_path / "robot.toml"))
    assert repr(mp.load_scene(tmp_path / "my.toml")) == repr(scene)
    assert repr(mp.load_robot(tmp_path / "robot.toml")) == repr(robot)
    scene.gravity = -1.0
    with pytest.raises(mp.errors.InvalidScene, match="gravity"):
        scene.save(tmp_path / "wrong.toml")
    assert not (tmp_path / "wrong.toml").exists()


def test_check_takes_files_and_names_as_the_command_does(result, tmp_path):
    result.plan.save(str(tmp_path / "plan.npz"))
    at_hand = mp.check(result.plan, mp.load_scene("stairs"), mp.load_robot("humanoid44"))
    in_files = mp.check(tmp_path / "plan.npz", "stairs", robot="humanoid44")
    assert [str(v) for v in in_files.violations()] == [str(v) for v in at_hand.violations()]
    assert not in_files.ok() and mp.check(str(tmp_path / "plan.npz")).ok() == mp.check(result.plan).ok()
    with pytest.raises(FileNotFoundError):
        mp.check(tmp_path / "none.npz")
    with pytest.raises(mp.UnknownName, match="no scene 'flatt' and no file of that name"):
        mp.check(result.plan, "flatt")


def test_check_takes_of_each_kind_of_plan_what_goes_with_it(result):
    with pytest.raises(
        mp.errors.InvalidArgument, match="self_collision: must not be given with a Plan, which takes scene and"
    ):
        mp.check(result.plan, self_collision=True)
    whole_body = mp.whole_body("chimney", forces="uniform", minimise="none", max_iterations=1).plan
    mp.check(whole_body, mp.PlanarTolerances(), True)
    with pytest.raises(
        mp.errors.InvalidArgument, match="scene: must not be given with a PlanarPlan, which takes tolerances"
    ):
        mp.check(whole_body, scene=result.plan.scene)


@pytest.mark.parametrize(("message", "call"), WRONG, ids=[message[:60] for message, _ in WRONG])
def test_what_is_of_another_type_is_named_with_what_is_expected(message, call, result):
    with pytest.raises(mp.InvalidInput) as found:
        call(result)
    assert str(found.value).startswith(message)


def test_a_wrong_number_of_arguments_of_python_stays_a_plain_type_error():
    for call in (lambda: mp.check(), lambda: mp.load_scene("flat", 3)):
        with pytest.raises(TypeError) as found:
            call()
        assert not isinstance(found.value, mp.InvalidInput)


def test_the_error_is_a_type_error_as_well():
    with pytest.raises(TypeError, match="a: must be a Plan, got None"):
        require("a", None, mp.Plan)
    with pytest.raises(TypeError, match="a: must be an EndEffector or None, got a set"):
        require("a", set(), mp.model.EndEffector, optional=True)
    require("a", standing_plan(), mp.Scene, mp.Plan)
    require("a", None, mp.Plan, optional=True)


def test_numbers_and_paths_are_taken_as_python_takes_them():
    assert [require_number("t", value) for value in (3, 0.5, True)] == [3.0, 0.5, 1.0]
    for value in ("3", b"3", 10**400, 1j, None, [1.0]):
        with pytest.raises(mp.errors.InvalidArgument, match="t: must be a number"):
            require_number("t", value)
    for path in ("a", Path("a")):
        require_or_path("a", path)


def test_what_cannot_be_shown_is_named_by_its_class():
    class Hostile:
        def __repr__(self):
            raise RuntimeError

        @property
        def plan(self):
            raise RuntimeError

    with pytest.raises(mp.errors.InvalidArgument, match="a: must be a Plan, got a Hostile"):
        require("a", Hostile(), mp.Plan)
