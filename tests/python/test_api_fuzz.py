"""No call of the public API crashes, hangs or raises anything but a typed error, whatever was set before.

The calls are random, of everything that the compiled module binds (api_signatures finds it), of the verbs of mcplan and of
the engines with input that they mostly take, in processes of their own (api_fuzz, api_verbs, api_solves). A failure names the
command that repeats it. MCPLAN_API_FUZZ_S is the CPU time [s] of the slow test, an hour by default; MCPLAN_API_FUZZ_SEED the
first of its seeds.
"""

from __future__ import annotations

import os
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import api_objects
import api_signatures
import api_verbs
import mcplan
from mcplan import _core

HERE = Path(__file__).parent
CALLS = 3000  # in a process: some two seconds of CPU time
SEEDS = 12
VERB_CALLS, VERB_SEEDS = 250, 4
SOLVES, SOLVE_SEEDS = 100, 4
STUCK_S = (
    120.0  # of a process all of whose threads sleep: a deadlock. One that computes for too long is ended by api_fuzz.
)


@pytest.fixture(scope="module")
def valid(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("api_fuzz") / "valid.pickle"
    api_objects.save(path)
    return path


def run(seed: int, calls: int, valid: Path, log: Path, script: str = "api_fuzz.py") -> None:
    command = [sys.executable, str(HERE / script), str(seed), str(calls), str(valid), str(log)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(HERE), str(Path(mcplan.__file__).parents[1])])}
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, errors="replace", env=environment)
    said, threads = end_of(process)
    if process.returncode != 0:
        last = "\n".join(log.read_text().splitlines()[-25:])
        pytest.fail(
            f"seed {seed} ended with {f'a deadlock: {threads}' if threads else process.returncode}; repeat with\n"
            f"  PYTHONPATH={HERE} {' '.join(command)}\nlast calls:\n{last}\n{said[-3000:]}",
            pytrace=False,
        )


def end_of(process: subprocess.Popen[str], stuck_s: float = STUCK_S) -> tuple[str, list[str]]:
    """What a process said until its end. One that is stuck is aborted, so that it tells where: what its threads waited for.

    A process that has no time on a busy machine is ready to run, or uses some; one that is stuck sleeps in all its threads.
    """
    used, since = -1.0, time.monotonic()
    while True:
        try:
            return process.communicate(timeout=2.0)[1], []
        except subprocess.TimeoutExpired:
            now, asleep, threads = threads_of(process.pid)
        if now != used or not asleep:
            used, since = now, time.monotonic()
        elif time.monotonic() - since > stuck_s:
            process.send_signal(signal.SIGABRT)
            return process.communicate()[1], threads


def threads_of(pid: int) -> tuple[float, bool, list[str]]:
    """CPU time of a process [ticks], whether all its threads sleep, and what each of them waits for."""
    used, states, waits = 0, set(), []
    for task in Path(f"/proc/{pid}/task").glob("*"):
        try:
            fields = (task / "stat").read_text().rpartition(")")[2].split()
            waits.append(f"{fields[0]} {(task / 'wchan').read_text()}")
        except OSError:  # it has just ended
            continue
        used += int(fields[11]) + int(fields[12])
        states.add(fields[0])
    return used, states <= {"S"}, waits


def cpu_of_children_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def test_every_binding_is_found() -> None:
    found = api_signatures.interface_of()
    calls = {call.text for call in found.constructors + found.methods + found.functions}
    assert {"Plan.at", "Plan.load", "Scene.__init__", "check", "Planner.solve", "TaylorModel.__mul__"} <= calls
    assert {"resolve_stance", "planar_inverse_dynamics", "certify", "ipopt_version"} <= calls
    bound = {value.__name__ for value in vars(_core).values() if isinstance(value, type)}
    assert bound <= {name.rsplit(".", 1)[1] for name in [*found.classes, *found.enums]}
    named = {(p.owner.__name__, p.name) for p in found.properties if p.type is not None}
    assert {("Knot", "end_effectors_W"), ("Options", "time_limit_s"), ("Result", "certificate")} <= named


@pytest.mark.parametrize("seed", range(SEEDS))
def test_random_calls_end_in_a_result_or_a_typed_error(seed: int, valid: Path, tmp_path: Path) -> None:
    run(seed, CALLS, valid, tmp_path / "calls.txt")


def test_every_verb_is_called() -> None:
    verbs = {"load_scene", "plan", "replan", "walk", "receding_horizon", "whole_body", "track", "show", "check"}
    assert verbs <= set(api_verbs.VERBS)


@pytest.mark.parametrize("seed", range(VERB_SEEDS))
def test_random_calls_of_verbs_end_in_a_result_or_an_error_of_ours(seed: int, valid: Path, tmp_path: Path) -> None:
    run(seed, VERB_CALLS, valid, tmp_path / "calls.txt", "api_verbs.py")


@pytest.mark.parametrize("seed", range(SOLVE_SEEDS))
def test_random_solves_end_in_a_result_or_a_typed_error(seed: int, valid: Path, tmp_path: Path) -> None:
    run(seed, SOLVES, valid, tmp_path / "calls.txt", "api_solves.py")


@pytest.mark.parametrize(
    ("code", "stuck"),
    [("import threading; threading.Lock().acquire(); threading.Event().wait()", True), ("while True: pass", False)],
)
def test_a_process_that_sleeps_is_told_from_one_that_computes(code: str, stuck: bool) -> None:
    process = subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)
    ender = threading.Timer(6.0, process.kill)
    ender.start()
    assert bool(end_of(process, 2.0)[1]) == stuck
    ender.cancel()
    assert process.returncode == -(signal.SIGABRT if stuck else signal.SIGKILL)


@pytest.mark.slow
def test_random_calls_for_an_hour(valid: Path, tmp_path: Path) -> None:
    seed = int(os.environ.get("MCPLAN_API_FUZZ_SEED", "1000"))
    end_s = cpu_of_children_s() + float(os.environ.get("MCPLAN_API_FUZZ_S", "3600"))
    while cpu_of_children_s() < end_s:
        run(seed, 3000, valid, tmp_path / "calls.txt")
        run(seed, VERB_CALLS, valid, tmp_path / "calls.txt", "api_verbs.py")
        run(seed, SOLVES, valid, tmp_path / "calls.txt", "api_solves.py")
        seed += 1
