"""Touches that go on are one, those that pause are two."""

from mcplan.tracking.touches import PAUSE_S, Touch, TouchLog, hardest


def seen(links, depth_m, force_N, terrain=False):
    return Touch(links, terrain, 0.0, 0.0, depth_m, force_N)


def test_a_touch_lasts_until_it_pauses():
    log = TouchLog()
    log.add(1.0, [seen(("a", "b"), 0.001, 5.0)])
    log.add(1.0 + 0.9 * PAUSE_S, [seen(("a", "b"), 0.003, 2.0)])
    log.add(1.0 + 2.5 * PAUSE_S, [seen(("a", "b"), 0.002, 9.0), seen(("c", "floor"), 0.001, 1.0, terrain=True)])
    first, second, third = log.touches()
    assert (first.links, first.start_s, first.end_s) == (("a", "b"), 1.0, 1.0 + 0.9 * PAUSE_S)
    assert (first.depth_m, first.force_N) == (0.003, 5.0)
    assert (second.start_s, second.end_s, second.force_N) == (1.0 + 2.5 * PAUSE_S, 1.0 + 2.5 * PAUSE_S, 9.0)
    assert third.terrain and not second.terrain
    assert hardest(log.touches(), terrain=False) is second and hardest(log.touches(), terrain=True) is third
    assert str(second) == f"a and b at {second.start_s:.2f} s, 9 N" and str(third).startswith("c on floor at ")


def test_nothing_touched_is_nothing():
    assert TouchLog().touches() == () and hardest((), terrain=True) is None


def test_what_had_ended_is_dropped():
    log = TouchLog()
    log.add(1.0, [seen(("a", "b"), 0.001, 5.0), seen(("c", "d"), 0.001, 1.0)])
    for time_s in (1.04, 1.08, 1.12):
        log.add(time_s, [seen(("a", "b"), 0.002, 4.0)])
    log.drop(1.1)
    (touch,) = log.touches()
    assert (touch.links, touch.start_s, touch.end_s) == (("a", "b"), 1.0, 1.12)
    log.add(1.14, [seen(("a", "b"), 0.001, 6.0)])  # it goes on
    assert log.touches()[0].force_N == 6.0 and len(log.touches()) == 1
    log.drop(2.0)
    assert log.touches() == ()
