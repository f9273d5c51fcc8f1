"""mcplan itself: light to import, and its errors are the ones of the C++ library."""

from __future__ import annotations

import pickle
import subprocess
import sys

import numpy as np
import pytest

import mcplan as mp
from mcplan import _core, errors, model
from mcplan.files.robots import save_robot
from mcplan.options import fill
from standing import standing_plan, standing_scene
from stepping import stepping_plan

HEAVY = ("typer", "rich", "matplotlib", "meshcat", "pinocchio", "mujoco", "scipy")


def test_import_loads_numpy_alone():
    script = f"import sys, mcplan; print([m for m in {HEAVY} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_public_face_is_some_thirty_names():
    assert len(mp.__all__) <= 34 and mp.__all__ == sorted(mp.__all__) and dir(mp) == mp.__all__


#: What has moved to mcplan.model, mcplan.errors and the engines is still here for a release.
MOVED = """CheckResult Contact ContactRule EndEffector ForceLaw InvalidArgument InvalidMotion InvalidOptions InvalidPlan
InvalidRobot InvalidScene Knot Phase PlanResult PlanarMotion Polytope Report Stance Step Surface Swing UnknownMotion
UnknownRobot UnknownScene Violation Walk WholeBodyPlan WholeBodyTolerances""".split()


def test_names_that_have_moved_can_still_be_had_and_say_where_they_are():
    for name in MOVED:
        assert name not in mp.__all__
        with pytest.warns(DeprecationWarning, match=rf"^mcplan\.{name} is mcplan\.\S+ now") as told:
            earlier = getattr(mp, name)
        assert isinstance(earlier, type) and told[0].filename == __file__
        assert earlier is eval(str(told[0].message).split()[2], {"mcplan": mp})
    with pytest.warns(DeprecationWarning, match=r"^mcplan\.load_motion is mcplan\.load_planar_task now"):
        assert mp.load_motion is mp.load_planar_task
    with pytest.raises(AttributeError, match="module 'mcplan' has no attribute 'Walks'"):
        mp.Walks  # noqa: B018


@pytest.mark.parametrize(
    ("name", "now"), [("InvalidMotion", "InvalidPlanarTask"), ("UnknownMotion", "UnknownPlanarTask")]
)
def test_errors_of_planar_tasks_are_caught_by_their_earlier_names(name, now):
    with pytest.warns(DeprecationWarning, match=rf"^mcplan\.errors\.{name} is mcplan\.errors\.{now} now") as told:
        assert getattr(errors, name) is getattr(errors, now)
    assert len(told) == 1 and told[0].filename == __file__ and name not in errors.__all__
    with pytest.raises(AttributeError, match="module 'mcplan.errors' has no attribute 'InvalidMotions'"):
        errors.InvalidMotions  # noqa: B018


def test_the_task_of_a_plan_can_be_read_and_written_by_its_earlier_name():
    plan = mp.PlanarPlan(task=mp.load_planar_task("stairs"))
    with pytest.warns(DeprecationWarning, match=r"^mcplan\.PlanarPlan\.motion is mcplan\.PlanarPlan\.task now") as told:
        assert plan.motion.name == "stairs"
    assert len(told) == 1 and told[0].filename == __file__
    with pytest.warns(DeprecationWarning) as told:
        plan.motion = mp.load_planar_task("chimney")
    assert len(told) == 1 and plan.task == mp.load_planar_task("chimney")


def test_ratios_can_be_read_and_given_by_their_earlier_names():
    robot = mp.load_robot("talos")
    with pytest.warns(DeprecationWarning, match=r"^mcplan\.Robot\.pressure_share is mcplan\.Robot\.pressure_ratio now"):
        assert robot.pressure_share == robot.pressure_ratio == 0.75
    with pytest.warns(
        DeprecationWarning, match=r"^mcplan\.rhp\.Options\.sole_share is mcplan\.rhp\.Options\.sole_ratio now"
    ):
        chosen = fill(mp.rhp.Options(), {"sole_share": 0.5})
    assert chosen.sole_ratio == 0.5
    with pytest.warns(DeprecationWarning, match=r"\.friction_share is mcplan\.rhp\.Options\.friction_ratio now"):
        mp.receding_horizon("rubbles", "talos_wang", friction_share=0.9)
    with pytest.raises(errors.InvalidOptions, match="sole_share: may not stand beside sole_ratio, whose earlier name"):
        fill(mp.rhp.Options(), {"sole_share": 0.5, "sole_ratio": 0.6})


def test_files_with_the_earlier_key_of_a_ratio_are_read(tmp_path):
    file = tmp_path / "talos.toml"
    robot = mp.load_robot("talos")
    robot.pressure_ratio = 0.5
    save_robot(robot, file)
    text = file.read_text()
    assert text.count("pressure_ratio = 0.5") == 1
    file.write_text(text.replace("pressure_ratio", "pressure_share"))
    assert mp.load_robot(file) == robot
    file.write_text(text.replace("pressure_ratio = 0.5", "pressure_ratio = 0.5\npressure_share = 0.5"))
    with pytest.raises(
        errors.InvalidRobot,
        match=r"pressure_share: is the earlier name of pressure_ratio, which is there too, got 0\.5$",
    ):
        mp.load_robot(file)


@pytest.mark.parametrize("module", [mp.ddp, errors, mp.ipm, model, mp.rhp, mp.sip], ids=lambda module: module.__name__)
def test_every_name_of_a_public_module_is_documented(module):
    assert module.__all__ == sorted(module.__all__) and len(module.__doc__) > 60
    for name in module.__all__:
        assert getattr(module, name).__doc__, name


def test_every_public_name_exists_and_is_documented():
    for name in mp.__all__:
        assert getattr(mp, name) is not None
    for name in ("load_scene", "load_robot", "load_planar_robot", "load_planar_task", "plan", "check", "show"):
        assert len(getattr(mp, name).__doc__) > 100


@pytest.mark.parametrize(
    ("name", "base"),
    [
        ("InvalidScene", errors.InvalidInput),
        ("InvalidRobot", errors.InvalidInput),
        ("InvalidOptions", errors.InvalidInput),
        ("InvalidPlan", errors.InvalidInput),
        ("InvalidInput", ValueError),
        ("PlanViolated", RuntimeError),
        ("UnknownScene", ValueError),
        ("UnknownRobot", ValueError),
        ("InvalidPlanarTask", errors.InvalidInput),
        ("UnknownPlanarTask", ValueError),
    ],
)
def test_errors_are_what_their_callers_expect(name, base):
    assert issubclass(getattr(errors, name), base)


def test_errors_of_the_library_carry_field_rule_and_value():
    scene = standing_scene()
    scene.surfaces[0].friction = -1.0
    with pytest.raises(mp.errors.InvalidScene) as found:
        scene.validate()
    error = found.value
    assert (error.field, error.rule, error.value) == (
        "surfaces[0].friction",
        "must be a positive number",
        "-1",
    )
    assert str(error) == "surfaces[0].friction: must be a positive number, got -1"
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is mp.errors.InvalidScene and str(again) == str(error)


def test_each_kind_of_error_keeps_its_class_across_the_border():
    with pytest.raises(mp.errors.InvalidRobot, match="mass: must be a positive number"):
        mp.Robot().validate()
    with pytest.raises(mp.errors.InvalidPlan, match="phases: needs at least one phase"):
        mp.Plan().validate()
    with pytest.raises(mp.InvalidInput, match="t: must lie in"):
        standing_plan().at(99.0)


def test_raise_if_violated_names_the_worst():
    plan = standing_plan()
    mp.check(plan).raise_if_violated()
    plan.knots[1].com_W[0] += 0.5
    with pytest.raises(mp.PlanViolated) as found:
        mp.check(plan).raise_if_violated()
    result = mp.check(plan)
    assert str(found.value).startswith(str(result.violations()[0]))
    assert [v.name for v in found.value.violations] == [v.name for v in result.violations()]


def test_check_takes_another_scene_and_tolerances():
    plan, other = standing_plan(), standing_scene()
    other.surfaces[0].vertices_W[:, 2] -= 0.01
    assert mp.check(plan, plan.scene, plan.robot).ok()
    assert not mp.check(plan, other).ok()
    loose = mp.Tolerances(contact_distance=0.02, boundary=0.02, stance=0.03)
    assert not {"contact_distance"} & {v.name for v in mp.check(plan, other, tolerances=loose).violations()}


def test_check_lets_other_threads_run():
    """Releases the GIL: a thread that waits for it gets on while a check runs, though nobody takes it away."""
    import sys
    import threading

    gate, ran = threading.Lock(), threading.Event()
    gate.acquire()

    def go_on():
        with gate:
            ran.set()

    thread = threading.Thread(target=go_on)
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e6)  # from here on only who releases it lets another thread have it
    try:
        thread.start()
        gate.release()
        for _ in range(1000):  # a busy machine may let the waiting thread sleep through a check or two
            if ran.is_set():
                break
            mp.check(standing_plan())
        assert ran.is_set()
    finally:
        sys.setswitchinterval(before)
        thread.join()


def test_elements_can_be_changed_in_place_and_outlive_their_list():
    scene = standing_scene()
    floor = scene.surfaces[0]
    floor.friction = 0.25
    vertices_W = floor.vertices_W
    vertices_W[0, 0] = -3.0
    assert scene.surfaces[0].friction == 0.25 and scene.surfaces[0].vertices_W[0, 0] == -3.0
    scene.surfaces = [mp.model.Surface(name="other", vertices_W=np.eye(3))]
    assert floor.name == "ground" and vertices_W[0, 0] == -3.0  # detached, but alive
    assert [surface.name for surface in scene.surfaces] == ["other"]
    with pytest.raises(AttributeError):
        scene.surfaces.append(floor)
    with pytest.raises(TypeError):
        scene.start.contacts["foot"] = "other"


def test_a_scene_may_be_assigned_to_itself():
    plan = standing_plan()
    plan.scene = plan.scene
    assert plan.scene.surfaces[0].name == "ground"


@pytest.mark.parametrize("value", [[[1.0, 2.0]], [1.0, 2.0, 3.0], "abc", [["a", "b", "c"]], None, np.zeros((2, 3, 1))])
def test_points_of_the_wrong_shape_are_rejected(value):
    with pytest.raises(mp.InvalidInput, match="vertices_W: must be an N x 3 array of numbers"):
        mp.model.Surface(name="s", vertices_W=value)


def test_reprs_can_be_pasted_back():
    names = {**vars(_core)}
    for value in (
        mp.Tolerances(slip=0.1),
        mp.model.Stance(yaw=0.1, contacts={"a": "b"}),
        mp.model.EndEffector(name="e"),
        mp.model.Contact(surface=2, stiffness=1 / 3),
        standing_plan().knots[0],
        standing_plan().phases[0],
        stepping_plan().phases[1],
        mp.model.Swing(height=0.1),
        mp.model.Violation(name="x", value=float("nan")),
    ):
        assert repr(eval(repr(value), names)) == repr(value)


def test_a_walk_says_how_far_it_goes():
    walk = mp.walk("flat", lookahead=2, cycles=2)
    assert repr(walk) == f"<Walk of 2 cycles: {walk.distance_m():.2f} m, solved>"


def test_status_reads_as_its_name():
    assert str(mp.Status.time_limit) == "time_limit"
    assert mp.Status.solved != mp.Status.acceptable


def test_rotation_helpers_agree_with_each_other():
    rpy = np.array([0.3, -0.4, 1.2])
    rotation = _core.rotation_from_rpy(rpy)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-15)
    w, x, _, _ = _core.quat_wxyz_from_rpy(rpy)
    assert rotation[2, 1] - rotation[1, 2] == pytest.approx(4 * w * x)
    assert np.trace(rotation) == pytest.approx(4 * w * w - 1)
    for i in range(3):
        unit = np.eye(3)[i] * 1e-6
        slope = (_core.rotation_from_rpy(rpy + unit) - _core.rotation_from_rpy(rpy - unit)) / 2e-6
        np.testing.assert_allclose(_core.rotation_derivative(rpy, i), slope, atol=1e-9)
    with pytest.raises(mp.InvalidInput):
        _core.rotation_derivative(rpy, 3)


def test_a_missing_viewer_says_what_to_install(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(errors.MissingExtra, match=r"mcplan.show needs meshcat: pip install 'mcplan\[view\]'"):
        mp.show(standing_plan())


def test_a_step_with_forces_at_the_corners_is_checked():
    robot = mp.load_robot("humanoid44")
    for end in robot.end_effectors:  # the hand-made gait leans further than this robot reaches
        end.reach_min_B, end.reach_max_B = end.reach_min_B - 0.05, end.reach_max_B + 0.05
    plan = stepping_plan(robot=robot)
    mp.check(plan).raise_if_violated()
    plan.phases[0].contacts[0].point_forces_W[5] += [0.0, 0.0, 1e-2]  # a view: changes the plan
    assert [violation.name for violation in mp.check(plan).violations()] == ["dynamics"]
    plan.phases[0].intervals = 99
    with pytest.raises(mp.errors.InvalidPlan, match="point_forces"):
        mp.check(plan)


def test_states_carry_points_and_their_forces():
    plan = stepping_plan()
    stance = plan.at(0.9).end_effectors[0]
    assert stance.points_W.shape == stance.point_forces_W.shape == (4, 3)
    assert stance.force_W == pytest.approx(stance.point_forces_W.sum(axis=0))
    about = np.cross(stance.points_W - stance.position_W, stance.point_forces_W).sum(axis=0)
    assert stance.moment_W == pytest.approx(about)
    assert plan.at(0.9).end_effectors[1].points_W.shape == (0, 3)
    assert plan.phases[0].node_count() == 8 and mp.model.Phase().node_count() == 0


@pytest.mark.parametrize("duration", [5e-324, 1e-310, 1e-15])
def test_a_phase_that_lasts_next_to_nothing_is_looked_at_like_any_other(duration):
    plan = stepping_plan()
    plan.phases[1].duration = duration
    plan.validate()
    assert np.isfinite(_core.plan_loads(plan).angular_momentum)
    assert plan.at_phase(1, duration).phase == 1
    assert not mp.check(plan).ok()  # the knots are still those of a phase that takes its time
