"""mcplan.files.geometry: what no robot can do is refused by name, what can hardly be meant is warned of, at any scale."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

import malformed
import mcplan as mp
from mcplan._core import require_standing
from mcplan.cli import main
from mcplan.errors import SuspiciousGeometry
from mcplan.files.generate import random_scene
from mcplan.files.geometry import require_meant
from mcplan.files.planar_robots import planar_robot_to_dict
from mcplan.files.planar_tasks import planar_task_to_dict
from mcplan.files.robots import list_robots, load_robot, robot_to_dict
from mcplan.files.scenes import list_scenes, load_scene, scaled, scene_to_dict
from mcplan.files.toml import toml_text

SIZES = [0.007, 1.0, 25.0]  # of robots of 5 mm to 20 m


def floor(size: float, **changes: object) -> dict:
    """Level ground of 6 x 2 lengths, start and goal on it."""
    square = [[size * x, size * y, 0.0] for x, y in ((-3, -1), (3, -1), (3, 1), (-3, 1))]
    data = {
        "name": "floor",
        "start": {"position": [0.0, 0.0, 0.0], "contacts": {"foot": "a"}},
        "goal": {"position": [size, 0.0, 0.0], "contacts": {"foot": "a"}},
        "surfaces": [{"name": "a", "vertices": square}],
    }
    return {**data, **changes}


def write(folder: Path, data: dict, name: str = "scene.toml") -> Path:
    (folder / name).write_text(toml_text(data))
    return folder / name


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("field", ["start", "goal"])
@pytest.mark.parametrize(
    ("place", "where"), [((1, 0, 0.5), "off"), ((1, 0, -2), "off"), ((9, 0, 0), "beside"), ((0, -5, 0), "beside")]
)
def test_a_stance_far_from_its_surfaces_is_refused(size, field, place, where, tmp_path):
    file = write(tmp_path, floor(size, **{field: {"position": [size * x for x in place], "contacts": {"foot": "a"}}}))
    with pytest.raises(
        mp.errors.InvalidScene, match=rf"scene.toml: {field}.position: must be a point of the ground .* m {where} \"a\""
    ):
        load_scene(file)


def test_a_stance_as_far_away_as_numbers_go_is_refused_with_its_distance(tmp_path):
    file = write(tmp_path, floor(1.0, goal={"position": [1e300, 0.0, 0.0], "contacts": {"foot": "a"}}))
    with pytest.raises(
        mp.errors.InvalidScene, match=r"goal.position: .* got \[1e\+300, 0, 0\], 1e\+300 m beside \"a\""
    ):
        load_scene(file)
    scene = mp.load_scene("flat")
    scene.goal.position_W = [1e300, 0.0, 0.0]
    with pytest.raises(mp.errors.InvalidScene, match=r"right_foot would stand 1e\+300 m off"):
        mp.plan(scene, "humanoid44")


def test_start_and_goal_are_both_named(tmp_path):
    high = {"position": [0.0, 0.0, 2.0], "contacts": {"foot": "a"}}
    with pytest.raises(mp.errors.InvalidScene) as found:
        load_scene(write(tmp_path, floor(1.0, start=high, goal=high)))
    assert [each.field for each in (found.value, *found.value.others)] == ["start.position", "goal.position"]
    assert {each.source for each in (found.value, *found.value.others)} == {str(tmp_path / "scene.toml")}


@pytest.mark.parametrize("factor", SIZES)
@pytest.mark.parametrize("name", list_scenes())
def test_built_in_scenes_are_meant_at_every_size(name, factor):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        if factor < 2.0 or name not in ("up_and_down", "v_shape", "rubbles", "random_patches"):  # 53 m long: 1.3 km
            require_meant(scaled(load_scene(name), factor), "")


@pytest.mark.parametrize("name", list_scenes())
def test_robots_stand_at_start_and_goal_of_built_in_scenes(name):
    for robot in list_robots():
        if name != "chimney" or robot not in ("anymal", "go2", "talos_wang"):  # which have no hands
            require_standing(load_scene(name), load_robot(robot))


def test_random_scenes_are_meant():
    robot = load_robot("humanoid44")
    for seed in range(200):
        scene = random_scene(seed)
        require_meant(scene, f"seed {seed}")
        require_standing(scene, robot)


def test_ground_that_faces_down_is_warned_of_and_not_planned_on(tmp_path, capsys):
    data = floor(1.0)
    data["surfaces"][0]["vertices"].reverse()
    file = write(tmp_path, data)
    with pytest.warns(
        SuspiciousGeometry, match=r"surfaces\[0\].vertices: faces down, and foot stands on it at the start"
    ):
        scene = load_scene(file)
    with pytest.raises(mp.errors.InvalidScene, match='start.contacts: must hold the robot up: .* got "a" faces down'):
        mp.plan(scene, "humanoid44")
    assert main(["plan", str(file)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(":")[0] for line in lines] == ["warning", "warning", "error", "error"]


def test_a_ceiling_is_no_ground(tmp_path):
    """Hands may press against what faces down above the robot."""
    data = floor(1.0)
    above = [[x, y, 2.0] for x, y, _ in data["surfaces"][0]["vertices"][::-1]]
    data["surfaces"].append({"name": "ceiling", "vertices": above})
    data["start"]["contacts"]["hand"] = "ceiling"
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        load_scene(write(tmp_path, data))


def test_a_goal_out_of_a_robots_reach_is_refused_once_the_robot_is_known(tmp_path):
    """2 m above 50 m of ground: a large robot may stand so, this one may not."""
    data = floor(25.0, goal={"position": [1.0, 0.0, 2.0], "contacts": {"foot": "a"}})
    scene = load_scene(write(tmp_path, data))
    with pytest.raises(
        mp.errors.InvalidScene,
        match=r"goal.position: must be where humanoid44 reaches .*_foot would stand 2 m off \"a\"",
    ):
        mp.plan(scene, "humanoid44")


def test_lengths_in_millimetres_are_warned_of(tmp_path):
    with pytest.warns(
        SuspiciousGeometry, match="surfaces: lengths are in metres, and these look like millimetres, got a scene"
    ):
        load_scene(write(tmp_path, scene_to_dict(scaled(load_scene("flat"), 1000.0))))
    robot = robot_to_dict(load_robot("humanoid44"))
    robot["end_effectors"][1]["half_size"] = [100.0, 50.0]
    with pytest.warns(SuspiciousGeometry, match=r"end_effectors\[1\].half_size: lengths are in metres"):
        load_robot(write(tmp_path, robot))
    with pytest.warns(SuspiciousGeometry, match="com_height: lengths are in metres"):
        load_robot(write(tmp_path, in_millimetres(malformed.ROBOT)))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"mass": 44000.0}, "mass: must be in kilograms, and this looks like grams, got 44000 kg in a robot of"),
        ({"phase_duration": [150.0, 500.0]}, r"phase_duration: durations are in seconds, .* got \[150, 500\] at a"),
        (
            {"inertia": [1.0, 1.0, 5.0]},
            r"inertia: of a body, no moment is above the sum of the other two, got \[1, 1, 5",
        ),
        (
            {"yaw_range": [-45.0, 45.0]},
            r"end_effectors\[0\].yaw_range: angles are in radians, .* degrees, got \[-45, 45",
        ),
    ],
)
def test_other_units_of_a_robot_are_warned_of(changes, message, tmp_path):
    robot = robot_to_dict(load_robot("humanoid44"))
    target = robot["end_effectors"][0] if "yaw_range" in changes else robot
    target.update(changes)
    with pytest.warns(SuspiciousGeometry, match=message) as found:
        load_robot(write(tmp_path, robot))
    assert len(found) == 1


@pytest.mark.parametrize("verb", [mp.plan, mp.walk])
@pytest.mark.parametrize(
    ("stance", "changes", "message"),
    [
        ("start", {"contacts": {"foot": "ceiling"}}, 'start.contacts: must hold the robot up: .* "ceiling" faces down'),
        ("goal", {"contacts": {"foot": "ceiling"}}, 'goal.contacts: must hold the robot up: .* "ceiling" faces down'),
        (
            "start",
            {"position_W": [0.0, 0.0, 2.0]},
            r"start.position: must be where talos_wang .* stand 2 m off \"ground\"",
        ),
        (
            "goal",
            {"position_W": [1.0, 0.0, 2.0]},
            r"goal.position: must be where talos_wang .* stand 2 m off \"ground\"",
        ),
    ],
)
def test_plan_and_walk_refuse_a_stance_that_cannot_stand_alike(verb, stance, changes, message):
    scene = load_scene("flat")
    ground = scene.surfaces[0].vertices_W
    scene.surfaces = [
        mp.model.Surface(name="ground", vertices_W=ground),
        mp.model.Surface(name="ceiling", vertices_W=ground[::-1] + [0.0, 0.0, 0.01]),
    ]
    for place in (scene.start, scene.goal):
        place.contacts = {"foot": "ground"}
    scene.steps = [
        mp.model.Step(end_effector=end.name, surface="ground") for end in load_robot("talos_wang").end_effectors
    ]
    for name, value in changes.items():
        setattr(getattr(scene, stance), name, value)
    with pytest.raises(mp.errors.InvalidScene, match=message):
        verb(scene, "talos_wang")


@pytest.mark.parametrize(
    ("metre", "gravity", "warned"),
    [
        (1.0, 9.81, None),
        (1.0, 9810.0, "gravity: goes with lengths in metres, .* got 9810 m/s.2 in a scene of"),
        (1000.0, 9.81, "surfaces: lengths are in metres"),
        (1000.0, 9810.0, None),  # both in millimetres: the same scene as the first
        (1.0, 24.8, None),  # Jupiter
        (1.0, 1.62, None),
    ],
)
def test_a_gravity_that_contradicts_the_lengths_is_warned_of_by_name(metre, gravity, warned, tmp_path):
    data = scene_to_dict(scaled(load_scene("flat"), metre))
    file = write(tmp_path, {**data, "gravity": gravity})
    if warned is None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            load_scene(file)
    else:
        with pytest.warns(SuspiciousGeometry, match=warned) as found:
            load_scene(file)
        assert len(found) == 1


@pytest.mark.parametrize("metre", [1.0, 1000.0])
def test_the_gravity_of_a_planar_robot_is_held_against_its_limbs(metre, tmp_path):
    robot = mp.load_planar_robot("climber9")
    robot.gravity = 9810.0
    for body in robot.bodies:
        body.joint_P = metre * body.joint_P
    file = write(tmp_path, planar_robot_to_dict(robot))
    task = write(
        tmp_path,
        {**planar_task_to_dict(mp.load_planar_task("climbing")), "robot": planar_robot_to_dict(robot)},
        "m.toml",
    )
    if metre == 1.0:
        with pytest.warns(
            SuspiciousGeometry, match="scene.toml: gravity: goes with lengths in metres, .* got 9810 m/s"
        ):
            mp.load_planar_robot(file)
        with pytest.warns(SuspiciousGeometry, match="m.toml: robot.gravity: goes with lengths in metres"):
            mp.load_planar_task(task)
    else:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            mp.load_planar_robot(file)


def in_millimetres(robot: dict) -> dict:
    data = malformed.broken(robot, ("com_height",), 1000.0 * robot["com_height"])
    for end in data["end_effectors"]:
        for key in ("nominal", "reach_min", "reach_max", "half_size"):
            if key in end:
                end[key] = [1000.0 * value for value in end[key]]
        for key in ("hip", "ankle"):
            if key in end.get("limb", {}):
                end["limb"][key] = [1000.0 * value for value in end["limb"][key]]
        for key in ("upper", "lower", "margin"):
            if key in end.get("limb", {}):
                end["limb"][key] *= 1000.0
        end.pop("com_reach", None)
        end.pop("partner_reach", None)
    return data
