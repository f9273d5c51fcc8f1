"""The viewer asks for its packages when used, in one line."""

import os
import subprocess
import sys

import pytest


def run(script: str) -> str:
    result = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": ":".join(sys.path)},
    )
    return result.stdout.strip()


HIDE = """
import sys
class Hide:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in {hidden!r}:
            raise ModuleNotFoundError(name)
import importlib.util
real = importlib.util.find_spec
def find(name, package=None):
    return None if name.split(".")[0] in {hidden!r} else real(name, package)
importlib.util.find_spec = find
sys.meta_path.insert(0, Hide())
"""


def test_import_loads_nothing_heavy():
    heavy = ("matplotlib", "meshcat", "mujoco", "pinocchio", "zmq", "umsgpack")
    rooms = "mcplan.view, mcplan.planar.view, mcplan.planar.tracking, mcplan.showing, mcplan.following"
    loaded = run(f"import {rooms}, sys; print([m for m in {heavy} if m in sys.modules])")
    assert loaded == "[]"


def test_missing_meshcat_is_one_line():
    script = (
        HIDE.format(hidden=["meshcat", "umsgpack"])
        + """
import plans_by_hand as h, mcplan as mp
try:
    mp.show(h.walk(h.flat(), h.humanoid()))
except mp.errors.MissingExtra as error:
    print(error)
"""
    )
    assert run(script) == "mcplan.show needs meshcat: pip install 'mcplan[view]'"


def test_missing_matplotlib_is_one_line():
    script = (
        HIDE.format(hidden=["matplotlib"])
        + """
import plans_by_hand as h, mcplan as mp, mcplan.view as view
try:
    view.plot_com(h.walk(h.flat(), h.humanoid()))
except mp.errors.MissingExtra as error:
    print(error)
"""
    )
    assert run(script) == "mcplan.view.plots needs matplotlib: pip install 'mcplan[view]'"


@pytest.mark.parametrize(
    ("call", "hidden", "message"),
    [
        ("mp.show(plan)", ["meshcat", "umsgpack"], "mcplan.show needs meshcat"),
        ("planar.film_strip(plan)", ["matplotlib"], "mcplan.planar.view.film_strip needs matplotlib"),
        ("planar.stroboscope(plan)", ["matplotlib"], "mcplan.planar.view.stroboscope needs matplotlib"),
        ("planar.plot_torques(plan)", ["matplotlib"], "mcplan.view.plots needs matplotlib"),
        ("planar.plot_cones(plan)", ["matplotlib"], "mcplan.view.plots needs matplotlib"),
        ("planar.save_whole_body_plots(plan, '.')", ["matplotlib"], "mcplan.planar.view.film_strip needs matplotlib"),
    ],
)
def test_pictures_of_whole_body_plans_name_what_they_miss(call, hidden, message):
    script = (
        HIDE.format(hidden=hidden)
        + f"""
import mcplan as mp, mcplan.planar.view as planar
from reference_solutions import reference_plan
plan = reference_plan("walking", "optimised_uniform")
try:
    {call}
except mp.errors.MissingExtra as error:
    print(error)
"""
    )
    assert run(script) == f"{message}: pip install 'mcplan[view]'"
