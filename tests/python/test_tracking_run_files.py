"""Files of runs: all comes back, and what is no such file is told apart."""

from __future__ import annotations

import dataclasses
import json

import numpy as np
import pytest

import mcplan as mp
import recordings
import tracked_cartwheel
from mcplan.files.plans import plan_to_bytes
from mcplan.files.whole_body_plans import plan_to_bytes as planar_bytes
from mcplan.planar.tracking import PlanarMeasures, PlanarResult
from mcplan.tracking import Options, Push, Recording, TrackingResult
from mcplan.tracking.options import Gains
from mcplan.tracking.touches import Touch

pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")


@pytest.fixture(scope="module")
def result() -> TrackingResult:
    options = Options(pushes=(Push(40.0, 0.2, 0.8),), seed=3, mass_scale=1.07, gains=Gains(com_kp=50.0))
    robot = mp.load_robot("talos")
    ends = robot.end_effectors
    ends[0].limb.hip_torque = [81.0, np.inf]  # no limit about one axis
    robot.end_effectors = ends
    recording = dataclasses.replace(recordings.walking(), robot=robot, fell_at_s=2.5)
    return TrackingResult(recording, recordings.measures(fell=True, com_rms_m=float("nan")), options, True)


def same_columns(a, b) -> int:
    """Number of arrays of two recordings, all of which are equal."""
    arrays = [f.name for f in dataclasses.fields(a) if isinstance(getattr(a, f.name), np.ndarray)]
    for name in arrays:
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=name)
        assert getattr(a, name).dtype == getattr(b, name).dtype, name
    return len(arrays)


def test_a_run_comes_back_as_it_was(result, tmp_path):
    result.save(tmp_path / "run.npz")
    back = TrackingResult.load(tmp_path / "run.npz")
    assert same_columns(result.recording, back.recording) == 19
    assert (back.recording.joints, back.recording.fell_at_s) == (result.recording.joints, 2.5)
    assert plan_to_bytes(back.recording.plan) == plan_to_bytes(result.recording.plan)
    assert repr(back.recording.robot) == repr(result.recording.robot)
    assert (back.options, back.interrupted) == (result.options, True)
    assert back.measures.fell and np.isnan(back.measures.com_rms_m)
    assert back.measures.com_max_m == result.measures.com_max_m


def test_earlier_names_are_those_of_files_and_of_attributes(result, tmp_path):
    result.save(tmp_path / "run.npz")
    with np.load(tmp_path / "run.npz") as arrays:
        np.testing.assert_array_equal(arrays["ends_W"], result.recording.end_effectors_W)
        np.testing.assert_array_equal(arrays["ends_plan_W"], result.recording.end_effectors_plan_W)
    run = result.recording
    assert run.ends_W is run.end_effectors_W and run.ends_plan_W is run.end_effectors_plan_W
    assert run.body is run.simulated_robot is run.robot


def test_measures_of_a_planar_run_are_read_by_earlier_names():
    result = tracked_cartwheel.tracked()
    measures, run = result.measures, result.recording
    earlier = measures.as_dict()
    assert earlier.pop("force_rms_end_effectors") == earlier["force_rms_ends"] == measures.force_rms_ends
    assert earlier.pop("torque_feedback_ratio") == earlier["torque_feedback_share"] == measures.torque_feedback_share
    assert PlanarMeasures.from_dict(earlier) == PlanarMeasures.from_dict(measures.as_dict()) == measures
    assert run.ends == run.end_effectors


def test_one_that_did_not_fall_has_no_time_of_it(result, tmp_path):
    stood = dataclasses.replace(result, recording=dataclasses.replace(result.recording, fell_at_s=np.inf, robot=None))
    stood.save(tmp_path / "run.npz")
    back = Recording.load(tmp_path / "run.npz")
    assert back.fell_at_s == np.inf and back.robot is None and back.simulated_robot.name == "talos"


def test_a_planar_run_comes_back_as_it_was(tmp_path):
    result = tracked_cartwheel.tracked()
    result.save(tmp_path / "run.npz")
    back = PlanarResult.load(tmp_path / "run.npz")
    assert same_columns(result.recording, back.recording) > 15
    assert planar_bytes(back.recording.plan) == planar_bytes(result.recording.plan)
    assert (back.measures, back.options, back.interrupted) == (result.measures, result.options, False)
    assert (back.recording.joints, back.recording.end_effectors) == (
        result.recording.joints,
        result.recording.end_effectors,
    )
    assert back.recording.left_plan_at_s == np.inf


def test_kinds_are_told_apart(result, tmp_path):
    planar, plan = tmp_path / "planar.npz", tmp_path / "plan.npz"
    tracked_cartwheel.tracked().save(planar)
    result.recording.plan.save(plan)
    with pytest.raises(mp.InvalidInput, match=r"planar.npz: header.kind: must be that of a robot with a URDF"):
        TrackingResult.load(planar)
    with pytest.raises(mp.InvalidInput, match=r"plan.npz: header.kind: must be \"run\" or \"planar_run\""):
        Recording.load(plan)
    result.save(plan)
    with pytest.raises(mp.InvalidInput, match="header.kind: must be that of a planar robot"):
        PlanarResult.load(plan)


def changed(path, header=None, **arrays):
    """The file with other values in its header, or other arrays; None: without."""
    with np.load(path) as archive:
        content = {name: archive[name] for name in archive.files}
    data = {**json.loads(content["header"].tobytes()), **(header or {})}
    content["header"] = np.frombuffer(json.dumps(data).encode(), np.uint8)
    content = {name: value for name, value in {**content, **arrays}.items() if value is not None}
    np.savez(path, **content)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"header": {"format": 2}}, "header.format: must be 1 for this version of mcplan, got 2"),
        ({"header": {"measures": {"fell": True}}}, "header: must be as mcplan track --save writes it"),
        ({"header": {"options": None}}, "header: must be as mcplan track --save writes it"),
        ({"torques": None}, "torques: is required"),
        ({"com_W": np.zeros((3, 3))}, "com_W: must have 301 rows, got 3"),
        ({"plan": np.zeros(9, np.uint8)}, "must be an .npz or .json file written by mcplan"),
    ],
)
def test_damaged_files_are_told_by_their_field(result, tmp_path, change, message):
    path = tmp_path / "run.npz"
    result.save(path)
    changed(path, **change)
    with pytest.raises(mp.InvalidInput) as found:
        TrackingResult.load(path)
    assert str(found.value).startswith(f"{path}: ") and message in str(found.value)
    path.write_bytes(path.read_bytes()[:1000])
    with pytest.raises(mp.InvalidInput, match="must be an .npz or .json file written by mcplan"):
        TrackingResult.load(path)


def test_touches_come_back_and_files_of_earlier_versions_have_none(result, tmp_path):
    touches = (
        Touch(("hand", "thigh"), False, 0.1, 0.2, 0.002, 40.0),
        Touch(("shin", "tread"), True, 0.3, 0.3, 0.0, 1.0),
    )
    changed = dataclasses.replace(result, recording=dataclasses.replace(result.recording, touches=touches))
    changed.save(tmp_path / "run.npz")
    assert TrackingResult.load(tmp_path / "run.npz").recording.touches == touches
    with np.load(tmp_path / "run.npz") as file:
        arrays = dict(file)
    header = json.loads(arrays.pop("header").tobytes())
    arrays.pop("velocity_limits")
    header.pop("touches")
    for name in (
        "speed_limits",
        "self_contacts",
        "torque_delay_s",
        "torque_bandwidth_hz",
        "sensor_noise",
        "noise_seed",
    ):
        header["options"].pop(name)
    for name in ("velocity_use", "self_contacts", "terrain_contacts"):
        header["measures"].pop(name)
    arrays["header"] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    np.savez(tmp_path / "earlier.npz", **arrays)
    back = TrackingResult.load(tmp_path / "earlier.npz")
    assert back.recording.touches == () and back.recording.velocity_limits.size == 0
    # Such a run had full torque at every speed, and links passed through each other.
    assert not back.options.speed_limits and not back.options.self_contacts
    assert np.isnan(back.measures.velocity_use) and back.measures.self_contacts is None
    assert "no limits are known" in str(back)
