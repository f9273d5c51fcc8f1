"""mcplan bench: what is written and printed."""

from __future__ import annotations

import csv
import json
from dataclasses import replace

from command_line import strict
from mcplan.cli import main
from mcplan_bench import contacts, contacts_cases, robustness


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


def test_robustness_takes_the_model(tmp_path, monkeypatch):
    models = []

    def outcome(task: robustness.Task) -> robustness.Outcome:
        models.append(task.model)
        return robustness.Outcome(task, "s", "gap", "solved", True, "", "", 0.0, 1.0, 5, 2, 0.5)

    monkeypatch.setattr(robustness, "solve", outcome)
    words = ["bench", "robustness", "--scenes", "1", "--out", str(tmp_path)]
    assert main([*words, "--no-settings"]) == main([*words, "--model", "lipm"]) == 0
    assert models == ["", *["lipm"] * 61]
    assert json.loads((tmp_path / "robustness.json").read_text())["model"] == "lipm"


def solved(case: contacts_cases.Case) -> contacts.Row:
    """A row of a plan that holds all but what costs 10."""
    row = contacts.Row(case.name, case.scene, case.robot, case.model, status="solved", time_s=0.1, cost=0.2)
    row = replace(row, tangent_foot=0.5, momentum_Nms=2.0, hands_only=1, holds=case.name != "gap")
    return row if row.holds else replace(row, why="J 10, at most 0.95")


def test_contacts_writes_tables_and_fails_when_a_row_does(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(contacts, "solve", solved)
    page = tmp_path / "page.md"
    words = ["bench", "contacts", "--out", str(tmp_path), "--markdown", str(page)]
    assert main([*words, "--case", "flat*", "--settings"]) == 0
    out, err = capsys.readouterr()
    assert "[2/2] flat/anymal: solved" in err and "16 of 16 find" in out
    content = strict((tmp_path / "contacts.json").read_text())
    assert [row["case"] for row in content["rows"]] == ["flat", "flat/anymal"] and content["holds"]
    assert content["settings"]["summary"]["min_cost"] == 0.2 and "speed" not in content
    assert (
        page.read_text().startswith("# Plans held to")
        and "`mcplan bench contacts --case 'flat*' --settings`" in page.read_text()
    )
    with (tmp_path / "contacts.csv").open(newline="") as file:
        assert [row["cost"] for row in csv.DictReader(file)] == ["0.2", "0.2"]
    assert main([*words, "--case", "gap"]) == 1
    assert "gap: J 10, at most 0.95" in capsys.readouterr().out


def test_contacts_measures_a_plan_and_prints_json(tmp_path, monkeypatch, capsys):
    case = contacts_cases.Case("mine", "flat", model="")
    monkeypatch.setattr(contacts_cases, "CASES", (case,))
    assert main(["bench", "contacts", "--case", "mine", "--json", "--out", str(tmp_path)]) == 0
    (row,) = strict(capsys.readouterr().out)["rows"]
    assert row["status"] == "solved" and 0.0 < row["tangent_foot"] < 0.7 and row["com_replay_m"] < 1e-9


def test_contacts_lists_its_cases_and_refuses_others(capsys):
    assert main(["bench", "contacts", "--list"]) == 0
    assert capsys.readouterr().out.splitlines() == [case.name for case in contacts_cases.CASES]
    assert main(["bench", "contacts", "--case", "flut"]) == 2
    assert "--case: must name one of flat, stairs" in capsys.readouterr().err


def test_speed_prints_both_tables_and_writes_files(tmp_path, capsys):
    assert main(["bench", "--quick", "--repeats", "1", "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert "Time per iteration" in out and "Growth of an iteration" in out
    content = json.loads((tmp_path / "bench.json").read_text())
    assert [row["scene"] for row in content["scenes"]] == ["flat", "stairs", "gap", "gap_with_rail"]
    assert {"speed.csv", "growth.csv"} <= {path.name for path in tmp_path.iterdir()}
