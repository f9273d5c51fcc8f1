"""mcplan_bench.tracking_speed: stopwatches, and that the parts of a control step make up the whole."""

from __future__ import annotations

import time

import pytest

from mcplan_bench import tracking_speed as bench


class Sleeper:
    def sleep(self, seconds):
        time.sleep(seconds)
        if seconds > 0.015:
            raise ValueError("overslept")
        return seconds


def test_calls_are_timed_and_nothing_else_about_them_changes():
    original = Sleeper.sleep
    with bench.stopwatches((Sleeper, "sleep")) as (times,):
        assert Sleeper().sleep(0.01) == 0.01
        with pytest.raises(ValueError, match="overslept"):
            Sleeper().sleep(0.02)
    assert len(times) == 2 and times[0] >= 0.01 and times[1] >= 0.02
    assert Sleeper.sleep is original


@pytest.mark.slow
def test_parts_of_a_control_step_add_up():
    pytest.importorskip("proxsuite")
    row = bench.measure(repeats=1)
    assert row["qp_ratio"] + row["model_ratio"] + row["rest_ratio"] == pytest.approx(1.0)
    assert min(row["qp_ms"], row["model_ms"], row["rest_ms"], row["simulation_ms"]) > 0.0
    # A control step of 2 ms, controller and simulation and little else.
    assert row["realtime_factor"] < 2.0 / (row["control_ms"] + row["simulation_ms"])
    assert row["p99_ms"] > row["control_ms"]
