"""What planners say reaches the standard library's logging and the caller's callback."""

from __future__ import annotations

import logging

import mcplan as mp


def test_logging_has_what_the_callback_has(caplog):
    lines: list[str] = []
    with caplog.at_level(logging.INFO, logger="mcplan"):
        mp.plan("flat", logger=lambda _, line: lines.append(line))
    assert lines and [record.message for record in caplog.records if record.name == "mcplan"] == lines


def test_engines_and_replans_are_heard(caplog):
    with caplog.at_level(logging.INFO, logger="mcplan"):
        plan = mp.plan("flat").plan
        caplog.clear()
        state = plan.at(0.0)
        measured = mp.model.Knot(com_W=state.com_W, end_effectors_W=[end.position_W for end in state.end_effectors])
        mp.replan(plan, 0.0, measured)
        assert any("replan, the plan's own sequence" in record.message for record in caplog.records)
        caplog.clear()
        lines: list[str] = []
        mp.sip.plan("cartwheel", minimise="none", logger=lambda _, line: lines.append(line))
        assert lines and [record.message for record in caplog.records] == lines


def test_nothing_is_said_where_nobody_listens(caplog, capfd):
    options = mp.ddp.Options()
    mp.plan("flat", options=options)
    assert options.logger is None and not caplog.records and capfd.readouterr() == ("", "")
