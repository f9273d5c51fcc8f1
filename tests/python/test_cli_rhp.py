"""mcplan rhp: rows on the way, summary, JSON, files, exit codes."""

from __future__ import annotations

import pytest

import mcplan as mp
from command_line import one_line_error, strict
from mcplan.cli import main

PER_CYCLE = {
    "solver",
    "status",
    "iterations",
    "time_s",
    "evaluation_s",
    "linear_solver_s",
    "variables",
    "constraints",
    "cost",
}
PER_CYCLE |= {"index", "message", "executed", "duration_s", "distance_m", "acceleration_cost", "momentum_cost"}
PER_CYCLE |= {"drift_com_m", "drift_momentum", "step_from"}
IN_TOTAL = {"success", "status", "message", "cycles_done", "distance_m", "acc_per_m", "momentum_per_m", "drift_com_m"}
IN_TOTAL |= {"drift_momentum", "worst_violation", "scene", "robot", "fidelity", "lookahead", "transcription", "version"}
IN_TOTAL |= {"cycles", "time_s", "warnings"}


def run(capsys, *words) -> tuple[int, str, str]:
    code = main(["rhp", *(str(word) for word in words)])
    out, err = capsys.readouterr()
    return code, out, err


def test_json_holds_every_figure_and_nothing_else_is_printed(capsys, tmp_path):
    file = tmp_path / "walk.npz"
    code, out, err = run(capsys, "flat", "--cycles", 2, "--json", "-o", file)
    report = strict(out)
    assert (code, err) == (0, "")
    assert set(report) == IN_TOTAL and all(set(cycle) == PER_CYCLE for cycle in report["cycles"])
    expected = {"success": True, "status": "solved", "cycles_done": 2, "scene": "flat", "robot": "talos_wang"}
    expected |= {"fidelity": "point", "lookahead": 3, "transcription": "trapezoidal", "version": mp.__version__}
    assert {name: report[name] for name in expected} == expected
    assert set(report["worst_violation"]) == {"name", "phase", "time_s", "value", "tolerance", "unit"}
    assert report["distance_m"] == pytest.approx(sum(cycle["distance_m"] for cycle in report["cycles"]))
    for cycle in report["cycles"]:
        assert 0.0 < cycle["evaluation_s"] + cycle["linear_solver_s"] < cycle["time_s"]
    plan = mp.Plan.load(file)
    assert plan.duration() == pytest.approx(sum(cycle["duration_s"] for cycle in report["cycles"]))
    assert mp.check(plan).ok()


def test_a_row_per_cycle_goes_to_stderr_and_the_summary_to_stdout(capsys):
    code, out, err = run(capsys, "flat", "--cycles", 2, "--fidelity", "single", "--lookahead", 2)
    assert code == 0
    rows = [line.split() for line in err.splitlines()]
    assert rows[0][:3] == ["cycle", "status", "iterations"]
    assert [row[:2] for row in rows[1:]] == [["0", "solved"], ["1", "solved"]]
    assert out.startswith("flat  talos_wang  solved (single, lookahead 2, trapezoidal): 2 cycles done in ")
    assert "cost per metre: acceleration " in out and "closest to its limit: " in out


def test_quiet_has_no_rows_and_verbose_more_columns(capsys):
    assert run(capsys, "flat", "--cycles", 1, "--quiet", "--lookahead", 1)[2] == ""
    code, _, err = run(capsys, "flat", "--cycles", 1, "--verbose", "--lookahead", 1)
    assert code == 0 and err.splitlines()[0].split()[-3:] == ["drift", "L", "drift"]
    assert len({len(line) for line in err.splitlines()}) == 1  # aligned


def test_the_papers_form_says_that_it_drifts(capsys):
    words = ("flat", "--cycles", 1, "--paper", "--transcription", "euler", "--json")
    code, out, _ = run(capsys, *words)
    report = strict(out)
    assert (code, report["success"], report["status"]) == (0, True, "acceptable")
    assert "forward-Euler" in report["message"]
    assert report["drift_com_m"] > 1e-3 and report["worst_violation"]["name"] in ("dynamics", "at_consistency")


def test_lifted_psi_is_a_larger_program_of_the_same_cost(capsys):
    small, large = (
        strict(run(capsys, "flat", "--cycles", 1, "--lookahead", 2, "--json", *extra)[1])["cycles"][0]
        for extra in ((), ("--lifted-psi",))
    )
    assert large["variables"] > small["variables"] + 200
    assert large["cost"] == pytest.approx(small["cost"], rel=1e-3)


def test_a_walk_out_of_time_writes_nothing_and_gives_exit_code_1(capsys, tmp_path):
    words = ("rubbles", "--time-limit", 0.002, "-o", tmp_path / "a.npz", "--html", tmp_path / "a.html")
    code, out, err = run(capsys, *words, "--plots", tmp_path / "plots")
    assert code == 1 and list(tmp_path.iterdir()) == []
    assert err.splitlines()[1].split()[:2] == ["0", "time_limit"]
    assert out.startswith("rubbles  talos_wang  time_limit ") and "Not written, since no step was found: " in out
    code, out, _ = run(capsys, *words, "--json")
    report = strict(out)
    assert (code, report["success"], report["status"], report["cycles_done"]) == (1, False, "time_limit", 0)
    assert report["cycles"][0]["distance_m"] is None and report["distance_m"] == 0.0


def test_a_walk_is_drawn(capsys, tmp_path):
    pytest.importorskip("meshcat")
    pytest.importorskip("matplotlib")
    words = ("flat", "--cycles", 1, "-q", "--html", tmp_path / "walk.html", "--plots")
    code, out, _ = run(capsys, *words, tmp_path / "plots")
    assert code == 0 and f"Saved {tmp_path / 'walk.html'}, {tmp_path / 'plots'}" in out
    assert "<html" in (tmp_path / "walk.html").read_text().lower()
    names = {path.stem for path in (tmp_path / "plots").iterdir()}
    assert {"com", "momentum", "forces", "timing"} <= names


def test_the_sequence_of_a_plan_is_walked(capsys, tmp_path):
    file = tmp_path / "plan.npz"
    assert main(["plan", "stairs", "-o", str(file)]) == 0
    capsys.readouterr()
    code, out, err = run(capsys, "stairs", "--sequence", file, "--json")
    report = strict(out)
    assert (code, report["robot"], report["success"]) == (0, "humanoid44", True), report["message"]
    assert report["cycles_done"] == len(report["cycles"]) < 14  # the sequence ends before the cycles


WRONG = [
    (("rubles",), "no scene 'rubles' and no file of that name. Did you mean 'rubbles'?"),
    (("rubbles", "--robot", "talis"), "no robot 'talis' and no file of that name. Did you mean 'talos'?"),
    (
        ("gap",),
        "gap: steps: must be in the scene, or taken from a plan: mcplan plan gap -o plan.npz, then mcplan rhp gap --sequence",
    ),
    (
        ("flat", "--robot", "anymal"),
        'anymal: end_effectors: must have exactly two of kind "foot" to walk with rhp, got 4',
    ),
    (("flat", "--lookahead", 0), "--lookahead: must lie in [1, 10], got 0"),
    (("flat", "--lookahead", 11), "--lookahead: must lie in [1, 10], got 11"),
    (("flat", "--cycles", 0), "--cycles: must lie in"),
    (("flat", "--time-limit", -1), "--time-limit: must be a positive number, got -1"),
    (("flat", "--fidelity", "best"), '--fidelity: must be one of single, com, rectangle, point, got "best"'),
    (("flat", "--transcription", "rk4"), '--transcription: must be one of trapezoidal, euler, got "rk4"'),
    (("flat", "--sequence", "none.npz"), "none.npz: No such file or directory"),
    (("flat", "-o", "/nowhere/at/all.npz"), '--output: must lie in a folder that exists, got "/nowhere/at/all.npz"'),
    (("flat", "-o", "/"), '--output: must be a file, got "/"'),
    (("flat", "--html", "/nowhere/x.html"), '--html: must lie in a folder that exists, got "/nowhere/x.html"'),
    (("flat", "--plots", "/dev/null"), '--plots: must be a folder, or a name for a new one, got "/dev/null"'),
]


@pytest.mark.parametrize(("words", "message"), WRONG, ids=lambda v: " ".join(map(str, v)) if type(v) is tuple else "")
def test_wrong_input_gives_one_line_and_exit_code_2(words, message, capsys):
    assert one_line_error(run(capsys, *words)).startswith(message)


@pytest.mark.parametrize(
    ("scene", "message"),
    [
        ("gap", "must have a foot on the ground for rhp, got flight"),
        ("gap_with_handle", "must have feet alone in contact for rhp, got "),
    ],
)
def test_a_sequence_that_is_no_walk_is_named(scene, message, capsys, tmp_path):
    mp.plan(scene).plan.save(tmp_path / "plan.npz")
    assert message in one_line_error(run(capsys, scene, "--sequence", tmp_path / "plan.npz"))
