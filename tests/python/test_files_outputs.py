"""mcplan.files.outputs: whole or not at all, never in the place of something else, errors that name the file."""

from __future__ import annotations

import os
import stat
import threading
from pathlib import Path

import pytest

import mcplan as mp
from mcplan.errors import InvalidArgument, InvalidInput
from mcplan.files.outputs import require_folder, require_target, whole_file, write_whole
from standing import standing_plan


def names(folder: Path) -> list[str]:
    return sorted(os.listdir(folder))


@pytest.mark.parametrize("raised", [ValueError, KeyboardInterrupt, SystemExit, MemoryError])
def test_what_fails_half_way_leaves_the_old_file_and_nothing_else(tmp_path, raised):
    target = tmp_path / "page.html"
    target.write_text("old")
    with pytest.raises(raised), whole_file(target) as temporary:
        temporary.write_text("half")
        raise raised
    assert target.read_text() == "old" and names(tmp_path) == ["page.html"]


def test_what_writes_by_name_finds_the_targets_ending_and_folder(tmp_path):
    with whole_file(tmp_path / "run.mp4") as temporary:
        assert temporary.suffix == ".mp4" and temporary.parent == tmp_path
        temporary.write_bytes(b"video")
    assert (tmp_path / "run.mp4").read_bytes() == b"video" and names(tmp_path) == ["run.mp4"]


@pytest.mark.parametrize("umask", [0o022, 0o077, 0o002])
def test_new_files_have_the_umasks_mode_and_old_ones_keep_theirs(tmp_path, umask):
    before = os.umask(umask)
    try:
        write_whole("a", tmp_path / "new")
        (tmp_path / "old").write_text("x")
        (tmp_path / "old").chmod(0o640)
        write_whole("b", tmp_path / "old")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "new").stat().st_mode) == 0o666 & ~umask
    assert stat.S_IMODE((tmp_path / "old").stat().st_mode) == 0o640 and (tmp_path / "old").read_text() == "b"


@pytest.mark.parametrize("there", [True, False])
def test_a_link_goes_on_pointing_where_it_points(tmp_path, there):
    (tmp_path / "elsewhere").mkdir()
    real, link = tmp_path / "elsewhere/real.npz", tmp_path / "link.npz"
    if there:
        real.write_text("old")
    link.symlink_to(real)
    standing_plan().save(link)
    assert link.is_symlink() and not real.is_symlink()
    assert mp.Plan.load(real).duration() == standing_plan().duration()
    assert names(tmp_path) == ["elsewhere", "link.npz"] and names(real.parent) == ["real.npz"]


def test_a_device_is_written_through_and_stays():
    before = os.stat("/dev/null")
    standing_plan().save("/dev/null")
    after = os.stat("/dev/null")
    assert stat.S_ISCHR(after.st_mode) and (after.st_ino, after.st_mode) == (before.st_ino, before.st_mode)


def test_a_pipe_gets_the_whole_file_and_stays(tmp_path):
    pipe, got = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: got.append(pipe.read_bytes()))
    reader.start()
    standing_plan().save(pipe)
    reader.join()
    standing_plan().save(tmp_path / "plan.npz")
    assert got == [(tmp_path / "plan.npz").read_bytes()]
    assert stat.S_ISFIFO(pipe.stat().st_mode) and names(tmp_path) == ["pipe", "plan.npz"]


@pytest.mark.parametrize(
    ("path", "error"),
    [
        ("/dev/full", OSError),
        ("no/such/folder/plan.npz", FileNotFoundError),
        (".", IsADirectoryError),
        ("/proc/plan.npz", OSError),
        ("n" * 300 + ".npz", OSError),
        ("loop.npz", OSError),
    ],
)
def test_errors_name_the_file_that_was_asked_for(tmp_path, monkeypatch, path, error):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "loop.npz").symlink_to("loop.npz")
    with pytest.raises(error) as told:
        write_whole(b"data", path)
    assert told.value.filename == path and told.value.strerror
    with pytest.raises(InvalidInput, match="path: must not be empty"):
        write_whole(b"data", "")
    assert names(tmp_path) == ["loop.npz"]


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_read_only_files_and_folders_are_refused(tmp_path):
    (tmp_path / "file").write_text("kept")
    (tmp_path / "file").chmod(0o444)
    with pytest.raises(PermissionError):
        write_whole("x", tmp_path / "file")
    tmp_path.chmod(0o555)
    with pytest.raises(PermissionError):
        write_whole("x", tmp_path / "other")
    with pytest.raises(InvalidInput, match="--output: must lie in a folder that can be written to"):
        require_target("--output", tmp_path / "other.npz")
    tmp_path.chmod(0o755)


@pytest.mark.parametrize(
    ("name", "rule"),
    [
        ("plan.csv", "must end in .npz"),
        ("plan", "must end in .npz"),
        ("no/plan.npz", "must lie in a folder that exists"),
        ("folder", "must be a file"),
        ("/proc/plan.npz", "must lie in a folder that can be written to"),
    ],
)
def test_what_cannot_be_written_is_said_beforehand(tmp_path, monkeypatch, name, rule):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    with pytest.raises(InvalidInput) as told:
        require_target("--output", Path(name), (".npz",))
    assert told.value.rule == rule and name in told.value.value
    assert names(tmp_path) == ["folder"]


def test_what_can_be_written_passes_without_a_trace(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "a.npz", tmp_path / "A.NPZ", tmp_path / "pipe", Path("/dev/null"), Path("/dev/stdout")):
        require_target("--output", path, (".npz",))
    require_folder("--out", tmp_path / "new/one")
    assert names(tmp_path) == ["pipe"]
    with pytest.raises(InvalidInput, match="must be a folder, or a name for a new one"):
        require_folder("--out", tmp_path / "pipe")


@pytest.mark.parametrize("name", ["plan.csv", "plan.yaml", "plan.npz.zip", "plan.json.gz"])
def test_a_plan_is_not_saved_under_another_kinds_name(tmp_path, name):
    with pytest.raises(InvalidInput, match=r"path: must end in \.npz or \.json, got .*" + name.replace(".", r"\.")):
        standing_plan().save(tmp_path / name)
    assert names(tmp_path) == []


@pytest.mark.parametrize("name", ["it.npz", "it", "it.txt"])
def test_scenes_robots_and_pages_are_not_saved_under_another_kinds_name(tmp_path, name):
    plan = standing_plan()
    page = mp.show(plan)
    for save, ending in (
        (page.save_html, r"\.html or \.htm"),
        (lambda to: mp.files.scenes.save_scene(plan.scene, to), r"\.toml"),
        (lambda to: mp.files.robots.save_robot(plan.robot, to), r"\.toml"),
    ):
        with pytest.raises(InvalidInput, match=f"path: must end in {ending}, got .*{name}"):
            save(tmp_path / name)
    assert names(tmp_path) == []


@pytest.mark.parametrize("path", [3, None, b"x.toml", ["x.toml"]])
def test_what_is_no_path_is_refused_by_name_wherever_something_is_saved(path):
    plan = standing_plan()
    page = mp.show(plan)
    for save in (
        plan.save,
        page.save_html,
        lambda to: mp.files.scenes.save_scene(plan.scene, to),
        lambda to: mp.files.robots.save_robot(plan.robot, to),
    ):
        with pytest.raises(InvalidArgument, match="path: must be a path, got "):
            save(path)
