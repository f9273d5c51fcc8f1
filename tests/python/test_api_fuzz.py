"""No call of the public API crashes, hangs or raises anything but a typed error, whatever was set before.

The calls are random, of everything that the compiled module binds (api_signatures finds it), in processes of their own
(api_fuzz). A failure names the command that repeats it. MCPLAN_API_FUZZ_S is the CPU time [s] of the slow test, an hour
by default; MCPLAN_API_FUZZ_SEED the first of its seeds.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

import api_objects
import api_signatures
import mcplan
from mcplan import _core

HERE = Path(__file__).parent
CALLS = 3000  # in a process: some two seconds of CPU time
SEEDS = 12
STUCK_S = 900.0  # wall clock of a process: a deadlock, since api_fuzz ends a call that computes for too long


@pytest.fixture(scope="module")
def valid(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("api_fuzz") / "valid.pickle"
    api_objects.save(path)
    return path


def run(seed: int, calls: int, valid: Path, log: Path) -> None:
    command = [sys.executable, str(HERE / "api_fuzz.py"), str(seed), str(calls), str(valid), str(log)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(HERE), str(Path(mcplan.__file__).parents[1])])}
    try:
        done = subprocess.run(
            command, capture_output=True, text=True, errors="replace", timeout=STUCK_S, env=environment
        )
        code, said = str(done.returncode), done.stderr
    except subprocess.TimeoutExpired:
        code, said = "a deadlock", ""
    if code != "0":
        last = "\n".join(log.read_text().splitlines()[-25:])
        pytest.fail(
            f"seed {seed} ended with {code}; repeat with\n  PYTHONPATH={HERE} {' '.join(command)}\n"
            f"last calls:\n{last}\n{said[-3000:]}",
            pytrace=False,
        )


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


@pytest.mark.slow
def test_random_calls_for_an_hour(valid: Path, tmp_path: Path) -> None:
    seed = int(os.environ.get("MCPLAN_API_FUZZ_SEED", "1000"))
    end_s = cpu_of_children_s() + float(os.environ.get("MCPLAN_API_FUZZ_S", "3600"))
    while cpu_of_children_s() < end_s:
        run(seed, 3000, valid, tmp_path / "calls.txt")
        seed += 1
