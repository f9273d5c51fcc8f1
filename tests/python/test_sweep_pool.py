"""mcplan.sweep.pool: a worker may die, and nothing else is lost with it."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from crashing import die_once, slowly, square_or_die
from mcplan.sweep import pool
from mcplan_bench import processes, robustness


def test_a_task_that_kills_its_workers_is_told_and_all_others_are_done():
    done = dict(pool.each(square_or_die, [1.0, -1.0, 2.0, 0.0, 3.0], 2, attempts=2))
    assert [done[i] for i in (0, 2, 4)] == [1.0, 4.0, 9.0]
    assert done[1] == pool.Crash(2, "its process was ended by SIGKILL")
    assert done[3] == pool.Crash(2, "its process ended with exit code 7")


def test_a_task_that_kills_one_worker_is_tried_again(tmp_path):
    assert list(pool.each(die_once, [str(tmp_path / "mark")], 1)) == [(0, "mark")]


def test_an_exception_ends_the_pool_and_its_processes():
    with pytest.raises(ValueError, match="could not convert"):
        list(pool.each(float, ["1", "x", *(["2"] * 50)], 2))


def test_who_stops_asking_ends_the_processes():
    working = pool.each(slowly, range(100), 2)
    assert next(working)[0] in (0, 1)
    working.close()  # would wait for half a minute if they went on
    assert next(working, None) is None


def test_the_first_process_of_all_leaves_ctrl_c_to_the_one_that_asks():
    # in a program of its own: what the first worker has along with it is started once in a process
    program = f"""from crashing import is_deaf
from mcplan.sweep import pool
print(dict(pool.each(is_deaf, [{int(signal.SIGINT)}], 1)))"""
    done = subprocess.run([sys.executable, "-c", program], cwd=Path(__file__).parent, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("{0: True}\n", "")


def test_the_bench_goes_on_after_a_crash_and_names_the_task():
    rest = []
    with pytest.raises(pool.Crashed, match=r"^-1.0: its process was ended by SIGKILL, in 3 of 3 attempts$"):
        for _, outcome in processes.each(square_or_die, [-1.0, 2.0, 3.0], 2):
            rest.append(outcome)
    assert sorted(rest) == [4.0, 9.0]


def test_a_crash_stands_in_the_table_of_robustness(monkeypatch):
    found = dict(processes.each(square_or_die, [-1.0, 2.0], 2, lambda task, crash: str(task)))
    assert found == {0: "-1.0", 1: 4.0}
    task = robustness.Task(seed=5)
    (row,) = robustness.summary([robustness.crashed(task, pool.Crash(3, "its process was ended by SIGSEGV"))])
    assert (row["kind"], row["good"], row["statuses"]) == ("gap", 0, {"crashed": 1})
    assert "random_gap_5 seed=5: crashed" in robustness.line(robustness.crashed(task, pool.Crash(3, "x")))
