"""mcplan bench: what is written and printed."""

from __future__ import annotations

import csv
import json

from mcplan.bench import robustness
from mcplan.cli import main


def test_robustness_writes_its_outcomes_and_lists_failures(tmp_path, capsys):
    code = main(["bench", "robustness", "--no-settings", "--scenes", "2", "--seed", "3", "--out", str(tmp_path)])
    out, err = capsys.readouterr()
    content = json.loads((tmp_path / "robustness.json").read_text())
    outcomes = content["random"]["outcomes"]
    assert [entry["seed"] for entry in outcomes] == [3, 4]
    assert "settings" not in content
    with (tmp_path / "random.csv").open(newline="") as file:
        assert [row["status"] for row in csv.DictReader(file)] == [entry["status"] for entry in outcomes]
    assert code == (0 if all(entry["good"] for entry in outcomes) else 1)
    assert "[2/2]" in err and "2 random scenes" in out


def test_too_few_good_runs_give_exit_code_1(tmp_path, monkeypatch, capsys):
    def outcome(task: robustness.Task) -> robustness.Outcome:
        good = task.seed != 5
        status = "solved" if good else "infeasible"
        return robustness.Outcome(task, "s", "gap", status, good, "" if good else "reach", "reach", 0.1, 1.0, 5, 2, 0.5)

    monkeypatch.setattr(robustness, "solve", outcome)
    words = ["bench", "robustness", "--no-settings", "--out", str(tmp_path), "--scenes"]
    assert main([*words, "10"]) == 0  # nine of ten
    assert main([*words, "9"]) == 1
    assert "seed=5: infeasible" in capsys.readouterr().out


def test_json_leaves_stdout_to_one_object(tmp_path, capsys):
    words = ["bench", "robustness", "--no-settings", "--scenes", "1", "--seed", "3", "--out", str(tmp_path), "--json"]
    main(words)
    assert json.loads(capsys.readouterr().out)["random"]["summary"][0]["runs"] == 1


def test_speed_prints_both_tables_and_writes_files(tmp_path, capsys):
    assert main(["bench", "--quick", "--repeats", "1", "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert "Time per iteration" in out and "Growth of an iteration" in out
    content = json.loads((tmp_path / "bench.json").read_text())
    assert [row["scene"] for row in content["scenes"]] == ["flat", "stairs", "gap", "gap_with_rail"]
    assert {"speed.csv", "growth.csv"} <= {path.name for path in tmp_path.iterdir()}
