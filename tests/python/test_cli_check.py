"""mcplan check --robot: table, JSON, exit codes, one-line errors; mcplan robots --strength."""

from __future__ import annotations

import pytest

import mcplan as mp
from command_line import one_line_error, strict
from mcplan.cli import main
from standing import standing_plan
from wrenches import standing_wrenches

pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")


def run(capsys, *words) -> tuple[int, str, str]:
    code = main([str(word) for word in words])
    out, err = capsys.readouterr()
    return code, out, err


@pytest.fixture
def file(tmp_path):
    """The feet are right below the CoM: at rest for good."""
    robot = mp.load_robot("talos")
    for end in robot.end_effectors:
        if end.kind == "foot":
            end.nominal_B[0] = 0.0
    path = tmp_path / "plan.npz"
    standing_plan(robot=robot).save(path)
    return path


def test_a_plan_that_can_be_followed_has_a_table_and_code_0(capsys, file):
    code, out, err = run(capsys, "check", file, "--robot", "talos")
    lines = out.splitlines()
    assert code == 0 and err == ""
    assert lines[0].startswith(f"{file}: ok. Closest to its limit: ")
    assert lines[1].startswith("talos can follow the plan; nearest to its limit: ")
    assert lines[2].split() == ["limit", "of", "where", "t", "[s]", "asked", "limit", "unit"]
    first_words = [line.split()[0] for line in lines[3:]]
    assert first_words[:4] == ["reach", "sole", "balance", "torque"] and first_words[-1] == "mass"


def test_a_plan_that_is_too_high_is_said_to_be_so_with_code_1(capsys, tmp_path):
    tall = mp.load_robot("talos")
    tall.com_height += 0.2
    for end in tall.end_effectors:
        if end.kind == "foot":
            end.limb = mp.model.LimbLimits()
            end.nominal_B[2] -= 0.2
            end.reach_min_B[2] -= 0.2
            end.reach_max_B[2] -= 0.2
    standing_plan(robot=tall).save(tmp_path / "tall.npz")
    code, out, _ = run(capsys, "check", tmp_path / "tall.npz", "--robot", "talos")
    assert code == 1
    assert "talos cannot follow the plan: reach of " in out
    marked = [line.split() for line in out.splitlines() if line.startswith("!")]
    assert any(words[1] == "reach" and "leg_left_4_joint," in words for words in marked)
    code, out, _ = run(capsys, "check", tmp_path / "tall.npz", "--robot", "talos", "--json")
    report = strict(out)
    assert code == 1 and report["feasibility"]["ok"] is False and report["robot"] == "talos"
    names = {found["name"] for found in report["feasibility"]["violations"]}
    assert "reach" in names
    keys = {"name", "value", "limit", "unit", "where", "time_s", "note"}
    assert all(set(found) == keys for found in report["feasibility"]["constraints"])


def test_json_without_a_robot_has_no_feasibility(capsys, file):
    code, out, _ = run(capsys, "check", file, "--json")
    assert code == 0 and strict(out)["feasibility"] is None


def test_robots_that_cannot_be_asked_are_one_line(capsys, file, tmp_path):
    assert one_line_error(run(capsys, "check", file, "--robot", "humanoid44")) == (
        "humanoid44: urdf: must name a URDF: this robot has no joints; plan for one that has, such as "
        "anymal, g1, go2, talos, talos_wang"
    )
    assert "no robot 'tallos' and no file of that name. Did you mean 'talos'?" in one_line_error(
        run(capsys, "check", file, "--robot", "tallos")
    )
    message = one_line_error(run(capsys, "check", file, "--robot", "anymal"))
    assert message.startswith(
        "anymal: end_effectors: must have 'right_foot', which the plan puts down, as g1, talos have"
    )


@pytest.mark.slow
def test_strength_is_told_per_hand_and_direction(capsys):
    code, out, _ = run(capsys, "robots", "talos", "--strength")
    assert code == 0
    assert "half the weight is 443 N" in out
    rows = [
        line.split() for line in out.splitlines() if line.startswith(("right_hand", "left_hand")) and "hand " in line
    ]
    pushes = {(row[0], row[1]): [float(x) for x in row[2:6]] for row in rows if row[1] != "hand"}
    assert len(pushes) == 12
    for median, most, part, most_part in pushes.values():
        assert median < most and part == pytest.approx(median / 443.0, abs=0.01)
        assert most_part == pytest.approx(most / 443.0, abs=0.01)
    assert run(capsys, "robots", "talos", "--strength")[1] == out
    assert run(capsys, "robots", "talos", "--strength", "--seed", 1)[1] != out


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--strength",), "--strength: needs the NAME of a robot with a URDF"),
        (("walker9", "--strength"), "--strength: needs the NAME of a robot with a URDF"),
        (("--from-urdf", "talos", "--strength"), "--strength: needs the NAME of a robot with a URDF"),
        (("humanoid44", "--strength"), "humanoid44: urdf: must name a URDF"),
        (("talos_wang", "--strength"), "talos_wang: end_effectors: must have one of kind 'hand'"),
    ],
)
def test_robots_without_arms_are_one_line(capsys, words, message):
    assert one_line_error(run(capsys, "robots", *words)).startswith(message)


def test_loads_of_contact_wrenches_are_said_and_written(capsys, tmp_path):
    """Half of the weight on each foot, and a push of 0.02 m in 0.7 m along x: hypot(0.02, sideways) / 0.7."""
    plan = standing_wrenches()
    path = tmp_path / "plan.npz"
    plan.save(path)
    _, out, _ = run(capsys, "check", path)
    contact, place = plan.phases[0].contacts[0], plan.knots[0].com_W
    arm = place - contact.anchor_W
    friction = (arm[0] ** 2 + arm[1] ** 2) ** 0.5 / arm[2]
    force = 0.5 * (1.0 + friction**2) ** 0.5
    lines = [line.strip() for line in out.splitlines()]
    assert f"friction used (tangential / normal): right_foot {friction:.2f}, left_foot {friction:.2f}" in lines
    assert "angular momentum: 0.00 kg m^2/s at most" in lines
    assert f"largest force in weights: right_foot {force:.2f}, left_foot {force:.2f}" in lines


def test_a_pendulum_has_no_loads_to_be_said(capsys, file):
    _, out, _ = run(capsys, "check", file)
    assert "angular momentum" not in out and "weights" not in out and len(out.splitlines()) == 1


def test_every_constraint_has_a_unit_and_ratios_are_printed_without(capsys, file, tmp_path):
    whole_body = tmp_path / "chimney.npz"
    mp.whole_body("chimney", forces="uniform", minimise="none", max_iterations=1).plan.save(str(whole_body))
    for path, ratios in (
        (file, {"friction", "force_cap", "angular_momentum", "joint_torque", "joint_speed"}),
        (whole_body, {"position", "velocity", "torque"}),
    ):
        found = strict(run(capsys, "check", path, "--json")[1])["constraints"]
        assert all(constraint["unit"] for constraint in found)
        assert {constraint["name"] for constraint in found if constraint["unit"] == "-"} == ratios
    ratio = mp.model.Violation(name="friction", value=0.5, tolerance=0.001, unit="-")
    assert str(ratio) == "friction: 0.5 over the limit (tolerance 0.001)"
