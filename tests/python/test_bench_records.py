"""mcplan_bench.records: tables as files."""

from __future__ import annotations

import csv
import datetime
import json

from mcplan_bench import records


def test_csv_gives_back_its_rows(tmp_path):
    rows = [{"scene": "flat, long", "ms": "1.5"}, {"scene": "gap", "ms": "2"}]
    path = records.write_csv(tmp_path / "new" / "table.csv", rows)
    with path.open(newline="") as file:
        assert list(csv.DictReader(file)) == rows
    assert records.write_csv(tmp_path / "empty.csv", []).read_text() == ""


def test_json_holds_no_nan(tmp_path):
    path = records.write_json(tmp_path / "out.json", {"a": [1.0, float("nan")], "b": {"c": float("inf")}})
    assert json.loads(path.read_text(), parse_constant=lambda name: 1 / 0) == {"a": [1.0, None], "b": {"c": None}}


def test_the_machine_is_named():
    machine = records.machine()
    assert machine["cores"] >= 1 and machine["cpu"]


def test_measurements_have_their_date():
    assert datetime.date.fromisoformat(records.machine()["date"])
