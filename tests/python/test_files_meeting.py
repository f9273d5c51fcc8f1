"""mcplan.files.meeting: names of end-effectors that a robot almost has are warned of, those of other robots are not."""

from __future__ import annotations

import warnings

import pytest

import mcplan as mp
from mcplan.cli import main
from mcplan.errors import SuspiciousName
from mcplan.files.meeting import warn_of_names
from mcplan.files.robots import list_robots
from mcplan.files.scenes import list_scenes, save_scene


def warned(scene: mp.Scene, robot: mp.Robot) -> list[str]:
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        warn_of_names(scene, robot)
    assert {each.category for each in found} <= {SuspiciousName}
    return [str(each.message) for each in found]


def table_for(*names: str, scene: str = "flat") -> mp.Scene:
    """A scene, and a table for those of some names."""
    scene = mp.load_scene(scene)
    table = mp.model.Surface(
        name="table", vertices_W=scene.surfaces[0].vertices_W + [0.0, 0.0, 1.0], end_effectors=list(names)
    )
    scene.surfaces = [*scene.surfaces, table]
    return scene


@pytest.mark.parametrize("robot", list_robots())
def test_built_in_scenes_serve_robots_with_other_limbs_without_a_word(robot):
    robot = mp.load_robot(robot)
    hands = any(end.kind == "hand" for end in robot.end_effectors)
    said = {name: warned(mp.load_scene(name), robot) for name in list_scenes()}
    for name, messages in said.items():
        if name == "chimney" and robot.name in ("anymal", "go2"):  # each wall is for a limb that they have not
            assert len(messages) == 1 and "none that a surface permits" in messages[0]
        elif mp.load_scene(name).rules and not hands:  # which ask for a hand where the feet leave the ground
            assert len(messages) == 1 and "so one of when_free is never free" in messages[0]
        else:
            assert messages == []


def test_a_rule_that_asks_for_limbs_that_the_robot_has_not_is_warned_of():
    scene, robot = mp.load_scene("flat"), mp.load_robot("humanoid44")
    scene.rules = [mp.model.ContactRule(when_free=["foot"], require=["left_arm", "right_arm"])]
    rule = "rules[0].require: humanoid44 has no such end-effector, so one of when_free is never free; it has "
    assert [message.startswith(f"flat: {rule}") for message in warned(scene, robot)] == [True]
    scene.rules = [mp.model.ContactRule(when_free=["tail"], require=["left_arm"])]  # is never asked
    assert warned(scene, robot) == []
    scene.rules = [mp.model.ContactRule(when_free=["foot"], require=["left_arm", "left_hand"])]  # both have to be
    assert warned(scene, robot)[0].endswith('got ["left_arm"]')


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        *(
            ("left_fot", "left_foot"),
            ("left_hnad", "left_hand"),
            ("right-hand", "right_hand"),
            ("LEFT_FOOT", "left_foot"),
        ),
        *(("foots", "foot"), ("hnd", "hand"), ("Hand", "hand")),
    ],
)
def test_a_misspelt_name_is_warned_of_with_what_it_means(wrong, right):
    scene, robot = table_for(wrong), mp.load_robot("humanoid44")
    rule = f"surfaces[1].end_effectors[0]: humanoid44 has no such end-effector. Did you mean '{right}'?"
    assert warned(scene, robot) == [f'flat: {rule}, got "{wrong}"']
    scene.surfaces = scene.surfaces[:1]
    scene.rules = [mp.model.ContactRule(when_free=["foot"], require=["right_hand", wrong])]
    assert warned(scene, robot) == [
        f'flat: {rule.replace("surfaces[1].end_effectors[0]", "rules[0].require[1]")}, got "{wrong}"'
    ]


@pytest.mark.parametrize(
    "names", [("left_fot", "left_foot"), ("tail", "hand"), ("left_fot", "foot"), ("rf_foot", "foot"), ("third_arm",)]
)
def test_names_of_other_robots_and_those_that_change_nothing_pass(names):
    assert warned(table_for(*names), mp.load_robot("humanoid44")) == []


def test_a_scene_that_permits_none_of_the_robots_end_effectors_is_warned_of_once():
    scene = table_for("paw", "tail")
    scene.surfaces[0].end_effectors = ["wheel"]
    message = (
        "surfaces[0].end_effectors: talos_wang has none that a surface permits; it has left_foot, right_foot, foot"
    )
    assert warned(scene, mp.load_robot("talos_wang")) == [f'flat: {message}, got ["wheel"]']


def test_every_verb_at_which_a_scene_meets_a_robot_warns():
    scene = table_for("left_fot")
    robot = mp.load_robot("humanoid44")
    for meet in (
        lambda: mp.plan(scene, robot, max_iterations=1),
        lambda: mp.receding_horizon(table_for("left_fot", scene="rubbles")),
        lambda: mp.check(mp.plan("flat", robot, max_iterations=1).plan, scene, robot),
        lambda: mp.show(mp.plan("flat", robot, max_iterations=1).plan, scene, robot),
    ):
        with pytest.warns(SuspiciousName, match="left_fot"):
            meet()


@pytest.mark.slow
def test_the_command_warns_in_a_line_each_time(tmp_path, capsys):
    save_scene(table_for("left_fot"), tmp_path / "table.toml")
    for words in (
        ("plan", str(tmp_path / "table.toml"), "-o", str(tmp_path / "plan.npz")),
        ("check", str(tmp_path / "plan.npz")),
        ("scenes", str(tmp_path / "table.toml"), "--robot", "talos", "--html", str(tmp_path / "table.html")),
    ):
        assert main(list(words)) == 0
        err = capsys.readouterr().err
        assert err.startswith("warning: flat: surfaces[1].end_effectors[0]: ") and err.count("\n") == 1
