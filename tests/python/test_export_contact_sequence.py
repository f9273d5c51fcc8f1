"""mcplan.export.contact_sequence: keys of multicontact-api, its rules, and curves that ndcurves takes."""

from __future__ import annotations

import functools
import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import mcplan as mp
from exports import plan

#: Names of ContactPhase::serialize of multicontact-api, without those of whole bodies, which may be left out.
KEYS = {f"{name}_{end}" for name in ("c", "dc", "ddc", "L", "dL") for end in ("init", "final")}
KEYS |= {"c", "dc", "ddc", "L", "dL", "root", "contact_forces", "contact_normal_force", "effector_trajectories"}
KEYS |= {"effector_in_contact", "contact_patches", "t_init", "t_final"}


@functools.cache
def _exported(folder: str) -> dict:
    return json.loads(mp.export(plan(), "contact-sequence", Path(folder) / "plan.json").read_text())


@pytest.fixture
def exported(tmp_path_factory):
    return _exported(str(tmp_path_factory.getbasetemp()))


def value(curve: dict, t: float) -> np.ndarray:
    times = np.array(curve["times"])
    i = min(max(int(np.searchsorted(times, t, "right")) - 1, 0), len(times) - 2)
    return np.array(curve["coefficients"][i]) @ (t - times[i]) ** np.arange(len(curve["coefficients"][i][0]))


def test_keys_are_those_of_the_library(exported):
    assert set(exported) == {"size", "contact_phase"} and exported["size"] == len(exported["contact_phase"])
    for phase in exported["contact_phase"]:
        assert set(phase) == KEYS
        for patch in phase["contact_patches"].values():
            assert set(patch) == {"placement", "mu"} and patch["mu"] > 0.0


def test_phases_follow_each_other_as_the_library_asks(exported):
    """haveTimings and haveConsistentContacts: one change between phases, none without contact; values go on."""
    phases = exported["contact_phase"]
    assert phases[0]["t_init"] == 0.0 and phases[-1]["t_final"] == pytest.approx(plan().duration())
    for before, after in zip(phases[:-1], phases[1:], strict=True):
        assert before["t_final"] == after["t_init"]
        assert len(set(before["effector_in_contact"]) ^ set(after["effector_in_contact"])) == 1
        for key in ("c", "dc", "L"):
            np.testing.assert_allclose(before[f"{key}_final"], after[f"{key}_init"], atol=1e-12)
    for phase in phases:
        assert set(phase["effector_in_contact"]) == set(phase["contact_patches"]) == set(phase["contact_forces"])
        assert not set(phase["effector_trajectories"]) & set(phase["effector_in_contact"])


def test_curves_are_the_plan_between_their_points(exported):
    for phase in exported["contact_phase"]:
        for t in np.linspace(phase["t_init"], phase["t_final"], 37)[1:-1]:
            state = plan().at(t)
            np.testing.assert_allclose(value(phase["c"], t), state.com_W, atol=1e-6)
            np.testing.assert_allclose(value(phase["dc"], t), state.com_velocity_W, atol=1e-4)
            np.testing.assert_allclose(value(phase["L"], t), state.angular_momentum_W, atol=1e-2)
            for end, own in zip(plan().robot.end_effectors, state.end_effectors, strict=True):
                if own.surface >= 0:
                    np.testing.assert_allclose(value(phase["contact_forces"][end.name], t), own.force_W, atol=1.0)


def test_patches_lie_where_the_feet_are(exported):
    for phase in exported["contact_phase"]:
        state = plan().at(0.5 * (phase["t_init"] + phase["t_final"]))
        for end, own in zip(plan().robot.end_effectors, state.end_effectors, strict=True):
            if own.surface >= 0:
                placement = phase["contact_patches"][end.name]["placement"]
                np.testing.assert_allclose(placement["translation"], own.position_W, atol=1e-9)
                np.testing.assert_allclose(np.array(placement["rotation"])[:, 2], [0, 0, 1], atol=1e-12)


#: A Python with ndcurves, which PyPI has; multicontact-api is not there.
CONSUMER = os.environ.get("MCPLAN_NDCURVES_PYTHON", "")
READ = """
import json, sys
import numpy as np, ndcurves
phases = json.load(open(sys.argv[1]))["contact_phase"]
for phase in phases:
    curve, spatial = ndcurves.piecewise(), ndcurves.piecewise_SE3()
    times = phase["c"]["times"]
    for i, piece in enumerate(phase["c"]["coefficients"]):
        curve.append(ndcurves.polynomial(np.array(piece), times[i], times[i + 1]))
    root = phase["root"]
    for i in range(len(times) - 1):
        move, turn = np.array(root["translation"]), np.array(root["rotation"])
        spatial.append(ndcurves.SE3Curve(move[i], move[i + 1], turn[i], turn[i + 1], times[i], times[i + 1]))
    middle = 0.5 * (phase["t_init"] + phase["t_final"])
    assert curve.is_continuous(1) and abs(curve.max() - phase["t_final"]) < 1e-12
    print(json.dumps([middle, curve(middle).tolist(), spatial.translation(middle).tolist()]))
"""


@pytest.mark.slow
@pytest.mark.skipif(not CONSUMER, reason="scripts/test_exports runs it")
def test_ndcurves_takes_the_curves(tmp_path):
    path = mp.export(plan(), "contact-sequence", tmp_path / "plan.json")
    bare = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([CONSUMER, "-c", READ, path], capture_output=True, text=True, check=True, env=bare)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(lines) > 5
    for t, com, root in lines:
        np.testing.assert_allclose(com, plan().at(t).com_W, atol=1e-6)
        np.testing.assert_allclose(root, plan().at(t).com_W, atol=1e-3)
