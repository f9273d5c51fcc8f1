"""mcplan_bench.processes: results come back, from processes on one thread and one core."""

from __future__ import annotations

import os

import pytest

from mcplan_bench import processes


def test_outcomes_carry_the_index_of_their_task():
    tasks = ["1", "2.5", "-3"]
    assert list(processes.each(float, tasks, 1)) == [(0, 1.0), (1, 2.5), (2, -3.0)]
    assert sorted(processes.each(float, tasks, 2)) == [(0, 1.0), (1, 2.5), (2, -3.0)]


def test_an_exception_comes_through():
    with pytest.raises(ValueError, match="could not convert"):
        list(processes.each(float, ["1", "x"], 2))


@pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="only Linux tells on which cores a process runs")
def test_a_process_apart_has_one_core_and_one_thread():
    assert len(processes.apart(os.sched_getaffinity, 0)) == 1
    assert processes.apart(os.getenv, "OPENBLAS_NUM_THREADS") == "1"


def test_the_environment_is_given_back(monkeypatch):
    monkeypatch.setenv("MCPLAN_A", "before")
    monkeypatch.delenv("MCPLAN_B", raising=False)
    with processes.environment({"MCPLAN_A": "1", "MCPLAN_B": "2"}):
        assert (os.environ["MCPLAN_A"], os.environ["MCPLAN_B"]) == ("1", "2")
    assert os.environ["MCPLAN_A"] == "before" and "MCPLAN_B" not in os.environ
