"""mcplan_bench.reproduce.lengagne: the published tables, runs, tables, page."""

from __future__ import annotations

import csv
import json
import re

import pytest

import mcplan
from mcplan.cli import main
from mcplan_bench.reproduce import lengagne_paper as paper
from mcplan_bench.reproduce import lengagne_runs, lengagne_settings, lengagne_tables, lengagne_text
from mcplan_bench.reproduce.lengagne_runs import Run
from mcplan_bench.reproduce.lengagne_settings import Config

pytest.importorskip("matplotlib")


def read(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def made_up(config, status="solved", message="converged", cost=None, **numbers):
    """A run of round numbers."""
    values = {"parameters": 82, "constraints": 1000, "iterations": 40, "time_s": 0.5, "cpu_s": 0.4, "evaluation_s": 0.1}
    values |= {"linear_solver_s": 0.3, "repeats": 1, "load": 1.0, "duration_s": 2.0, "drift_m": 1e-3, "drift_rad": 2e-3}
    return Run(config, status=status, message=message, cost=cost, beyond={}, **{**values, **numbers})


def planner(config):
    """The planner that a row is run with."""
    from mcplan.planar.planning import make_options

    options = config.options()
    return mcplan.sip.Planner(mcplan.load_planar_task(config.motion), make_options(options.pop("minimise"), options))


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    out = tmp_path_factory.mktemp("lengagne")
    assert main(["reproduce", "lengagne", "--quick", "--tables", "2,4", "--out", str(out)]) == 0
    return out


@pytest.mark.parametrize("motion", paper.MOTIONS)
def test_the_planner_has_the_papers_numbers_of_parameters(motion):
    free_flyer = planner(Config(1, motion, "band", 0)).parameters
    printed = paper.TABLE_1[motion, 0].parameters
    assert free_flyer == (109 if motion == "cartwheel" else printed)  # its 108 lacks the duration that others count
    assert planner(Config(2, motion, "band", 0)).parameters == paper.TABLE_2[motion, 0].parameters
    for case, forces in paper.CASES.items():
        assert planner(Config(3, motion, "tube", forces=forces)).parameters == paper.TABLE_3[motion, case].parameters


def test_the_numbers_of_parameters_are_typed_in_right():
    assert [paper.TABLE_2[m, 0].parameters for m in paper.MOTIONS] == [82, 298, 298]
    with_weights = [[paper.TABLE_3[m, case].parameters for case in (2, 3)] for m in paper.MOTIONS]
    assert with_weights == [[84, 89], [312, 335], [303, 317]]
    assert [paper.TABLE_1[m, 0].parameters for m in paper.MOTIONS] == [108, 397, 397]
    for motion in paper.MOTIONS:
        for table in (paper.TABLE_1, paper.TABLE_2):
            assert len({table[motion, neq].parameters for neq in range(4)}) == 1


def test_forces_as_parameters_make_338():
    made = planner(Config(3, "cartwheel", "band", 2, "parameters"))
    assert made.parameters == paper.FORCES_AS_PARAMETERS["parameters"] == 338


@pytest.mark.parametrize("motion", paper.MOTIONS)
def test_a_duration_per_phase_adds_one_for_each_phase_but_the_first(motion):
    phases = len(mcplan.load_planar_task(motion).phases)
    for case, forces in paper.CASES.items():
        with_durations = planner(Config(4, motion, "tube", forces=forces)).parameters
        assert with_durations == paper.TABLE_3[motion, case].parameters + phases - 1


def test_the_papers_rows_are_those_of_its_counting_rule():
    """Base rows 198 / 684 / 684 (its own inequalities), 3 for each coefficient, contact and interval, and 4 of forces."""
    contact_intervals = {"cartwheel": 16, "climbing": 86, "walking": 52}
    for motion, base in zip(paper.MOTIONS, (198, 684, 684), strict=True):
        count = contact_intervals[motion]
        assert count == sum(len(p.contacts) * p.intervals for p in mcplan.load_planar_task(motion).phases)
        for neq in range(4):
            assert paper.TABLE_1[motion, neq].constraints == base + 3 * (neq + 1) * count
            assert paper.TABLE_2[motion, neq].constraints == base + 3 * (neq + 1) * count
        for case in paper.CASES:
            assert paper.TABLE_3[motion, case].constraints == base + (9 + 4) * count


@pytest.mark.parametrize("table", [1, 2])
@pytest.mark.parametrize("motion", paper.MOTIONS)
def test_equalities_are_counted_as_the_planner_counts_them(table, motion):
    """A row of an inequality each and the rest: what strict adds from one coefficient to the next."""
    rows = [planner(Config(table, motion, "strict", neq)).constraints for neq in range(4)]
    added = lengagne_tables.equalities(motion, table, 0)
    assert [b - a for a, b in zip(rows, rows[1:], strict=False)] == [added] * 3
    assert lengagne_tables.equalities(motion, table, 3) == 4 * added


def test_the_paper_says_that_richer_cases_cost_less():
    for motion in paper.MOTIONS:
        costs = [paper.TABLE_4[motion, case].criterion for case in paper.CASES if (motion, case) in paper.TABLE_4]
        assert costs == sorted(costs, reverse=True)
    assert ("climbing", 1) not in paper.TABLE_4


@pytest.mark.slow
def test_the_page_shows_what_the_csv_files_hold(quick):
    page = (quick / "lengagne.md").read_text()
    for row in read(quick / "table_2.csv"):
        cells = f"| 1 `cartwheel` | {row['neq']} | {row['paper_parameters']} | {row['parameters']} |"
        assert cells in page
        assert (
            f"| {float(row['time_s']):.2f} | {float(row['cpu_s']):.2f} | {row['paper_status']} | {row['status']} |"
            in page
        )
    for row in read(quick / "table_4.csv"):
        assert f"| {row['paper_criterion']} | {float(row['cost']):.1f} |" in page
    figures = re.findall(r"\]\((.+?\.png)\)", page)
    assert figures == ["lengagne_costs.png", "lengagne_figure_2.png"]
    for name in figures:
        assert (quick / name).read_bytes().startswith(b"\x89PNG")
    assert all(len(line) <= 130 or line.startswith("|") for line in page.splitlines())


@pytest.mark.slow
def test_table_2_of_the_cartwheel_converges_as_in_the_paper(quick):
    rows = read(quick / "table_2.csv")
    assert [row["neq"] for row in rows] == ["0", "1", "2", "3", "tube"]
    assert all(row["status"] == "OK" and row["parameters"] == "82" for row in rows)
    assert all(row["paper_status"] == "OK" for row in rows[:4])
    assert (
        float(rows[0]["drift_mm"]) > 10.0 > 1.5 >= float(rows[4]["drift_mm"])
    )  # only the tube says where contacts are


@pytest.mark.slow
def test_table_4_of_the_cartwheel_is_solved_proved_and_falls_from_case_to_case(quick):
    rows = [row for row in read(quick / "table_4.csv") if row["kept"] == "True"]
    assert [row["forces"] for row in rows] == list(paper.CASES.values())
    assert all(row["checker"] == "solved" and row["certified"] == "True" for row in rows)
    costs = [float(row["cost"]) for row in rows]
    assert costs == sorted(costs, reverse=True)
    saved = mcplan.files.whole_body_plans.load_whole_body_plan(quick / "table_4_cartwheel_per_point.npz")
    assert mcplan.check(saved).ok()


@pytest.mark.slow
def test_the_kernel_stands_beside_ipopt_in_table_4(quick):
    rows = read(quick / "solvers.csv")
    assert [(row["table"], row["motion"], row["forces"]) for row in rows] == [
        ("4", "cartwheel", forces) for forces in paper.CASES.values()
    ]
    page = (quick / "lengagne.md").read_text()
    full = {row["forces"]: row for row in read(quick / "table_4.csv") if row["kept"] == "True"}
    for row in rows:
        assert row["ipopt_status"] == row["ipm_status"] == "solved" and row["ipm_certified"] == "True"
        assert row["ipopt_cost"] == full[row["forces"]]["cost"]  # the paper's tables stay Ipopt's
        assert float(row["ipm_cost"]) <= 1.02 * float(row["ipopt_cost"])
        assert f"| {row['ipopt_iterations']} | {row['ipm_iterations']} |" in page
        saved = mcplan.files.whole_body_plans.load_whole_body_plan(quick / f"table_4_cartwheel_{row['forces']}_ipm.npz")
        assert mcplan.check(saved).ok()


def test_a_solver_is_compared_where_both_were_run_with_its_own_poorer_case():
    theirs = [made_up(Config(4, "walking", "tube", forces=f), cost=c) for f, c in (("uniform", 5.0), ("per_body", 4.0))]
    ours = [made_up(Config(4, "walking", "tube", forces="uniform", solver="ipm"), cost=5.1, iterations=7)]
    (row,) = lengagne_tables.solver_rows([*theirs, *ours], 4)
    assert (row["forces"], row["ipm_iterations"], row["ipopt_cost"], row["ipm_cost"]) == ("uniform", 7, 5.0, 5.1)
    assert {row["forces"] for row in lengagne_tables.full_rows([*theirs, *ours])} == {"uniform", "per_body"}
    assert len(lengagne_tables.full_rows([*theirs, *ours])) == 2
    assert lengagne_tables.solver_table([row])[-1].count("|") == lengagne_tables.solver_table([row])[0].count("|")


@pytest.mark.slow
def test_resume_draws_again_without_solving(quick, monkeypatch):
    before = json.loads((quick / "runs.json").read_text())
    (quick / "lengagne_figure_2.png").unlink()
    monkeypatch.setattr(lengagne_runs, "run", lambda *_: pytest.fail("nothing is missing"))
    words = ["reproduce", "lengagne", "--quick", "--tables", "2,4", "--resume", "--out", str(quick)]
    assert main(words) == 0
    assert (quick / "lengagne_figure_2.png").exists()
    assert json.loads((quick / "runs.json").read_text()) == before


def test_a_richer_case_that_ends_worse_is_started_from_the_poorer_one(tmp_path, monkeypatch):
    poorer, cold = (
        made_up(Config(4, "walking", "tube", forces=f), cost=c) for f, c in (("uniform", 5.0), ("per_body", 6.0))
    )
    plan = object()
    monkeypatch.setattr("mcplan.files.whole_body_plans.load_whole_body_plan", lambda path: plan)

    def run(config, repeats=1, warm_start=None, start=""):
        assert (config, warm_start, start) == (cold.config, plan, "uniform")
        return made_up(config, cost=4.0, start=start), plan

    monkeypatch.setattr(lengagne_runs, "run", run)
    ((warm, _),) = lengagne_runs.from_poorer(cold, [poorer], tmp_path, lambda text: None)
    runs = [poorer, cold, warm]
    assert lengagne_runs.best_of(runs, 4, "walking", "per_body") is warm
    rows = lengagne_tables.full_rows(runs)
    assert [(row["start"], row["kept"]) for row in rows] == [("P = 0", True), ("P = 0", False), ("uniform", True)]
    assert lengagne_tables.unordered(rows) == []
    assert lengagne_tables.unordered(lengagne_tables.full_rows([poorer, cold])) == ["walking"]
    assert lengagne_runs.from_poorer(warm, [poorer], tmp_path, lambda text: None) == []


def test_ok_means_converged_whatever_the_checker_finds():
    config = Config(1, "walking", "band", 0)
    assert made_up(config, "acceptable", "converged, but the checker finds drift").verdict == "OK"
    assert made_up(config, "iteration_limit", "reached max_iterations").verdict == "MAX ITER"
    assert made_up(config, "time_limit", "reached time_limit_s").verdict == "TIME LIMIT"
    assert made_up(config, "infeasible", "there are more equalities than free variables").verdict == "REFUSED"
    assert made_up(config, "infeasible", "converged to a point of local infeasibility").verdict == "FAILED"


def test_ctrl_c_leaves_what_was_done_and_resume_goes_on(tmp_path, monkeypatch):
    asked = []

    def run(config, repeats=1, warm_start=None, start=""):
        asked.append(config)
        if len(asked) == 3:
            raise KeyboardInterrupt
        return made_up(config), None

    monkeypatch.setattr(lengagne_runs, "run", run)
    wanted = lengagne_settings.configs([1], ["cartwheel"])
    runs, about = lengagne_runs.collect(wanted, tmp_path, 1, False, lambda text: None)
    assert about["interrupted"] and len(runs) == 2
    runs, about = lengagne_runs.collect(wanted, tmp_path, 1, True, lambda text: None)
    assert not about["interrupted"] and [kept.config for kept in runs] == wanted


def test_every_row_of_the_paper_is_run():
    wanted = set(lengagne_settings.configs([1, 2, 3, 4], lengagne_settings.chosen_motions(None)))
    for table, published in ((1, paper.TABLE_1), (2, paper.TABLE_2)):
        assert {Config(table, motion, "band", neq) for motion, neq in published} <= wanted
    assert {Config(3, motion, "band", 2, paper.CASES[case]) for motion, case in paper.TABLE_3} <= wanted
    for solver in ("ipopt", "ipm"):
        assert {Config(3, m, "tube", forces=paper.CASES[c], solver=solver) for m, c in paper.TABLE_3} <= wanted
        assert {Config(4, m, "tube", forces=paper.CASES[c], solver=solver) for m, c in paper.TABLE_4} <= wanted
    grids = {(c.table, c.motion, c.neq) for c in wanted if c.continuous == "grid" and c.hold == "band"}
    assert grids == {(table, *key) for table in (1, 2) for key in paper.TABLE_1}


def test_wrapped_text_keeps_its_words():
    text = "one " * 100 + "end"
    assert " ".join(lengagne_text.paragraph(text)).split() == text.split()
    lines = lengagne_text.bullet(text)
    assert lines[0].startswith("- one") and all(line.startswith("  one") for line in lines[1:])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["lengagne", "--tables", "5"], "tables"),
        (["lengagne", "--tables", "one"], "--tables"),
        (["lengagne", "--motions", "dancing"], "dancing"),
        (["lengagne", "--repeats", "0"], "repeats"),
        (["lengagne", "--cycles", "3"], "--cycles"),
        (["wang", "--tables", "1"], "--tables"),
        (["tazaki", "--resume"], "--resume"),
    ],
)
def test_options_out_of_range_are_named(words, message, capsys, tmp_path):
    assert main(["reproduce", *words, "--out", str(tmp_path)]) == 2
    assert message in capsys.readouterr().err
