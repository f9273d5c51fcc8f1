"""Results of engines and checks come back from pickles as they were."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import pytest

import mcplan as mp

pytestmark = pytest.mark.filterwarnings("ignore:.*the earlier name goes:DeprecationWarning")


def attributes(value: Any) -> dict[str, Any]:
    """What it says of itself, by name."""
    kind = type(value)
    return {name: getattr(value, name) for name, member in vars(kind).items() if isinstance(member, property)}


def assert_same(one: Any, other: Any) -> None:
    """Compares all attributes, to the bottom."""
    assert type(one) is type(other)
    if isinstance(one, (list, tuple)):
        assert len(one) == len(other)
        for a, b in zip(one, other, strict=True):
            assert_same(a, b)
    elif type(one).__module__.startswith("mcplan") and attributes(one) and not hasattr(type(one), "__members__"):
        mine, theirs = attributes(one), attributes(other)
        for name in mine:
            assert_same(mine[name], theirs[name])
    else:
        assert repr(one) == repr(other)


@pytest.fixture(scope="module", params=["ddp", "replan", "rhp", "sip", "check"])
def result(request):
    if request.param == "rhp":
        return mp.walk("flat", cycles=1)
    if request.param == "sip":
        return mp.sip.plan("cartwheel", minimise="none", certify=True)
    found = mp.plan("flat", record_history=True)
    if request.param == "check":
        return mp.check(found.plan)
    if request.param == "ddp":
        return found
    state = found.plan.at(0.5)
    measured = mp.model.Knot(
        com_W=state.com_W + [0.2, 0.0, 0.0],
        com_velocity_W=state.com_velocity_W,
        end_effectors_W=[end.position_W for end in state.end_effectors],
    )
    return mp.replan(found.plan, 0.5, measured)


def test_results_come_back_from_pickles(result):
    again = pickle.loads(pickle.dumps(result))
    assert_same(again, result)
    assert again == result and not again != result
    assert pickle.dumps(pickle.loads(pickle.dumps(result))) == pickle.dumps(result)


def test_results_can_be_copied(result):
    assert_same(copy.deepcopy(result), result)
    assert copy.deepcopy(result) == result


def with_state(value: Any, place: int, change: Any) -> Any:
    """The same with one of the members that it is pickled by changed."""
    state = list(value.__getstate__())
    state[place] = change(state[place])
    other = type(value).__new__(type(value))
    other.__setstate__(tuple(state))
    return other


def test_results_differ_where_a_member_of_a_member_does(result):
    if hasattr(result, "constraints") and not hasattr(result, "report"):
        other = with_state(result, 0, lambda constraints: constraints[:-1])
    else:
        other = with_state(result, 1, lambda report: with_state(report, 1, lambda message: f"{message}!"))
    assert result != other and result not in (3, None, "x")


def test_a_pickle_of_another_shape_is_refused(result):
    with pytest.raises(ValueError, match="another version"):
        type(result).__new__(type(result)).__setstate__((1,))
