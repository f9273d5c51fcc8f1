"""No mutation of a file of any kind crashes, hangs, takes much memory, or ends in an error that is not mcplan's.

Behind the marker `slow` as many as MCPLAN_FILE_MUTATIONS says are tried, 9000 unless it is set:

    MCPLAN_FILE_MUTATIONS=1000000 pytest -m slow tests/python/test_files_fuzz.py

Each batch runs in a process of its own (fuzz_files.py), with limits of memory and of time of the processor.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

import fuzz_files

#: Tried at every run of the tests: seconds of the processor in all. Runs and URDFs take longer, or load more, than the rest.
FEW = {kind: 200 for kind in fuzz_files.VALID} | {"run": 20}
MANY = int(os.environ.get("MCPLAN_FILE_MUTATIONS", "9000"))
BATCH = 5000
MEMORY_BYTES = 4 * 2**30  # of addresses, most of which libraries reserve and do not use


def _limit() -> None:
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(
        resource.RLIMIT_CPU, (1000, 1000)
    )  # a mutation has far less, this is for what cannot be interrupted


def try_mutations(kind: str, seed: int, first: int, count: int, folder: Path) -> None:
    """Fail with the call that gives the bytes of a mutation that does not end as it should."""
    command = [sys.executable, fuzz_files.__file__, kind, str(seed), str(first), str(count), str(folder)]
    found = subprocess.run(command, capture_output=True, text=True, errors="replace", preexec_fn=_limit)
    *failures, last = found.stdout.splitlines() or [""]
    number = (folder / "progress").read_text() if (folder / "progress").exists() else "?"
    assert (found.returncode, last) == (0, "done"), f"mutation({kind!r}, {seed}, {number}): {found.stderr[-2000:]}"
    assert not failures, "\n".join(failures)


def require_packages(kind: str) -> None:
    if kind in ("urdf", "run"):
        pytest.importorskip("pinocchio")
        pytest.importorskip("example_robot_data")


@pytest.mark.parametrize("kind", sorted(fuzz_files.VALID))
def test_a_mutated_file_loads_or_is_refused_by_name(kind, tmp_path):
    require_packages(kind)
    try_mutations(kind, seed=1, first=0, count=FEW[kind], folder=tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(fuzz_files.VALID))
def test_many_mutated_files_load_or_are_refused_by_name(kind, tmp_path):
    require_packages(kind)
    count = MANY // len(fuzz_files.VALID)
    for first in range(0, count, BATCH):
        try_mutations(kind, seed=2, first=first, count=min(BATCH, count - first), folder=tmp_path)


@pytest.mark.parametrize("kind", ["scene", "plan"])
def test_a_mutation_is_the_same_for_the_same_numbers(kind):
    assert fuzz_files.mutation(kind, 3, 4) == fuzz_files.mutation(kind, 3, 4)
    assert len({fuzz_files.mutation(kind, 3, number) for number in range(40)}) > 35


@pytest.mark.parametrize(
    ("raised", "message"),
    [(KeyError("x"), "KeyError"), (MemoryError(), "MemoryError"), (RecursionError(), "RecursionError")],
)
def test_an_error_that_is_not_mcplans_is_a_failure(raised, message, tmp_path, monkeypatch):
    def fail(*_):
        raise raised

    monkeypatch.setattr(fuzz_files, "read", fail)
    assert message in fuzz_files.attempt("scene", tmp_path / "x.toml", 1)
