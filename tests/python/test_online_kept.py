"""The end of a long run is kept as it is in the recording of all of it, and memory does not grow."""

import tracemalloc

import numpy as np
import pytest

import mcplan as mp
from mcplan.view.pages.show_run import show_run

for name in ("mujoco", "pinocchio", "proxsuite", "example_robot_data"):
    pytest.importorskip(name)

LATENCY = 0.02
ROWS = ("configurations", "torques", "com_W", "com_plan_W", "forces_W", "contacts_plan", "pushes_W", "end_effectors_W")


@pytest.fixture(scope="module")
def plan():
    return mp.plan("flat", "talos").plan


@pytest.fixture(scope="module")
def runs(plan):
    """The same run with all of it recorded, and with its end."""
    told = {"latency": LATENCY, "duration": 1.3, "push": (60.0, 0.2, 0.7, 90.0)}
    return mp.run(plan, **told), mp.run(plan, keep=0.5, **told)


def test_the_end_is_what_it_was(runs):
    whole, end = runs
    dropped = len(whole.recording.times_s) - len(end.recording.times_s)
    assert end.online.kept_from_s == pytest.approx(0.8) and whole.online.kept_from_s == 0.0
    np.testing.assert_array_equal(end.recording.times_s, whole.recording.times_s[dropped:])
    for field in ROWS:
        np.testing.assert_array_equal(
            getattr(end.recording, field), getattr(whole.recording, field)[dropped:], err_msg=field
        )
    assert end.measures.completed_s == whole.measures.completed_s == pytest.approx(1.3)
    assert end.online.replans == whole.online.replans


def test_plans_are_those_that_were_followed_then(runs):
    whole, end = runs
    followed = [one for one in whole.plans if one.from_s > 0.8]
    before = whole.plans[len(whole.plans) - len(followed) - 1]
    assert len(whole.plans) > len(end.plans)
    assert [one.plan.knots for one in end.plans] == [one.plan.knots for one in [before, *followed]]
    assert [one.from_s for one in end.plans] == [one.from_s for one in [before, *followed]]
    assert [one.begins_s for one in end.plans] == [one.begins_s for one in [before, *followed]]


def test_contacts_older_than_what_is_kept_are_drawn_as_such(runs):
    from mcplan.view.plots.run_footholds import plot_run_footholds

    def labels(run):
        chart = plot_run_footholds(run.recording).axes[0]
        return sorted(text.get_text() for text in chart.texts if text.get_text())

    whole, end = (labels(run) for run in runs)
    assert whole[:2] == ["0.0", "0.0"] and not any(label.startswith("<") for label in whole)
    stood = [text for text in end if text.startswith("<")]
    assert stood and set(stood) == {"< 0.8"}
    assert set(end) - set(stood) <= set(whole)


def test_what_is_kept_is_saved_drawn_and_said(runs, tmp_path):
    end = runs[1]
    assert "recorded" in str(end) and "from 0.80 s on" in str(end) and "recorded  " not in str(runs[0])
    end.save(tmp_path / "run.npz")
    again = type(end).load(tmp_path / "run.npz")
    np.testing.assert_array_equal(again.recording.times_s, end.recording.times_s)
    assert again.online.kept_from_s == end.online.kept_from_s and len(again.plans) == len(end.plans)


def test_pages_begin_with_what_is_kept(runs):
    """Planned contacts and pushes are those of the whole run's page, as much earlier."""
    from mcplan.view.pages.show_run import _followed_contacts
    from mcplan.view.runs import from_zero, was_replanned

    whole, end = runs
    page = show_run(end)
    assert page.duration_s == pytest.approx(0.5) and page.knots_s[0] == 0.0 and page.knots_s[-1] == page.duration_s
    assert was_replanned(end) and was_replanned(end.recording) and not was_replanned(whole.recording)
    found = _followed_contacts(from_zero(end.recording))
    there = [i for i in _followed_contacts(whole.recording) if i.end_s > 0.8]
    assert len(found) == len(there)
    for one, other in zip(found, there, strict=True):
        assert one.end_s + 0.8 == pytest.approx(other.end_s) and one.surface == other.surface
        assert one.start_s + 0.8 == pytest.approx(max(other.start_s, 0.8))
    assert "from 0.80 s on" in page.overlay and "push of 60 N" in page.overlay


def test_exports_begin_at_zero(runs, tmp_path):
    end = runs[1]
    mp.export(end, "mjlab", tmp_path / "motion.npz")
    whole = np.load(tmp_path / "motion.npz")
    assert len(whole["joint_pos"]) == 1 + round(0.5 * float(whole["fps"][0]))


@pytest.mark.parametrize("seconds", [0.0, -1.0, 1e9, float("inf")])
def test_a_wrong_length_is_named(plan, seconds):
    with pytest.raises(mp.errors.InvalidOptions, match="keep_s: must lie in 0.1 to 3600"):
        mp.run(plan, keep=seconds)


def test_a_fall_keeps_its_place(plan):
    run = mp.run(plan, replanning=False, push=(600.0, 0.2, 0.3, 90.0), keep=0.3, latency=LATENCY, duration=3.0)
    assert run.measures.fell
    assert run.recording.times_s[0] == run.online.kept_from_s > 0.0
    assert run.recording.fell_at_s == run.measures.completed_s == run.recording.times_s[-1]
    assert f"fell at {run.recording.fell_at_s:.2f} s" in show_run(run).overlay


@pytest.mark.slow
def test_memory_does_not_grow_with_the_length_of_a_run(plan):
    """Objects of Python and arrays of NumPy; those of C++ are what benchmarks/long_walk.py looks at."""
    sizes = []

    def look(time_s, *_):
        if round(time_s / 0.002) in (5000, 10000):
            sizes.append(tracemalloc.get_traced_memory()[0])

    tracemalloc.start()
    try:
        mp.run(plan, command=(0.0, 0.0, 0.0), keep=1.0, duration=20.5, latency=LATENCY, watch=look)
    finally:
        tracemalloc.stop()
    assert sizes[1] - sizes[0] < 1e5


@pytest.mark.parametrize(
    ("told", "error", "message"),
    [
        ({"keep": np.array([0.2])}, mp.errors.InvalidOptions, "keep_s: must be a number"),
        ({"keep": 1.0, "keep_s": 1.0}, mp.errors.InvalidOptions, "keep: must not be given with keep_s"),
        ({"watch": 3}, mp.errors.InvalidArgument, "watch: must be a function"),
        ({"command": (11.0, 0.0, 0.0)}, mp.errors.InvalidOptions, "command: must have velocities of at most 10 m/s"),
    ],
)
def test_what_cannot_be_asked_for_is_named(plan, told, error, message):
    with pytest.raises(error, match=message):
        mp.run(plan, duration=0.1, latency=LATENCY, **told)
