"""A process forked while its parent plans can plan itself: locks and threads of the parent do not reach it."""

from __future__ import annotations

import subprocess
import sys

import pytest

DEADLOCK_S = 300.0  # far above what the children need on a loaded machine

WHILE_IPOPT_RUNS = """
import os, signal, sys, threading, time
import mcplan as mp

scene, robot = mp.load_scene("rubbles"), mp.load_robot("talos_wang")
inside = threading.Event()
over = threading.Event()

def logger(*_):
    inside.set()

def plan_on():
    # Back to back, so that the lock is nearly always held.
    while not over.is_set():
        mp.whole_body("chimney", minimise="none", forces="uniform", max_iterations=30, logger=logger)

thread = threading.Thread(target=plan_on)
thread.start()
inside.wait()
codes = []
for k in range(4):
    time.sleep(0.013 * k)  # Ipopt is elsewhere each time, most of it in MUMPS
    child = os.fork()
    if child == 0:
        signal.alarm(200)  # a deadlock ends the child with SIGALRM
        walk = mp.walk(scene, robot, cycles=1, lookahead=1, **({} if k == 0 else {"max_iterations": 2}))
        os._exit(0 if walk.success or k > 0 else 1)
    codes.append(os.waitpid(child, 0)[1])
over.set()
thread.join()
sys.exit(0 if codes == [0] * 4 else f"children ended with {codes}")
"""

AFTER_THREADS = """
import os, signal, sys
import mcplan as mp

options = dict(phases=24, max_iterations=6, restarts=0, threads=3)
here = mp.plan("gap_with_rail", **options)
child = os.fork()
if child == 0:
    signal.alarm(200)
    there = mp.plan("gap_with_rail", **options)
    os._exit(0 if there.report.cost == here.report.cost else 1)
code = os.waitpid(child, 0)[1]
sys.exit(0 if code == 0 else f"the child ended with {code}")
"""


@pytest.mark.parametrize("program", [WHILE_IPOPT_RUNS, AFTER_THREADS], ids=["while_ipopt_runs", "after_threads"])
def test_a_forked_child_plans(program: str) -> None:
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=DEADLOCK_S)
    assert done.returncode == 0, done.stderr[-2000:]
