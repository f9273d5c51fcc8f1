"""The certificate of motions: it accepts what is right by hand, and names what is wrong, where and by how much."""

from __future__ import annotations

import ast
import copy
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan.wb.certificate  # noqa: E402
from mcplan.errors import InvalidArgument, InvalidOptions, PlanViolated  # noqa: E402
from mcplan.wb import Motion  # noqa: E402
from mcplan.wb.certificate import MotionTolerances, MotionViolation, certify  # noqa: E402
from mcplan.wb.nodes import nodes_of as solver_nodes  # noqa: E402
from motions_by_hand import LEFT, RIGHT, Talos, changed, lifting_motion, plan_for, standing_motion, swaying_motion  # noqa: E402

#: Motions by hand move away from their plan, which stands still.
AWAY = MotionTolerances(com_rms_m=0.2, com_max_m=0.2)


@pytest.fixture(scope="module")
def talos() -> Talos:
    return Talos()


@pytest.fixture(scope="module")
def standing(talos: Talos) -> Motion:
    return standing_motion(talos)


@pytest.fixture(scope="module")
def swaying(talos: Talos) -> Motion:
    return swaying_motion(talos)


@pytest.fixture(scope="module")
def lifting(talos: Talos) -> Motion:
    return lifting_motion(talos)


def violated(motion: Motion, tolerances: MotionTolerances = AWAY) -> dict[str, MotionViolation]:
    return {violation.name: violation for violation in certify(motion, tolerances).violations()}


def moved(motion: Motion, joint: str, angle: float) -> Motion:
    """The motion with one joint off by an angle throughout."""
    coefficients = motion.coefficients.copy()
    coefficients[:, 6 + motion.joints.index(joint)] += angle
    return changed(motion, coefficients=coefficients)


def test_what_is_right_by_hand_is_certified(standing: Motion, swaying: Motion) -> None:
    for motion in (standing, swaying):
        result = certify(motion)
        result.raise_if_violated()
        assert str(result) == "ok"
        assert result.worst().factor < 1.0


def test_a_lifted_foot_is_certified_but_for_the_plan_s_com(lifting: Motion) -> None:
    result = certify(lifting, AWAY)
    result.raise_if_violated()
    assert result.of("mid_swing").end_effector == "left_foot"
    assert 0.02 < result.of("mid_swing").value < 0.03
    assert set(violated(lifting, MotionTolerances())) == {"com_rms", "com_max"}


def test_a_swing_that_is_cut_out_of_a_motion_has_the_middle_of_the_whole(talos: Talos, lifting: Motion) -> None:
    whole = certify(lifting, AWAY).of("mid_swing")
    since, begin = 0.3, 1.0
    first = int(np.argmin(np.abs(lifting.times_s - begin - since)))  # nodes are equally far apart
    plan = plan_for(talos, [(0.8 - since, [RIGHT]), (1.0, [RIGHT, LEFT])])
    parts = {
        "times_s": lifting.times_s[first:] - lifting.times_s[first],
        "coefficients": lifting.coefficients[first:],
        "corner_forces_S": lifting.corner_forces_S[first:],
        "contacts": lifting.contacts[first:],
    }
    swings = plan.swings
    swings[0].elapsed_s = since
    plan.swings = swings
    cut = certify(changed(lifting, plan=plan, **parts), AWAY).of("mid_swing")
    assert cut.value == pytest.approx(whole.value, rel=1e-6) and cut.end_effector == whole.end_effector
    assert abs(cut.time_s - 0.4 + since) == pytest.approx(
        abs(whole.time_s - begin - 0.4), abs=1.5e-3
    )  # as low on both sides

    nodes, rest = solver_nodes(lifting.plan, 0.1), solver_nodes(plan, 0.1)
    middle = {round(float(t) - begin - since, 6): nodes.middle(k, LEFT) for k, t in enumerate(nodes.times_s)}
    assert [rest.middle(k, LEFT) for k in range(5)] == pytest.approx([middle[round(0.1 * k, 6)] for k in range(5)])
    assert rest.middle(1, LEFT) == pytest.approx(1.0)


def test_what_stands_is_as_statics_say(standing: Motion, talos: Talos) -> None:
    """Normal forces bear the weight, and no torque is more than the weight times the largest lever."""
    weight = 9.8 * sum(inertia.mass for inertia in talos.model.inertias)
    np.testing.assert_allclose(standing.corner_forces_S[0, ..., 2].sum(), weight, rtol=1e-9)
    assert certify(standing).measures["base_residual_N"] < 1e-6


def test_a_wrench_times_1_01_is_seen(swaying: Motion) -> None:
    found = violated(changed(swaying, corner_forces_S=1.01 * swaying.corner_forces_S))
    largest = np.linalg.norm(swaying.corner_forces_S.sum(axis=(1, 2)), axis=1).max()
    assert found["residual_force"].value == pytest.approx(0.01 * largest, rel=1e-3)
    assert set(found) == {"residual_force"}


def test_forces_that_are_corrected_balance(swaying: Motion) -> None:
    measures = certify(changed(swaying, corner_forces_S=1.01 * swaying.corner_forces_S), AWAY).measures
    assert measures["corrected_residual_N"] < 1e-6
    assert measures["corrected_residual_Nm"] < 1e-6
    assert 0.5 < measures["correction_N"] < 20.0


@pytest.mark.parametrize("joint", ["leg_left_2_joint", "leg_right_4_joint", "leg_left_6_joint"])
def test_one_joint_off_by_a_milliradian_is_seen(swaying: Motion, joint: str) -> None:
    found = violated(moved(swaying, joint, 1e-3))
    assert {"drift", "drift_angle"} & set(found)
    found.pop("unbalanced", None)  # where what is missing on the base is no more than it may be
    assert all(violation.end_effector == f"{joint[4:].split('_')[0]}_foot" for violation in found.values())


@pytest.mark.parametrize("joint", ["torso_1_joint", "torso_2_joint"])
def test_one_joint_of_the_trunk_off_by_a_milliradian_is_seen(swaying: Motion, joint: str) -> None:
    """No sole moves, and less than a newton is missing: but at no node do the forces balance any more."""
    assert certify(swaying).of("unbalanced").value == 0.0
    found = violated(moved(swaying, joint, 1e-3))
    assert set(found) == {"unbalanced"}
    assert found["unbalanced"].value == pytest.approx(swaying.duration())
    assert found["unbalanced"].time_s == 0.0


def test_nodes_that_do_not_balance_for_a_moment_are_no_violation(swaying: Motion) -> None:
    forces, step = swaying.corner_forces_S.copy(), swaying.times_s[1] - swaying.times_s[0]
    forces[10:14] *= 1.0001
    seen = certify(changed(swaying, corner_forces_S=forces)).of("unbalanced")
    assert seen.value == pytest.approx(4.0 * step) and not seen.violated
    assert seen.time_s == swaying.times_s[10]
    forces[20::2] *= 1.0001  # with nodes between them that balance
    assert set(violated(changed(swaying, corner_forces_S=forces))) == {"unbalanced"}


def test_a_foothold_off_by_two_millimetres_is_seen(standing: Motion) -> None:
    plan = copy.deepcopy(standing.plan)
    for knot in plan.knots:
        ends_W = knot.end_effectors_W.copy()
        ends_W[LEFT, 0] += 2e-3
        knot.end_effectors_W = ends_W
    found = violated(changed(standing, plan=plan))
    assert found["drift"].end_effector == "left_foot"
    assert found["drift"].value == pytest.approx(2e-3, rel=1e-6)


def test_a_slip_at_a_later_knot_is_seen(standing: Motion, talos: Talos) -> None:
    whole = standing.duration()
    plan = plan_for(talos, [(0.4 * whole, [RIGHT, LEFT]), (0.6 * whole, [RIGHT, LEFT])])
    again = changed(standing, plan=plan, times_s=standing.times_s * plan.duration() / whole)
    assert "drift" not in violated(again)
    knots = plan.knots
    ends_W = knots[1].end_effectors_W.copy()
    ends_W[LEFT, :2] += [2e-3, 1e-3]
    knots[1].end_effectors_W = ends_W
    plan.knots = knots
    found = violated(changed(again, plan=plan))["drift"]
    assert found.value == pytest.approx(np.hypot(2e-3, 1e-3)) and found.end_effector == "left_foot"
    assert found.time_s == pytest.approx(0.4 * whole)


@pytest.mark.parametrize("height", [2e-3, -0.02, 0.1])
def test_a_surface_that_is_not_under_the_soles_is_seen(standing: Motion, height: float) -> None:
    plan = copy.deepcopy(standing.plan)
    scene = plan.scene
    surfaces = scene.surfaces
    surfaces[0].vertices_W = np.asarray(surfaces[0].vertices_W) + [0.0, 0.0, height]
    scene.surfaces = surfaces
    plan.scene = scene
    found = violated(changed(standing, plan=plan))
    assert found["contact_distance"].value == pytest.approx(abs(height), abs=1e-6)
    assert found["contact_distance"].end_effector in ("left_foot", "right_foot")
    plan.measured_start = True  # what stands where it was measured does not move
    assert "contact_distance" not in violated(changed(standing, plan=plan))


def test_a_surface_for_hands_under_feet_is_seen(standing: Motion) -> None:
    plan = copy.deepcopy(standing.plan)
    scene = plan.scene
    surfaces = scene.surfaces
    surfaces[0].end_effectors = ["hand"]
    scene.surfaces = surfaces
    plan.scene = scene
    found = violated(changed(standing, plan=plan))
    assert set(found) == {"contact_permission"}
    assert found["contact_permission"].value == 1.0
    assert found["contact_permission"].end_effector in ("left_foot", "right_foot")


def test_a_locked_joint_beyond_its_limits_is_seen(standing: Motion, talos: Talos) -> None:
    model, name = talos.model, "arm_left_4_joint"
    low = float(model.lowerPositionLimit[model.idx_qs[model.getJointId(name)]])
    found = violated(changed(standing, locked={**standing.locked, name: low - 0.02}))
    assert found["position"].joint == name
    assert found["position"].value == pytest.approx(0.02)


def test_a_lower_torque_limit_is_seen(swaying: Motion) -> None:
    use = certify(swaying).of("torque")
    assert use.joint.startswith("leg_")
    found = violated(swaying, replace(AWAY, torque_use=0.9 * use.value))
    assert set(found) == {"torque"}
    assert found["torque"] == replace(use, limit=0.9 * use.value)


def test_a_lower_limit_in_the_urdf_is_seen(tmp_path: Path, standing: Motion, talos: Talos) -> None:
    text = re.sub(r"<(visual|collision)>.*?</\1>", "", talos.urdf_path.read_text(), flags=re.DOTALL)
    joint = text.index('joint name="leg_left_4_joint"')
    start = text.index('effort="', joint) + len('effort="')
    end = text.index('"', start)
    lowered = 0.5 * float(text[start:end]) * certify(standing).of("torque").value
    (tmp_path / "weak.urdf").write_text(f"{text[:start]}{lowered}{text[end:]}")
    found = violated(changed(standing, urdf=str(tmp_path / "weak.urdf")))
    assert found["torque"].joint == "leg_left_4_joint"
    assert found["torque"].value > 1.0


def test_a_force_beyond_what_the_foot_may_take_is_seen(standing: Motion) -> None:
    plan = copy.deepcopy(standing.plan)
    robot = plan.robot
    ends = robot.end_effectors
    largest = float(np.linalg.norm(standing.corner_forces_S.sum(axis=2), axis=2)[:, RIGHT].max())
    ends[RIGHT].max_force = 0.9 * largest
    robot.end_effectors = ends
    plan.robot = robot
    found = violated(changed(standing, plan=plan))
    assert set(found) == {"force_cap"}
    assert found["force_cap"].value == pytest.approx(1.0 / 0.9) and found["force_cap"].end_effector == "right_foot"


def test_a_larger_distance_of_links_is_asked_of_the_same_links(standing: Motion) -> None:
    least = certify(standing).of("self_distance")
    found = violated(standing, replace(AWAY, self_distance_m=least.value + 0.01))["self_distance"]
    assert found.value == pytest.approx(least.value, abs=1e-3) and set(found.links) == set(least.links)


def test_a_plan_that_its_own_check_rejects_is_noted(standing: Motion) -> None:
    (note,) = certify(standing).notes  # the contact model of its plan asks for moments that no foot gives
    assert note.startswith("the plan that the motion carries out does not keep all of its own constraints: moment at ")
    plan = copy.deepcopy(standing.plan)
    scene = plan.scene
    scene.start.contacts = {"right_foot": "nowhere"}
    plan.scene = scene
    assert "cannot be checked: " in certify(changed(standing, plan=plan)).notes[0]


def test_a_corner_force_outside_its_cone_is_seen(standing: Motion) -> None:
    forces = standing.corner_forces_S.copy()
    forces[10, RIGHT, 0] = [60.0, 0.0, 70.0]
    friction = standing.plan.scene.surfaces[0].friction
    found = violated(changed(standing, corner_forces_S=forces))
    assert found["friction"].end_effector == "right_foot"
    assert found["friction"].value == pytest.approx(60.0 - friction * 70.0, rel=0.1)
    forces[10, RIGHT, 0] = [0.0, 0.0, -5.0]
    assert violated(changed(standing, corner_forces_S=forces))["pull"].value == pytest.approx(5.0, rel=0.2)


def test_forces_of_free_feet_and_other_contacts_are_seen(lifting: Motion) -> None:
    forces = lifting.corner_forces_S.copy()
    forces[len(forces) // 2, LEFT, 0, 2] = 1.0
    found = violated(changed(lifting, corner_forces_S=forces))
    assert found["free_force"].end_effector == "left_foot"
    contacts = lifting.contacts.copy()
    contacts[len(contacts) // 2, LEFT] = 0
    found = violated(changed(lifting, contacts=contacts))
    assert found["contacts"].value == pytest.approx(np.diff(lifting.times_s)[len(contacts) // 2])


def test_a_corner_outside_of_the_sole_is_seen(standing: Motion) -> None:
    points = standing.corner_points_S.copy()
    points[RIGHT] *= 1.2
    assert violated(changed(standing, corner_points_S=points))["center_of_pressure"].value == pytest.approx(0.008)


def test_limits_of_position_and_speed_are_seen(swaying: Motion, talos: Talos) -> None:
    model = talos.model
    joint = model.getJointId("torso_1_joint")
    found = violated(moved(swaying, "torso_1_joint", model.upperPositionLimit[model.idx_qs[joint]] + 0.01))
    assert found["position"].joint == "torso_1_joint"
    assert found["position"].value == pytest.approx(0.01)
    coefficients = swaying.coefficients.copy()
    at = 6 + swaying.joints.index("torso_1_joint")
    coefficients[:, at] += 0.2 * np.sin(60.0 * np.linspace(0.0, swaying.duration(), len(coefficients)))
    found = violated(changed(swaying, coefficients=coefficients))
    assert found["velocity"].joint == "torso_1_joint"
    assert found["velocity"].value > 1.0


def test_a_sole_in_the_ground_or_too_low_is_seen(talos: Talos, lifting: Motion) -> None:
    low = lifting_motion(talos, lift_m=0.005)
    assert set(violated(low)) == {"mid_swing"}
    deep = lifting_motion(talos, lift_m=-0.005)
    found = violated(deep)
    assert found["clearance"].value == pytest.approx(0.005, rel=0.01)
    assert found["clearance"].end_effector == "left_foot"


def test_steps_of_torque_are_seen(standing: Motion) -> None:
    forces = standing.corner_forces_S.copy()
    forces[20:, RIGHT] *= 1.5
    found = violated(changed(standing, corner_forces_S=forces))
    limit = certify(standing).of("torque_step")
    assert "torque_step" in found or limit.value < 0.05
    steep = changed(
        standing, corner_forces_S=np.where(np.arange(len(forces))[:, None, None, None] % 2, 3.0, 0.5) * forces
    )
    assert violated(steep)["torque_step"].joint.startswith("leg_")


def test_motions_that_start_or_end_in_motion_are_seen(standing: Motion) -> None:
    coefficients = standing.coefficients.copy()
    coefficients[:2, 6 + standing.joints.index("torso_1_joint")] += 1e-3
    assert violated(changed(standing, coefficients=coefficients))["rest"].time_s == 0.0


def test_a_state_that_the_motion_says_wrongly_is_seen(standing: Motion) -> None:
    class Wrong(Motion):
        def sample(self, times: object) -> object:
            samples = super().sample(times)
            return replace(samples, tau=samples.tau * (1.0 + 1e-6))

    assert violated(Wrong(**standing.__getstate__()))["consistency"].value == pytest.approx(1e-6, rel=1e-3)


def test_violations_are_errors_that_say_where_and_how_much(swaying: Motion) -> None:
    result = certify(changed(swaying, corner_forces_S=1.01 * swaying.corner_forces_S), AWAY)
    with pytest.raises(PlanViolated, match=r"residual_force, t = .* s: violated: 9.* N \(at most 1 N\)"):
        result.raise_if_violated()
    assert result.as_dict()["violations"][0]["name"] == "residual_force"
    with pytest.raises(InvalidOptions, match="drift_m: must be at least 0, got -1.0"):
        certify(swaying, MotionTolerances(drift_m=-1.0))
    for wrong in (10**400, True, "a", float("inf")):
        with pytest.raises(InvalidOptions, match="drift_m: must be a number, got"):
            certify(swaying, MotionTolerances(drift_m=wrong))
    with pytest.raises(InvalidOptions, match=r"sample_s: must lie in \[1e-05, 0.01\] s, got 100"):
        certify(swaying, MotionTolerances(sample_s=100.0))
    certify(swaying, MotionTolerances(drift_m=np.float32(1e-3), sample_s=0.01))
    for other in (5, {}, False):
        with pytest.raises(InvalidArgument, match="tolerances: must be a MotionTolerances or None, got"):
            certify(swaying, other)


def test_the_certificate_sees_no_solver() -> None:
    """Of mcplan it imports the loaders of robots and what is below them, and of `wb` nothing but itself."""
    folder = Path(mcplan.wb.certificate.__file__).parent
    allowed = ("mcplan._core", "mcplan.errors", "mcplan.extras", "mcplan.files.", "mcplan.kinematics.urdf_model")
    for path in folder.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.ImportFrom):
                assert node.level <= 1, path
                assert node.level or not (node.module or "").startswith("mcplan") or node.module.startswith(allowed), (
                    path
                )
            elif isinstance(node, ast.Import):
                assert not any(alias.name.startswith("mcplan") for alias in node.names), path
