"""mcplan_bench.reproduce.wang: runs, tables, figures, page."""

from __future__ import annotations

import csv
import json
import re
from dataclasses import replace

import numpy as np
import pytest

from mcplan.cli import main
from mcplan.errors import InvalidInput
from mcplan_bench.reproduce import (
    wang_figures,
    wang_kernel,
    wang_runs,
    wang_size,
    wang_table_2,
    wang_tables,
    wang_tracking,
)
from mcplan_bench.reproduce.wang_runs import Config, Run
from mcplan_bench.reproduce.wang_tracking import Tracked

for package in ("matplotlib", "mujoco", "pinocchio", "proxsuite"):
    pytest.importorskip(package)


def read(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def made_up(
    terrain, method, predicted, acc=0.3, cycles=2, asked=2, seed=0, status="solved", transcription="euler", **numbers
):
    """A run whose steps go 0.5 m at the cost `acc`, without momentum."""
    cycle = {"status": status, "converged": status == "solved", "iterations": 40, "time_s": 0.2, "cpu_s": 0.1}
    cycle |= {"evaluation_s": 0.01, "acceleration_cost": acc, "momentum_cost": 0.0, "distance_m": 0.5}
    cycle |= {"duration_s": 1.4, "defect": 0.0, "drift_com_m": 0.03, "drift_momentum": 30.0, **numbers}
    entries = [{"index": index, **cycle} for index in range(cycles)]
    return Run(Config(terrain, method, predicted, seed, transcription), asked, 1.0, entries)


def tracked_of(method, predicted, seed=0, fell=False, limits=True, terrain="rubbles", transcription="euler"):
    """A run of the simulation of 20 s that ends after 9 s if it falls."""
    config = Config(terrain, method, predicted, seed, transcription)
    measures = {"com_rms_m": 0.006, "com_max_m": 0.03, "final_base_error_m": 0.02}
    return Tracked(config, limits, "1.2.3", 20.0, "", 9.0 if fell else 21.0, fell, measures)


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    out = tmp_path_factory.mktemp("wang")
    assert main(["reproduce", "wang", "--quick", "--out", str(out)]) == 0
    return out


@pytest.mark.slow
def test_the_page_shows_the_published_tables_and_links_what_was_written(quick):
    page = (quick / "wang.md").read_text()
    for cells in ("| 36 | 39 |", "| 18 | 33 |", "| 78 | 33 | 81 |", "| 12 | 15 | 27 |"):
        assert cells in page
    for time in ("1.84 ± 1.67", "3.53 ± 3.16", "1.12 ± 0.24", "0.62 ± 0.07"):  # Table III, rubbles
        assert time in page
    figures = re.findall(r"\]\((.+?\.png)\)", page)
    assert figures == ["figure_4.png", "figure_5.png"]
    for name in [*figures, "figure_4_rubbles.png"]:
        assert (quick / name).read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_the_cells_are_those_of_the_cycles(quick):
    cycles = read(quick / "cycles.csv")
    for row in read(quick / "table_3.csv"):
        mine = [
            c for c in cycles if (c["method"], c["predicted"]) == (row["method"], row["predicted"]) and c["seed"] == "0"
        ]
        assert len(mine) == int(row["cycles"]) == 2
        assert float(row["time_mean"]) == pytest.approx(np.mean([float(c["time_s"]) for c in mine]))
        assert 0.0 < float(row["cpu_mean"]) and 0.0 < float(row["evaluation_ratio"]) < 1.0
    for row in read(quick / "figure_4.csv"):
        mine = [c for c in cycles if (c["method"], c["predicted"]) == (row["method"], row["predicted"])]
        cost = sum(float(c["acceleration_cost"]) + float(c["momentum_cost"]) for c in mine)
        assert float(row["cost_per_m"]) == pytest.approx(cost / sum(float(c["distance_m"]) for c in mine))


@pytest.mark.slow
def test_com_fails_in_the_second_cycle_and_says_how(quick):
    for row in read(quick / "table_2.csv"):
        if row["terrain"] != "rubbles":
            assert row["converges"] == ""  # not run
        elif row["method"] == "com":
            assert row["converges"] == "fail" and "in cycle 2" in row["failures"]
        else:
            assert row["converges"] in ("1", "2")


@pytest.mark.slow
def test_resume_draws_again_without_solving(quick, monkeypatch, capsys):
    before = json.loads((quick / "runs.json").read_text())
    (quick / "figure_5.png").unlink()
    monkeypatch.setattr(wang_runs, "walk", lambda *_: pytest.fail("nothing is missing"))
    monkeypatch.setattr(wang_tracking, "follow", lambda *_: pytest.fail("nothing is missing"))
    assert main(["reproduce", "wang", "--quick", "--resume", "--out", str(quick)]) == 0
    assert (quick / "figure_5.png").exists()
    assert json.loads((quick / "runs.json").read_text()) == before


def test_ctrl_c_leaves_what_was_done_and_resume_goes_on(tmp_path, monkeypatch):
    walks = []

    def walk(config, cycles):
        walks.append(config)
        if len(walks) == 3:
            raise KeyboardInterrupt
        run = made_up(config.terrain, config.method, config.predicted, cycles=cycles, asked=cycles)
        return replace(run, config=config), _Nothing

    monkeypatch.setattr(wang_runs, "walk", walk)
    wanted = wang_runs.configs(3, 0)
    runs, about = wang_runs.collect(wanted, 2, tmp_path, False, lambda text: None)
    assert about["interrupted"] and len(runs) == 2
    runs, about = wang_runs.collect(wanted, 2, tmp_path, True, lambda text: None)
    assert not about["interrupted"] and [run.config for run in runs] == wanted


def test_walks_of_another_version_are_not_added_to(tmp_path):
    old = made_up("rubbles", "single", 1)
    wang_runs.save(tmp_path / "runs.json", [old], {"version": "0.0.1"})
    assert wang_runs.collect([old.config], 2, tmp_path, True, print)[0] == [old]
    with pytest.raises(InvalidInput, match="version"):
        wang_runs.collect(wang_runs.configs(2, 0), 2, tmp_path, True, print)


class _Nothing:
    phases = ()


@pytest.mark.parametrize("row", wang_size.built(), ids=lambda row: f"{row['method']} lifted={row['lifted_psi']}")
def test_counts_of_a_knot_add_up_to_the_program_that_is_built(row):
    assert row["variables_added"] == row["variables_by_formula"]
    assert row["rows_more_than_com"] == row["rows_by_formula"]


def test_lifting_psi_adds_what_the_paper_counts_for_it():
    for method, count in (("rectangle", 48), ("point", 12)):
        assert wang_size.knot(method, lifted_psi=True).variables - wang_size.knot(method).variables == count


def test_the_tables_of_the_paper_are_typed_in_right():
    """Its own remarks: point is 1.4 to 3.0 times, on average 2.4 times, faster than the fastest baseline."""
    ratios = [
        baseline[0] / point[0]
        for baseline, point in zip(
            wang_tables.PUBLISHED_3["single", 1], wang_tables.PUBLISHED_3["point", 2], strict=True
        )
    ]
    assert round(min(ratios), 1) == 1.4 and round(max(ratios), 1) == 3.0 and round(np.mean(ratios), 1) == 2.4
    assert set(wang_tables.PUBLISHED_3) == set(wang_runs.TABLE_3)
    assert set(wang_table_2.PUBLISHED) == set(wang_runs.METHODS) == set(wang_size.PUBLISHED)


def test_candidate_2_is_compared_with_the_baseline_by_iterations_and_by_time_of_one():
    rows = [
        {"method": method, "predicted": predicted, "terrain": "rubbles", "published_mean_s": 2.0, **means}
        for method, predicted, means in (
            ("single", 1, {"cpu_mean": 0.2, "iterations_mean": 50.0}),
            ("rectangle", 2, {"cpu_mean": 0.3, "iterations_mean": 40.0}),
        )
    ]
    (compared,) = wang_tables.faster(rows, "rectangle")
    assert compared == ("rubbles", 1.0, pytest.approx(2.0 / 3.0))
    assert wang_tables.why_slower(rows, "rectangle") == pytest.approx((0.8, 1.875))
    assert wang_tables.why_slower(rows, "point") is None and wang_tables.faster(rows) == []


def test_table_2_tells_convergence_from_a_quiet_walk():
    runs = [
        made_up("rubbles", "single", 1, acc=0.3),
        made_up("rubbles", "point", 1, acc=1.0),
        made_up("rubbles", "point", 2, acc=0.4),
        made_up("rubbles", "com", 1, cycles=1, status="infeasible"),
    ]
    rows = wang_table_2.rows(runs, [])
    cells = {row["method"]: row for row in rows if row["terrain"] == "rubbles"}
    assert (cells["single"]["converges"], cells["single"]["converges_and_quiet"]) == (1, 1)
    assert (cells["point"]["converges"], cells["point"]["converges_and_quiet"]) == (1, 2)
    assert cells["com"]["converges"] == "fail" and cells["com"]["failures"] == "1-step PH: infeasible in cycle 1"
    assert cells["rectangle"]["converges"] == ""
    assert "| candidate 1 (`com`) |" in "\n".join(wang_table_2.table(rows, runs, []))
    # Nothing was tracked, and what does not converge cannot be.
    assert (cells["point"]["followed"], cells["com"]["followed"]) == ("", "fail")


def test_table_2_has_the_least_horizon_whose_walk_was_followed():
    runs = [made_up("rubbles", method, p) for method in ("single", "rectangle", "point") for p in (1, 2)]
    runs.append(made_up("rubbles", "rectangle", 1, transcription="trapezoidal"))
    runs.append(made_up("rubbles", "point", 1, status="infeasible", transcription="trapezoidal"))
    tracked = [
        tracked_of("single", 1),
        tracked_of("single", 2, fell=True),  # a longer horizon takes nothing away
        tracked_of("point", 1, fell=True),
        tracked_of("point", 1, limits=False),
        tracked_of("point", 2),
        tracked_of("rectangle", 1, fell=True),
        tracked_of("rectangle", 1, fell=True, limits=False),
        tracked_of("rectangle", 1, transcription="trapezoidal"),
        tracked_of("rectangle", 2, seed=1),  # the table is of the scene's start
    ]
    cells = {row["method"]: row for row in wang_table_2.rows(runs, tracked) if row["terrain"] == "rubbles"}
    keys = [key for _, _, key in wang_table_2.COLUMNS]
    assert [cells["single"][key] for key in keys] == [1, 1, "", ""]
    assert [cells["point"][key] for key in keys] == [2, 1, "fail", "fail"]  # what does not converge is not followed
    assert cells["point"]["failures"] == "1-step PH, trapezoidal: infeasible in cycle 1"
    assert [cells["rectangle"][key] for key in keys] == ["fail", "fail", 1, 1]
    assert [c.title for c in wang_table_2.relapses(tracked, True)] == ["rubbles, single, 2-step PH"]
    rows = wang_table_2.rows(runs, tracked)
    assert wang_table_2.agreement(rows, "followed") == (2, 3)  # 1, fail and 2; the paper has 1, 2 and 2
    (row,) = [row for row in wang_table_2.start_rows(tracked) if (row["method"], row["predicted"]) == ("rectangle", 2)]
    assert (row["starts"], row["followed"], row["followed_without"]) == (1, 1, 1)
    details = "\n".join(wang_table_2.details(tracked))
    assert "falls at 9.0 s of 20.0 s" in details and "6.0 mm, 30 mm" in details


def test_what_is_tracked_has_converged_and_starts_come_one_after_the_other():
    runs = [made_up("rubbles", "point", p, seed=seed) for seed in (2, 1, 0) for p in (1, 2, 3, 4)]
    runs.append(made_up("v_shape", "com", 1, cycles=1, status="infeasible"))
    wanted = wang_tracking.wanted(runs, seeds=1)
    assert [(c.seed, c.predicted) for c in wanted] == [(0, 1), (0, 2), (0, 3), (1, 1), (1, 2)]


def test_runs_of_the_simulation_are_saved_one_by_one(tmp_path, monkeypatch):
    configs = [Config("rubbles", "point", p) for p in (1, 2, 3)]
    for config in configs:
        path = wang_runs.plan_path(tmp_path, config)
        path.parent.mkdir(exist_ok=True)
        path.touch()
    done = []

    def follow(config, plan, limits):
        if len(done) == 3:
            raise KeyboardInterrupt
        done.append((config.predicted, limits))
        version = wang_tracking.mcplan.__version__
        return Tracked(config, limits, version, 20.0, fell=config.predicted == 1, completed_s=9.0)

    monkeypatch.setattr(wang_tracking, "follow", follow)
    monkeypatch.setattr(wang_tracking, "load_plan", lambda path: None)
    runs, interrupted = wang_tracking.collect(configs, tmp_path, False, print)
    assert interrupted and done == [(1, True), (1, False), (2, True)] and len(runs) == 3
    with (tmp_path / wang_tracking.FILE).open("a") as file:
        file.write('{"config": {"terr')  # cut off while it was written
    done.clear()
    runs, interrupted = wang_tracking.collect(configs, tmp_path, True, print)
    assert not interrupted and done == [(3, True)]
    assert [run.config.predicted for run in runs] == [1, 1, 2, 3]
    assert wang_tracking.load(tmp_path / wang_tracking.FILE) == runs


def test_a_rectangle_walk_is_tracked(tmp_path):
    """Its executed steps have forces at the corners of the soles, as those of every fidelity."""
    run, plan = wang_runs.walk(Config("rubbles", "rectangle", 2), 1)
    tracked = wang_tracking.follow(run.config, plan, True)
    assert run.success and tracked.followed, tracked.ending
    assert tracked.measures["com_max_m"] < 0.05


def test_a_walk_cut_short_is_no_success():
    assert made_up("rubbles", "point", 2, cycles=2, asked=2).success
    assert not made_up("rubbles", "point", 2, cycles=1, asked=2).success


def test_table_3_takes_all_starts_and_figure_5_all_terrains():
    runs = [
        made_up("v_shape", "point", 2, time_s=0.2, cpu_s=0.2),
        made_up("v_shape", "point", 2, time_s=0.4, cpu_s=0.4, seed=1),
        made_up("rubbles", "point", 2, time_s=0.9, cpu_s=0.9),
    ]
    (here, _) = wang_tables.table_3_rows(runs)
    assert (here["starts"], here["cycles"]) == (2, 4)
    assert here["time_mean"] == pytest.approx(0.3) and here["time_std"] == pytest.approx(0.1)
    rows = wang_figures.figure_5_rows(runs)
    assert [row["cycle"] for row in rows] == [1, 2]
    assert rows[0]["point_2_mean_s"] == pytest.approx(0.5) and rows[0]["motion_mean_s"] == pytest.approx(1.4)


def test_failed_walks_have_no_point_in_figure_4():
    runs = [made_up("rubbles", "point", 1), made_up("rubbles", "point", 2, cycles=1, status="infeasible")]
    assert wang_figures.curve(runs, "rubbles", "point", "cost") == ([1], [pytest.approx(0.6)])


def test_a_longer_horizon_that_costs_more_is_counted():
    runs = [made_up("rubbles", "point", p, acc=acc) for p, acc in ((1, 1.0), (2, 0.4), (3, 0.5), (4, 0.5))]
    assert wang_tables.rises(wang_tables.cost_rows(runs)) == (1, 3)


def test_noise_stays_within_its_share_and_repeats_with_its_seed():
    start = wang_runs.planner(Config("rubbles", "point", 1)).state()
    feet, com = np.array(start.feet_W), np.array(start.com_W)
    for seed in range(1, 20):
        moved = wang_runs.noisy(wang_runs.planner(Config("rubbles", "point", 1)).state(), seed)
        again = wang_runs.noisy(wang_runs.planner(Config("rubbles", "point", 1)).state(), seed)
        assert np.array_equal(moved.com_W, again.com_W) and np.array_equal(moved.feet_W, again.feet_W)
        assert np.all(np.abs(np.array(moved.com_W) - com) <= 0.05 * wang_runs.LENGTHS_M)
        shift = np.array(moved.feet_W) - feet
        assert np.all(shift[:, 2] == 0.0) and np.any(shift != 0.0)
        assert np.all(np.abs(shift) <= 0.05 * wang_runs.LENGTHS_M)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["wang", "--lookahead-max", "11"], "--lookahead-max"),
        (["wang", "--cycles", "0"], "cycles"),
        (["wang", "--seeds", "-1"], "seeds"),
        (["wang", "--tracked-seeds", "-1"], "tracked-seeds"),
        (["tazaki", "--cycles", "3"], "--cycles"),
    ],
)
def test_options_out_of_range_are_named(words, message, capsys, tmp_path):
    assert main(["reproduce", *words, "--out", str(tmp_path)]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.slow
def test_the_kernels_walks_stand_beside_ipopts_and_in_no_other_table(quick):
    page = (quick / "wang.md").read_text()
    section = page[page.index("### The same by the kernel") : page.index("## Figure 4")]
    lines = [line for line in section.splitlines() if line.startswith("| baseline") or line.startswith("| cand")]
    rows = read(quick / "solvers.csv")
    assert len(lines) == len(rows) == 4  # of Table III, on one terrain
    for row in rows:
        assert int(row["ipopt_converged"]) == int(row["ipm_converged"]) == 2
        assert float(row["ipm_cost_per_m"]) == pytest.approx(float(row["ipopt_cost_per_m"]), rel=0.01)
    runs = json.loads((quick / "runs.json").read_text())["runs"]
    assert {run["config"]["solver"] for run in runs} == {"ipopt", "ipm"}
    for name in ("table_3.csv", "figure_4.csv"):
        walks = [(row["method"], row["predicted"], row["terrain"]) for row in read(quick / name)]
        assert len(walks) == len(set(walks))
    assert all(row["starts"] == "1" for row in read(quick / "table_3.csv"))


def test_cells_are_compared_where_both_solvers_were_run_from_the_scenes_own_start():
    ipopt = [made_up("rubbles", "single", 1), made_up("rubbles", "single", 2), made_up("rubbles", "single", 1, seed=3)]
    kernel = made_up("rubbles", "single", 1, acc=0.33, cpu_s=0.02)
    kernel = replace(kernel, config=replace(kernel.config, solver="ipm"))
    (row,) = wang_kernel.rows([*ipopt, kernel])
    assert row["ratio"] == pytest.approx(5.0) and row["ipm_cost_per_m"] == pytest.approx(0.66)
    text = "\n".join(wang_kernel.section([row]))
    assert "Ipopt takes 5.0 to 5.0 times" in text and "+10.0 %" in text and "2 of 2 | 2 of 2 |" in text
    assert wang_kernel.section(wang_kernel.rows(ipopt)) == []
