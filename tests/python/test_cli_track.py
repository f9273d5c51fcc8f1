"""mcplan track: measures in words and JSON, files, exit codes, one-line errors, Ctrl-C."""

from __future__ import annotations

import signal
from dataclasses import fields, replace

import pytest

import mcplan as mp
import tracked_cartwheel
from command_line import one_line_error, strict
from mcplan.cli import main
from mcplan.cli.pushes import FIELDS
from mcplan.cli.track_text import Progress
from mcplan.planar.tracking import PlanarMeasures
from mcplan.planar.tracking.measures import EARLIER
from mcplan.tracking import Measures, Recording, TrackingResult
from reference_solutions import reference_plan
from standing import standing_plan

for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
    pytest.importorskip(name)

BESIDES = {"plan", "scene", "robot", "duration_s", "torque_joint", "interrupted", "feasible", "verdict"}
BESIDES |= {"velocity_joint", "velocity_at_s", "touches"}
BESIDES |= {"options", "version", "followed"}


def run(capsys, *words) -> tuple[int, str, str]:
    code = main(["track", *(str(word) for word in words)])
    out, err = capsys.readouterr()
    return code, out, err


def keys(measures: type) -> set[str]:
    return {item.name for item in fields(measures)}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """Talos stands for 0.6 s, the feet right below its CoM."""
    robot = mp.load_robot("talos")
    for end in robot.end_effectors:
        if end.kind == "foot":
            end.nominal_B[0] = 0.0
    path = tmp_path_factory.mktemp("track") / "plan.npz"
    standing_plan(phases=2, duration_s=0.3, robot=robot).save(path)
    return path


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    path = tmp_path_factory.mktemp("track") / "wheel.npz"
    tracked_cartwheel.cartwheel().save(path)
    return path


def test_standing_is_told_in_words_and_code_0(capsys, file):
    code, out, err = run(capsys, file, "--quiet")  # a slow machine is told how far it is
    lines = out.splitlines()
    assert (code, err) == (0, "")
    assert lines[0] == "flat  talos  followed to the end: 1.60 s without a fall (plan of 0.60 s, unassisted)"
    names = [line[2:27].strip() for line in lines[1:]]
    assert [name for name in names if name != "torques that jump"] == [
        "CoM off the plan",
        "orientation off the plan",
        "swinging end-effectors",
        "slip in contact",
        "base at the end",
        "largest torque",
        "fastest joint",
        "contacts of links",
        "assistance",
        "controller",
        "simulator",
    ]
    told = dict(zip(names, lines[1:], strict=True))
    assert told["assistance"].endswith("none") and told["contacts of links"].endswith("none, but for end-effectors")
    assert "every step solved" in told["controller"] and "no warnings" in told["simulator"]
    assert " % of the speed limit of " in told["fastest joint"]


def test_json_holds_every_measure_and_what_was_drawn_from_the_seed(capsys, file):
    code, out, err = run(capsys, file, "--seed", 4, "--json")
    data = strict(out)
    assert (code, err) == (0, "")
    assert set(data) == keys(Measures) | BESIDES
    assert (data["plan"], data["scene"], data["robot"], data["fell"]) == (str(file), "flat", "talos", False)
    assert (data["feasible"], data["interrupted"], data["version"]) == (True, False, mp.__version__)
    assert data["assist_force_rms_N"] == data["assist_moment_rms_Nm"] == 0.0
    assert 0.0 < data["velocity_use"] < 1.0 and data["velocity_joint"] and data["touches"] == []
    used = data["options"]
    assert used["seed"] == 4 and len(used["pushes"]) == 1
    assert 0.9 <= used["mass_scale"] <= 1.1 and used["mass_scale"] != 1.0
    assert used["torque_delay_s"] > 0.0 and used["torque_bandwidth_hz"] >= 50.0 and used["sensor_noise"] > 0.0
    assert 0.8 <= used["friction_scale"] <= 1.2 and 0.0 < abs(used["ground_shift_m"]) <= 0.01


def test_a_hard_push_is_a_fall_with_code_1_and_a_run_to_look_at(capsys, file, tmp_path):
    saved = tmp_path / "run.npz"
    code, out, err = run(capsys, file, "--push", "700,0.4,0.1,90", "--no-check", "--quiet", "--save", saved)
    assert (code, err) == (1, "")
    lines = out.splitlines()
    assert lines[0].startswith("flat  talos  fell after ")
    assert "  not told to the controller  push of 700 N for 0.4 s at 0.10 s to the left" in lines
    assert lines[-1] == f"Saved {saved}" and "base at the end" not in out
    recording = Recording.load(saved)
    assert recording.fell_at_s == recording.times_s[-1] < 1.6
    assert recording.pushes_W[:, 1].max() == pytest.approx(700.0)
    assert TrackingResult.load(saved).measures.fell


def test_assistance_is_reported(capsys, file):
    code, out, _ = run(capsys, file, "--assist", "--mass-scale", 1.1, "--no-check", "--json")
    data = strict(out)
    assert code == 0 and data["feasible"] is None and data["verdict"] is None
    # A tenth of the weight that the controller does not know of; feet and wrench share it.
    assert 5.0 < data["assist_force_rms_N"] < 0.35 * 90.3 * 9.81
    assert data["options"]["assist"] is True and data["options"]["mass_scale"] == 1.1


def test_pictures_are_written(capsys, file, tmp_path):
    pytest.importorskip("matplotlib")
    pytest.importorskip("meshcat")
    code, out, _ = run(capsys, file, "--no-check", "--html", tmp_path / "run.html", "--plots", tmp_path / "plots")
    assert code == 0 and out.splitlines()[-1] == f"Saved {tmp_path / 'plots'}, {tmp_path / 'run.html'}"
    assert (tmp_path / "run.html").stat().st_size > 1e6
    assert {path.name for path in (tmp_path / "plots").iterdir()} == {
        "com.png",
        "errors.png",
        "forces.png",
        "momentum.png",
        "torques.png",
    }


def test_whole_body_plans_have_their_measures_under_the_same_keys(capsys, wheel):
    code, out, _ = run(capsys, wheel, "--json")
    data = strict(out)
    assert code == 0
    assert set(data) == keys(Measures) | keys(PlanarMeasures) | set(EARLIER) | BESIDES
    assert (data["fell"], data["completed"], data["com_rms_m"], data["feasible"]) == (False, True, None, True)
    assert (data["scene"], data["robot"]) == ("cartwheel", "climber9")


@pytest.mark.slow
def test_what_the_robot_exceeds_is_warned_of_before_it_is_simulated_all_the_same(capsys, file, tmp_path):
    plan = mp.Plan.load(file)
    plan.robot.mass *= 0.8
    path = tmp_path / "plan.npz"
    plan.save(path)
    code, out, err = run(capsys, path)
    assert code == 0 and "followed to the end" in out
    # Below it a slow machine may be told how far the simulation is.
    assert err.count("warning") == 1 and err.startswith(
        "warning: talos cannot follow the plan: mass at 0.00 s: 0.2, limit 0.1"
    )
    assert "warning" not in run(capsys, path, "--no-check")[2]
    assert run(capsys, path, "--quiet")[2] == ""


def test_a_posture_out_of_reach_is_an_error(capsys, file, tmp_path):
    plan = mp.Plan.load(file)
    for knot in plan.knots:
        knot.com_W[2] += 0.3
    path = tmp_path / "plan.npz"
    plan.save(path)
    message = one_line_error(run(capsys, path, "--no-check"))
    assert message.startswith("plan: must be in reach of talos, got ") and message.endswith(" m")


def test_ctrl_c_ends_the_run_and_reports_what_was_there(capsys, file, monkeypatch, ctrl_c):
    def press(self, now_s: float, end_s: float) -> None:
        if now_s > 0.15:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Progress, "simulated", press)
    code, out, err = run(capsys, file, "--no-check")
    assert (code, err) == (130, "")
    assert out.splitlines()[0].startswith("flat  talos  interrupted after 0.20 s, until then without a fall")
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


@pytest.mark.parametrize(
    ("push", "message"),
    [
        ("nonsense", '--push: must be newtons,seconds,at,direction, such as 40,0.2,3,90, got "nonsense"'),
        ("40,0.2,3", '--push: must be newtons,seconds,at,direction, such as 40,0.2,3,90, got "40,0.2,3"'),
        ("x,0.2,0.3,90", '--push: newtons: must be a number, got "x"'),
        ("40,0.2,later,90", '--push: at: must be a number, got "later"'),
        ("40,0,0.3,90", "--push: seconds: must be above 0, got 0"),
        ("40,0.2,0.3,inf", "--push: direction: must be finite, got inf"),
        ("40,0.2,9,90", "--push: at: must lie in the run, from 0 to 1.6 s, got 9"),
    ],
)
def test_malformed_pushes_are_one_line_that_names_the_field(capsys, file, push, message):
    assert one_line_error(run(capsys, file, "--push", push)) == message


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--robot", "tallos"), "no robot 'tallos' and no file of that name. Did you mean 'talos'?"),
        (
            ("--robot", "humanoid44"),
            "this robot has no joints; plan for one that has, such as anymal, g1, go2, talos, talos_wang",
        ),
        (("--robot", "anymal"), "must have the plan's 'right_foot', as g1, talos have, got rf_foot, "),
        (
            ("--robot", "walker9"),
            "walker9 is a planar robot: it comes with its planar tasks, for mcplan sip. Built-in:",
        ),
        (("--mass-scale", "9"), "--mass-scale: must lie in 0.2 to 5, got 9.0"),
        (("--friction", "0"), "--friction: must lie above 0 and at most 10, got 0.0"),
        (("--ground-shift", "1"), "--ground-shift: must lie in -0.2 to 0.2, got 1.0"),
        (("--torque-delay", "1"), "--torque-delay: must lie in 0 to 0.05, got 1.0"),
        (("--torque-bandwidth", "0.5"), "--torque-bandwidth: must lie in 1 to 1000, or be 0, got 0.5"),
        (("--sensor-noise", "-1"), "--sensor-noise: must lie in 0 to 100, got -1.0"),
        (("--seed", "-1"), "--seed: must not be negative, got -1"),
        (("--save", "nowhere/run.npz"), '--save: must lie in a folder that exists, got "nowhere/run.npz"'),
        (("--html", "nowhere/run.html"), '--html: must lie in a folder that exists, got "nowhere/run.html"'),
        (("--video", "nowhere/run.webp"), '--video: must lie in a folder that exists, got "nowhere/run.webp"'),
        (("--video", "run.avi"), '--video: must end in .mp4, .webp or .gif, got "run.avi"'),
        (("--strip", "run.pdf"), '--strip: must end in .png, got "run.pdf"'),
        (("--save", "."), '--save: must be a file, got "."'),
        (("--plots", "/proc/plots"), '--plots: must lie in a folder that can be written to, got "/proc/plots" ('),
    ],
)
def test_what_cannot_be_done_is_said_before_simulating(capsys, file, monkeypatch, words, message):
    monkeypatch.setattr("mcplan.tracking.runner._run", lambda *_: pytest.fail("it simulates"))
    assert message in one_line_error(run(capsys, file, *words))


@pytest.mark.parametrize("words", [("--robot", "talos"), ("--assist",), ("--push", "40,0.2,0.3,90"), ("--seed", "3")])
def test_planar_robots_refuse_what_they_have_not(capsys, wheel, words):
    assert one_line_error(run(capsys, wheel, *words)).startswith(
        f"{words[0]}: needs a plan of mcplan plan or mcplan rhp"
    )


def test_files_that_are_no_plans_are_one_line(capsys, file, tmp_path):
    assert one_line_error(run(capsys, tmp_path / "none.npz")) == f"{tmp_path / 'none.npz'}: No such file or directory"
    text = tmp_path / "text.npz"
    text.write_text("no plan")
    assert one_line_error(run(capsys, text)).startswith(f"{text}: must be an .npz or .json file written by mcplan")
    saved = tmp_path / "run.npz"
    tracked_cartwheel.tracked().save(saved)
    told = one_line_error(run(capsys, saved))
    rule = f"{saved}: must be a plan, got a run of one, which mcplan track or mcplan run saved"
    assert told == rule
    for words, lead in ((["motion"], ""), (["rhp", "flat", "--sequence"], "--sequence ")):
        assert one_line_error((main([*words, str(saved)]), *capsys.readouterr())) == lead + rule


def test_missing_packages_are_one_line(capsys, file, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    message = "mcplan track needs mujoco, pinocchio, proxsuite: pip install 'mcplan[sim]'"
    assert one_line_error(run(capsys, file)) == message
    with pytest.raises(mp.errors.MissingExtra, match="mcplan.track needs mujoco"):
        mp.track(file)


@pytest.fixture(scope="module")
def plain_wheel(tmp_path_factory):
    """A cartwheel as mcplan sip plans it by default: not made to be tracked."""
    path = tmp_path_factory.mktemp("track") / "plain.npz"
    reference_plan("cartwheel", "optimised_per_point").save(path)
    return path


def test_a_plan_not_made_to_be_tracked_is_said_to_be_so_and_other_forces_are_no_success(capsys, plain_wheel):
    code, out, err = run(capsys, plain_wheel)
    assert code == 1
    assert "warning: the plan was not made to be tracked: its contacts move by up to 1.7 mm" in err
    assert "plan it by mcplan sip --trackable" in err and "to be followed" in out
    assert "moved as planned to the end, 2.84 s, by other contact forces" in out.splitlines()[0]
    code, out, err = run(capsys, plain_wheel, "--json")
    data = strict(out)
    assert (code, err) == (1, "")
    assert (data["completed"], data["followed"], data["feasible"]) == (True, False, False)
    assert data["force_rms"] > 0.3 and "--trackable" in data["verdict"]


def test_a_plan_made_to_be_tracked_gets_no_warning(capsys, wheel):
    code, out, err = run(capsys, wheel)
    assert code == 0 and "warning" not in err and "to be followed" not in out


def test_forces_off_by_more_than_a_quarter_are_other_forces(capsys, wheel, monkeypatch):
    result = tracked_cartwheel.tracked()
    for share, code in ((0.24, 0), (0.26, 1)):
        told = replace(result, measures=replace(result.measures, force_rms=share))
        monkeypatch.setattr("mcplan.following.track_any", lambda *_, told=told: told)
        assert run(capsys, wheel)[0] == code


def test_the_line_of_a_video_says_how_long_it_still_takes(capsys, monkeypatch):
    now_s = iter([0.0, 10.0, 10.0, 40.0, 40.0])
    monkeypatch.setattr("mcplan.cli.track_text.time.monotonic", lambda: next(now_s))
    progress = Progress(silent=False)
    progress.drawn(1, 101)
    progress.drawn(11, 101)  # 3 s a picture, and 90 are left
    assert capsys.readouterr().err == "video: picture 1 of 101\nvideo: picture 11 of 101, 270 s left\n"


def test_help_and_errors_show_a_push_in_one_form(capsys):
    form = ",".join(FIELDS)
    assert form in run(capsys, "--help")[1] and form in one_line_error(run(capsys, "none.npz", "--push", "3"))
