"""The folder of a sweep: shards that begin at once, files that are damaged or another's, files that change."""

from __future__ import annotations

import json
import shutil
import threading
from dataclasses import replace
from pathlib import Path

import pytest

for package in ("pydantic", "pyarrow", "pandas"):
    pytest.importorskip(package)

import mcplan as mp  # noqa: E402
from mcplan.errors import InvalidSweep  # noqa: E402
from mcplan.files.robots import save_robot  # noqa: E402
from mcplan.files.scenes import save_scene  # noqa: E402
from mcplan.files.sweep_specs import sweep_spec  # noqa: E402
from mcplan.sweep import load_sweep, run, store  # noqa: E402
from mcplan.sweep.tasks import tasks_of  # noqa: E402
from mcplan.sweep.work import Job, work  # noqa: E402

DATA = {
    "name": "small",
    "options": {"max_iterations": 50},
    "scenes": [{"generator": "gap", "samples": 2, "parameters": {"width_m": {"uniform": [0.1, 0.3]}}}],
}
FIRST, SECOND = "records/0000/0000000.json", "records/0000/0000001.json"


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> Path:
    """The folder of a sweep of two tasks."""
    out = tmp_path_factory.mktemp("store") / "o"
    run(sweep_spec(DATA), out)
    return out


@pytest.fixture
def copied(done, tmp_path) -> Path:
    """The same, to be damaged."""
    return Path(shutil.copytree(done, tmp_path / "o"))


def test_shards_that_begin_at_once_share_a_folder(tmp_path):
    spec = sweep_spec(DATA)
    manifest = store.manifest_of(spec, tasks_of(spec))
    for k in range(20):
        together, refused = threading.Barrier(4), []

        def begin(out: Path = tmp_path / str(k), together=together, refused=refused) -> None:
            together.wait()
            try:
                store.begin(out, manifest)
            except InvalidSweep as error:
                refused.append(str(error))

        threads = [threading.Thread(target=begin) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert refused == []


def test_a_manifest_that_is_being_written_is_no_stranger_and_other_files_are(tmp_path):
    spec = sweep_spec(DATA)
    manifest = store.manifest_of(spec, tasks_of(spec))
    (tmp_path / ".manifest.0123456789ab.json").touch()
    store.begin(tmp_path, manifest)
    assert store.read_manifest(tmp_path) == manifest
    (tmp_path / "manifest.json").unlink()
    (tmp_path / "notes.txt").touch()
    with pytest.raises(InvalidSweep, match="must be a new or an empty folder"):
        store.begin(tmp_path, manifest)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{}",
        '{"status": "solved"}',
        None,
        {"plan": 5},
        {"cost": "a"},
        {"task": 0},
        {"seed": "0"},
        {"options": []},
    ],
)
def test_a_damaged_record_is_a_task_that_is_not_done(copied, done, text):
    path = copied / SECOND
    if text is None:
        text = (copied / FIRST).read_text()
    elif isinstance(text, dict):
        text = json.dumps(json.loads(path.read_text()) | text)
    path.write_text(text)
    (copied / "index.parquet").unlink()
    assert not load_sweep(copied).complete
    assert run(sweep_spec(DATA), copied).ran == 1
    assert path.read_bytes() == (done / SECOND).read_bytes() and load_sweep(copied).verify() == []


@pytest.mark.parametrize("content", [b"", b"cut", None])
def test_a_damaged_plan_is_made_again(copied, done, content):
    plan = "plans/0000/0000001.npz"
    (copied / plan).write_bytes((done / "plans/0000/0000000.npz").read_bytes() if content is None else content)
    assert load_sweep(copied).verify() == [plan]
    assert run(sweep_spec(DATA), copied).ran == 1
    assert (copied / plan).read_bytes() == (done / plan).read_bytes()


@pytest.mark.parametrize("text", ["[]", "{}", '{"task": 0}', '{"task": 1, "wall_s": "a"}', "no JSON"])
def test_damaged_times_are_left_out(copied, text):
    (copied / "times/0000/0000001.json").write_text(text)
    assert list(load_sweep(copied).times.task) == [0]
    run(sweep_spec(DATA), copied)
    assert load_sweep(copied).complete


@pytest.mark.parametrize("name", ["index.parquet", "checksums.sha256"])
@pytest.mark.parametrize("content", [b"", b"\xff\xfe no table"])
def test_damaged_tables_are_told_and_made_again(copied, name, content):
    (copied / name).write_bytes(content)
    with pytest.raises(InvalidSweep, match=f"{name} is damaged"):
        load_sweep(copied).verify()
    run(sweep_spec(DATA), copied)
    assert load_sweep(copied).verify() == []


def test_a_manifest_without_its_fields_is_told(copied):
    manifest = json.loads((copied / "manifest.json").read_text())
    del manifest["tasks"]
    (copied / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(InvalidSweep, match="tasks: must be a whole number"):
        load_sweep(copied)


def test_each_file_has_a_digest_and_a_change_is_refused(tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        save_scene(mp.load_scene("flat"), tmp_path / name / "s.toml")
    save_robot(mp.load_robot("humanoid44"), tmp_path / "r.toml")
    scenes = [{"scene": "a/s.toml", "name": "a"}, {"scene": "b/s.toml", "name": "b"}]
    data = {"name": "s", "robots": ["r.toml"], "options": {"max_iterations": 5}, "scenes": scenes}
    spec = sweep_spec(data, folder=tmp_path)
    run(spec, tmp_path / "o", tmp_path)
    assert list(load_sweep(tmp_path / "o").manifest["files_sha256"]) == ["a/s.toml", "b/s.toml", "r.toml"]
    with (tmp_path / "a/s.toml").open("a") as file:
        file.write("# changed\n")
    with pytest.raises(InvalidSweep, match="scene or robot files differ"):
        run(spec, tmp_path / "o", tmp_path)


def test_a_worker_that_does_not_see_a_file_records_nothing(tmp_path, monkeypatch):
    save_scene(mp.load_scene("flat"), tmp_path / "s.toml")
    monkeypatch.chdir(tmp_path)
    data = {"name": "s", "options": {"max_iterations": 5}, "scenes": [{"scene": "s.toml"}]}
    (task,) = tasks_of(sweep_spec(data))
    monkeypatch.chdir("/")
    work(Job(task, str(tmp_path / "o")))
    assert store.read_record(tmp_path / "o", task.stem) is not None
    lost = replace(task, index=1, source=str(tmp_path / "gone.toml"))
    with pytest.raises(FileNotFoundError, match=r"gone\.toml"):
        work(Job(lost, str(tmp_path / "o")))
    assert store.read_record(tmp_path / "o", lost.stem) is None
