"""mcplan.cli.contacts_text and the report of mcplan plan: tables that fit 80 columns, violations told once."""

from __future__ import annotations

import copy
import re
import types

import pytest

import mcplan as mp
from mcplan.cli.contacts_text import WIDTH, contact_rows, wrapped
from mcplan.cli.plan import report_text
from standing import standing_plan


def table_plan(phases: int, surfaces: int, names: list[str]) -> mp.Plan:
    """A plan of many phases: end-effector l touches surface (k + l) mod surfaces, nothing in every fifth phase."""
    scene, robot = mp.load_scene("flat"), mp.load_robot("humanoid44")
    ends = []
    for name in names:
        end = copy.deepcopy(robot.end_effectors[0])
        end.name = name
        ends.append(end)
    robot.end_effectors = ends
    scene.surfaces = [mp.model.Surface(name=f"surface_number_{i}") for i in range(surfaces)]
    rows = [[-1 if k % 5 == 0 else (k + n) % surfaces for n in range(len(names))] for k in range(phases)]
    return mp.Plan(
        scene=scene,
        robot=robot,
        phases=[mp.model.Phase(duration=0.4, contacts=[mp.model.Contact(surface=i) for i in row]) for row in rows],
        final_contacts=[-1] * len(names),
    )


def read_back(lines: list[str], names: list[str]) -> dict[str, list[str]]:
    """Cells of every end-effector, the parts of the table joined."""
    cells: dict[str, list[str]] = {name: [] for name in names}
    for line in lines:
        name, *rest = line.split()
        if name in cells:
            cells[name] += rest
    return cells


@pytest.mark.parametrize("phases", [1, 18, 33, 34, 35, 288])
@pytest.mark.parametrize("surfaces", [1, 12, 120])
@pytest.mark.parametrize("ends", [1, 2, 8])
def test_the_contact_table_fits_80_columns_and_loses_nothing(phases, surfaces, ends):
    names = [f"end_effector_{n}" for n in range(ends)]
    plan = table_plan(phases, surfaces, names)
    lines = contact_rows(plan)
    assert max(len(line) for line in lines) <= WIDTH
    expected = [["-" if i < 0 else str(i) for i in column] for column in zip(*plan.contact_sequence(), strict=True)]
    assert read_back(lines, names) == dict(zip(names, expected, strict=True))


@pytest.mark.parametrize("length", [1, 24, 25, 60, 200])
def test_long_names_do_not_widen_the_table(length):
    plan = table_plan(50, 3, ["e" * length, "f"])
    for surface in plan.scene.surfaces:
        surface.name = "s" * length
    assert max(len(line) for line in contact_rows(plan)) <= WIDTH


def test_a_table_that_fits_is_one_block_without_phases():
    lines = contact_rows(standing_plan())
    assert lines[0] == "  right_foot  0 0 0" and not any("phases" in line for line in lines)


def test_only_surfaces_that_are_touched_are_named():
    plan = table_plan(4, 1000, ["foot"])
    text = " ".join(line.strip() for line in contact_rows(plan))
    assert re.findall(r"(\d+) surface_number_\1", text) == ["1", "2", "3"]


def test_a_plan_without_phases_has_no_table():
    assert contact_rows(mp.Plan()) == []


def test_wrapped_lines_hang_under_their_text():
    lines = wrapped("lead: " + ", ".join(f"word_{i}" for i in range(40)), "  ", " " * 8)
    assert len(lines) > 2 and max(len(line) for line in lines) <= WIDTH
    assert lines[0].startswith("  lead: word_0,") and all(line.startswith(" " * 8 + "word_") for line in lines[1:])


def result_of(
    status: str, worst: mp.model.Violation, message: str, plan: mp.Plan | None = None
) -> types.SimpleNamespace:
    """What mcplan.plan returns, made up."""
    report = types.SimpleNamespace(
        status=status,
        message=message,
        iterations=20,
        time_s=0.1,
        worst_violation=worst,
        friction_use={},
        warnings=(),
        paper_verdict="",
    )
    return types.SimpleNamespace(plan=plan if plan is not None else standing_plan(), report=report)


@pytest.mark.parametrize("status", ["infeasible", "acceptable", "time_limit", "iteration_limit"])
def test_a_violation_is_told_once(status):
    worst = mp.model.Violation(
        name="slip", phase=1, end_effector="left_foot", time_s=0.5, value=0.02, tolerance=1e-3, unit="m"
    )
    text = report_text(result_of(status, worst, f"the best plan violates {worst}"), [])
    assert text.count(str(worst)) == 1 and text.count("slip") == 1


def test_a_margin_within_tolerance_is_not_called_over_the_limit():
    worst = mp.model.Violation(name="orientation", phase=1, time_s=0.5, value=0.0017, tolerance=0.0175, unit="rad")
    text = report_text(result_of("solved", worst, "the checker accepts the plan"), [])
    assert "0.0017 rad, within tolerance (0.0175)" in text and "over the limit" not in text


def test_what_has_no_plan_has_no_worst_place():
    scene = mp.load_scene("gap")
    scene.surfaces = [surface for surface in scene.surfaces]
    scene.surfaces[1].end_effectors = ["hand"]
    scene.surfaces[1].vertices_W = scene.surfaces[1].vertices_W + [0.0, 0.0, 0.9]  # where hands hang
    scene.goal.contacts = {"right_hand": scene.surfaces[1].name}
    result = mp.plan(scene, "humanoid44", phases=2)
    assert str(result.report.status) == "no_sequence"
    text = report_text(result, [])
    assert "no contact sequence joins start and goal" in text
    assert "over the limit" not in text and "worst" not in text
