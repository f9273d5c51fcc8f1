"""The stages made for fatrop hold the same problem: `pytest benchmarks/wang_casadi`, with the extra `bench`."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
from horizon import Settings  # noqa: E402
from loop import Loop  # noqa: E402
from stages import StagedHorizon  # noqa: E402
from walker import load_walker  # noqa: E402

OPTIONS = {
    "ipopt": {"ipopt": {"print_level": 0, "sb": "yes", "tol": 1e-5, "constr_viol_tol": 1e-6}},
    "fatrop": {"fatrop": {"print_level": 0, "tol": 1e-5, "max_iter": 300}},
}


@pytest.mark.parametrize(
    "fidelity, lookahead, mode, plugin",
    [
        ("single", 1, ("euler", True), "ipopt"),
        ("single", 1, ("trapezoidal", False), "ipopt"),
        ("point", 2, ("euler", True), "fatrop"),
        ("point", 2, ("trapezoidal", False), "ipopt"),
        ("point", 2, ("trapezoidal", False), "fatrop"),
    ],
)
def test_stages_have_the_optimum_of_the_whole_and_keep_its_rows(
    fidelity: str, lookahead: int, mode: tuple[str, bool], plugin: str
) -> None:
    walker, settings = load_walker("rubbles"), Settings(fidelity, lookahead, *mode)
    foot = walker.step(0)[0]
    staged = StagedHorizon(walker, settings, foot, plugin, OPTIONS[plugin])
    loop = Loop(walker, settings, {foot: staged})
    found = loop.step()
    whole = SimpleNamespace(
        first_foot=foot, program=staged.whole, points=staged.points, standing=staged.standing
    )  # what a Loop asks of a horizon
    expected = Loop(walker, settings, {foot: whole}).step().outcome
    assert found.outcome.success and expected.success
    assert found.outcome.objective == pytest.approx(expected.objective, rel=1e-5)
    assert sum(found.outcome.parts.values()) == pytest.approx(found.outcome.objective, rel=1e-9)

    patches = [walker.step(i)[1] for i in range(lookahead)]
    parameters = loop.parameters(found.start, foot, patches, loop.origins)
    assert staged.whole.violation(found.outcome.values, parameters) < 1e-5
    wrong = found.outcome.values | {("c", 5): found.outcome.values["c", 5] + [0.0, 0.0, 1e-3]}
    assert staged.whole.violation(wrong, parameters) > 5e-4
    np.testing.assert_allclose(found.outcome.values["c", 0], found.start.com, atol=1e-9)
