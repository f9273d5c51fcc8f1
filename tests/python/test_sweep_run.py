"""Sweeps: the same bytes whoever does them, in one go or not, and nothing lost with a worker."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

for package in ("pydantic", "pyarrow", "pandas"):
    pytest.importorskip(package)

import mcplan as mp  # noqa: E402
from command_line import one_line_error  # noqa: E402
from crashing import crash_on_task_one  # noqa: E402
from mcplan.cli import main  # noqa: E402
from mcplan.errors import InvalidArgument, InvalidInput, InvalidSweep  # noqa: E402
from mcplan.files.sweep_specs import sweep_spec  # noqa: E402
from mcplan.sweep import How, load_sweep, run  # noqa: E402
from mcplan.sweep.tasks import share_of, tasks_of  # noqa: E402

SPEC = """name = "small"
robots = ["humanoid44"]
[options]
phases = { grid = [10, 18] }
max_iterations = 200
[[scenes]]
generator = "gap"
samples = 2
parameters.width_m = { uniform = [0.1, 0.3] }
[[scenes]]
scene = "flat"
"""
DATA = {
    "name": "small",
    "options": {"max_iterations": 50},
    "scenes": [{"generator": "gap", "samples": 3, "parameters": {"width_m": {"uniform": [0.1, 0.3]}}}],
}


def content(out: Path) -> dict[str, bytes]:
    """All files but times, by name."""
    apart = ("times", "summary")
    files = [path for path in sorted(out.rglob("*")) if path.is_file()]
    return {str(p.relative_to(out)): p.read_bytes() for p in files if not str(p.relative_to(out)).startswith(apart)}


@pytest.fixture(scope="module")
def done(tmp_path_factory) -> tuple[Path, Path]:
    """The file of a sweep and its folder, made by one process."""
    folder = tmp_path_factory.mktemp("sweep")
    (folder / "spec.toml").write_text(SPEC)
    assert main(["sweep", str(folder / "spec.toml"), "--out", str(folder / "one")]) == 0
    return folder / "spec.toml", folder / "one"


def test_shards_part_the_tasks_and_make_the_same_bytes(done, tmp_path):
    spec, one = done
    for i in (2, 3, 1):
        assert main(["sweep", str(spec), "--out", str(tmp_path / "o"), "--shard", f"{i}/3", "--jobs", "2"]) == 0
        assert (tmp_path / "o/index.parquet").exists() == (i == 1)
    assert content(tmp_path / "o") == content(one)
    tasks = tasks_of(sweep_spec(DATA))
    shares = [share_of(tasks, (i, 2)) for i in (1, 2)]
    assert sorted(task.index for share in shares for task in share) == [0, 1, 2]


def test_a_second_call_does_nothing(done, capsys):
    spec, one = done
    before = content(one)
    assert main(["sweep", str(spec), "--out", str(one), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["ran"], found["left"], found["tasks"]) == (0, 0, 6) and content(one) == before


@pytest.mark.parametrize(("number", "code"), [(signal.SIGKILL, -9), (signal.SIGINT, 130)])
def test_what_is_killed_in_the_middle_goes_on_to_the_same_bytes(done, tmp_path, number, code):
    spec, one = done
    out = tmp_path / "killed"
    words = [sys.executable, "-m", "mcplan", "sweep", str(spec), "--out", str(out), "--jobs", "2"]
    started = subprocess.Popen(
        words, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    while started.poll() is None and not list(out.glob("records/*/0*.json")):
        time.sleep(0.01)
    os.killpg(started.pid, number)
    told = started.communicate()[1]
    assert started.returncode == code and told == b""
    assert not (out / "index.parquet").exists() and not load_sweep(out).complete
    assert main(["sweep", str(spec), "--out", str(out)]) == 0
    assert content(out) == content(one)


def test_a_task_that_kills_its_workers_is_recorded_by_name_and_can_be_tried_again(tmp_path):
    spec = sweep_spec(DATA)
    outcome = run(spec, tmp_path / "o", how=How(jobs=2, attempts=2), function=crash_on_task_one)
    ((name, message),) = outcome.failed
    assert name.startswith("task 1: gap width_m=") and message.startswith("crashed: ") and outcome.crashed == 1
    sweep = load_sweep(tmp_path / "o")
    assert list(sweep.table.status == "crashed") == [False, True, False]
    assert "ended by SIGKILL" in sweep.times.crash[1]
    again = run(spec, tmp_path / "o", how=How(retry_crashed=True))
    assert (again.ran, again.crashed) == (1, 0)


def test_a_table_and_plans_are_loaded_and_solved_means_that_the_checker_accepts(done):
    sweep = mp.load_sweep(done[1])
    assert sweep.complete and len(sweep.table) == 6 and sweep.verify() == [] and len(sweep.times) == 6
    assert (sweep.table.status == "solved").any()
    for row in sweep.table[sweep.table.status == "solved"].itertuples():
        assert mp.check(sweep.plans[row.task]).ok() and len(row.contact_sequence) == row.phases
    assert "solved over width_m" in (done[1] / "summary.html").read_text()


def test_a_folder_of_another_sweep_is_refused(done):
    with pytest.raises(InvalidSweep, match="must be a new folder, or one of the same sweep"):
        run(sweep_spec(DATA), done[1])
    with pytest.raises(InvalidSweep, match="must be the folder of a sweep"):
        load_sweep(done[0].parent)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"sceness": []}, "sceness: no such key. Did you mean 'scenes'? Keys: name, description, engine"),
        ({"engine": "dpp"}, 'engine: must be one of ddp, rhp, got "dpp"'),
        ({"seed": -1}, "seed: must be at least 0, got -1"),
        ({"robots": ["taloss"]}, "robots[0]: no robot 'taloss'"),
        ({"options": {"phases": "x"}}, 'options.phases: must be of type int, got "x"'),
        ({"options": {"phases": {"grid": [18, -3]}}}, "options.phases: must"),
        ({"options": {"phases": 10**11}}, "options.phases: must be at most 2000, got 100000000000"),
        ({"name": "a\n"}, 'name: must have no control characters, got "a\\n"'),
        ({"exports": ["mjlba"]}, "exports[0]: no such format. Did you mean 'mjlab'? Formats: mjlab, "),
        ({"options": {"seed": 3}}, "options.seed: is said by seeds"),
        ({"options": {"time_limit": float("inf")}}, "options.time_limit: must be finite, got inf"),
        ({"options": {"phases": {"grid": [8, 8]}}}, "options.phases: must have values that differ, got [8, 8]"),
        ({"options": {"proximal_weight": {"linspace": [1.0, 1.0, 3]}}}, "options.proximal_weight: must have values"),
        ({"options": {"weights": {"flight": 1.0}, "weights.flight": 2.0}}, "options: must have weights.flight once"),
        ({"scenes": []}, "scenes: must not be empty"),
        ({"scenes": [{"generator": "gap", "samples": 0}]}, "scenes[0].samples: must be at least 1, got 0"),
        ({"scenes": [{"generator": "gaps"}]}, "scenes[0].generator: must be one of gap, random"),
        ({"scenes": [{"generator": "gap", "parameters": {"width_m": 9.0}}]},
         "scenes[0].parameters.width_m: must lie in [0, 5], got 9.0"),
        ({"scenes": [{"generator": "gap", "parameters": {"width_m": {"uniform": [2, 1]}}}]},
         "scenes[0].parameters.width_m: must have the lower bound first"),
        ({"robots": ["g1", "g1"]}, 'robots[1]: must differ from those before it, got "g1"'),
        ({"seeds": [1, 2, 1]}, "seeds[2]: must differ from those before it, got 1"),
        ({"scenes": [{"scene": "flat", "samples": 5}]}, "scenes[0].samples: must be 1 where nothing is drawn"),
        ({"scenes": [{"generator": "gap", "samples": 10**5, "parameters": {"width_m": {"linspace": [0.1, 0.2, 10**5]}}}]},
         "scenes[0].samples: must be 1 where nothing is drawn"),
        ({"scenes": [{"generator": "gap", "samples": 10**5, "parameters": {
            "width_m": {"linspace": [0.1, 0.2, 10**5]}, "rise_m": {"uniform": [0.0, 0.1]}}}]},
         "scenes: must give at most 1000000 tasks, got 10000000000"),
    ],
)  # fmt: skip
def test_errors_name_field_rule_and_value(change, message):
    with pytest.raises(InvalidSweep) as found:
        sweep_spec({**DATA, **change}, "s.toml")
    assert str(found.value).startswith(f"s.toml: {message}")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"jobs": 0}, "jobs: must be a whole number in [1, 1024], got 0"),
        ({"jobs": 2.0}, "jobs: must be a whole number in [1, 1024], got 2.0"),
        ({"attempts": 10**6}, "attempts: must be a whole number in [1, 1000], got 1000000"),
        ({"shard": (3, 2)}, "shard: must be i/n with 1 <= i <= n, got 3/2"),
        ({"shard": "1/2"}, 'shard: must be None or (i, n) with whole numbers 1 <= i <= n, got "1/2"'),
        ({"scheduler": None}, "scheduler: must be a str, got None"),
    ],
)
def test_how_a_sweep_is_run_is_checked_when_it_is_said(change, message):
    with pytest.raises(InvalidArgument) as found:
        How(**change)
    assert str(found.value) == message


def test_what_is_refused_leaves_no_folder(tmp_path, capsys):
    (tmp_path / "s.toml").write_text('name = "s"\n[[scenes]]\nscene = "flat"\n')
    (tmp_path / "file").touch()
    for words, message in (
        (["--out", "o", "--shard", "\uff11/2"], "--shard: must be i/n with 1 <= i <= n"),
        (["--out", "o", "--jobs", "1025"], "--jobs: must lie in [1, 1024], got 1025"),
        (["--out", "file"], "--out: must be a folder, or a name for a new one"),
        (["--out", "."], "--out: must be a new or an empty folder, or one of this sweep"),
        (["--out", "o", "--scheduler", "nobody"], "--scheduler: must be the address of a Dask scheduler"),
        (["--out", "o", "--scheduler", "http://x"], "--scheduler: must be the address of a Dask scheduler"),
    ):
        words[1] = str(tmp_path / words[1])
        code = main(["sweep", str(tmp_path / "s.toml"), *words])
        assert one_line_error((code, *capsys.readouterr())).startswith(message)
    for spec, out in (("s.toml", tmp_path / "o"), (sweep_spec(DATA), None), (sweep_spec(DATA), tmp_path / "file")):
        with pytest.raises(InvalidInput, match="^(spec|out): must be"):
            run(spec, out)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "s.toml"]


def test_dask_workers_make_the_same_bytes(done, tmp_path):
    distributed = pytest.importorskip("distributed")
    spec, one = done
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        words = ["sweep", str(spec), "--out", str(tmp_path / "o"), "--scheduler", cluster.scheduler_address]
        assert main(words) == 0
    assert content(tmp_path / "o") == content(one)


def test_a_dask_worker_that_is_killed_costs_its_tasks_a_second_try(done, tmp_path):
    distributed = pytest.importorskip("distributed")
    spec, one = done
    out = tmp_path / "o"
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            processes = list(client.run(os.getpid).values())

        def kill_one() -> None:
            while not list(out.glob("records/*/0*.json")):
                time.sleep(0.01)
            os.kill(processes[0], signal.SIGKILL)

        killer = threading.Thread(target=kill_one)
        killer.start()
        assert main(["sweep", str(spec), "--out", str(out), "--scheduler", cluster.scheduler_address]) == 0
        killer.join()
        with distributed.Client(cluster) as client:
            client.wait_for_workers(2, timeout=60)  # its nanny has begun another
            assert processes[0] not in client.run(os.getpid).values()
    assert content(out) == content(one)


def test_a_task_that_kills_dask_workers_is_recorded_and_the_others_are_done(tmp_path):
    distributed = pytest.importorskip("distributed")
    spec = sweep_spec(DATA)
    with (
        pytest.importorskip("dask").config.set({"distributed.scheduler.allowed-failures": 1}),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
    ):
        how = How(scheduler=cluster.scheduler_address)
        outcome = run(spec, tmp_path / "o", how=how, function=crash_on_task_one)
    ((name, message),) = outcome.failed
    assert name.startswith("task 1: gap width_m=") and message.startswith("crashed: ") and outcome.crashed == 1
    sweep = load_sweep(tmp_path / "o")
    assert list(sweep.table.status == "crashed") == [False, True, False]
    assert "its Dask worker died" in sweep.times.crash[1]
