"""mcplan motion, and what check and show do with its files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("scipy.optimize")

import mcplan as mp  # noqa: E402
from command_line import one_line_error  # noqa: E402
from mcplan.cli import main  # noqa: E402
from mcplan.wb import Motion  # noqa: E402
from motions_by_hand import Talos, changed, plan_for, swaying_motion  # noqa: E402

KEYS = {
    *("status", "time_s", "iterations", "base_residual_N", "base_residual_Nm", "drift_m", "torque_use", "velocity_use"),
    *("self_distance_m", "clearance_m", "com_rms_m", "worst"),
}


def run(capsys, *words) -> tuple[int, str, str]:
    return main([str(word) for word in words]), *capsys.readouterr()


@pytest.fixture(scope="module")
def talos() -> Talos:
    return Talos()


@pytest.fixture(scope="module")
def swaying(talos: Talos) -> Motion:
    return swaying_motion(talos, duration_s=0.5, size_m=0.002)


@pytest.fixture(scope="module")
def standing_plan(talos: Talos, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("standing") / "plan.npz"
    plan_for(talos, [(0.5, [0, 1])]).save(path)
    return path


def test_check_prints_a_row_for_each_constraint_and_fails_on_a_violation(swaying, capsys, tmp_path):
    swaying.save(tmp_path / "right.npz")
    code, out, _ = run(capsys, "check", tmp_path / "right.npz")
    assert code == 0
    assert "right.npz: ok. Closest to its limit: " in out
    rows = {line.split()[0]: line for line in out.partition("constraint ")[2].splitlines()[1:]}
    assert set(rows) == {constraint.name for constraint in swaying.check().constraints}
    assert not any("VIOLATED" in row for row in rows.values())
    wrong = changed(swaying, corner_forces_S=1.01 * swaying.corner_forces_S)
    wrong.save(tmp_path / "wrong.npz")
    code, out, _ = run(capsys, "check", tmp_path / "wrong.npz")
    assert code == 1
    assert "1 constraint violated" in out and "residual_force" in out and "VIOLATED" in out
    code, out, _ = run(capsys, "check", tmp_path / "wrong.npz", "--json")
    found = json.loads(out)
    assert code == 1 and not found["ok"] and [v["name"] for v in found["violations"]] == ["residual_force"]
    assert found["robot"] == "talos" and found["samples"] == 501


def test_options_of_plans_are_refused_with_motions(swaying, capsys, tmp_path):
    swaying.save(tmp_path / "motion.npz")
    for words in (("--certify",), ("--self-collision",), ("--robot", "talos")):
        message = one_line_error(run(capsys, "check", tmp_path / "motion.npz", *words))
        assert message == f"{words[0]}: needs a plan; of a motion all that is known is checked"
    message = one_line_error(run(capsys, "motion", tmp_path / "motion.npz"))
    assert message.endswith("must be a plan, got a motion along one, which mcplan motion or mcplan plan --motion saved")


def test_a_motion_is_found_written_and_said(standing_plan, capsys, tmp_path):
    """A robot that stands still: what the JSON says is what the certificate says of the file."""
    output = tmp_path / "motion.npz"
    code, out, _ = run(capsys, "motion", standing_plan, "-o", output, "--joints", "legs", "--json")
    found = json.loads(out)
    assert set(found) >= KEYS and found["robot"] == "talos"
    assert set(found["worst"]) == {"name", "joint", "time", "factor"}
    motion = Motion.load(output)
    assert found["joints"] == list(motion.joints) and all("leg" in name for name in motion.joints)
    check = motion.check()
    assert (code == 0) == (found["status"] == "solved")
    assert found["certified"] == check.ok()
    for name in ("base_residual_N", "drift_m", "torque_use", "self_distance_m", "com_rms_m"):
        assert found[name] == pytest.approx(check.measures[name], abs=1e-12)


def test_a_solve_that_stops_early_says_so_and_saves_what_there_is(standing_plan, capsys, tmp_path):
    output = tmp_path / "motion.npz"
    code, out, _ = run(capsys, "motion", standing_plan, "-o", output, "--max-iterations", "0", "--joints", "legs")
    assert code == 1 and "not_converged after" in out
    assert Motion.load(output).duration() == pytest.approx(0.5)
    assert f"Saved {output}" in out


def test_ctrl_c_during_the_certificate_saves_the_motion(standing_plan, capsys, tmp_path, monkeypatch):
    """Also that of a motion that did not converge, which the command alone asks for."""

    def interrupted(*_):
        raise KeyboardInterrupt

    output = tmp_path / "motion.npz"
    monkeypatch.setattr("mcplan.wb.certificate.certify", interrupted)
    for words in ((), ("--max-iterations", "0")):
        code, out, _ = run(capsys, "motion", standing_plan, "-o", output, "--joints", "legs", *words)
        assert code == 130 and f"Saved {output}" in out
        assert Motion.load(output).duration() == pytest.approx(0.5)
        output.unlink()


def test_plans_too_long_to_be_checked_are_refused_by_what_is_long(standing_plan, swaying, capsys, tmp_path):
    plan = mp.Plan.load(standing_plan)
    phases = plan.phases
    phases[0].duration = 3000.0
    plan.phases = phases
    plan.save(tmp_path / "plan.npz")
    message = one_line_error(run(capsys, "check", tmp_path / "plan.npz"))
    assert "plan.npz: durations: must last at most 2000 s for a check of every millisecond, got 3000" in message
    changed(swaying, plan=plan, times_s=swaying.times_s / swaying.duration() * plan.duration()).save(tmp_path / "m.npz")
    message = one_line_error(run(capsys, "check", tmp_path / "m.npz"))
    assert "m.npz: durations: must last at most 500 s" in message


def test_a_motion_that_had_no_time_is_not_certified(standing_plan, capsys, tmp_path):
    output = tmp_path / "motion.npz"
    code, out, _ = run(
        capsys, "motion", standing_plan, "-o", output, "--time-limit", "0.001", "--node", "0.001", "--json"
    )
    found = json.loads(out)
    assert code == 1 and found["status"] == "time_limit" and found["iterations"] == 0
    assert found["certified"] is False and found["drift_m"] is None and found["cost"] is None
    assert Motion.load(output).duration() == pytest.approx(0.5)


def test_a_robot_without_urdf_is_refused(capsys, tmp_path):
    mp.plan("flat", time_limit=2.0).plan.save(tmp_path / "plan.npz")
    message = one_line_error(run(capsys, "motion", tmp_path / "plan.npz"))
    assert "urdf" in message


def test_mp_check_takes_motions_and_no_scene(swaying):
    assert mp.check(swaying).ok()
    with pytest.raises(mp.errors.InvalidArgument, match="which takes tolerances"):
        mp.check(swaying, scene=swaying.plan.scene)
    tight = mp.wb.MotionTolerances(drift_m=0.0)
    assert {violation.name for violation in mp.check(swaying, tight).violations()} <= {"drift"}
    assert np.isfinite(mp.check(swaying, tight).of("drift").value)


def test_pages_plots_and_pictures_of_a_motion(swaying, capsys, tmp_path):
    pytest.importorskip("meshcat")
    pytest.importorskip("matplotlib")
    swaying.save(tmp_path / "motion.npz")
    page, plots = tmp_path / "page.html", tmp_path / "plots"
    code, _, _ = run(capsys, "show", tmp_path / "motion.npz", "-o", page, "--plots", plots, "-q")
    assert code == 0
    text = page.read_text()
    assert 'id="maps"' in text and "leg left 4" in text and "<title>" in text
    assert {path.name for path in plots.iterdir()} == {
        *("torques.png", "speeds.png", "distances.png", "balance.png", "com.png"),
    }
