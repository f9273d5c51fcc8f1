"""mcplan.export.crocoddyl: the script carries the motion, and Crocoddyl solves its problem from the warm start."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess

import numpy as np
import pytest

import mcplan as mp
from exports import plan, run

#: A Python with crocoddyl, an environment of its own: its wheels bring a Pinocchio that need not be ours.
CONSUMER = os.environ.get("MCPLAN_CROCODDYL_PYTHON", "")


def script(path):
    spec = importlib.util.spec_from_file_location("problem", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_script_carries_what_was_exported(tmp_path):
    data = script(mp.export(run(), "crocoddyl", tmp_path / "problem.py", rate_hz=50)).load()
    np.testing.assert_array_equal(data["q"][:, 7:], run().configurations[::2, 7:])
    np.testing.assert_array_equal(data["contacts"], run().contacts_plan[::2] >= 0)
    assert data["rate_hz"] == 50 and (data["frictions"] > 0.0).all()


def test_the_model_of_the_script_has_its_contacts_where_the_plan_has_them(tmp_path):
    import pinocchio as pin

    module = script(mp.export(plan(), "crocoddyl", tmp_path / "problem.py", rate_hz=10))
    data = module.load()
    model = module.build_model(data)
    state = model.createData()
    for n, q in enumerate(data["q"]):
        pin.framesForwardKinematics(model, state, q)
        for e, name in enumerate(data["end_effectors"]):
            if data["contacts"][n, e]:
                placement = state.oMf[model.getFrameId(f"mcplan/{name}")]
                np.testing.assert_allclose(placement.translation, data["positions_W"][n, e], atol=1e-5)
                np.testing.assert_allclose(placement.rotation, data["rotations_W"][n, e], atol=1e-4)


def test_the_script_knows_nothing_of_mcplan(tmp_path):
    text = mp.export(plan(), "crocoddyl", tmp_path / "problem.py", rate_hz=10).read_text()
    assert "import mcplan" not in text and "from mcplan" not in text and "from ." not in text


@pytest.mark.slow
@pytest.mark.skipif(not CONSUMER, reason="scripts/test_exports runs it")
def test_crocoddyl_solves_the_problem_and_keeps_the_feet_where_they_are(tmp_path):
    path = mp.export(plan(), "crocoddyl", tmp_path / "problem.py")
    bare = {name: text for name, text in os.environ.items() if name != "PYTHONPATH"}
    words = [CONSUMER, path, "--iterations", "50", "--save", tmp_path / "found.npz"]
    done = subprocess.run(words, capture_output=True, text=True, check=True, env=bare)
    report = json.loads(done.stdout)
    assert report["converged"] and report["cost"] < report["cost_at_start"] and report["iterations"] < 50
    module, found = script(path), np.load(tmp_path / "found.npz")
    data = module.load()
    import pinocchio as pin

    model = module.build_model(data)
    state = model.createData()
    worst = 0.0
    for n, x in enumerate(found["xs"]):
        pin.framesForwardKinematics(model, state, x[: model.nq])
        for e, name in enumerate(data["end_effectors"]):
            if data["contacts"][n, e] and data["feet"][e]:
                placement = state.oMf[model.getFrameId(f"mcplan/{name}")]
                worst = max(worst, float(np.linalg.norm(placement.translation - data["positions_W"][n, e])))
    assert worst < 0.02
