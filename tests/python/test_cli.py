"""mcplan.cli: what is printed, where, and the exit codes."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import types
from pathlib import Path

import pytest

import malformed
import mcplan as mp
from command_line import commands, one_line_error
from mcplan.cli import app, main
from mcplan.files.planar_robots import list_planar_robots, load_planar_robot
from mcplan.files.planar_tasks import list_planar_tasks, load_planar_task
from mcplan.files.robots import list_robots, load_robot
from mcplan.files.scenes import list_scenes, load_scene, scene_to_dict
from mcplan.files.schema import KINDS
from mcplan.files.terrains import random_patches
from mcplan.files.toml import toml_text
from standing import standing_plan
from wrenches import standing_wrenches

VERBS = (
    "bench",
    "check",
    "demo",
    "motion",
    "plan",
    "reproduce",
    "rhp",
    "robots",
    "run",
    "scenes",
    "schema",
    "show",
    "sip",
    "tasks",
    "track",
    "version",
)


def run(capsys, *words) -> tuple[int, str, str]:
    code = main([str(word) for word in words])
    out, err = capsys.readouterr()
    return code, out, err


@pytest.mark.parametrize("verb", VERBS)
def test_every_verb_has_help_with_an_example(verb, capsys):
    code, out, err = run(capsys, verb, "--help")
    assert code == 0 and err == ""
    assert f"Example: mcplan {verb}" in out


def test_schema_prints_where_the_schemas_are(capsys):
    code, out, _ = run(capsys, "schema")
    assert code == 0 and [line.split()[0] for line in out.splitlines()] == list(KINDS)
    for kind in KINDS:
        code, path, _ = run(capsys, "schema", kind)
        assert code == 0 and json.loads(Path(path.strip()).read_text(encoding="utf-8"))["$schema"]
    code, _, err = run(capsys, "schema", "scenery")
    assert code == 2 and "must be one of scene, robot" in err


def test_no_words_print_the_verbs(capsys):
    code, out, _ = run(capsys)
    assert code == 0
    assert all(f"  {verb} " in out for verb in VERBS)


@pytest.mark.parametrize("words", [(), ("bench",)])
def test_lists_of_verbs_show_whole_summaries_at_80_columns(words, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    code, out, _ = run(capsys, *words, "--help")
    rows = out.partition("\nCommands:\n")[2].splitlines()
    assert code == 0 and len(rows) >= (4 if words else len(VERBS))
    assert [row for row in rows if len(row) > 80 or row.endswith("...") or not row.endswith(".")] == []


def test_a_help_line_says_what_an_option_is():
    lines = {
        (command.name, param.name): param.help
        for _, command in commands()
        for param in command.params
        if param.name != "help"
    }
    assert len(lines) > 100
    assert {
        name: line for name, line in lines.items() if not re.fullmatch(r"(?!Of )[A-Za-z].{7,}[.)]", line or "")
    } == {}


def test_the_earlier_name_of_tasks_works_and_is_not_listed(capsys):
    assert run(capsys, "motions") == run(capsys, "tasks")
    assert "motions" not in run(capsys, "--help")[1]


@pytest.mark.parametrize("verb", ["bench", "reproduce"])
def test_verbs_of_a_distribution_that_is_not_there_say_what_to_install(verb, capsys, monkeypatch):
    for kind in ("registered_commands", "registered_groups"):
        own = [each for each in getattr(app.app, kind) if each.name not in app.APART]
        monkeypatch.setattr(app.app, kind, own)
    monkeypatch.setattr("importlib.metadata.entry_points", lambda **_: ())
    message = one_line_error(run(capsys, verb, "--help"))
    assert message == f"mcplan {verb} needs mcplan-bench: pip install ./bench in the source tree of mcplan"
    assert run(capsys, "version")[0] == 0


def test_verbs_of_other_distributions_are_looked_for_only_when_asked_for(capsys, monkeypatch):
    monkeypatch.setattr("importlib.metadata.entry_points", lambda **_: pytest.fail("looked for"))
    assert run(capsys, "version")[0] == 0
    assert run(capsys, "scenes")[0] == 0


def test_version(capsys):
    status, output, errors = run(capsys, "version")
    assert (status, errors) == (0, "")
    assert re.match(re.escape(mp.__version__) + r"\nIpopt 3\.\d+\.\d+\n", output)
    inside = dict(line.split(": ", 1) for line in output.splitlines()[2:])
    assert list(inside) == ["linear solver", "BLAS", "OpenMP", "compiler", "Eigen", "instructions"]
    assert "none found" not in inside.values() and re.fullmatch(r"3\.\d+\.\d+", inside["Eigen"])


def test_the_version_is_an_option_too(capsys):
    assert run(capsys, "--version") == run(capsys, "version")
    assert "--version" in run(capsys, "--help")[1]
    assert "Multi-contact motion planning" in run(capsys)[1]


def test_the_command_runs_as_a_process():
    done = subprocess.run([sys.executable, "-m", "mcplan", "plan", "stares"], capture_output=True, text=True)
    assert done.returncode == 2 and done.stdout == ""
    assert done.stderr.startswith(
        "error: no scene 'stares' and no file of that name. Did you mean 'stairs'? Built-in: chimney, flat"
    )


@pytest.mark.parametrize(
    ("verb", "names"),
    [
        ("scenes", list_scenes()),
        ("robots", [*list_robots(), *list_planar_robots()]),
        ("tasks", list_planar_tasks()),
    ],
)
def test_lists_have_a_described_line_each(verb, names, capsys):
    code, out, _ = run(capsys, verb)
    lines = out.splitlines()
    assert code == 0
    assert [line.split()[0] for line in lines] == names
    assert all(len(line.split()) > 3 for line in lines)


def test_a_scene_is_printed_with_its_rule_and_surfaces(capsys):
    code, out, _ = run(capsys, "scenes", "gap_with_rail")
    assert code == 0
    assert "when foot is free, right_hand and left_hand must be in contact" in out
    assert "left_pad   0.900 0.375 0.500   0.000 0.000 1.000  4        0.7       left_hand" in out


def test_a_scene_file_is_printed_like_a_built_in_one(capsys, tmp_path):
    (tmp_path / "room.toml").write_text(toml_text(malformed.SCENE))
    code, out, _ = run(capsys, "scenes", tmp_path / "room.toml")
    assert code == 0 and out.startswith("room\n") and "floor" in out


def test_random_patches_of_a_seed_are_written(capsys, tmp_path):
    file = tmp_path / "mine.toml"
    assert run(capsys, "scenes", "random_patches", "--seed", 7, "-o", file) == (0, f"Wrote {file}\n", "")
    assert file.read_text().startswith(f"# Made by: mcplan scenes random_patches --seed 7 -o {file}\n")
    assert scene_to_dict(load_scene(file)) == scene_to_dict(random_patches(7))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["flat", "--seed", 3], '--seed: is for random_patches alone, got "flat"'),
        (["--seed", 3], "--seed: needs the NAME of a scene"),
        (["-o", "x.toml"], "--output: needs the NAME of a scene"),
    ],
)
def test_options_of_scenes_that_do_not_fit_are_named(arguments, message, capsys):
    code, _, err = run(capsys, "scenes", *arguments)
    assert code == 2 and message in err


def test_reach_polytopes_are_for_urdfs(capsys):
    code, _, err = run(capsys, "robots", "talos", "--reach-polytopes")
    assert code == 2 and "--reach-polytopes: needs --from-urdf" in err


def test_a_scene_is_drawn_on_a_page(capsys, tmp_path):
    pytest.importorskip("mcplan.view")
    code, out, _ = run(capsys, "scenes", "stairs", "--html", tmp_path / "stairs.html")
    assert code == 0 and "stairs.html" in out
    assert "<html" in (tmp_path / "stairs.html").read_text().lower()


@pytest.mark.parametrize("name", list_robots())
def test_a_robot_is_printed_with_its_ends(name, capsys):
    code, out, _ = run(capsys, "robots", name)
    assert code == 0
    assert all(end.name in out for end in load_robot(name).end_effectors)


@pytest.mark.parametrize("name", list_planar_robots())
def test_a_planar_robot_is_marked_and_printed_with_its_bodies(name, capsys):
    code, out, _ = run(capsys, "robots", name)
    robot = load_planar_robot(name)
    assert code == 0 and out.startswith(f"{name} (planar): ")
    first_words = {line.split()[0] for line in out.splitlines() if line}
    assert {part.name for part in (*robot.bodies, *robot.end_effectors)} <= first_words


@pytest.mark.parametrize("name", list_planar_tasks())
def test_a_task_is_printed_with_a_line_for_each_phase(name, capsys):
    code, out, _ = run(capsys, "tasks", name)
    task = load_planar_task(name)
    assert code == 0 and out.startswith(f"{name}: ")
    head, *lines = out.split("\n\n")[-1].splitlines()
    assert head.split()[:2] == ["phase", "intervals"]
    assert [line.split()[:2] for line in lines] == [[str(k), str(p.intervals)] for k, p in enumerate(task.phases)]


def test_a_task_is_copied(capsys, tmp_path):
    file = tmp_path / "mine.toml"
    assert run(capsys, "tasks", "stairs", "-o", file) == (0, f"Wrote {file}\n", "")
    assert file.read_text().startswith(f"# Made by: mcplan tasks stairs -o {file}\n")
    assert repr(load_planar_task(file)) == repr(load_planar_task("stairs"))


def test_a_plan_that_holds_is_ok(capsys, tmp_path):
    standing_plan().save(tmp_path / "plan.npz")
    code, out, _ = run(capsys, "check", tmp_path / "plan.npz")
    assert code == 0
    assert out.startswith(f"{tmp_path / 'plan.npz'}: ok. Closest to its limit: ")


def test_a_plan_that_slips_is_named_and_gives_exit_code_1(capsys, tmp_path):
    plan = standing_plan()
    plan.knots[1].end_effectors_W[0, 0] += 0.01
    plan.save(tmp_path / "plan.npz")
    code, out, _ = run(capsys, "check", tmp_path / "plan.npz")
    assert code == 1 and "slip at right_foot" in out
    code, out, _ = run(capsys, "check", tmp_path / "plan.npz", "--json")
    report = json.loads(out)
    assert code == 1 and report["ok"] is False
    worst = {violation["name"]: violation for violation in report["violations"]}["slip"]
    assert worst["end_effector"] == "right_foot" and worst["value"] == pytest.approx(0.01, rel=0.05)
    assert {"dynamics", "friction", "reach"} <= {constraint["name"] for constraint in report["constraints"]}


def test_check_json_of_a_good_plan(capsys, tmp_path):
    standing_plan().save(tmp_path / "plan.npz")
    code, out, _ = run(capsys, "check", tmp_path / "plan.npz", "--json")
    assert code == 0
    assert json.loads(out)["ok"] is True and json.loads(out)["violations"] == []


BAD_WORDS = [
    (("plann",), "No such command 'plann'"),
    (("scenes", "--htm"), "No such option"),
    (
        ("scenes", "stares"),
        "no scene 'stares' and no file of that name. Did you mean 'stairs'? Built-in: chimney, flat, ",
    ),
    (("scenes", "--html", "x.html"), "--html: needs the NAME of a scene"),
    (("robots", "humanoid4"), "no robot 'humanoid4' and no file of that name. Did you mean 'humanoid44'?"),
    (("robots", "walker"), "no robot 'walker' and no file of that name. Did you mean 'walker9'? Built-in: anymal, "),
    (("tasks", "stare"), "no planar task 'stare' and no file of that name. Did you mean 'stairs'? Built-in: cartwheel"),
    (("tasks", "-o", "x.toml"), "--output: needs the NAME of a task"),
    (("check",), "PLAN: is required"),
    (("check", "none.npz"), "none.npz: No such file or directory"),
    (("plan",), "SCENE: is required"),
    (
        ("plan", "flat", "--robot", "talus"),
        "no robot 'talus' and no file of that name. Did you mean 'talos'?",
    ),
    (("plan", "flat", "--phases", "many"), '--phases: must be a whole number, got "many"'),
    (("robots", "--from-urdf", "nobody"), "--from-urdf: must be a URDF file or a name of example-robot-data"),
    (
        ("robots", "--from-urdf", "talos", "--end", "foot"),
        "--end: must read NAME=FRAME[:KIND[:LENGTHxWIDTH[:X,Y,Z]]]",
    ),
    (("robots", "--from-urdf", "g1", "--posture", "knee"), "--posture: must read JOINT=ANGLE"),
    (("robots", "--posture", "knee=1"), "--posture: needs --from-urdf"),
    (("plan", "flat", "--scale", "0"), "--scale: must lie in [0.001, 1000], got 0.0"),
    (("plan", "flat", "--sole-inside", "3"), "--sole-inside: must be at most 2, got 3"),
    (
        ("plan", "gap", "--min-flight", "0.2", "--no-flight"),
        "--min-flight: must not be given with --no-flight, which plans none, got 0.2",
    ),
    (("robots", "--from-urdf", "talos", "--end", "foot=nowhere"), "--end foot: must name a link of the URDF"),
    (
        ("robots", "--from-urdf", "talos", "--posture", "leg_left_4_jiont=1"),
        "--posture leg_left_4_jiont: must name a joint of the URDF that has one angle. Did you mean 'leg_left_4_joint'?",
    ),
    (("robots", "--from-urdf", "solo12"), "--end: must be given for a robot other than talos, anymal"),
]


@pytest.mark.parametrize(("words", "message"), BAD_WORDS, ids=lambda v: " ".join(v) if isinstance(v, tuple) else "")
def test_bad_words_give_one_line_and_exit_code_2(words, message, capsys):
    assert one_line_error(run(capsys, *words)).startswith(message)


@pytest.mark.parametrize("verb", ["scenes", "plan"])
def test_a_broken_scene_file_is_named(verb, capsys, tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text(toml_text(malformed.broken(malformed.SCENE, ("surfaces", 1, "vertices"), malformed.SQUARE[:2])))
    message = one_line_error(run(capsys, verb, file))
    assert message == f"{file}: surfaces[1].vertices: needs at least 3 points, got 2"


def test_a_broken_plan_file_is_named(capsys, tmp_path):
    (tmp_path / "bad.npz").write_bytes(b"PK")
    message = one_line_error(run(capsys, "check", tmp_path / "bad.npz"))
    assert message.startswith(f"{tmp_path / 'bad.npz'}: must be an .npz or .json file written by mcplan")


def solve_result(status: str = "solved") -> types.SimpleNamespace:
    """What mcplan.plan returns, with the report made up."""
    report = types.SimpleNamespace(
        status=status, message="", cost=1.5, cost_terms={"com": 1.0, "limit": float("nan")}, iterations=20, time_s=0.1,
        switches=4, seed=7, threads=2, version="0.1.0", friction_use={"left_foot": 0.4},
        warnings=(), paper_verdict="", paper_cost=0.0, parallel_loops=0,
        worst_violation=mp.model.Violation(name="reach", phase=1, end_effector="left_foot", time_s=0.5, value=-0.01, unit="m"),
    )  # fmt: skip
    return types.SimpleNamespace(plan=standing_plan(), report=report)


def test_plan_scales_the_scene_and_keeps_soles_inside(capsys, monkeypatch):
    given = []
    monkeypatch.setattr(mp, "plan", lambda *args, **options: given.append((args, options)) or solve_result())
    assert run(capsys, "plan", "slope", "--robot", "g1", "--scale", 0.5, "--sole-inside", 1)[0] == 0
    ((scene, robot), options), whole = given[0], load_scene("slope")
    assert (robot, options) == ("g1", {"sole_inside": 1.0})
    assert (scene.surfaces[1].vertices_W == 0.5 * whole.surfaces[1].vertices_W).all()


def test_a_plan_saved_as_json_is_checked_and_drawn_like_one_saved_as_arrays(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(mp, "plan", lambda *args, **options: solve_result())
    assert run(capsys, "plan", "flat", "-o", tmp_path / "plan.json")[0] == 0
    standing_plan().save(tmp_path / "plan.npz")
    said = [run(capsys, "check", tmp_path / name)[1].replace(name, "") for name in ("plan.json", "plan.npz")]
    assert said[0] == said[1]
    for name in ("plan.json", "plan.npz"):
        assert run(capsys, "show", tmp_path / name, "-o", tmp_path / f"{name}.png")[0] == 0
    assert (tmp_path / "plan.json.png").read_bytes() == (tmp_path / "plan.npz.png").read_bytes()


def test_plan_hands_its_options_on_and_prints_json(capsys, tmp_path, monkeypatch):
    given = []
    monkeypatch.setattr(mp, "plan", lambda *args, **options: given.append((args, options)) or solve_result())
    words = ["plan", "flat", "--robot", "talos", "--phases", 20, "--method", "paper", "--time-limit", 1.5]
    words += ["--threads", 2, "--seed", 7, "-o", tmp_path / "plan.npz", "--json"]
    code, out, _ = run(capsys, *words)
    assert code == 0
    assert given == [(("flat", "talos"), {"phases": 20, "method": "paper", "time_limit": 1.5, "threads": 2, "seed": 7})]
    assert mp.check(mp.Plan.load(tmp_path / "plan.npz")).ok()
    report = json.loads(out, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert report["contact_sequence"] == [["ground", "ground", None, None]] * 3
    assert report["durations_s"] == [0.4] * 3 and report["phases"] == 3 and report["flight_phases"] == 0
    assert report["iteration_ms"] == pytest.approx(5.0)
    assert report["cost_terms"] == {"com": 1.0, "limit": None}
    assert report["friction_use"] == {"left_foot": 0.4}
    assert report["worst_violation"]["name"] == "reach" and report["worst_violation"]["value"] == -0.01
    same = {"scene": "flat", "robot": "humanoid44", "status": "solved", "cost": 1.5, "iterations": 20, "time_s": 0.1}
    same |= {"switches": 4, "seed": 7, "threads": 2, "version": "0.1.0"}
    assert {key: report[key] for key in same} == same


@pytest.mark.parametrize(
    ("status", "expected"), [("solved", 0), ("acceptable", 1), ("time_limit", 1), ("infeasible", 1)]
)
def test_only_a_solved_plan_gives_exit_code_0(status, expected, capsys, monkeypatch):
    monkeypatch.setattr(mp, "plan", lambda *args, **options: solve_result(status))
    code, out, _ = run(capsys, "plan", "flat")
    assert code == expected
    assert out.startswith(f"flat  humanoid44  {status} ")
    assert "right_foot  0 0 0" in out and "right_hand  - - -" in out and "reach at left_foot" in out


@pytest.mark.parametrize("option", ["-o", "--html"])
def test_a_folder_that_does_not_exist_is_said_before_planning(option, capsys, monkeypatch):
    monkeypatch.setattr(mp, "plan", lambda *args, **options: pytest.fail("planned"))
    message = one_line_error(run(capsys, "plan", "flat", option, "/nowhere/at/all"))
    assert 'must lie in a folder that exists, got "/nowhere/at/all' in message


def test_a_missing_extra_says_what_to_install(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    message = one_line_error(run(capsys, "scenes", "flat", "--html", tmp_path / "x.html"))
    assert message == "mcplan scenes --html needs meshcat: pip install 'mcplan[view]'"


def test_a_robot_of_a_urdf_file_is_written(capsys, tmp_path):
    pytest.importorskip("pinocchio")
    (tmp_path / "leg.urdf").write_text(LEG)
    code, _, err = run(
        capsys,
        "robots",
        "--from-urdf",
        tmp_path / "leg.urdf",
        "--end",
        "foot=tip:foot",
        "-o",
        tmp_path / "leg.toml",
    )
    assert code == 0 and err.startswith("note: no trunk, ")
    robot = load_robot(tmp_path / "leg.toml")
    assert robot.mass == pytest.approx(11.0) and robot.end_effectors[0].frame == "tip"
    # The leg hangs 0.5 m below its hip; its slide makes it 0.2 m shorter or 0.1 m longer.
    assert robot.com_height == pytest.approx(0.5 - (0.25 * 0.4 + 0.25 * 0.5) / 11, abs=1e-3)
    assert robot.end_effectors[0].reach_max_B[2] - robot.end_effectors[0].reach_min_B[2] < 0.3
    text = Path(tmp_path / "leg.toml").read_text()
    assert text.startswith(f"# Made by: mcplan robots --from-urdf {tmp_path / 'leg.urdf'} --end foot=tip:foot -o ")


JOINT = (
    '<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/>'
    '<axis xyz="{axis}"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>'
)
LINK = (
    '<link name="{name}"><inertial><mass value="{mass}"/>'
    '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>'
)
LEG = (
    '<robot name="leg">'
    + LINK.format(name="base", mass=10)
    + "".join(LINK.format(name=name, mass=0.25) for name in ("hip", "thigh", "shank", "tip"))
    + JOINT.format(name="roll", kind="revolute", parent="base", child="hip", xyz="0 0.1 0", axis="1 0 0")
    + JOINT.format(name="pitch", kind="revolute", parent="hip", child="thigh", xyz="0 0 0", axis="0 1 0")
    + JOINT.format(
        name="length", kind="prismatic", parent="thigh", child="shank", xyz="0 0 -0.4", axis="0 0 1"
    ).replace('lower="-1" upper="1"', 'lower="-0.1" upper="0.2"')
    + JOINT.format(name="tip", kind="fixed", parent="shank", child="tip", xyz="0 0 -0.1", axis="0 0 1")
    + "</robot>"
)


def test_plans_of_contact_wrenches_are_summed_up_with_their_loads(capsys, monkeypatch):
    found = solve_result()
    found.plan = standing_wrenches(squeeze_m=0.0)
    monkeypatch.setattr(mp, "plan", lambda *args, **options: found)
    report = json.loads(run(capsys, "plan", "flat", "--json")[1])
    assert report["angular_momentum_max"] == pytest.approx(0.0, abs=1e-9)
    assert report["force_max_weights"].keys() == {"right_foot", "left_foot"}
    assert all(0.5 < force < 0.55 for force in report["force_max_weights"].values())
    lines = run(capsys, "plan", "flat")[1].splitlines()
    assert "  friction used (tangential / normal): left_foot 0.40" in lines  # the report's
    assert "  angular momentum: 0.00 kg m^2/s at most" in lines
    assert any(line.startswith("  largest force in weights: right_foot 0.5") for line in lines)
    found.plan = standing_plan()
    report = json.loads(run(capsys, "plan", "flat", "--json")[1])
    assert report["angular_momentum_max"] is None and report["force_max_weights"] is None


@pytest.mark.parametrize("words", [("--reach-polytopes",), ("--srdf", "x.srdf"), ("--end", "foot=sole")])
@pytest.mark.parametrize("name", ["talos", "walker9"])
def test_robots_ignore_no_option(capsys, tmp_path, monkeypatch, name, words):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, "robots", name, *words)
    assert (code, out, err) == (2, "", f"error: {words[0]}: needs --from-urdf\n")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("name", ["talos", "humanoid44", "walker9"])
def test_robots_are_copied(capsys, tmp_path, name):
    file = tmp_path / "my.toml"
    assert run(capsys, "robots", name, "-o", file)[:2] == (0, f"Wrote {file}\n")
    load = mp.load_planar_robot if name == "walker9" else mp.load_robot
    assert load(file) == load(name)
    assert file.read_text().startswith(f"# Made by: mcplan robots {name} -o ")
    assert run(capsys, "robots", "-o", file)[2] == "error: --output: needs the NAME of a robot, or --from-urdf\n"
    one_line_error(run(capsys, "robots", name, "-o", tmp_path / "my.txt"))


def test_robots_takes_a_name_or_a_urdf(capsys):
    code, _, err = run(capsys, "robots", "talos", "--from-urdf", "g1")
    assert (code, err) == (2, 'error: NAME: may not stand beside --from-urdf, got "talos"\n')
