"""mcplan_bench.speed: times by part. Nothing here depends on how fast the machine is."""

from __future__ import annotations

import pytest

import mcplan as mp
from mcplan_bench import speed


@pytest.fixture(scope="module")
def rows():
    return speed.compare(["stairs"], repeats=1)


def test_an_iteration_is_the_sum_of_its_parts(rows):
    (row,) = rows
    for method in ("", "paper_"):
        parts = sum(row[f"{method}{part}_ms"] for part in speed.PARTS)
        assert row[f"{method}iteration_ms"] == pytest.approx(parts)
        assert row[f"{method}pricing_ratio"] == pytest.approx(row[f"{method}pricing_ms"] / parts)
    assert row["ratio"] == pytest.approx(row["paper_iteration_ms"] / row["iteration_ms"])


def test_a_whole_plan_takes_longer_than_its_iterations(rows):
    (row,) = rows
    assert row["plan_ms"] > row["iterations"] * row["iteration_all_ms"]
    assert row["paper_plan_ms"] > row["paper_iterations"] * row["paper_iteration_ms"]


def test_searching_iterations_are_those_that_price_from_the_start_on():
    report = mp.plan("flat").report
    count = speed.searching_iterations(report)
    assert 1 < count < report.iterations
    assert all(row.neighbours > 0 for row in report.history[:count])
    assert report.history[count].neighbours == 0


def test_parts_outside_the_iterations_are_left_out():
    report = mp.plan("flat").report
    assert {"check", "make_exact"} & set(report.timing_s) and not {"check", "make_exact"} & set(speed.PARTS)
    assert sum(speed.iteration_parts_ms(report).values()) * report.iterations < 1e3 * report.time_s
