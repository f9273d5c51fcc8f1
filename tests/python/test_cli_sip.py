"""mcplan sip and mcplan check --certify: what is printed, files, exit codes, options."""

from __future__ import annotations

import signal

import pytest

import mcplan as mp
from command_line import one_line_error, strict
from mcplan.cli import main
from mcplan.cli.sip_text import Progress, iteration_state
from mcplan.model import PlanarNoClearance, PlanarSurface

FIGURES = {"status", "iterations", "time_s", "evaluation_s", "parameters", "constraints", "cost", "durations_s"}
FIGURES |= {"drift_m", "drift_rad", "worst_violation", "certified"}
BESIDES = {"message", "solver", "linear_solver_s", "cost_terms", "task", "motion", "robot", "version"}
FAST = ("--forces", "uniform", "--minimise", "none")  # 1 s
FASTEST = ("--kinematics", "--order", 5)  # 0.2 s


def run(capsys, *words, verb: str = "sip") -> tuple[int, str, str]:
    code = main([verb, *(str(word) for word in words)])
    out, err = capsys.readouterr()
    return code, out, err


@pytest.fixture(scope="module")
def plan_file(tmp_path_factory):
    """A solved cart wheel with forces of case 1."""
    file = tmp_path_factory.mktemp("sip") / "plan.npz"
    assert main(["sip", "cartwheel", *FAST, "-q", "-o", str(file)]) == 0
    return file


@pytest.fixture
def options_of(monkeypatch):
    """The planner's options that some words on the command line ask for."""

    class Seen(Exception):
        pass

    def parse(*words) -> mp.sip.Options:
        seen = []

        def planner(task, options):
            seen.append(options)
            raise Seen

        monkeypatch.setattr(mp.sip, "Planner", planner)
        with pytest.raises(Seen):
            main(["sip", "cartwheel", *(str(word) for word in words)])
        return seen[0]

    return parse


@pytest.mark.parametrize("solver", ["ipm", "auto"])
def test_the_kernel_solves_where_it_is_asked_for(capsys, solver):
    code, out, _ = run(capsys, "cartwheel", "--minimise", "none", "--solver", solver, "--json")
    found = strict(out)
    assert code == 0 and found["solver"] == "ipm" and found["status"] == "solved"


def test_solvers_that_there_are_not_and_what_the_kernel_has_not_are_refused(capsys):
    code, out, err = run(capsys, "cartwheel", "--solver", "snopt")
    assert code == 2 and out == "" and "--solver: must be one of ipopt, ipm, auto" in err
    code, out, err = run(capsys, "cartwheel", "--solver", "ipm", "--hessian", "limited-memory")
    assert code == 2 and out == "" and "--hessian: must be automatic, exact or gauss_newton" in err


def test_json_holds_every_figure_and_nothing_else_is_printed(capsys, tmp_path):
    file = tmp_path / "plan.npz"
    code, out, err = run(capsys, "cartwheel", *FAST, "--certify", "--json", "-o", file)
    report = strict(out)
    assert (code, err) == (0, "")
    assert set(report) == FIGURES | BESIDES
    assert report["motion"] == report["task"]  # its earlier name
    expected = {"task": "cartwheel", "robot": "climber9", "status": "solved", "parameters": 82, "certified": True}
    assert {name: report[name] for name in expected} == expected and report["version"] == mp.__version__
    assert 0.0 < report["evaluation_s"] + report["linear_solver_s"] < report["time_s"]
    assert set(report["worst_violation"]) == {"name", "phase", "end_effector", "time_s", "value", "tolerance", "unit"}
    plan = mp.PlanarPlan.load(file)
    assert list(plan.durations) == report["durations_s"] and mp.check(plan).ok()
    drift = mp._core.largest_drift(plan)
    assert (report["drift_m"], report["drift_rad"]) == (drift.position_m, drift.angle_rad)


def test_certified_is_null_where_it_was_not_asked_for(capsys):
    code, out, _ = run(capsys, "cartwheel", *FASTEST, "--json")
    report = strict(out)
    assert (code, report["status"], report["certified"], report["cost"]) == (0, "solved", None, 0.0)


def test_the_summary_names_phases_contacts_and_what_is_closest_to_its_limit(capsys):
    code, out, err = run(capsys, "cartwheel", *FASTEST, "--quiet")
    lines = out.splitlines()
    assert (code, err) == (0, "")
    assert lines[0].startswith("cartwheel  climber9  solved in ") and lines[0].endswith("kinematics alone")
    assert "closest to its limit: " in out and ", within tolerance (" in out and "82 parameters, " in out
    head = lines.index("  phase  start [s]  lasts [s]  contacts")
    rows = [line.split(maxsplit=3) for line in lines[head + 1 :]]
    assert [row[3] for row in rows] == ["A on ground, B on ground", "B on ground", "B on ground, C on ground"]


def test_verbose_prints_the_table_of_iterations(capsys):
    code, out, err = run(capsys, "cartwheel", *FASTEST, "--verbose", "--json")
    assert code == 0 and strict(out)["status"] == "solved"
    assert err.splitlines()[0].split()[:2] == ["iter", "cost"] and iteration_state(err.splitlines()[3]) is not None


def test_a_line_follows_the_search(capsys, monkeypatch):
    row = "  12r 1.234567e+02 3.21e-03 4.56e-05  -1.0 7.89e-01     - 1.00e+00 1.00e+00   1"
    assert iteration_state(row) == (12, "3.21e-03", "4.56e-05")
    assert iteration_state("iter      cost      inf_pr   inf_du") is None and iteration_state("") is None
    monkeypatch.setattr("mcplan.cli.sip_text._FILE_S", 0.0)
    progress = Progress("cartwheel", verbose=False)
    progress(mp._core.LogLevel.info, "iter      cost      inf_pr   inf_du")
    progress(mp._core.LogLevel.info, row.replace("12r", " 0 "))
    capsys.readouterr()
    progress(mp._core.LogLevel.info, row)
    progress.end()
    err = capsys.readouterr().err
    assert err.startswith("cartwheel: iteration 1, ")
    assert err.endswith("constraints to 3.21e-03, optimality to 4.56e-05\n")


def test_out_of_time_gives_exit_code_1_and_says_what_is_violated_most(capsys, tmp_path):
    words = ("climbing", "--time-limit", 0.001, "-o", tmp_path / "a.npz")
    code, out, _ = run(capsys, *words)
    assert code == 1 and out.startswith("climbing  climber9  time_limit after ")
    assert "violated most: " in out and " in phase " in out and "t = " in out
    assert out.endswith(f"Saved {tmp_path / 'a.npz'}, with status time_limit\n")
    assert main(["check", str(tmp_path / "a.npz")]) == 1
    capsys.readouterr()
    code, out, _ = run(capsys, *words, "--json")
    report = strict(out)
    assert (code, report["status"], len(report["durations_s"])) == (1, "time_limit", 9)
    assert report["worst_violation"]["value"] > report["worst_violation"]["tolerance"]


@pytest.mark.usefixtures("ctrl_c")
def test_an_interrupt_keeps_what_was_found(capsys, monkeypatch, tmp_path):
    calls = []

    def interrupt(self, level, line):
        calls.append(line)
        if len(calls) == 4:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Progress, "__call__", interrupt)
    code, out, _ = run(capsys, "cartwheel", "-o", tmp_path / "a.npz")
    assert code == 130 and out.startswith("cartwheel  climber9  interrupted after ") and len(calls) < 10
    mp.PlanarPlan.load(tmp_path / "a.npz").validate()


def test_what_is_not_proved_gives_exit_code_1(capsys):
    """In a tube of twice the checker's tolerance the drift is violated, and the certificate says so."""
    code, out, _ = run(capsys, "cartwheel", *FAST, "--tube", 0.004, "--certify", "--json")
    report = strict(out)
    assert (code, report["status"], report["certified"]) == (1, "acceptable", False)
    assert report["worst_violation"]["name"].startswith("drift")


def test_a_motion_is_drawn(capsys, tmp_path, plan_file):
    pytest.importorskip("meshcat")
    pytest.importorskip("matplotlib")
    words = ("--html", tmp_path / "a.html", "--plots", tmp_path / "plots", "--strip", tmp_path / "strip.png")
    code, out, _ = run(capsys, "cartwheel", *FASTEST, "-q", *words)
    assert code == 0 and f"Saved {tmp_path / 'a.html'}, {tmp_path / 'plots'}, {tmp_path / 'strip.png'}" in out
    assert "<html" in (tmp_path / "a.html").read_text().lower()
    assert (tmp_path / "strip.png").read_bytes().startswith(b"\x89PNG")
    assert {"joints", "torques", "forces", "cones"} <= {path.stem for path in (tmp_path / "plots").iterdir()}


def test_case_3_starts_from_case_1(capsys, plan_file):
    code, out, _ = run(capsys, "cartwheel", "--minimise", "none", "--warm-start", plan_file, "--json")
    report = strict(out)
    assert (code, report["status"], report["parameters"]) == (0, "solved", 89)


def test_check_proves_a_plan_on_request(capsys, plan_file):
    code, out, _ = run(capsys, plan_file, verb="check")
    assert code == 0 and "certified" not in out
    code, out, _ = run(capsys, plan_file, "--certify", verb="check")
    assert code == 0 and "certified: every constraint holds at every instant" in out and "friction" in out
    code, out, _ = run(capsys, plan_file, "--certify", "--json", verb="check")
    report = strict(out)
    assert report["certified"] is True
    proofs = {entry["name"]: entry for entry in report["certificate"]["constraints"]}
    assert proofs["torque"]["proof"] == "proved" and proofs["torque"]["bound"] <= proofs["torque"]["tolerance"]
    assert strict(run(capsys, plan_file, "--json", verb="check")[1])["certified"] is None


def test_check_tells_the_depth_of_pairs_of_which_no_clearance_is_asked(capsys, plan_file, tmp_path):
    pairs = {
        (d["end_effector"], d["surface"]): d
        for d in strict(run(capsys, plan_file, "--json", verb="check")[1])["solid_depths"]
    }
    assert pairs.keys() == {("A", "ground"), ("C", "ground")}
    assert all(depth["asked"] and depth["depth_m"] <= 1.5e-3 for depth in pairs.values())
    plan = mp.PlanarPlan.load(plan_file)
    task = plan.task
    step = PlanarSurface(name="step", origin_W=(0.0, 2.0))  # all of it is in there
    task.surfaces = [*task.surfaces, step]
    plan.task = task
    plan.save(tmp_path / "in_step.npz")
    code, out, _ = run(capsys, tmp_path / "in_step.npz", verb="check")
    assert code == 1 and "clearance at A and step" in out and "not asked" not in out
    task.no_clearance = [PlanarNoClearance(end_effector=e, surface=1) for e in range(3)]
    plan.task = task
    plan.save(tmp_path / "let_in.npz")
    code, out, _ = run(capsys, tmp_path / "let_in.npz", verb="check")
    assert code == 0
    assert "not asked: clearance of A and step: depth 2e+03 mm" in out and "not asked: clearance of C and step" in out
    depths = strict(run(capsys, tmp_path / "let_in.npz", "--json", verb="check")[1])["solid_depths"]
    assert {(d["end_effector"], d["surface"]) for d in depths if not d["asked"]} == {("A", "step"), ("C", "step")}


def test_check_refuses_a_plan_with_a_control_point_moved(capsys, plan_file, tmp_path):
    plan = mp.PlanarPlan.load(plan_file)
    points = plan.control_points.copy()
    points[4, 6] += 0.05
    plan.control_points = points
    plan.save(tmp_path / "moved.npz")
    code, out, _ = run(capsys, tmp_path / "moved.npz", "--certify", "--json", verb="check")
    report = strict(out)
    assert (code, report["ok"], report["certified"]) == (1, False, False)
    assert "violated" in {entry["proof"] for entry in report["certificate"]["constraints"]}


def test_whole_body_plans_are_held_against_no_other_robot(capsys, plan_file):
    message = one_line_error(run(capsys, plan_file, "--robot", "talos", verb="check"))
    assert message.startswith("--robot: needs a plan of mcplan plan or rhp")


def test_only_whole_body_plans_are_certified(capsys, tmp_path):
    mp.plan("flat").plan.save(tmp_path / "plan.npz")
    message = one_line_error(run(capsys, tmp_path / "plan.npz", "--certify", verb="check"))
    assert message == "--certify: needs a whole-body plan, as mcplan sip makes them"


def test_every_choice_reaches_the_planner(options_of):
    s = mp.sip
    choices = {
        ("--forces", "forces"): {"per-body": s.Forces.per_body, "per_point": s.Forces.per_point},
        ("--contact", "contact"): {"band": s.ContactMode.band, "strict": s.ContactMode.strict},
        ("--free-flyer", "free_flyer"): {"parameterised": s.FreeFlyer.parameterised},
        ("--continuous", "continuous"): {"extremum": s.Continuous.extremum, "grid": s.Continuous.grid},
        ("--hessian", "hessian"): {
            "gauss-newton": s.HessianChoice.gauss_newton,
            "limited-memory": s.HessianChoice.limited_memory,
        },
    }
    for (word, name), values in choices.items():
        for text, value in values.items():
            assert getattr(options_of(word, text), name) == value, (word, text)
    numbers = {"--order": ("order", 6), "--neq": ("neq", 1), "--max-iterations": ("max_iterations", 7)}
    numbers |= {"--time-limit": ("time_limit_s", 2.5), "--tube": ("tube_m", 1e-4)}
    for word, (name, value) in numbers.items():
        assert getattr(options_of(word, value), name) == value


def test_switches_reach_the_planner(options_of):
    plain = options_of()
    assert plain.free_durations and plain.dynamics and not plain.self_collision
    assert (plain.torque_weight, plain.duration_weight) == (1.0, 0.0)
    assert options_of("--self-collision").self_collision
    assert not options_of("--kinematics").dynamics and not options_of("--kinematics").has_cost()
    assert not options_of("--one-duration").free_durations and not options_of("--minimise", "none").free_durations
    assert options_of("--minimise", "none", "--free-durations").free_durations
    assert options_of("--minimise", "time").duration_weight == 1.0
    assert options_of("--tube", 0.0002).tube_rad == pytest.approx(0.001)
    asked = options_of("--trackable")
    assert (asked.tube_m, asked.tube_rad, asked.min_normal_force) == (2e-5, 1e-4, 5.0)
    assert options_of("--trackable", "--tube", 0.0002).tube_m == 0.0002


WRONG = [
    (("cartweel",), "no planar task 'cartweel' and no file of that name. Did you mean 'cartwheel'?"),
    ((), "TASK: is required"),
    (
        ("cartwheel", "--forces", "most"),
        '--forces: must be one of uniform, per_body, per_point, parameters, got "most"',
    ),
    (("cartwheel", "--minimise", "energy"), '--minimise: must be one of torque, time, none, got "energy"'),
    (("cartwheel", "--contact", "glue"), '--contact: must be one of tube, band, strict, got "glue"'),
    (("cartwheel", "--order", 13), "--order: must lie in [3, 12], got 13"),
    (("cartwheel", "--neq", -1), "--neq: must lie in [0, order], got -1"),
    (("cartwheel", "--free-flyer", "x"), '--free-flyer: must be one of computed, parameterised, got "x"'),
    (("cartwheel", "--continuous", "x"), '--continuous: must be one of hull, extremum, grid, got "x"'),
    (("cartwheel", "--hessian", "x"), "--hessian: must be one of automatic, exact, gauss_newton, limited_memory, got"),
    (("cartwheel", "--max-iterations", 0), "--max-iterations: must lie in [1, 1000000], got 0"),
    (("cartwheel", "--time-limit", -1), "--time-limit: must be a positive number, got -1"),
    (("cartwheel", "--kinematics", "--minimise", "torque"), "--minimise: must be time or none without dynamics"),
    (("cartwheel", "--kinematics", "--certify"), "--certify: needs dynamics"),
    (("cartwheel", "--warm-start", "none.npz"), "none.npz: No such file or directory"),
    (
        ("cartwheel", "-o", "/nowhere/at/all.npz"),
        '--output: must lie in a folder that exists, got "/nowhere/at/all.npz"',
    ),
    (("cartwheel", "--html", "/nowhere/x.html"), '--html: must lie in a folder that exists, got "/nowhere/x.html"'),
    (("cartwheel", "--plots", "/dev/null"), '--plots: must be a folder, or a name for a new one, got "/dev/null"'),
    (("cartwheel", "--strip", "/nowhere/x.png"), '--strip: must lie in a folder that exists, got "/nowhere/x.png"'),
    (("cartwheel", "--strip", "strip.txt"), '--strip: must end in .png, .pdf or .svg, got "strip.txt"'),
]


@pytest.mark.parametrize(("words", "message"), WRONG, ids=lambda v: " ".join(map(str, v)) if type(v) is tuple else "")
def test_wrong_input_gives_one_line_and_exit_code_2(words, message, capsys):
    assert one_line_error(run(capsys, *words)).startswith(message)


def test_all_options_that_are_out_of_range_are_named(capsys):
    code, _, err = run(capsys, "cartwheel", "--tube", 0, "--order", 13)
    assert code == 2 and err == (
        "error: --tube: must be a positive number, got 0\nerror: --order: must lie in [3, 12], got 13\n"
    )


def test_a_warm_start_that_does_not_fit_is_named(capsys, plan_file):
    one_line_error(run(capsys, "climbing", "--warm-start", plan_file, "-q"))
