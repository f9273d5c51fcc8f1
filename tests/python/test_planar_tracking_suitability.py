"""Plans that were made to be tracked are told from those that were not, by their contacts alone."""

import pytest

import tracked_cartwheel
from mcplan.planar.tracking import PLANNING, suitability
from reference_solutions import reference_plan


@pytest.mark.parametrize("name", ["cartwheel", "climbing", "walking"])
def test_least_torque_in_the_default_tube_moves_its_feet_and_unloads_them(name):
    found = suitability(reference_plan(name, "optimised_per_point"))
    assert not found.ok()
    assert 1e-3 < found.drift_m < 3e-3  # a tube of 1 mm either way and of 5 mrad
    assert found.least_N == found.min_N < 1.0
    assert "move by up to" in found.verdict and "carry as little as" in found.verdict


def test_a_plan_made_to_be_tracked_keeps_its_feet_where_they_are():
    found = suitability(tracked_cartwheel.cartwheel())
    assert found.ok()
    assert found.drift_m < 3.0 * PLANNING["tube_m"]
    assert found.min_N > 0.95 * PLANNING["min_normal_force"]
    assert found.verdict == "contacts are at rest and carry weight throughout"
