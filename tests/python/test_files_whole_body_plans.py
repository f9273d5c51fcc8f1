"""mcplan.files.whole_body_plans: a plan comes back as it was, and a damaged file is rejected with a name for it."""

from __future__ import annotations

import copy
import io
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from mcplan import _core
from mcplan._core import planar_task_from_plain, planar_task_to_plain
from mcplan.cli import main
from mcplan.files.whole_body_plans import load_any_plan, load_whole_body_plan, plan_from_bytes, plan_to_bytes
from reference_solutions import reference_plan, reference_task
from standing import standing_plan


@pytest.fixture
def plan() -> mp.PlanarPlan:
    return reference_plan("cartwheel", "optimised_per_point")


def given_forces() -> mp.PlanarPlan:
    """A plan with forces and a base of its own."""
    plan, rng = reference_plan("walking", "feasible_uniform"), np.random.default_rng(1)
    plan.force_law = _core.PlanarForceLaw.polynomial
    points = [2 * len(phase.contacts) for phase in plan.task.phases for _ in range(phase.intervals)]
    plan.force_polynomials = [rng.normal(size=(4, 2 * count)) for count in points]
    plan.weights = []
    plan.base_control_points = rng.normal(size=(3, plan.control_points.shape[1]))
    return plan


def arrays_of(data: bytes) -> dict:
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def bytes_of(arrays: dict) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def states(plan: mp.PlanarPlan) -> list:
    return [repr(plan.at(t)) for t in np.linspace(0.0, plan.duration(), 7)]


@pytest.mark.parametrize("make", [lambda: reference_plan("cartwheel", "optimised_per_point"), given_forces])
def test_a_plan_comes_back_exactly(make, tmp_path):
    plan = make()
    plan.task.phases[1].poses = [_core.PlanarPose(body=3, fraction=1 / 3, max=[1.0, np.inf, 1e-17])]
    plan.save(tmp_path / "plan.npz")
    loaded = mp.PlanarPlan.load(tmp_path / "plan.npz")
    for other in (loaded, pickle.loads(pickle.dumps(plan)), copy.deepcopy(plan)):
        assert states(other) == states(plan)
        assert repr(other.task) == repr(plan.task)
        assert other.planner == "reference" and other.force_law == plan.force_law
        assert plan_to_bytes(other) == plan_to_bytes(plan)


@pytest.mark.parametrize("make", [lambda: reference_plan("cartwheel", "optimised_per_point"), given_forces])
def test_a_plan_comes_back_exactly_from_json(make, tmp_path):
    plan = make()
    plan.task.phases[1].poses = [_core.PlanarPose(body=3, fraction=1 / 3, max=[1.0, np.inf, 1e-17])]
    plan.save(tmp_path / "plan.json")
    for other in (mp.PlanarPlan.load(tmp_path / "plan.json"), load_any_plan(tmp_path / "plan.json")):
        assert other == plan and states(other) == states(plan)
        assert plan_to_bytes(other) == plan_to_bytes(plan)
    header = json.loads((tmp_path / "plan.json").read_text())
    assert (header["kind"], header["format"], header["mcplan"]) == ("planar_plan", 2, mp.__version__)
    assert header["task"]["phases"][1]["poses"][0]["max"] == [1.0, "inf", 1e-17]
    assert header["task"] == json.loads(arrays_of(plan_to_bytes(plan))["header"].tobytes())["task"]


@pytest.mark.parametrize("ending", ["npz", "json"])
def test_a_file_of_0_1_whose_task_is_called_motion_is_read_and_written_anew(plan, ending, tmp_path):
    file = Path(__file__).parents[1] / f"data/planar_plan_of_0_1.{ending}"
    for load in (mp.PlanarPlan.load, load_any_plan):
        assert load(file) == plan
    mp.PlanarPlan.load(file).save(tmp_path / f"again.{ending}")
    text = (tmp_path / f"again.{ending}").read_bytes()
    header = json.loads(text if ending == "json" else arrays_of(text)["header"].tobytes())
    assert header["task"]["name"] == "cartwheel" and "motion" not in header


def test_all_that_is_wrong_with_a_plan_in_json_is_named_with_its_file(plan, tmp_path):
    file = tmp_path / "plan.json"
    plan.save(file)
    data = json.loads(file.read_text())
    data["task"]["robot"]["gravity"] = "x"
    data["task"]["phases"][0]["min_duration"] = "-inf"
    data["durations"][1] = 0.0
    file.write_text(json.dumps(data))
    with pytest.raises(mp.errors.InvalidPlan) as found:
        mp.PlanarPlan.load(file)
    assert str(found.value).splitlines() == [
        f'{file}: task.robot.gravity: must be a number, got "x"',
        f"{file}: task.phases[0].min_duration: must be a finite number, got -inf",
        f"{file}: durations[1]: must be a positive number, got 0.0",
    ]


def test_arrays_of_a_plan_are_views_that_outlive_what_replaces_them(plan):
    weights, points = plan.weights[0], plan.control_points
    before = points.copy()
    weights[0] = 7.0
    assert plan.weights[0][0] == 7.0
    plan.control_points = np.zeros((2, 3))
    plan.weights = []
    assert weights[0] == 7.0 and (points == before).all()


def test_the_header_says_what_it_holds(plan):
    header = json.loads(arrays_of(plan_to_bytes(plan))["header"].tobytes())
    assert header["kind"] == "whole_body" and header["format"] == 1 and header["mcplan"] == mp.__version__
    assert "m, kg, s" in header["units"]
    assert header["task"]["robot"]["name"] == "climber9"


def test_an_invalid_plan_is_not_saved(plan, tmp_path):
    target = tmp_path / "plan.npz"
    target.write_text("old")
    plan.control_points[1, 1] = np.nan
    with pytest.raises(mp.errors.InvalidPlan, match="control_points"):
        plan.save(target)
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["plan.npz"]


def test_every_truncation_is_rejected(plan, tmp_path):
    data = plan_to_bytes(plan)
    for length in [0, 1, 100, *range(0, len(data), len(data) // 40), len(data) - 1]:
        (tmp_path / "cut.npz").write_bytes(data[:length])
        for load in (load_whole_body_plan, load_any_plan):
            with pytest.raises(
                mp.errors.InvalidPlan, match=r"cut.npz: must be an .npz or .json file written by mcplan"
            ):
                load(tmp_path / "cut.npz")


def test_flipped_bytes_never_crash(plan, tmp_path):
    data, rng = plan_to_bytes(plan), np.random.default_rng(0)
    for _ in range(300):
        damaged = bytearray(data)
        for position in rng.integers(0, len(data), 3):
            damaged[position] ^= int(rng.integers(1, 256))
        (tmp_path / "bad.npz").write_bytes(damaged)
        try:
            load_whole_body_plan(tmp_path / "bad.npz")  # a flip may hit bytes that nobody reads
        except mp.errors.InvalidPlan as found:
            assert "bad.npz: " in str(found)


def without(name):
    return lambda arrays: arrays.pop(name)


def put(name, value):
    return lambda arrays: arrays.update({name: value(arrays[name])})


def header(**changes):
    def change(arrays):
        data = {**json.loads(arrays["header"].tobytes()), **changes}
        arrays["header"] = np.frombuffer(json.dumps(data).encode(), np.uint8)

    return change


def in_task(change):
    """Change the task of the header in place."""

    def apply(arrays):
        task = json.loads(arrays["header"].tobytes())["task"]
        change(task)
        header(task=task)(arrays)

    return apply


DAMAGE = {
    "no header": (without("header"), "an archive without `header`"),
    "header no JSON": (put("header", lambda a: a[:-1]), "header: must be JSON"),
    "no kind": (header(kind=None), 'header.kind: must be "whole_body": a plan of a planar robot, got none, as'),
    "another kind": (
        header(kind="half_body"),
        'header.kind: must be "whole_body": a plan of a planar robot, got "half_body"',
    ),
    "future format": (header(format=2), "header.format: must be 1 for this version of mcplan, got 2"),
    "format true": (header(format=True), "header.format: must be 1"),
    "planner a number": (header(planner=1), "header.planner: must be a string, got 1"),
    "law of nobody": (
        header(force_law="magic"),
        'header.force_law: must be one of least_norm, polynomial, got "magic"',
    ),
    "another law": (header(force_law="polynomial"), r"weights: must have shape \(0,\)"),
    "no task": (header(task=[]), r"header.task: must be an object, got \[\]"),
    "task empty": (header(task={}), "header.task.robot: is required"),
    "task with more": (in_task(lambda m: m.update(speed=1)), "header.task.speed: no such key. Keys: name,"),
    "mass text": (
        in_task(lambda m: m["robot"]["bodies"][2].update(mass="heavy")),
        r"header.task.robot.bodies\[2\].mass: must be a number, got \"heavy\"",
    ),
    "no mass": (
        in_task(lambda m: m["robot"]["bodies"][2].update(mass=0.0)),
        r"header.task.robot.bodies\[2\].mass: must be a positive number, got 0",
    ),
    "loop": (in_task(lambda m: m["robot"]["bodies"][2].update(parent=2)), r"bodies\[2\].parent: .* \(no loops\)"),
    "half an interval": (
        in_task(lambda m: m["phases"][0].update(intervals=2.5)),
        "intervals: must be a whole number",
    ),
    "huge index": (
        in_task(lambda m: m["phases"][0]["contacts"][0].update(surface=2**40)),
        "surface: must be a whole number of 32 bits",
    ),
    "flat place": (
        in_task(lambda m: m["phases"][0]["contacts"][0].update(position_W=[1.0])),
        "position_W: needs at least 2 entries, got 1",
    ),
    "contact in the air": (
        in_task(lambda m: m["phases"][0]["contacts"][0].update(position_W=[0.0, 0.1])),
        r"header.task.phases\[0\].contacts\[0\].position: must lie on surface \"ground\"",
    ),
    "no durations": (without("durations"), "durations: is required"),
    "too few durations": (put("durations", lambda a: a[1:]), "durations: must have 3 entries, got 2"),
    "time runs back": (put("durations", lambda a: -a), r"durations\[0\]: must be a positive number"),
    "whole durations": (put("durations", lambda a: a.astype(int)), "durations: must hold floating-point numbers"),
    "text": (put("control_points", lambda a: a.astype(str)), "control_points: must hold floating-point numbers"),
    "flat joints": (put("control_points", lambda a: a.ravel()), "control_points: must have 2 axes, got 1"),
    "too few joints": (put("control_points", lambda a: a[1:]), "control_points: must be 9 x 13, got 8 x 13"),
    "half a base": (put("base_control_points", lambda a: np.zeros((2, 13))), "base_control_points: must be 3 x 13"),
    "a pickle": (put("weights", lambda a: a.astype(object)), "must be an .npz or .json file written by mcplan"),
    "weight missing": (put("weights", lambda a: a[1:]), r"weights: must have shape \(10,\), got \(9,\)"),
    "weight 0": (put("weights", lambda a: 0 * a), r"weights\[0\]\[0\]: must be a positive number"),
    "NaN": (put("control_points", lambda a: a * np.nan), "control_points: must be finite numbers"),
}


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_content_is_named(damage, plan, tmp_path):
    change, message = DAMAGE[damage]
    arrays = arrays_of(plan_to_bytes(plan))
    change(arrays)
    (tmp_path / "bad.npz").write_bytes(bytes_of(arrays))
    with pytest.raises(mp.errors.InvalidPlan, match=message) as found:
        load_whole_body_plan(tmp_path / "bad.npz")
    assert str(found.value).startswith(str(tmp_path / "bad.npz"))


def test_forces_of_the_wrong_shape_are_named():
    arrays = arrays_of(plan_to_bytes(given_forces()))
    arrays["force_polynomials"] = arrays["force_polynomials"][:3]
    with pytest.raises(mp.errors.InvalidPlan, match=r"force_polynomials: must have shape \(4, 208\), got \(3, 208\)"):
        plan_from_bytes(bytes_of(arrays))


def test_files_of_the_two_kinds_are_told_apart(plan, tmp_path):
    plan.save(tmp_path / "whole.npz")
    standing_plan().save(tmp_path / "centroidal.npz")
    assert isinstance(load_any_plan(tmp_path / "whole.npz"), mp.PlanarPlan)
    assert isinstance(load_any_plan(tmp_path / "centroidal.npz"), mp.Plan)
    with pytest.raises(
        mp.errors.InvalidPlan, match='header.kind: must be "whole_body": a plan of a planar robot, got none'
    ):
        mp.PlanarPlan.load(tmp_path / "centroidal.npz")
    with pytest.raises(
        mp.errors.InvalidPlan, match='header.kind: must be none: a plan of contacts and CoM, got "whole_body"'
    ):
        mp.Plan.load(tmp_path / "whole.npz")
    with pytest.raises(FileNotFoundError):
        load_any_plan(tmp_path / "none.npz")
    plan.save(tmp_path / "whole.json")
    standing_plan().save(tmp_path / "centroidal.json")
    assert isinstance(load_any_plan(tmp_path / "whole.json"), mp.PlanarPlan)
    assert isinstance(load_any_plan(tmp_path / "centroidal.json"), mp.Plan)
    with pytest.raises(
        mp.errors.InvalidPlan, match='kind: must be "planar_plan": a plan of a planar robot, got "plan"'
    ):
        mp.PlanarPlan.load(tmp_path / "centroidal.json")
    with pytest.raises(
        mp.errors.InvalidPlan, match='kind: must be "plan": a plan of contacts and CoM, got "planar_plan"'
    ):
        mp.Plan.load(tmp_path / "whole.json")


def test_tasks_come_back_exactly_from_json():
    for name in ("cartwheel", "climbing", "climbing_steep", "walking"):
        task = reference_task(name)
        task.surfaces[0].to = 3.5  # the other end stays open
        plain = json.loads(json.dumps(planar_task_to_plain(task), allow_nan=False))
        assert repr(planar_task_from_plain(plain)) == repr(task)


def test_the_command_checks_whole_body_plans(plan, tmp_path, capsys):
    target = tmp_path / "plan.npz"
    plan.save(target)
    assert main(["check", str(target)]) == 0
    assert capsys.readouterr().out.startswith(f"{target}: ok. Closest to its limit: ")
    plan.control_points[0, 3] += 0.05
    plan.save(target)
    assert main(["check", str(target), "--json"]) == 1
    report = json.loads(capsys.readouterr().out)
    assert (report["task"], report["robot"], report["ok"]) == ("cartwheel", "climber9", False)
    assert "drift" in {violation["name"] for violation in report["violations"]}
    assert len(report["constraints"]) == 16
