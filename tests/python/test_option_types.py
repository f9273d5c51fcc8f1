"""mcplan.option_types: what is checked in is what the compiled module says, and type checkers see a wrong option."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import mcplan as mp
from mcplan import option_types
from mcplan.options import ALIASES, option_names

ROOT = Path(__file__).resolve().parents[2]


def test_options_by_name_are_those_of_the_compiled_module(tmp_path):
    made = tmp_path / "option_types.py"
    subprocess.run([sys.executable, ROOT / "scripts/option_types", made], check=True)
    assert (ROOT / "python/mcplan/option_types.py").read_text() == made.read_text(), "run scripts/option_types"


@pytest.mark.parametrize("engine", ["ddp", "rhp", "sip"])
def test_every_option_can_be_given_by_name(engine):
    names = set(option_names(getattr(mp, engine).Options)) | set(ALIASES)
    assert set(getattr(option_types, f"{engine.capitalize()}Options").__annotations__) == names


RIGHT = """
import mcplan as mp

mp.plan("flat", "anymal", phases=24, time_limit=1.0, method="paper", weights={"flight": 2.0, "com": 1})
mp.plan("flat", options=mp.ddp.Options(phases=24), model=mp.ddp.Model.lipm, initial_sequence=[[0, -1], [0, 0]])
mp.plan("flat", "talos", motion=True, phases=24).motion_result
mp.ddp.plan("flat", logger=lambda level, line: print(line)).report.status.name
mp.walk("rubbles", fidelity="single", lookahead=2, double_support_s=(0.1, 0.2), time_limit=None).cycles
mp.receding_horizon("rubbles", paper=True).step().executed
mp.whole_body("climbing", forces="per_body", minimise="time", tube_m=1e-4).plan.at(0.5)
mp.sip.plan("climbing", options=mp.sip.Options(order=10)).certificate
chosen: "mp.option_types.RhpOptions" = {"cycles": 3}
mp.rhp.walk("flat", **chosen).plan.save("walk.npz")
scene: mp.Scene = mp.load_scene("flat")
scene.surfaces = [mp.model.Surface(name="floor")]
""".replace("mp.option_types.RhpOptions", "RhpOptions").replace(
    "import mcplan as mp\n", "import mcplan as mp\nfrom mcplan.option_types import RhpOptions\n", 1
)
#: mp.plan has two signatures, with and without a motion: mypy names the call, and notes both.
NO_PLAN = 'No overload variant of "plan" matches argument types'
WRONG = {
    'mp.plan("flat", phasse=24)': NO_PLAN,
    'mp.plan("flat", phases="many")': NO_PLAN,
    'mp.plan("flat", method="papers")': NO_PLAN,
    'mp.plan("flat", weights={"con": 1.0})': NO_PLAN,
    'mp.plan("flat", options=mp.rhp.Options())': NO_PLAN,
    "mp.replan(mp.Plan(), 0.0, mp.model.Knot(), restart=1)": 'Unexpected keyword argument "restart" for "replan"',
    'mp.walk("flat", lookahead=2.5)': 'Argument "lookahead" to "walk" has incompatible type "float"',
    'mp.receding_horizon("flat", fidelity="pont")': 'Argument "fidelity" to "receding_horizon" has incompatible type',
    'mp.whole_body("climbing", tube=1e-3)': 'Unexpected keyword argument "tube" for "whole_body"',
    'mp.sip.plan("climbing", neq=None)': 'Argument "neq" has incompatible type "None"',
    "mp.ddp.Options(phasse=24)": 'Unexpected keyword argument "phasse" for "Options"',
    "mp.plna": 'Module has no attribute "plna"',
}


def test_a_wrong_option_is_an_error_of_types(tmp_path):
    pytest.importorskip("mypy")
    script = tmp_path / "uses.py"
    head = RIGHT.count("\n") + 1
    script.write_text(RIGHT + "\n".join(WRONG) + "\n")
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", f"--cache-dir={tmp_path / 'cache'}", script]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    found = [line.split(":", 2) for line in done.stdout.splitlines() if ": error: " in line]
    about = {int(line): text for path, line, text in found if Path(path).name == "uses.py"}
    assert set(about) == {head + i for i in range(len(WRONG))}, done.stdout
    for i, (call, error) in enumerate(WRONG.items()):
        assert error in about[head + i], (call, about[head + i])
