"""The recorded first cycles again: `pytest benchmarks/wang_casadi`, with the extra `bench`."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from horizon import Settings  # noqa: E402
from loop import Loop  # noqa: E402
from walker import load_walker  # noqa: E402

ROWS = json.loads((Path(__file__).parents[2] / "tests/data/wang_casadi_first_cycles.json").read_text())["rows"]
V_SHAPE = [row for row in ROWS if row["terrain"] == "v_shape"]


@pytest.mark.parametrize("row", V_SHAPE, ids=lambda row: f"{row['fidelity']}-{row['lookahead']}-{row['transcription']}")
def test_recorded_optimum_is_found_again(row: dict) -> None:
    settings = Settings(row["fidelity"], row["lookahead"], row["transcription"], row["paper"])
    outcome = Loop(load_walker("v_shape"), settings).step().outcome
    assert outcome.success
    assert outcome.objective == pytest.approx(row["objective"], rel=1e-6)


@pytest.mark.parametrize("fidelity, lookahead", [("single", 2), ("rectangle", 3), ("point", 3)])
def test_plain_form_has_the_optimum_of_the_reduced_one(fidelity: str, lookahead: int) -> None:
    same, plain = (
        Loop(load_walker("v_shape"), Settings(fidelity, lookahead, "euler", True, form)).step().outcome
        for form in ("same", "plain")
    )
    assert plain.objective == pytest.approx(same.objective, rel=1e-6)
    assert plain.parts["acc_executed"] == pytest.approx(same.parts["acc_executed"], rel=1e-2)
