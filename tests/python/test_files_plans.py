"""mcplan.files.plans: a plan comes back as it was, and a damaged file is rejected with a name for the damage."""

from __future__ import annotations

import copy
import io
import json
import os
import pickle
import re
import stat

import numpy as np
import pytest

import mcplan as mp
from mcplan.files import plans
from mcplan.files.plans import load_plan, plan_from_bytes, plan_to_bytes
from mcplan.files.whole_body_plans import load_any_plan
from mcplan.showing import load
from standing import standing_plan
from stepping import stepping_plan
from turning import turning_plan


@pytest.fixture
def plan() -> mp.Plan:
    return standing_plan()


def arrays_of(data: bytes) -> dict:
    with np.load(io.BytesIO(data), allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def bytes_of(arrays: dict) -> bytes:
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def states(plan: mp.Plan) -> list:
    return [repr(plan.at(t)) for t in np.linspace(0.0, plan.duration(), 7)]


def test_a_plan_comes_back_exactly(plan, tmp_path):
    plan.phases[1].duration = 1 / 3
    plan.knots[2].com_velocity_W[1] = 1e-17
    plan.save(tmp_path / "plan.npz")
    for other in (mp.Plan.load(tmp_path / "plan.npz"), pickle.loads(pickle.dumps(plan)), copy.deepcopy(plan)):
        assert states(other) == states(plan)
        assert repr(other.scene) == repr(plan.scene) and repr(other.robot) == repr(plan.robot)
        assert repr(other.swings) == repr(plan.swings) and other.final_contacts == plan.final_contacts
        assert other.planner == "by hand"
        assert plan_to_bytes(other) == plan_to_bytes(plan)


@pytest.mark.parametrize("ending", [".npz", ".json"])
def test_a_scene_or_robot_without_a_name_comes_back_with_the_plan(ending, plan, tmp_path):
    scene, robot = plan.scene, plan.robot
    scene.name = robot.name = ""  # what a scene built in code has that was given none
    plan.scene, plan.robot = scene, robot
    plan.save(tmp_path / f"plan{ending}")
    loaded = mp.Plan.load(tmp_path / f"plan{ending}")
    assert (loaded.scene.name, loaded.robot.name) == ("", "")


@pytest.mark.parametrize("make", [standing_plan, stepping_plan, turning_plan])
def test_a_plan_comes_back_exactly_from_json(make, tmp_path):
    plan = make()
    plan.knots[1].com_velocity_W[1] = 1 / 3
    plan.save(tmp_path / "plan.json")
    for other in (mp.Plan.load(tmp_path / "plan.json"), load_any_plan(tmp_path / "plan.json")):
        assert other == plan and states(other) == states(plan)
        assert plan_to_bytes(other) == plan_to_bytes(plan)
    header = json.loads((tmp_path / "plan.json").read_text())
    assert (header["kind"], header["format"], header["mcplan"]) == ("plan", 4, mp.__version__)
    assert header["knots"][1]["com_velocity_W"][1] == 1 / 3


@pytest.mark.parametrize("name", ["plan.npz", "plan.json"])
def test_a_limit_that_is_infinite_about_one_axis_comes_back(name, plan, tmp_path):
    limb = mp.load_robot("g1").end_effectors[0].limb
    limb.hip_torque = [81.0, np.inf]
    ends = plan.robot.end_effectors
    place = np.array([0.0, 0.0, plan.robot.com_height + ends[0].nominal_B[2]])
    limb.hip_B, limb.ankle = ends[0].nominal_B + [0.0, 0.0, 0.5 * (limb.upper + limb.lower)] + place, np.zeros(3)
    ends[0].limb = limb
    plan.robot.end_effectors = ends
    plan.robot.validate()
    file = tmp_path / name
    plan.save(file)
    assert load(file).robot == plan.robot


def test_how_long_a_swing_is_under_way_comes_back(tmp_path):
    plan = stepping_plan()
    assert "swing_elapsed_s" not in arrays_of(plan_to_bytes(plan))
    plan.swings[0].first_phase, plan.swings[0].elapsed_s = 0, 1 / 3
    for name in ("plan.npz", "plan.json"):
        plan.save(tmp_path / name)
        assert mp.Plan.load(tmp_path / name) == plan
    arrays = arrays_of(plan_to_bytes(plan))
    del arrays["swing_elapsed_s"]  # as older versions write plans
    assert all(swing.elapsed_s == 0.0 for swing in plan_from_bytes(bytes_of(arrays)).swings)


def test_a_damaged_plan_in_json_is_named_with_its_file(plan, tmp_path):
    file = tmp_path / "plan.json"
    plan.save(file)
    file.write_text(re.sub('"gravity": [0-9.]+', '"gravity": "x"', file.read_text()))
    with pytest.raises(mp.errors.InvalidPlan) as found:
        mp.Plan.load(file)
    assert str(found.value) == f'{file}: scene.gravity: must be a number, got "x"'


def test_a_plan_in_json_has_each_key_once(plan, tmp_path):
    file = tmp_path / "plan.json"
    plan.save(file)
    file.write_text(re.sub(r'("gravity": [0-9.]+)', r"\1, \1", file.read_text()))
    with pytest.raises(mp.errors.InvalidPlan, match='must be JSON, got the key "gravity" twice'):
        mp.Plan.load(file)


@pytest.mark.parametrize("load", [mp.Plan.load, load_any_plan, load])
def test_a_plan_in_json_may_begin_with_a_byte_order_mark(plan, tmp_path, load):
    for name in ("plan.json", "plan"):
        plan.save(tmp_path / "plan.json")
        (tmp_path / name).write_bytes(b"\xef\xbb\xbf" + (tmp_path / "plan.json").read_bytes())
        assert load(tmp_path / name) == plan


@pytest.mark.parametrize("load", [mp.Plan.load, load_any_plan, load])
@pytest.mark.parametrize(
    ("content", "says"),
    [
        ("", "must be JSON, got parse error at line 1, column 1: "),
        (" \n", "must be JSON, got parse error at line 2, column 1: "),
        ("[1, 2]", "must be a JSON object, got "),
        ("7", "must be a JSON object, got 7"),
        ("[" + "0," * 2_000_000 + "0]", "may have 2000000 values at most, got more"),
    ],
)
def test_a_file_with_the_ending_of_json_is_refused_as_json(content, says, tmp_path, load):
    file = tmp_path / "plan.json"
    file.write_text(content)
    with pytest.raises(mp.InvalidInput) as found:
        load(file)
    assert str(found.value).startswith(f"{file}: {says}"), found.value


def test_an_archive_is_read_whatever_its_ending(plan, tmp_path):
    plan.save(tmp_path / "plan.npz")
    (tmp_path / "plan.npz").rename(tmp_path / "plan.json")
    assert mp.Plan.load(tmp_path / "plan.json") == plan


def test_a_deep_copy_shares_nothing(plan):
    other = copy.deepcopy(plan)
    other.knots[0].com_W[0] = 5.0
    other.scene.surfaces[0].vertices_W[0] = [9.0, 9.0, 9.0]
    assert plan.knots[0].com_W[0] == 0.0
    assert plan.scene.surfaces[0].vertices_W[0, 0] == -1.0


def test_the_header_says_what_it_holds(plan):
    header = json.loads(arrays_of(plan_to_bytes(plan))["header"].tobytes())
    assert header["format"] == 1 and header["mcplan"] == mp.__version__
    assert "m, kg, s" in header["units"]
    assert header["scene"]["name"] == "flat" and header["robot"]["mass"] == 44.0


def test_saving_replaces_the_file_at_once_and_leaves_nothing_else(plan, tmp_path):
    target = tmp_path / "no_ending"
    target.write_text("old")
    plan.save(target)
    assert [path.name for path in tmp_path.iterdir()] == ["no_ending"]
    assert load_plan(target).duration() == plan.duration()
    umask = os.umask(0)
    os.umask(umask)
    assert stat.S_IMODE(target.stat().st_mode) == 0o666 & ~umask


def test_an_invalid_plan_is_not_saved(plan, tmp_path):
    target = tmp_path / "plan.npz"
    target.write_text("old")
    plan.knots[1].com_W[0] = np.nan
    with pytest.raises(mp.errors.InvalidPlan, match=r"knots\[1\]"):
        plan.save(target)
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["plan.npz"]


def test_every_truncation_is_rejected(plan, tmp_path):
    data = plan_to_bytes(plan)
    for length in [0, 1, 100, *range(0, len(data), len(data) // 40), len(data) - 1]:
        (tmp_path / "cut.npz").write_bytes(data[:length])
        with pytest.raises(mp.errors.InvalidPlan, match=r"cut.npz: must be an .npz or .json file written by mcplan"):
            load_plan(tmp_path / "cut.npz")


def test_flipped_bytes_never_crash(plan, tmp_path):
    data = plan_to_bytes(plan)
    rng = np.random.default_rng(0)
    for _ in range(300):
        damaged = bytearray(data)
        for position in rng.integers(0, len(data), 3):
            damaged[position] ^= int(rng.integers(1, 256))
        (tmp_path / "bad.npz").write_bytes(damaged)
        try:
            load_plan(tmp_path / "bad.npz")  # a flip may hit bytes that nobody reads
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


DAMAGE = {
    "no header": (without("header"), "an archive without `header`"),
    "header no JSON": (put("header", lambda a: a[:-1]), "header: must be JSON"),
    "header a list": (
        put("header", lambda a: np.frombuffer(b"[]", np.uint8)),
        "header: must be a JSON object",
    ),
    "future format": (header(format=4), r"header.format: must be 1, 2 or 3 for this version of mcplan, got 4"),
    "no format": (header(format=None), "header.format: must be 1"),
    "format a list": (header(format=[1]), "header.format: must be 1"),
    "format true": (header(format=True), "header.format: must be 1, 2 or 3"),
    "points promised": (header(format=2), "laws: is required"),
    "wrenches promised": (header(format=3), "laws: is required"),
    "planner a number": (header(planner=1), "header.planner: must be a string, got 1"),
    "scene a list": (header(scene=[]), r"header.scene: must be an object, got \[\]"),
    "scene broken": (header(scene={"name": "x"}), "header.scene.surfaces: is required"),
    "robot broken": (header(robot={"mass": -1}), "header.robot.mass: must be a positive number"),
    "no durations": (without("durations"), "durations: is required"),
    "no swings": (without("swings"), "swings: is required"),
    "too few knots": (put("com_W", lambda a: a[:-1]), r"com_W: must have shape \(4, 3\), got \(3, 3\)"),
    "points of two": (put("anchors_W", lambda a: a[..., :2]), "anchors_W: must have shape"),
    "too many ends": (put("surfaces", lambda a: np.hstack([a, a])), "surfaces: must have shape"),
    "whole durations": (
        put("durations", lambda a: a.astype(int)),
        "durations: must hold floating-point numbers",
    ),
    "broken surfaces": (put("surfaces", lambda a: a + 0.5), "surfaces: must hold integers"),
    "text": (put("com_W", lambda a: a.astype(str)), "com_W: must hold floating-point numbers"),
    "a pickle": (put("com_W", lambda a: a.astype(object)), "must be an .npz or .json file written by mcplan"),
    "surface too large": (put("surfaces", lambda a: a + 99), r"surface"),
    "64 bit surface": (
        put("surfaces", lambda a: a.astype(np.int64) + 2**40),
        "surfaces: must hold numbers of 32 bits",
    ),
    "final contact": (put("final_contacts", lambda a: a + 99), "final_contacts"),
    "swing of nobody": (put("swings", lambda a: a + 99), "swings"),
    "NaN": (put("stiffness", lambda a: a * np.nan), "must be finite numbers"),
    "time runs back": (put("durations", lambda a: -a), "duration"),
}


POINT_DAMAGE = {
    "no laws": (without("laws"), "laws: is required"),
    "no points": (without("points_W"), "points_W: is required"),
    "unknown law": (put("laws", lambda a: a + 2), r"laws: must lie in \[0, 2\], got [34]"),
    "negative intervals": (put("intervals", lambda a: -a), r"intervals: must lie in \[0, 100000\]"),
    "many intervals": (put("intervals", lambda a: a * 10**8), r"intervals: must lie in \[0, 100000\]"),
    "more intervals": (put("intervals", lambda a: a + 1), r"point_forces_W: must have the \d+ rows that point_counts"),
    "no intervals": (
        lambda arrays: arrays.update(intervals=0 * arrays["intervals"], laws=0 * arrays["laws"] + 1),
        "point_forces_W: must have the 0 rows",
    ),
    "negative points": (put("point_counts", lambda a: -a), r"point_counts: must lie in"),
    "more points": (put("point_counts", lambda a: a + 1), r"points_W: must have the \d+ rows that point_counts imply"),
    "points of two": (put("points_W", lambda a: a[:, :2]), r"points_W: must have shape"),
    "flat points": (put("points_W", lambda a: a.ravel()), r"points_W: must have shape"),
    "one number": (put("points_W", lambda a: a[0, 0]), r"points_W: must have shape"),
    "half a count": (put("point_counts", lambda a: a + 0.5), "point_counts: must hold integers"),
    "infinite force": (put("point_forces_W", lambda a: a * np.inf), "must be finite numbers"),
    "infinite momentum": (put("angular_momentum_W", lambda a: a + np.inf), "must be finite numbers"),
    "free foot with points": (put("surfaces", lambda a: a * 0 - 1), "points: must be none at a free end-effector"),
    "stiff": (put("stiffness", lambda a: a + 1.0), "stiffness: must be 0 where forces act at points"),
}


@pytest.mark.parametrize("damage", POINT_DAMAGE)
def test_damaged_forces_at_points_are_named(damage, tmp_path):
    change, message = POINT_DAMAGE[damage]
    arrays = arrays_of(plan_to_bytes(stepping_plan()))
    change(arrays)
    (tmp_path / "bad.npz").write_bytes(bytes_of(arrays))
    with pytest.raises(mp.errors.InvalidPlan, match=message) as found:
        load_plan(tmp_path / "bad.npz")
    assert str(found.value).startswith(str(tmp_path / "bad.npz"))


def test_forces_at_points_come_back_exactly(tmp_path):
    plan = stepping_plan()
    plan.phases[1].contacts[0].point_forces_W[3, 1] = 1 / 3
    plan.save(tmp_path / "plan.npz")
    for other in (mp.Plan.load(tmp_path / "plan.npz"), pickle.loads(pickle.dumps(plan)), copy.deepcopy(plan)):
        assert states(other) == states(plan)
        assert repr(other.phases) == repr(plan.phases) and repr(other.knots) == repr(plan.knots)
        assert other.open_end and plan_to_bytes(other) == plan_to_bytes(plan)
    assert json.loads(arrays_of(plan_to_bytes(plan))["header"].tobytes())["format"] == 2


WRENCH_DAMAGE = {
    "no centres": (without("centers_of_pressure_W"), "centers_of_pressure_W: is required"),
    "no headings": (without("end_effector_yaw"), "end_effector_yaw: is required"),
    "no momentum": (without("angular_momentum_W"), "angular_momentum_W: is required"),
    "unknown law": (put("laws", lambda a: a + 1), r"laws: must lie in \[0, 3\], got 4"),
    "law of a later format": (header(format=2), r"laws: must lie in \[0, 2\], got 3"),
    "centres of two": (put("centers_of_pressure_W", lambda a: a[..., :2]), "centers_of_pressure_W: must have shape"),
    "too few headings": (
        put("end_effector_yaw", lambda a: a[:, :2]),
        r"end_effector_yaw: must have shape \(5, 4\), got \(5, 2\)",
    ),
    "headings of some": (put("end_effector_yaw", lambda a: a[:-1]), "end_effector_yaw: must have shape"),
    "whole headings": (put("end_effector_yaw", lambda a: a.astype(int)), "end_effector_yaw: must hold floating-point"),
    "infinite centre": (
        put("centers_of_pressure_W", lambda a: a + np.inf),
        r"phases\[0\].contacts\[0\]: must be finite",
    ),
    "infinite heading": (put("end_effector_yaw", lambda a: a + np.inf), r"knots\[0\]: must be finite numbers"),
    "intervals": (put("intervals", lambda a: a + 1), r"phases\[0\].intervals: must be 0"),
    "centres of points": (put("laws", lambda a: a - 3 + 2 * (a == 3)), r"intervals: must lie in \[1, 100000\]"),
}


@pytest.mark.parametrize("damage", WRENCH_DAMAGE)
def test_damaged_contact_wrenches_are_named(damage, tmp_path):
    change, message = WRENCH_DAMAGE[damage]
    arrays = arrays_of(plan_to_bytes(turning_plan()))
    change(arrays)
    (tmp_path / "bad.npz").write_bytes(bytes_of(arrays))
    with pytest.raises(mp.errors.InvalidPlan, match=message) as found:
        load_plan(tmp_path / "bad.npz")
    assert str(found.value).startswith(str(tmp_path / "bad.npz"))


def format_of(plan: mp.Plan) -> int:
    return json.loads(arrays_of(plan_to_bytes(plan))["header"].tobytes())["format"]


@pytest.mark.parametrize("headings", [True, False])
def test_contact_wrenches_come_back_exactly(headings, tmp_path):
    plan = turning_plan()
    plan.phases[1].contacts[0].center_of_pressure_W[1] = 1 / 3
    for k, knot in enumerate(plan.knots):
        knot.end_effector_yaw = [0.1, 0.2, 0.3 * k, 1 / 3] if headings else []
    plan.robot.end_effectors[0].yaw_range = [-0.5, 0.25]
    plan.save(tmp_path / "plan.npz")
    for other in (mp.Plan.load(tmp_path / "plan.npz"), pickle.loads(pickle.dumps(plan)), copy.deepcopy(plan)):
        assert states(other) == states(plan)
        assert repr(other.phases) == repr(plan.phases) and repr(other.knots) == repr(plan.knots)
        assert repr(other.robot) == repr(plan.robot) and plan_to_bytes(other) == plan_to_bytes(plan)
    assert format_of(plan) == 3


def plan_under(law: mp.model.ForceLaw) -> mp.Plan:
    """A plan whose first phase is under a law."""
    if law == mp.model.ForceLaw.pendulum:
        return standing_plan()
    if law == mp.model.ForceLaw.wrench:
        return turning_plan()
    plan = stepping_plan()
    first = plan.phases[0]
    first.law = law
    for contact in first.contacts:  # held forces have one node less
        contact.point_forces_W = contact.point_forces_W[: first.node_count() * len(contact.points_W)]
    return plan


def test_files_number_laws_in_their_order_in_the_enum():
    """Numbers of files that exist: a new law stands behind these."""
    assert list(mp.model.ForceLaw.__members__)[:4] == ["pendulum", "held", "linear", "wrench"]
    assert list(plans._LAWS) == list(mp.model.ForceLaw.__members__.values())
    assert [int(law) for law in plans._LAWS] == list(range(len(plans._LAWS)))
    first = list(plans._FORMAT_OF_LAW.values())
    assert first == sorted(first) and set(first) <= set(plans.FORMATS)


@pytest.mark.parametrize("name", mp.model.ForceLaw.__members__)
@pytest.mark.parametrize("ending", ["npz", "json"])
def test_a_phase_of_every_law_passes_through_a_file_unchanged(name, ending, tmp_path):
    law = mp.model.ForceLaw.__members__[name]
    plan = plan_under(law)
    plan.phases[0].duration += 1 / 3e6
    plan.save(tmp_path / f"plan.{ending}")
    (tmp_path / "again").mkdir()
    other = mp.Plan.load(tmp_path / f"plan.{ending}")
    other.save(tmp_path / "again" / f"plan.{ending}")
    phase = other.phases[0]
    assert phase == plan.phases[0] and other == plan and states(other) == states(plan)
    assert (phase.law, phase.intervals) == (law, plan.phases[0].intervals)
    assert (tmp_path / "again" / f"plan.{ending}").read_bytes() == (tmp_path / f"plan.{ending}").read_bytes()


def test_a_phase_says_what_its_law_has():
    has = {law: mp.model.Phase(law=law, intervals=3) for law in mp.model.ForceLaw.__members__.values()}
    assert [phase.has_points for phase in has.values()] == [False, True, True, False]
    assert [phase.has_momentum for phase in has.values()] == [False, True, True, True]
    assert [phase.has_wrenches for phase in has.values()] == [False, False, False, True]
    assert [phase.node_count() for phase in has.values()] == [0, 3, 4, 0]


def test_a_number_that_no_law_has_is_refused():
    phase = mp.model.Phase()
    for wrong in ("held", 1):
        with pytest.raises(TypeError):
            phase.law = wrong
    assert phase.law == mp.model.ForceLaw.pendulum


def test_a_plan_is_written_in_the_least_format_that_holds_it(plan):
    assert [format_of(plan), format_of(stepping_plan()), format_of(turning_plan())] == [1, 2, 3]
    headed, pressed, spinning = (copy.deepcopy(plan) for _ in range(3))
    for knot in headed.knots:
        knot.end_effector_yaw = [0.0] * 4
    pressed.phases[0].contacts[0].center_of_pressure_W = [0.0, -0.1, 0.0]
    spinning.knots[1].angular_momentum_W = [0.0, 0.0, 1.0]
    assert [format_of(headed), format_of(pressed), format_of(spinning)] == [3, 3, 2]
    again = plan_from_bytes(plan_to_bytes(headed))
    assert again.knots[2].end_effector_yaw == (0.0, 0.0, 0.0, 0.0) and again.phases[0].law == mp.model.ForceLaw.pendulum
    assert plan_from_bytes(plan_to_bytes(pressed)).phases[0].contacts[0].center_of_pressure_W.tolist() == [0, -0.1, 0]


def test_a_plan_with_a_heading_for_some_soles_alone_is_not_saved(tmp_path):
    plan = turning_plan()
    plan.knots[2].end_effector_yaw = [0.0, 0.0]
    with pytest.raises(mp.errors.InvalidPlan, match=r"knots\[2\].end_effector_yaw: must be one per end-effector"):
        plan.save(tmp_path / "plan.npz")


def test_files_from_before_there_were_points_still_load(plan):
    arrays = arrays_of(plan_to_bytes(plan))
    data = json.loads(arrays["header"].tobytes())
    assert data.pop("open_end") is False and data["format"] == 1  # what the first version did not write
    arrays["header"] = np.frombuffer(json.dumps(data).encode(), np.uint8)
    other = plan_from_bytes(bytes_of(arrays))
    assert states(other) == states(plan) and not other.open_end


@pytest.mark.parametrize("damage", DAMAGE)
def test_damaged_content_is_named(damage, plan, tmp_path):
    change, message = DAMAGE[damage]
    arrays = arrays_of(plan_to_bytes(plan))
    change(arrays)
    (tmp_path / "bad.npz").write_bytes(bytes_of(arrays))
    with pytest.raises(mp.errors.InvalidPlan, match=message) as found:
        load_plan(tmp_path / "bad.npz")
    assert str(found.value).startswith(str(tmp_path / "bad.npz"))


def test_pickles_in_a_plan_file_are_never_run(plan, tmp_path):
    class Bomb:
        def __reduce__(self):
            return (open, (str(tmp_path / "run"), "w"))

    arrays = arrays_of(plan_to_bytes(plan))
    arrays["com_W"] = np.array([Bomb()], dtype=object)
    (tmp_path / "bad.npz").write_bytes(bytes_of(arrays))
    with pytest.raises(mp.errors.InvalidPlan):
        load_plan(tmp_path / "bad.npz")
    assert not (tmp_path / "run").exists()


def test_a_missing_file_is_no_invalid_plan(tmp_path):
    with pytest.raises(FileNotFoundError):
        load_plan(tmp_path / "none.npz")


@pytest.mark.parametrize("kind", [mp.Plan, mp.PlanarPlan])
def test_what_is_no_path_is_refused_by_its_name(kind):
    for given, text in ((5, "5"), (None, "None"), (b"x.npz", "b'x.npz'"), (["x.npz"], "a list")):
        for call in (lambda given=given: kind.load(given), lambda given=given: kind.save(kind(), given)):
            with pytest.raises(mp.errors.InvalidArgument) as found:
                call()
            assert (found.value.field, found.value.rule, found.value.value) == ("path", "must be a path", text)


def test_names_that_no_file_can_have_are_refused(tmp_path):
    plan = standing_plan()
    for call in (plan.save, mp.Plan.load):
        with pytest.raises(mp.errors.InvalidInput, match="path: must have no null character"):
            call("\0.npz")
    with pytest.raises(mp.errors.InvalidInput, match="path: must be that of a file, not of a folder"):
        plan.save(f"{tmp_path}/x.npz/")
    assert not list(tmp_path.iterdir())
