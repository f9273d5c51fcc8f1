"""First cycles against optima that CasADi and its Ipopt found for the same programs, written from the equations alone.

tests/data/wang_casadi_first_cycles.json says with which command and versions they were made.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

import mcplan as mp
from mcplan import rhp

ROWS = json.loads((Path(__file__).parents[1] / "data/wang_casadi_first_cycles.json").read_text())["rows"]
SLOW = {"up_and_down", "v_shape"}


def first_cycle(row: dict[str, Any]) -> rhp.Cycle:
    options = rhp.Options()
    options.fidelity = getattr(rhp.Fidelity, row["fidelity"])
    options.transcription = getattr(rhp.Transcription, row["transcription"])
    options.lookahead, options.paper = row["lookahead"], row["paper"]
    # The recorded programs let soles stand on edges. Their pyramid inside the friction cone is that of the rows.
    options.foothold_margin_m = 0.0
    options.friction_rows = not row["paper"]
    # Forces act at the soles' very corners there, and the CoM may be as low as the authors have it.
    options.sole_ratio, options.com_height = 1.0, (0.87, 1.07)
    return rhp.RecedingHorizon(mp.load_scene(row["terrain"]), mp.load_robot("talos_wang"), options).step()


@pytest.mark.parametrize(
    "row",
    [pytest.param(row, marks=pytest.mark.slow if row["terrain"] in SLOW else ()) for row in ROWS],
    ids=lambda row: "-".join(str(row[key]) for key in ("terrain", "fidelity", "lookahead", "transcription")),
)
def test_first_cycle_has_the_recorded_optimum(row: dict[str, Any]) -> None:
    cycle = first_cycle(row)
    assert cycle.executed
    # Some programs have several optima close together: any of those that CasADi finds is one.
    known = [row["objective"], *row.get("from_noisy_guesses", [])]
    nearest = min(known, key=lambda cost: abs(cost - cycle.cost))
    # Interior points stop at products of 1e-6 to 1e-5 of slacks and multipliers, and there are some thousand of them.
    assert cycle.cost == pytest.approx(nearest, abs=0.01)
    if nearest == row["objective"]:
        assert cycle.acceleration_cost == pytest.approx(row["parts"]["acc_executed"], rel=2e-3)
