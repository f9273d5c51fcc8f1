"""mcplan.solve: options by name. The planner itself has tests of its own; here it is a stand-in that records its input."""

from __future__ import annotations

import enum
import types

import pytest

import mcplan as mp
from mcplan import _core
from mcplan.solve import make_options
from standing import standing_plan


class Method(enum.Enum):
    standard, paper = 0, 1


Method.__members__  # noqa: B018  the attribute by which make_options knows an enumeration


def field(name, kind, default):
    def check(self, value):
        if not isinstance(value, kind):
            raise TypeError
        self.__dict__["_" + name] = value

    return property(lambda self: self.__dict__.get("_" + name, default), check)


class Weights:
    com = field("com", (int, float), 0.1)


class Options:
    phases = field("phases", int, 18)
    time_limit_s = field("time_limit_s", (int, float), float("inf"))
    method = field("method", Method, Method.standard)

    def __init__(self):
        self.weights_ = Weights()

    weights = property(lambda self: self.weights_)

    def validate(self):
        if self.phases < 1:
            raise mp.errors.InvalidOptions("phases", "must be at least 1", str(self.phases))


class SwitchedDdp:
    def __init__(self, scene, robot, options):
        self.given = (scene, robot, options)

    def solve(self):
        return self.given


@pytest.fixture(autouse=True)
def stand_in(monkeypatch):
    monkeypatch.setattr(_core, "ddp", types.SimpleNamespace(Options=Options, SwitchedDdp=SwitchedDdp), raising=False)


def test_names_and_objects_are_taken_alike():
    scene, robot, _ = mp.plan("stairs")
    assert (scene.name, robot.name) == ("stairs", "humanoid44")
    own_scene, own_robot = mp.load_scene("gap"), mp.load_robot("anymal")
    assert mp.plan(own_scene, own_robot)[:2] == (own_scene, own_robot)


def test_options_go_by_their_names():
    options = make_options({"phases": 24, "time_limit": 0.5, "method": "paper", "weights": {"com": 2.0}})
    assert (options.phases, options.time_limit_s, options.method) == (24, 0.5, Method.paper)
    assert options.weights.com == 2.0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"phasse": 24},
            r"phasse: no such option. Did you mean 'phases'\? Options: phases, time_limit_s, method, weights",
        ),
        ({"weights": {"con": 1.0}}, r"weights.con: no such option. Did you mean 'com'\? Options: com"),
        ({"phases": "many"}, 'phases: must be of type int, got "many"'),
        ({"phases": 0}, "phases: must be at least 1, got 0"),
        ({"method": "papers"}, 'method: must be one of standard, paper, got "papers"'),
        ({"validate": True}, "validate: no such option"),
        ({"__init__": 1}, "__init__: no such option"),
    ],
)
def test_a_wrong_option_is_named(options, message):
    with pytest.raises(mp.errors.InvalidOptions, match=message):
        mp.plan("flat", **options)


def test_a_plan_of_another_robot_is_no_start():
    rule = "must be that of the robot that is planned for, "
    with pytest.raises(mp.errors.InvalidPlan, match=f'warm_start.robot.name: {rule}"talos", got "humanoid44"'):
        mp.plan("flat", "talos", warm_start=standing_plan())
    handless = mp.load_robot("humanoid44")
    handless.end_effectors = handless.end_effectors[:2]
    with pytest.raises(
        mp.errors.InvalidPlan, match=f"warm_start.robot.end_effectors: {rule}right_foot, .* got right_foot"
    ):
        mp.plan("flat", "humanoid44", warm_start=standing_plan(robot=handless))
