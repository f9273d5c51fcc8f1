"""mp.export and mcplan export: what they take, what they refuse, and what they leave behind."""

from __future__ import annotations

import copy
import json
import re
import subprocess
import sys

import numpy as np
import pytest

import mcplan as mp
from command_line import one_line_error
from exports import plan
from mcplan.cli import main
from mcplan.files.export_formats import FORMATS


def test_files_of_plans_and_runs_are_taken_as_objects_are(tmp_path):
    plan().save(tmp_path / "plan.npz")
    one = np.load(mp.export(plan(), "contacts", tmp_path / "one.npz"))
    other = np.load(mp.export(tmp_path / "plan.npz", "contacts", tmp_path / "other.npz"))
    assert all((one[key] == other[key]).all() for key in one.files)


@pytest.mark.parametrize("name", FORMATS)
def test_the_same_plan_gives_the_same_bytes(name, tmp_path):
    suffix = FORMATS[name].suffix[0]
    rate = None if FORMATS[name].rate_hz in (0.0, 30.0) else 10
    paths = [mp.export(plan(), name, tmp_path / f"{n}{suffix}", rate_hz=rate) for n in range(2)]
    assert paths[0].read_bytes() == paths[1].read_bytes()


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        (("mjlba", "a.npz"), {}, "to: no such format. Did you mean 'mjlab'? Formats: mjlab, isaaclab, "),
        (("mjlab", "a.csv"), {}, "path: must end in .npz, got "),
        (("mjlab", "none/a.npz"), {}, "path: must lie in a folder that exists, got "),
        (("mjlab", "a.npz"), {"rate_hz": 0}, "rate_hz: must lie in 1 to 1000 [1/s], got 0.0"),
        (("mjlab", "a.npz"), {"robot": "anymal"}, "must have the plan's 'right_foot'"),
    ],
)
def test_errors_name_field_value_and_rule(arguments, options, message, tmp_path):
    with pytest.raises(mp.InvalidInput, match=re.escape(message)):
        mp.export(plan(), arguments[0], tmp_path / arguments[1], **options)
    assert not list(tmp_path.iterdir())


def test_planar_plans_and_results_are_refused(tmp_path):
    planar = mp.PlanarPlan(task=mp.load_planar_task("stairs"))
    with pytest.raises(mp.InvalidInput, match="what: must be a plan of ddp or rhp"):
        mp.export(planar, "contacts", tmp_path / "a.npz")
    with pytest.raises(mp.errors.InvalidArgument, match="what: must be a Plan"):
        mp.export(3, "contacts", tmp_path / "a.npz")


def test_the_file_that_is_read_is_not_replaced(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    plan().save("plan.npz")
    before = (tmp_path / "plan.npz").read_bytes()
    (tmp_path / "link.npz").symlink_to("plan.npz")
    for words, option in (
        (["export", "plan.npz", "--to", "contacts", "-o", "link.npz"], "--output"),
        (["motion", "plan.npz", "-o", "./plan.npz"], "--output"),
        (["track", "link.npz", "--save", "plan.npz"], "--save"),
    ):
        message = one_line_error((main(words), *capsys.readouterr()))
        assert message.startswith(f"{option}: must be another file than the one that is read, got ")
    assert (tmp_path / "plan.npz").read_bytes() == before


@pytest.mark.parametrize("name", ["a\0.npz", "\ud800.npz"])
def test_names_that_no_file_has_are_refused(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for write in (lambda: mp.export(plan(), "contacts", name), lambda: plan().save(name)):
        with pytest.raises(
            mp.InvalidInput, match="path: must (have no null character|be text that can be encoded), got "
        ):
            write()


def test_a_malformed_plan_and_a_robot_of_another_type_are_named(tmp_path):
    broken = copy.deepcopy(plan())
    broken.phases[0].duration = float("nan")
    with pytest.raises(mp.errors.InvalidPlan, match=r"phases\[0\].duration: must be a positive number, got nan"):
        mp.export(broken, "contacts", tmp_path / "a.npz")
    with pytest.raises(mp.errors.InvalidArgument, match="robot: must be a Robot, a name, a path or None, got 3"):
        mp.export(plan(), "mjlab", tmp_path / "a.npz", robot=3)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("to", ["contacts", "centroidal", "contact-sequence"])
def test_a_robot_for_a_format_without_joints_is_refused(tmp_path, to):
    with pytest.raises(mp.InvalidInput, match=f"robot: must not be given for {to}, which has no joints"):
        mp.export(plan(), to, tmp_path / "a.json" if to != "contacts" else tmp_path / "a.npz", robot="talos")
    assert not list(tmp_path.iterdir())


def test_what_fails_leaves_the_file_of_before(tmp_path):
    path = tmp_path / "a.npz"
    path.write_bytes(b"before")
    with pytest.raises(mp.InvalidInput):
        mp.export(plan(), "mjlab", path, rate_hz=12.5)
    assert path.read_bytes() == b"before" and list(tmp_path.iterdir()) == [path]


def test_the_command_writes_and_lists(tmp_path, capsys):
    plan().save(tmp_path / "plan.npz")
    out = tmp_path / "out.npz"
    assert main(["export", str(tmp_path / "plan.npz"), "--to", "contacts", "-o", str(out), "--json"]) == 0
    said = json.loads(capsys.readouterr().out)
    assert said == {"file": str(tmp_path / "plan.npz"), "format": "contacts", "output": str(out)}
    assert out.exists()
    assert main(["export", "--list", "--json"]) == 0
    assert [entry["name"] for entry in json.loads(capsys.readouterr().out)["formats"]] == list(FORMATS)
    assert main(["export", "--list"]) == 0
    assert all(name in capsys.readouterr().out for name in ["mjlab"])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "FILE: is required"),
        (["plan.npz"], "--to: is required"),
        (["plan.npz", "--to", "mjlab"], "--output: is required"),
        (["--list", "--to", "mjlab"], "--to: must not stand beside --list"),
    ],
)
def test_the_command_says_what_is_missing(words, message, capsys):
    assert one_line_error((main(["export", *words]), *capsys.readouterr())).startswith(message)


def test_importing_the_formats_loads_nothing_heavy():
    code = "import sys, mcplan.export; print([m for m in ('pinocchio', 'mujoco', 'crocoddyl') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
