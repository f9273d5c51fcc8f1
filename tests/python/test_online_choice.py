"""When a robot that nothing pushes stays with the plan under way."""

import dataclasses

import pytest

from mcplan.online import Update
from mcplan.online.choice import YOUNG_PERIODS, misses_at_once

PERIOD_S = 0.1
MISSES = Update(None, 2.0, 0.01, "acceptable", True, 2.003, "", "same_sequence", 1)


def test_a_plan_that_misses_a_limit_before_the_next_one_is_not_better_than_a_young_one():
    assert misses_at_once(MISSES, 0.1, PERIOD_S)
    assert not misses_at_once(MISSES, YOUNG_PERIODS * PERIOD_S, PERIOD_S)  # by then the one under way is old


@pytest.mark.parametrize("told", [{"status": "solved"}, {"status": "infeasible"}, {"kept_until_s": 2.1}])
def test_any_other_plan_is_followed(told):
    assert not misses_at_once(dataclasses.replace(MISSES, **told), 0.1, PERIOD_S)
