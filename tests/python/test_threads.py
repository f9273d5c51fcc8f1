"""Threads of the contact-sequence search: as many as a user asks for, on a machine that has not got them."""

from __future__ import annotations

import os
import resource
import subprocess
import sys

import pytest

#: Long enough that pricing is shared out among threads.
PLAN = "import mcplan as mp; mp.plan('gap_with_rail', phases=120, max_iterations=2, restarts=0, threads={threads})"


@pytest.mark.skipif((os.cpu_count() or 1) > 16, reason="so many processors have their threads in more memory")
@pytest.mark.parametrize("threads", [2, 256])
def test_threads_that_the_system_denies_do_not_end_the_process(threads):
    def little_memory() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))

    command = [sys.executable, "-c", PLAN.format(threads=threads)]
    done = subprocess.run(command, capture_output=True, text=True, preexec_fn=little_memory)
    assert done.returncode == 0, done.stderr
