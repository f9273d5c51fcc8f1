"""ProxQP's build: the one whose runs repeat, unless somebody chose another before."""

import subprocess
import sys

import pytest

pytest.importorskip("proxsuite")

SOLVE = """
import numpy as np
from mcplan.tracking.quadratic_program import Problem, QuadraticProgram

program = QuadraticProgram()
problem = Problem(np.eye(2), np.array([-1.0, -1.5]), np.ones((1, 2)), np.ones(1), np.eye(2), np.zeros(2), np.ones(2))
x = program.solve(problem, "any")
assert np.allclose(x, [0.25, 0.75], atol=1e-4), x
"""


def run(code: str) -> str:
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_build_without_avx_is_taken_and_stays_when_proxsuite_is_imported_later():
    urdf_model = run(
        SOLVE + "import sys, proxsuite; print(*[name for name in sys.modules if 'pywrap' in name])"
    ).split()
    assert {name.split(".")[1] for name in urdf_model} == {"proxsuite_pywrap"}
    assert "instructionset" not in " ".join(urdf_model)


def test_a_build_that_was_imported_before_is_used():
    run("import proxsuite\n" + SOLVE)
