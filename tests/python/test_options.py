"""mcplan.options and the options of the engines: classes that come from tables of fields, given as objects or by name."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import mcplan as mp
from mcplan import _core
from mcplan.options import fill, option_names, start

ENGINES = [_core.ddp, _core.rhp, _core.sip]
CHANGED = {
    _core.ddp: {
        "phases": 24,
        "weights": _core.ddp.Weights(com=2.0, own={"flight": 3.0}),
        "initial_sequence": [[0, -1]],
    },
    _core.rhp: {"fidelity": _core.rhp.Fidelity.single, "double_support_s": (0.2, 0.4), "time_limit_s": 2.0},
    _core.sip: {"forces": _core.sip.Forces.uniform, "phase_duration_s": (0.3, 4.0), "self_collision": True},
}
SETTINGS = [(engine.Options, {**vars(_core), **vars(engine)}) for engine in ENGINES]
SETTINGS += [(mp.Tolerances, vars(_core)), (mp.PlanarTolerances, vars(_core))]


@pytest.mark.parametrize(("kind", "names"), SETTINGS, ids=lambda value: getattr(value, "__module__", ""))
def test_options_are_values(kind, names):
    """Every field by keyword, one at a time: repr can be pasted, copies and pickles are equal, other values are not."""
    usual = kind()
    assert usual == kind() and usual != object()
    for name in option_names(kind):
        value = getattr(usual, name)
        if name == "logger":
            continue
        other = {
            bool: lambda v: not v,
            int: lambda v: v + 1,
            float: lambda v: v / 2 + 1.0 if np.isfinite(v) else 7.0,
        }.get(type(value))
        if other:
            made = kind(**{name: other(value)})
            assert getattr(made, name) == other(value) and made != usual, name
        else:
            made = kind(**{name: value})
            assert made == usual, name
        for same in (eval(repr(made), names), copy.copy(made), copy.deepcopy(made), pickle.loads(pickle.dumps(made))):
            assert same == made and repr(same) == repr(made), name


@pytest.mark.parametrize("engine", ENGINES, ids=lambda engine: engine.__name__)
def test_choices_ranges_and_groups_are_values_too(engine):
    made = engine.Options(**CHANGED[engine])
    made.validate()
    for name, value in CHANGED[engine].items():
        assert getattr(made, name) == value
    assert made != engine.Options()
    for same in (eval(repr(made), vars(engine)), copy.copy(made), pickle.loads(pickle.dumps(made))):
        assert same == made
    for name in option_names(engine.Options):
        for member in getattr(type(getattr(made, name)), "__members__", {}).values():
            assert eval(repr(member), vars(engine)) == member


def test_who_listens_is_no_part_of_the_value():
    lines = []
    loud = mp.ddp.Options(phases=6, logger=lambda level, line: lines.append(line))
    assert loud == mp.ddp.Options(phases=6) and "logger" not in repr(loud)
    assert pickle.loads(pickle.dumps(loud)).logger is None
    assert copy.copy(loud).logger is not None
    mp.plan("flat", options=loud, max_iterations=2, restarts=0)
    assert lines


def test_all_that_is_out_of_range_is_named_at_once():
    with pytest.raises(mp.errors.InvalidOptions) as found:
        mp.plan("flat", phases=-1, threads=0, weights={"com": -1.0})
    assert {error.field for error in (found.value, *found.value.others)} == {"phases", "threads", "weights.com"}


def test_names_stand_above_given_options_which_stay_as_they_are():
    base = mp.rhp.Options(cycles=3, lookahead=2)
    made = fill(start("options", base, mp.rhp.Options), {"lookahead": 4, "fidelity": "single", "time_limit": None})
    assert (made.cycles, made.lookahead, made.fidelity) == (3, 4, mp.rhp.Fidelity.single)
    assert (base.lookahead, base.fidelity) == (2, mp.rhp.Fidelity.point)


def test_each_engine_takes_options_as_an_object_or_by_name_and_gives_a_plan_and_a_report():
    ways = [
        (mp.ddp.plan, "flat", mp.ddp.Options, {"phases": 6, "max_iterations": 4, "restarts": 0}),
        (mp.rhp.walk, "flat", mp.rhp.Options, {"cycles": 1, "lookahead": 1}),
        (mp.sip.plan, "chimney", mp.sip.Options, {"max_iterations": 3, "torque_weight": 0.0, "free_durations": False}),
    ]
    for solve, what, kind, values in ways:
        by_object, by_name = solve(what, options=kind(**values)), solve(what, **values)
        assert by_object.report.status == by_name.report.status
        np.testing.assert_array_equal(by_object.plan.at(0.1).com_W, by_name.plan.at(0.1).com_W)
    assert isinstance(by_name, mp.sip.Result)
    assert (mp.plan, mp.walk, mp.whole_body) == (mp.ddp.plan, mp.rhp.walk, mp.sip.plan)
    assert mp.ddp.Result is mp.ddp.Result and mp.rhp.Result is mp.rhp.Walk


@pytest.mark.parametrize("solve", [mp.ddp.plan, mp.rhp.walk, mp.rhp.receding_horizon, mp.sip.plan])
def test_options_of_another_kind_are_refused(solve):
    with pytest.raises(mp.errors.InvalidArgument, match="options: must be an Options or None, got a Tolerances"):
        solve("flat" if solve is not mp.sip.plan else "chimney", options=mp.Tolerances())


@pytest.mark.parametrize("call", [mp.ddp.plan, mp.rhp.walk])
def test_an_option_has_one_of_its_names(call):
    with pytest.raises(mp.InvalidInput, match="time_limit: may not stand beside time_limit_s, which it is short for"):
        call("flat", time_limit=0.05, time_limit_s=5.0)


@pytest.mark.parametrize(
    ("kind", "values", "text"),
    [
        (mp.ddp.Options, {"initial_sequence": [["a"]]}, 'initial_sequence[0][0]: must be a whole number, got "a"'),
        (mp.ddp.Options, {"initial_sequence": [3]}, "initial_sequence[0]: must be a list, got 3"),
        (mp.ddp.Options, {"phases": True}, "phases: must be of type int, got True"),
        (mp.ddp.Options, {"time_limit_s": True}, "time_limit_s: must be of type float, got True"),
        (mp.ddp.Options, {"stepping_guesses": 5}, "stepping_guesses: must be of type bool, got 5"),
    ],
)
def test_items_of_lists_are_named_and_truth_is_no_number(kind, values, text):
    with pytest.raises(mp.errors.InvalidOptions) as found:
        fill(kind(), values)
    assert str(found.value) == text
