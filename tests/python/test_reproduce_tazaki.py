"""mcplan_bench.reproduce.tazaki: the page with its table and figures."""

from __future__ import annotations

import csv
import re
from types import SimpleNamespace

import numpy as np
import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan_bench.reproduce import tazaki, tazaki_models, tazaki_text
from wrench_plans import LEFT_HAND, RIGHT_HAND, hanging_plan, leaning_plan, with_contact

pytest.importorskip("matplotlib")


@pytest.mark.slow
def test_the_page_shows_the_published_times_and_links_what_was_written(tmp_path, capsys):
    assert main(["reproduce", "tazaki", "--quick", "--out", str(tmp_path)]) == 0
    assert str(tmp_path / "tazaki.md") in capsys.readouterr().out
    page = (tmp_path / "tazaki.md").read_text()
    assert "| flat | 12.16 | 11.36 |" in page
    figures = re.findall(r"\]\((.+?\.png)\)", page)
    assert {"tazaki_figure_1.png", "tazaki_figure_3.png", "tazaki_figure_4.png"} <= set(figures)
    for name in figures:
        assert (tmp_path / name).read_bytes().startswith(b"\x89PNG")
    with (tmp_path / "tazaki_table_2.csv").open(newline="") as file:
        (row,) = csv.DictReader(file)
    assert float(row["paper_1_ms"]) > 0.0 and float(row["standard_1_ms"]) > 0.0
    with (tmp_path / "tazaki_models.csv").open(newline="") as file:
        paper, ours = csv.DictReader(file)
    assert (paper["model"], ours["model"]) == ("lipm", "wrench")
    assert float(ours["cost"]) < float(paper["cost"])
    assert "## The paper's model of contacts against ours" in page and "| flat | ours |" in page
    assert "pads held" not in page and not (tmp_path / "tazaki_hand_forces.png").exists()  # there are no hands on flat
    assert "| flat | ours, `wrench` | 2 of 2 |" in page and "30 joints and 44 kg" in page
    robot = mp.load_robot(tmp_path / "humanoid44_joints.toml")
    assert robot.mass == 44.0 and (tmp_path / "humanoid44_joints.urdf").samefile(robot.urdf)


def result_of(plan: mp.Plan, status: str = "solved") -> SimpleNamespace:
    report = SimpleNamespace(status=status, cost_terms={"task": 0.2, "flight": 0.5})
    return SimpleNamespace(plan=plan, report=report)


def test_a_row_compares_what_contacts_are_asked_for():
    """Hands that bear half the weight each straight up, and a foot beside the CoM that turns the body."""
    row = tazaki_models.row_of("gap_with_rail", tazaki_models.HELD, "wrench", result_of(hanging_plan()))
    assert (row["cost"], row["hands_only"], row["friction_foot"]) == (0.2, 1, None)
    assert row["friction_hand"] == pytest.approx(0.0, abs=1e-9) and row["peak_hand"] == pytest.approx(0.5)
    assert row["com_low_m"] == pytest.approx(0.7) and row["replay_com_m"] < 1e-10
    row = tazaki_models.row_of("flat", "", "wrench", result_of(leaning_plan()))
    assert row["momentum_Nms"] == pytest.approx(0.1 * 44.0 * 9.8 * 0.4) and row["replay_orientation_deg"] < 1e-8
    nothing = tazaki_models.row_of("flat", "", "lipm", result_of(mp.Plan(), "no_sequence"))
    assert nothing["status"] == "no_sequence" and nothing["cost"] is nothing["replay_com_m"] is None
    pulling = with_contact(hanging_plan(), 0, RIGHT_HAND, anchor_W=[0.0, 0.0, 0.8])
    pulls = tazaki_models.row_of("gap_with_rail", tazaki_models.TOUCHED, "wrench", result_of(pulling))
    lines = "\n".join(tazaki_models.section_lines([row, nothing, pulls], "hand_forces.png"))
    assert "| flat | ours | solved | 0.2 | 0.00 | - |" in lines and "| flat | paper's | no_sequence | - |" in lines
    assert "| gap_with_rail, pads with friction | ours | solved | 0.2 | - | pulls |" in lines
    assert "](hand_forces.png)" in lines


def test_pads_are_held_and_ground_is_not():
    for held in (True, False):
        scene = tazaki_models.with_pads(mp.load_scene("gap_with_rail"), held)
        assert {s.name: s.grasp for s in scene.surfaces} == {
            "before": False,
            "after": False,
            "right_pad": held,
            "left_pad": held,
        }
        assert {s.friction for s in scene.surfaces} == {0.7}


def test_hand_forces_are_drawn_by_side(tmp_path):
    """A line of force that passes 0.07 m to the right of s = (0, 0, 0) leans to the left by a tenth, and the reverse."""
    plan = with_contact(hanging_plan(), 0, RIGHT_HAND, anchor_W=[0.0, -0.07, 0.0])
    plan = with_contact(plan, 0, LEFT_HAND, anchor_W=[0.0, 0.07, 0.0])
    forces = tazaki_models.hand_forces(plan)
    half = 0.5 * 44.0 * 9.8
    assert forces["right_hand"][0] == pytest.approx([0.1 * half, half])
    assert forces["left_hand"][0] == pytest.approx([-0.1 * half, half])
    assert tazaki_models.hand_forces(leaning_plan()) == {}
    held, touched = (tazaki_models.HELD, "lipm"), (tazaki_models.TOUCHED, "wrench")
    path = tazaki_models.save_hand_forces(tmp_path, {held: result_of(plan), touched: result_of(hanging_plan())})
    assert path is not None and path.read_bytes().startswith(b"\x89PNG")
    assert tazaki_models.save_hand_forces(tmp_path, {}) is None
    chart = tazaki_models.plot_hand_forces(leaning_plan(), plan).axes[0]
    assert np.isfinite(chart.get_ylim()).all()  # also with nothing to draw


def test_the_table_of_the_paper_is_typed_in_right():
    """The paper's own remark: parallel runs took longer on every scene."""
    assert set(tazaki.PUBLISHED_MS) == set(tazaki.SCENES)
    assert all(parallel > alone for parallel, alone in tazaki.PUBLISHED_MS.values())


def test_an_unknown_paper_is_an_error_that_lists_the_known(capsys):
    assert main(["reproduce", "tazki"]) == 2
    assert "must be one of lengagne, tazaki, wang" in capsys.readouterr().err


def row_with(paper_loops: int, standard_loops: int) -> dict[str, float]:
    times = {"paper_parallel_ms": 3.0, "paper_1_ms": 2.0, "standard_parallel_ms": 0.5, "standard_1_ms": 0.4}
    return {**times, "paper_parallel_loops": paper_loops, "standard_parallel_loops": standard_loops}


def test_an_effect_of_threads_is_told_only_where_threads_ran():
    none = " ".join(tazaki_text.threads_text([row_with(0, 0)], 2, False))
    assert "times as long" not in none and none.count("started no thread") == 2
    published = " ".join(tazaki_text.threads_text([row_with(120, 0)], 2, False))
    assert "shared out 120 loops" in published and "1.50 times as long" in published
    assert "Ours started no thread: it shares out loops of 400 neighbours or more" in published
    assert "waited for cores" not in published
    assert "waited for cores" in " ".join(tazaki_text.threads_text([row_with(120, 0)], 2, True))
    cells = [tazaki_text.cell(row_with(120, 0), f"{method}_parallel_ms") for method in ("paper", "standard")]
    assert cells == ["3.00", "–"]
