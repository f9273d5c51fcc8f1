"""Ctrl-C in the command: exit code 130 at whatever moment, no traceback, nothing half-written, the best plan kept."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import mcplan as mp
from standing import standing_plan

#: In the place of site customisation: sends SIGINT, or says so on file descriptor 3, when a module is looked for.
HOOK = """
import os, signal, sys


class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == os.environ.get("AT"):
            os.environ.pop("AT")
            if os.environ.get("SAY"):
                os.write(int(os.environ["SAY"]), b"x")
            else:
                os.kill(os.getpid(), signal.SIGINT)
        return None


sys.meta_path.insert(0, Finder())
"""
#: Runs the command with a function replaced: it sends SIGINT first.
AT_CALL = """
import importlib, os, signal, sys
from mcplan.cli import main

module, name = sys.argv.pop(1).split(":")
module = importlib.import_module(module)
before = getattr(module, name)


def pressed(*arguments, **options):
    os.kill(os.getpid(), signal.SIGINT)
    return before(*arguments, **options)


setattr(module, name, pressed)
sys.exit(main())
"""


def hears_ctrl_c() -> None:
    """What a shell starts in the background ignores SIGINT, and so do the tests in it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def start(folder: Path, words: list, environment: dict[str, str], **more) -> subprocess.Popen:
    (folder / "sitecustomize.py").write_text(HOOK)
    paths = [str(folder), os.environ.get("PYTHONPATH", "")]
    return subprocess.Popen(
        [sys.executable, *map(str, words)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths)), **environment},
        preexec_fn=hears_ctrl_c,
        **more,
    )


def must_be_interrupted(process: subprocess.Popen) -> tuple[str, str]:
    out, err = process.communicate(timeout=300)
    assert process.returncode == 130, (process.returncode, err)
    assert "Traceback" not in err and "ignored" not in err and "error" not in err, err
    return out, err


def left_over(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.rglob("*") if path.name not in ("sitecustomize.py", "__pycache__"))


@pytest.mark.parametrize(
    "module", ["numpy", "mcplan._core", "mcplan.cli", "mcplan.cli.app", "typer", "mcplan.cli.plan"]
)
def test_an_interrupt_while_it_starts(tmp_path, module):
    must_be_interrupted(start(tmp_path, ["-m", "mcplan", "plan", "flat", "-o", "a.npz"], {"AT": module}))
    assert [name for name in left_over(tmp_path) if not name.endswith(".pyc")] == []


@pytest.mark.parametrize("module", ["mcplan.view", "meshcat", "matplotlib.figure", "mcplan.kinematics.samples"])
def test_an_interrupt_while_what_draws_is_loaded(tmp_path, module):
    words = ["-m", "mcplan", "plan", "flat", "-o", "a.npz", "--html", "a.html", "--plots", "plots"]
    process = start(tmp_path, words, {"AT": module})
    out, err = process.communicate(timeout=300)
    if process.returncode == 0:
        pytest.skip(f"{module} is not looked for in this version")
    assert process.returncode == 130 and err == ""
    if (tmp_path / "a.npz").exists():  # some are asked for before planning
        mp.Plan.load(tmp_path / "a.npz")


@pytest.mark.parametrize(
    "call",
    [
        "mcplan.cli.outputs:require_outputs",
        "mcplan.solve:scene_of",
        "mcplan.cli.outputs:write_outputs",
        "mcplan.files.plans:plan_to_bytes",
        "mcplan.view.plots.save:save_plots",
        "mcplan.view.sheets:save_figure",
        "mcplan.cli.plan:report_text",
    ],
)
def test_an_interrupt_at_any_step_of_the_work(tmp_path, call):
    words = ["-c", AT_CALL, call, "plan", "flat", "-o", "a.npz", "--plots", "plots"]
    must_be_interrupted(start(tmp_path, words, {}))
    names = left_over(tmp_path)
    assert not [name for name in names if name.startswith(".")]
    if "a.npz" in names:
        mp.Plan.load(tmp_path / "a.npz")


@pytest.mark.parametrize("seed", range(4))
def test_an_interrupt_at_any_time(tmp_path, seed):
    """Counted from when the interpreter has come to the package: before, Python itself is spoken to."""
    reader, writer = os.pipe()
    words = ["-m", "mcplan", "plan", "gap_with_rail", "-o", "a.npz", "--html", "a.html", "--plots", "plots"]
    process = start(tmp_path, words, {"AT": "numpy", "SAY": str(writer)}, pass_fds=[writer])
    os.close(writer)
    with os.fdopen(reader, "rb") as pipe:
        assert pipe.read(1) == b"x"
    time.sleep(random.Random(seed).uniform(0.0, 1.0))
    process.send_signal(signal.SIGINT)
    must_be_interrupted(process)
    assert not [name for name in left_over(tmp_path) if name.startswith(".")]


def test_the_check_of_a_long_plan_can_be_interrupted(tmp_path):
    standing_plan(phases=100, duration_s=10.0).save(tmp_path / "long.npz")
    must_be_interrupted(start(tmp_path, ["-c", AT_CALL, "mcplan._core:check", "check", "long.npz"], {}))


def test_the_best_motion_is_saved_and_nothing_is_drawn(tmp_path):
    """SIGINT comes with the fifth line of the solver."""
    press = """
import os, signal, sys
from mcplan.cli import main
from mcplan.cli.sip_text import Progress

lines = []


def call(self, level, line):
    lines.append(line)
    if len(lines) == 5:
        os.kill(os.getpid(), signal.SIGINT)


Progress.__call__ = call
sys.exit(main())
"""
    words = ["-c", press, "sip", "cartwheel", "-o", "a.npz", "--html", "a.html", "--strip", "a.png"]
    out, err = must_be_interrupted(start(tmp_path, words, {}))
    assert out.startswith("cartwheel  climber9  interrupted after ")
    assert out.splitlines()[-1] == "Saved a.npz, with status interrupted"
    mp.PlanarPlan.load(tmp_path / "a.npz").validate()
    assert not (tmp_path / "a.html").exists() and not (tmp_path / "a.png").exists()


def test_a_walk_that_was_interrupted_did_not_fail(tmp_path):
    """SIGINT comes with the second cycle."""
    press = """
import os, signal, sys
from mcplan.cli import main
from mcplan.cli.rhp_text import Progress

rows = []


def row(self, cycle):
    rows.append(cycle)
    if len(rows) == 2:
        os.kill(os.getpid(), signal.SIGINT)


Progress.row = row
sys.exit(main())
"""
    out, _ = must_be_interrupted(start(tmp_path, ["-c", press, "rhp", "flat", "-o", "a.npz"], {}))
    assert out.splitlines()[-1] == "Saved a.npz, the 2 cycles before the interruption"


def test_an_interrupt_that_a_library_swallows_still_ends_with_130(tmp_path):
    swallow = """
import os, signal, sys
import mcplan.cli.version
from mcplan.cli import main


class Quiet:
    def __del__(self):
        os.kill(os.getpid(), signal.SIGINT)


before = mcplan.cli.version.version
import mcplan.cli.app as app


def version() -> None:
    Quiet()
    print("done")


app.app.command("quiet")(version)
sys.exit(main(["quiet"]))
"""
    out, _ = must_be_interrupted(start(tmp_path, ["-c", swallow], {}))
    assert out in ("done\n", "")


def test_an_interrupt_in_an_exec_is_forgotten_by_the_interpreter(tmp_path):
    """CPython would end the process by SIGINT then, and a script would see -2 and no exit code."""
    inside = """
import sys
import mcplan.cli.version
from mcplan.cli import main
import mcplan.cli.app as app


def made() -> None:
    exec("import os, signal; os.kill(os.getpid(), signal.SIGINT); print(1)")


app.app.command("made")(made)
sys.exit(main(["made"]))
"""
    must_be_interrupted(start(tmp_path, ["-c", inside], {}))
