"""Videos of runs: as many pictures as asked for, not black, and the robot moves in them."""

import dataclasses
import importlib.util
import stat

import numpy as np
import pytest

import mcplan as mp
import recordings
from mcplan.errors import MissingExtra
from mcplan.view import save_video
from mcplan.view.video import files as video_files
from mcplan.view.video.files import find_ffmpeg, write_video
from mcplan.view.video.film import smoothed

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
Image = pytest.importorskip("PIL.Image")


def shortened(recording, until_s):
    n = int(np.sum(recording.times_s <= until_s + 1e-9))
    cut = {
        f.name: getattr(recording, f.name)[:n]
        for f in dataclasses.fields(recording)
        if isinstance(getattr(recording, f.name), np.ndarray) and f.name != "torque_limits"
    }
    return dataclasses.replace(recording, **cut)


@pytest.fixture(scope="module")
def recording():
    return shortened(recordings.walking(), 1.0)


def test_a_run_becomes_a_moving_picture(recording, tmp_path):
    done = []
    path = save_video(
        recording, tmp_path / "run.webp", size=(192, 108), rate_hz=5.0, progress=lambda n, of: done.append((n, of))
    )
    assert done == [(n, 6) for n in range(1, 7)]
    with Image.open(path) as video:
        assert (video.n_frames, video.size) == (6, (192, 108))
        pictures = []
        for n in range(6):
            video.seek(n)
            pictures.append(np.asarray(video.convert("RGB"), float))
    for picture in pictures:
        assert picture.mean() > 80 and picture.std() > 20
    # The robot stands in the middle of the picture, and moves; the corner above is sky, and does not.
    change = np.abs(pictures[-1] - pictures[0]).max(axis=2)
    assert (change[30:90, 60:132] > 60).sum() > 50
    assert change[:20, :40].max() < 20


@pytest.mark.parametrize(("suffix", "lasts_ms"), [("webp", 40), ("gif", 40)])
def test_animations_keep_their_frames_and_their_pace(tmp_path, suffix, lasts_ms):
    shades = [20, 90, 160, 230]
    frames = (np.full((32, 48, 3), shade, np.uint8) for shade in shades)
    write_video(frames, tmp_path / f"run.{suffix}", 25.0)
    with Image.open(tmp_path / f"run.{suffix}") as video:
        for n, shade in enumerate(shades):
            video.seek(n)
            assert np.asarray(video.convert("RGB"), float).mean() == pytest.approx(shade, abs=6)
            assert video.info["duration"] == lasts_ms
        assert video.n_frames == len(shades)


def test_frames_arrive_at_ffmpeg_whole_and_in_order(tmp_path, monkeypatch):
    program = tmp_path / "ffmpeg"
    program.write_text('#!/bin/sh\nfor last; do :; done\necho "$@" >"$(dirname "$0")/arguments"\ncat >"$last"\n')
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    frames = np.random.default_rng(5).integers(0, 255, (7, 12, 16, 3), np.uint8)
    write_video(iter(frames), tmp_path / "run.mp4", 25.0)
    assert (tmp_path / "run.mp4").read_bytes() == frames.tobytes()
    assert "-s 16x12 -r 25" in (tmp_path / "arguments").read_text()


def test_what_ffmpeg_says_is_told_when_it_fails(tmp_path, monkeypatch):
    program = tmp_path / "ffmpeg"
    program.write_text("#!/bin/sh\necho 'Unknown encoder libx264' >&2\nexit 1\n")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    frames = np.zeros((50, 200, 320, 3), np.uint8)
    with pytest.raises(RuntimeError, match=r"wrote no run\.mp4: Unknown encoder libx264"):
        write_video(iter(frames), tmp_path / "run.mp4", 25.0)


@pytest.mark.skipif(find_ffmpeg() is None, reason="no ffmpeg: an extra of its own")
def test_an_mp4_is_one(recording, tmp_path):
    path = save_video(recording, tmp_path / "run.mp4", size=(192, 108), rate_hz=5.0)
    assert path.read_bytes()[4:8] == b"ftyp"


def test_without_ffmpeg_it_is_told_what_to_install(tmp_path, monkeypatch, recording):
    monkeypatch.setattr(video_files, "find_ffmpeg", lambda: None)
    with pytest.raises(MissingExtra) as error:
        save_video(recording, tmp_path / "run.mp4")
    assert str(error.value).startswith("run.mp4 needs ffmpeg: pip install 'mcplan[video]' or apt-get install ffmpeg")


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("run.avi", {}, 'video: must end in .mp4, .webp or .gif, got "'),
        ("run", {}, "video: must end in"),
        ("nowhere/run.gif", {}, "video: must lie in a folder that exists"),
        ("run.gif", {"size": (641, 360)}, "size: must be even, 16 to 8192 pixels, got 641x360"),
        ("run.gif", {"rate_hz": 0.0}, "rate_hz: must lie in 1 to 120, got 0"),
    ],
)
def test_bad_requests_are_named_before_anything_is_rendered(recording, tmp_path, name, options, message):
    with pytest.raises(mp.InvalidInput) as error:
        save_video(recording, tmp_path / name, **options)
    assert message in str(error.value)


def test_the_camera_keeps_a_steady_pace_and_loses_the_sway():
    times = np.arange(0.0, 8.0, 0.04)
    way = np.column_stack([0.3 * times, 0.05 * np.sin(2 * np.pi * times / 0.8), np.full(len(times), 0.9)])
    calm = smoothed(way, 25.0)
    inner = slice(60, -60)
    assert calm[inner, 0] == pytest.approx(way[inner, 0], abs=1e-6)
    assert np.abs(calm[inner, 1]).max() < 1e-3
    assert calm[:, 2] == pytest.approx(0.9)


@pytest.mark.parametrize("hidden", ["mujoco", "OpenGL"])
def test_what_is_not_installed_is_named(recording, tmp_path, monkeypatch, hidden):
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *rest: None if name == hidden else find(name, *rest))
    with pytest.raises(MissingExtra) as error:
        save_video(recording, tmp_path / "run.webp")
    assert str(error.value) == f"rendering a run needs {hidden}: pip install 'mcplan[sim]'"
