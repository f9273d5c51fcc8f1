"""Whole-body motions found for plans: derivatives, what the certificate says, starts, limits, interruption."""

from __future__ import annotations

import functools
import re
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan as mp  # noqa: E402
from mcplan.errors import Interrupted, InvalidInput, InvalidOptions, InvalidPlan  # noqa: E402
from mcplan.files.scenes import scaled  # noqa: E402
from mcplan.kinematics.urdf_model import load_model  # noqa: E402
from mcplan.wb import MotionStatus, splines  # noqa: E402
from mcplan.wb.capsules import keep_apart, link_capsules  # noqa: E402
from mcplan.wb.certificate import MotionViolation  # noqa: E402
from mcplan.wb.contact_points import corners_S, points_S, to_corners  # noqa: E402
from mcplan.wb.knots import subdivided, with_knots  # noqa: E402
from mcplan.wb.moving_joints import MovingRobot, moving_joints  # noqa: E402
from mcplan.wb.nodes import nodes_of  # noqa: E402
from mcplan.wb.solve import _Search  # noqa: E402
from standing import standing_plan  # noqa: E402
from stepping import stepping_plan  # noqa: E402


@functools.cache
def talos_steps() -> mp.Plan:
    return stepping_plan(2, robot=mp.load_robot("talos"))


@functools.cache
def solved() -> mp.wb.MotionResult:
    return mp.motion(talos_steps())


def test_a_walk_of_two_steps_is_certified():
    result = solved()
    assert result.status is MotionStatus.SOLVED and result.certificate.ok()
    measures = result.certificate.measures
    assert result.iterations <= 20
    assert measures["base_residual_N"] <= 0.5 and measures["drift_m"] <= 2e-5 and measures["com_rms_m"] <= 0.01
    assert result.certificate.of("friction").value <= 1e-6 and measures["torque_use"] <= 0.98


def test_standing_still_and_inverse_kinematics_lead_to_the_same_motion():
    standing = mp.motion(talos_steps(), start="stand")
    assert standing.status is MotionStatus.SOLVED
    assert standing.report.cost == pytest.approx(solved().report.cost, rel=1e-3)
    times = np.linspace(0.0, talos_steps().duration(), 50)
    np.testing.assert_allclose(standing.motion.sample(times).com_W, solved().motion.sample(times).com_W, atol=2e-3)


def test_a_motion_is_the_same_bytes_each_time():
    assert mp.motion(talos_steps()).motion.to_bytes() == solved().motion.to_bytes()


@pytest.mark.parametrize("robot", ["talos", "g1", "go2"])
def test_derivatives_are_those_of_differences(robot: str):
    make = standing_plan if robot == "go2" else lambda robot: stepping_plan(1, robot=robot)
    plan = make(robot=mp.load_robot(robot))
    search = _Search.of(MovingRobot.of(plan, "default"), 0.1)
    capsules = list(link_capsules(search.model).values())
    numbers = [search.problem.add_capsule(own.joint + 4, own.start, own.end, own.radius) for own in capsules]
    for first, second in ((0, 5), (3, -1), (9, 12)):
        search.problem.add_pair(numbers[first], numbers[second], 0.01)
    search.renew()
    generator = np.random.default_rng(7)
    x = search.start("follow")
    x = x + 0.05 * generator.standard_normal(x.size)
    for _ in range(3):
        step = generator.standard_normal(x.size)
        cost, equalities, inequalities = search.solver.slopes(x, step)
        length = 1e-5
        after, before = (search.solver.values(x + sign * length * step) for sign in (1.0, -1.0))
        differences = [(np.asarray(a) - np.asarray(b)) / (2.0 * length) for a, b in zip(after, before, strict=True)]
        assert cost == pytest.approx(differences[0], rel=1e-6)
        for slopes, expected in ((equalities, differences[1]), (inequalities, differences[2])):
            assert np.abs(slopes - expected).max() <= 1e-6 * np.abs(expected).max()
            assert np.median(np.abs(slopes - expected)) <= 1e-7 * np.median(np.abs(expected))


@pytest.mark.slow
def test_a_motion_that_asks_for_more_torque_than_there_is_names_joint_time_and_factor():
    plan = talos_steps()
    scene = plan.scene
    scene.gravity *= 1.5  # of which the plan's CoM, and so its horizontal forces, knows nothing
    plan.scene = scene
    talos_steps.cache_clear()
    result = mp.motion(plan, max_iterations=100)
    assert result.status is MotionStatus.TORQUE_INFEASIBLE, result.report
    assert result.shortfall.factor > 1.05 and 0.0 < result.shortfall.time_s < plan.duration()
    assert result.shortfall.joint in result.motion.joints
    assert f"{result.shortfall.joint} needs {result.shortfall.factor:.2f} times its torque" in str(result.report)


def with_limits(tmp_path: Path, **factors: float) -> mp.Robot:
    """Talos with the limits of all its joints times factors, such as velocity=0.5; without shapes."""
    robot = mp.load_robot("talos")
    text = re.sub(r"<(visual|collision)>.*?</\1>", "", load_model(robot).path.read_text(), flags=re.DOTALL)
    for name, factor in factors.items():
        text = re.sub(rf'{name}="([^"]+)"', lambda found, n=name, f=factor: f'{n}="{f * float(found[1])}"', text)
    (tmp_path / "talos.urdf").write_text(text)
    robot.urdf = str(tmp_path / "talos.urdf")
    return robot


def test_joints_that_are_too_slow_are_named_with_time_and_factor(tmp_path: Path):
    plan = stepping_plan(2, robot=with_limits(tmp_path, velocity=0.02))
    result = mp.motion(plan)
    assert result.status is MotionStatus.SPEED_INFEASIBLE, result.report
    assert result.shortfall.what == "speed" and result.shortfall.joint.startswith("leg_")
    assert result.shortfall.factor > 1.1 and 0.0 < result.shortfall.time_s < plan.duration()


@pytest.mark.parametrize("ratio", [0.05, 0.03])
def test_joints_that_are_too_weak_are_named_though_the_search_does_not_end(tmp_path: Path, ratio: float):
    """At 0.03 what is left on the base is not small either, but no less than the torque that is lacking."""
    result = mp.motion(stepping_plan(2, robot=with_limits(tmp_path, effort=ratio)))
    assert result.status is MotionStatus.TORQUE_INFEASIBLE, result.report
    assert result.shortfall.factor > 2.0 and result.shortfall.joint in result.motion.joints
    assert result.iterations == 60 and "max_iterations" in result.report.message


def test_few_iterations_do_not_say_that_a_torque_is_lacking(tmp_path: Path):
    weak = stepping_plan(2, robot=with_limits(tmp_path, effort=0.5))
    assert mp.motion(weak, max_iterations=8).status is MotionStatus.NOT_CONVERGED
    assert mp.motion(weak).status is MotionStatus.SOLVED


@pytest.mark.parametrize(("gravity", "effort"), [(2.0, 1.0), (2.0, 4.0)])
def test_a_walk_planned_for_twice_the_gravity_is_certified(tmp_path: Path, gravity: float, effort: float):
    """Legs that are nearly straight carry twice the weight; with stronger joints the motion is nearer to its plan."""
    scene = mp.load_scene("flat")
    scene.gravity *= gravity
    result = mp.motion(stepping_plan(2, scene=scene, robot=with_limits(tmp_path, effort=effort)))
    assert result.status is MotionStatus.SOLVED, result.report
    measures = result.certificate.measures
    assert measures["com_max_m"] <= 0.03
    assert (measures["torque_use"] > 0.9) == (effort == 1.0)


def test_a_plan_whose_com_is_too_high_for_the_legs_names_one():
    robot = mp.load_robot("talos")
    robot.com_height += 0.15
    result = mp.motion(stepping_plan(1, robot=robot), max_iterations=30)
    assert result.status is MotionStatus.REACH_INFEASIBLE, result.report
    assert result.shortfall.joint.startswith("leg") and 1.005 < result.shortfall.factor < 1.3


def standing_with(**state: list[float]) -> mp.Plan:
    """Talos standing, with another state at all knots."""
    plan = standing_plan(robot=mp.load_robot("talos"))
    knots = plan.knots
    for knot in knots:
        for name, value in state.items():
            setattr(knot, name, value)
    plan.knots = knots
    return plan


def test_a_base_that_lies_on_its_front_is_refused():
    plan = standing_with(base_rpy=[0.0, 1.4, 0.0])
    with pytest.raises(InvalidPlan, match=r"plan.*at most 75 degrees.*got 80\.21 degrees"):
        mp.motion(plan)


def test_an_end_of_time_and_of_iterations_are_said():
    assert mp.motion(talos_steps(), time_limit_s=1e-3).status is MotionStatus.TIME_LIMIT
    plan = talos_steps()
    stands = mp.motion(plan, node_s=1e-3, time_limit_s=1e-3)  # far more nodes than there is time for
    assert stands.status is MotionStatus.TIME_LIMIT and stands.iterations == 0
    assert "before the first iteration" in stands.report.message
    assert stands.motion.duration() == plan.duration() and not stands.motion.corner_forces_S.any()
    few = mp.motion(talos_steps(), max_iterations=2)
    assert few.status is MotionStatus.NOT_CONVERGED and few.iterations == 2 and few.certificate is None


def test_ctrl_c_ends_a_solve_and_carries_what_there_is(ctrl_c: None, monkeypatch: pytest.MonkeyPatch):
    from mcplan.wb import dynamics

    calls, usual = [0], dynamics.Dynamics.__call__

    def interrupting(self: dynamics.Dynamics, derivatives: bool) -> None:
        calls[0] += 1
        if calls[0] == 5:
            signal.raise_signal(signal.SIGINT)
        usual(self, derivatives)

    monkeypatch.setattr(dynamics.Dynamics, "__call__", interrupting)
    with pytest.raises(Interrupted) as found:
        mp.motion(talos_steps())
    assert found.value.result.status is MotionStatus.INTERRUPTED and calls[0] <= 8
    assert found.value.result.motion.duration() == talos_steps().duration()


def test_ctrl_c_during_the_certificate_carries_the_motion(ctrl_c: None, monkeypatch: pytest.MonkeyPatch):
    from mcplan.wb import certificate

    monkeypatch.setattr(certificate, "certify", lambda *_: signal.raise_signal(signal.SIGINT))
    with pytest.raises(Interrupted) as found:
        mp.motion(standing_plan(robot=mp.load_robot("talos")))
    monkeypatch.undo()
    result = found.value.result
    assert result.status is MotionStatus.INTERRUPTED and result.certificate is None
    result.motion.check().raise_if_violated()


def test_feet_take_no_more_than_they_may():
    plan = talos_steps()
    free = mp.motion(plan).motion
    largest = np.linalg.norm(free.corner_forces_S.sum(axis=2), axis=2).max(axis=0)
    robot = plan.robot
    ends = robot.end_effectors
    for end, force in zip(ends[:2], largest, strict=False):
        end.max_force = 0.98 * force
    robot.end_effectors = ends
    plan.robot = robot
    capped = mp.motion(plan)
    assert capped.status is MotionStatus.SOLVED, capped.report
    assert 0.9 < capped.certificate.of("force_cap").value <= 1.0


def test_a_plan_of_ages_is_refused_before_there_are_nodes():
    plan = standing_plan(robot=mp.load_robot("talos"))
    phases = plan.phases
    phases[0].duration = 1e6
    plan.phases = phases
    with pytest.raises(InvalidPlan, match=r"plan: must be short enough for a motion of 100000 nodes.*got 1e\+06"):
        mp.motion(plan)


def test_a_plan_beyond_all_bounds_is_refused():
    plan = standing_with(com_W=[1e300, 0.0, 1.0])
    with pytest.raises(InvalidPlan, match=r"plan: must keep within 1e\+06 m of the origin.*got .*e\+300 m at 1\.200 s"):
        mp.motion(plan)


def test_swings_begin_and_end_where_contacts_do():
    plan = talos_steps()
    nodes = nodes_of(plan, 0.05)
    swings = 0
    for k in range(nodes.count):
        for end in range(2):
            before = [i for i in range(k + 1) if nodes.intervals[i][end] is not None]
            after = [i for i in range(k, nodes.count) if nodes.intervals[i][end] is not None]
            expected = (nodes.times_s[before[-1]], nodes.times_s[after[0]]) if before and after else (0.0, 0.0)
            assert nodes.swing(k, end) == expected
            swings += expected[1] > expected[0]
    assert swings > 10


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"node_s": 1.0}, InvalidOptions, "node_s"),
        ({"max_iterations": -1}, InvalidOptions, "max_iterations"),
        ({"time_limit_s": 0.0}, InvalidOptions, "time_limit_s"),
        ({"start": "there"}, InvalidOptions, "start"),
        ({"joints": "knee"}, InvalidInput, "joints: must be all, default, legs"),
        ({"joints": "leg_left_1_joint,"}, InvalidInput, 'joints: must be all, default, legs.*got ""'),
        ({"joints": ["leg_left_1_joint", "knee"]}, InvalidInput, r"joints\[1\]: must be all, default, legs"),
        ({"joints": []}, InvalidInput, "joints: must name a joint at least"),
        ({"joints": ["leg_left_1_joint"] * 2}, InvalidInput, r"joints\[1\]: must name each joint once"),
    ],
)
def test_options_are_refused_by_name(options: dict, error: type, message: str):
    with pytest.raises(error, match=message):
        mp.motion(talos_steps(), **options)


def test_joints_are_chosen_by_word_or_name():
    model = load_model(mp.load_robot("talos"))
    everything, locked = moving_joints(model, "all")
    assert len(everything) == 32 and not locked
    most, locked = moving_joints(model, "default")
    assert sorted(locked) == ["gripper_left_joint", "gripper_right_joint", "head_1_joint", "head_2_joint"]
    legs, _ = moving_joints(model, "legs")
    assert len(legs) == 12 and all(name.startswith("leg") for name in legs)
    assert moving_joints(model, ",".join(reversed(legs)))[0] == legs


def test_a_motion_of_legs_alone_is_certified():
    result = mp.motion(standing_plan(robot=mp.load_robot("talos")), joints="legs")
    assert result.status is MotionStatus.SOLVED and len(result.motion.joints) == 12


def test_more_knots_leave_a_spline_as_it_is():
    generator = np.random.default_rng(1)
    nodes = np.cumsum(generator.uniform(0.01, 0.1, 9))
    coefficients = generator.standard_normal((11, 3))
    more = subdivided(nodes, 0.013)
    assert set(nodes) <= set(more) and np.diff(more).max() <= 0.013 + 1e-12
    times = np.linspace(nodes[0], nodes[-1], 400)
    for one, other in zip(
        splines.evaluate(nodes, coefficients, times),
        splines.evaluate(more, with_knots(nodes, coefficients, more), times),
        strict=True,
    ):
        np.testing.assert_allclose(other, one, atol=1e-9 * np.abs(one).max())


def test_forces_within_a_sole_are_the_same_wrench_at_its_corners():
    generator = np.random.default_rng(2)
    corners = np.array([[0.1, 0.06, 0.0], [0.1, -0.06, 0.0], [-0.1, -0.06, 0.0], [-0.1, 0.06, 0.0]])
    points = np.column_stack([generator.uniform(-1.0, 1.0, (4, 2)) * [0.1, 0.06], np.zeros(4)])
    forces = generator.standard_normal((4, 3))
    to = to_corners(points, corners)
    assert (to >= 0.0).all()
    np.testing.assert_allclose((to @ forces).sum(axis=0), forces.sum(axis=0), atol=1e-12)
    np.testing.assert_allclose(
        np.cross(corners, to @ forces).sum(axis=0), np.cross(points, forces).sum(axis=0), atol=1e-12
    )


def test_contact_points_lie_on_the_surface_under_the_sole():
    plan = talos_steps()
    interval = nodes_of(plan, 0.1).samples.intervals[0]
    sole = corners_S(plan.robot.end_effectors[interval.end_effector])
    assert (np.abs(points_S(plan, interval)) <= np.abs(sole)).all()
    right = np.array([0.05, 0.0, 0.0])  # now the surface ends 5 cm ahead of where the sole stands
    scene = plan.scene
    vertices = np.array(scene.surfaces[interval.surface].vertices_W)
    vertices[:, 0] = np.minimum(vertices[:, 0], (interval.position_W + right)[0])
    surfaces = list(scene.surfaces)
    surfaces[interval.surface].vertices_W = vertices
    scene.surfaces = surfaces
    plan.scene = scene
    moved = points_S(plan, interval)
    assert moved[:, 0].max() <= 0.05 and moved[:, 0].min() < -0.08
    talos_steps.cache_clear()


@pytest.mark.slow
def test_links_that_are_too_near_are_moved_apart():
    """Arms are asked to stay 3 cm farther from the thighs than they are: a motion that does so is found and certified."""
    search = _Search.of(MovingRobot.of(talos_steps(), "default"), 0.025)
    q = solved().motion.sample([1.5]).q[0]
    capsules = link_capsules(search.model)
    near = MotionViolation(
        "self_distance", -0.02, 0.005, "m", 1.5, "", "", ("arm_left_7_link", "leg_left_3_link"), True
    )
    assert keep_apart(search.problem, search.model, capsules, near, q)
    search.renew()
    from mcplan.wb.solve import _Found

    found = _Found()
    search.solve(found, search.start("follow"), 60, np.inf)
    assert found.last.status == mp.Status.solved and found.last.penalty < 0.1
    moved, still = search.motion(found.last.x), solved().motion
    apart = [_distance(search, motion, capsules, "arm_left_7_link", "leg_left_3_link") for motion in (moved, still)]
    assert apart[0] >= apart[1] + 0.029
    assert moved.check().of("torque").value <= 1.0


def _distance(search: _Search, motion: mp.wb.Motion, capsules: dict, first: str, second: str) -> float:
    from mcplan.wb.capsules import _apart

    return _apart(search.model, motion.sample([1.5]).q[0], capsules[first], capsules[second])


def test_capsules_contain_their_links():
    import pinocchio as pin

    from mcplan.wb.capsules import _points

    search = _Search.of(MovingRobot.of(talos_steps(), "all"), 0.1)
    capsules, path = link_capsules(search.model), search.model.complete.path
    from mcplan.files.urdf_reading import package_folders

    model = search.model.complete.model
    shapes = pin.buildGeomFromUrdf(model, str(path), pin.GeometryType.COLLISION, None, package_folders(path))
    assert len(capsules) >= 40
    for shape in shapes.geometryObjects:
        own = capsules[shape.name.rpartition("_")[0]]
        points = _points(shape.geometry) @ shape.placement.rotation.T + shape.placement.translation
        along = own.end - own.start
        part = np.clip((points - own.start) @ along / max(along @ along, 1e-12), 0.0, 1.0)
        off = np.linalg.norm(points - own.start - part[:, None] * along, axis=1)
        assert off.max() <= own.radius + 1e-5, shape.name
        assert off.max() >= own.radius - 1e-3, shape.name


def test_a_finer_motion_leaves_less_on_the_base():
    from mcplan.wb.between_nodes import balanced

    motion = solved().motion
    coarse = replace(motion, corner_forces_S=motion.corner_forces_S)
    finer = balanced(coarse, 0.002)
    times = np.linspace(0.0, motion.duration(), 700)
    worst = [np.abs(one.sample(times).base_residual_B).max() for one in (coarse, finer)]
    assert worst[1] < 0.5 * worst[0]


def test_forces_that_do_not_balance_between_nodes_get_finer_ones():
    """The G1 on stairs of 0.62 of their size: with nodes 25 ms apart 0.1 N cannot be corrected while a foot is unloaded."""
    plan = mp.plan(scaled(mp.load_scene("stairs"), 0.62), "g1", phases=18, polish="penalty").plan
    result = mp.motion(plan)
    assert str(result.status) == "solved", str(result.report)
    assert result.iterations <= 40  # of both searches
