"""mcplan.refusals: what the compiled module refuses of its arguments is one typed line that names the argument."""

from __future__ import annotations

import copy
import inspect
import pickle
import types
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import mcplan as mp
from mcplan import _core
from mcplan.errors import InvalidArgument
from mcplan.refusals import refusal
from standing import standing_plan

LAWS = "ForceLaw.pendulum, ForceLaw.held, ForceLaw.linear, ForceLaw.wrench"

CALLS: list[tuple[str, Callable[[mp.Plan], Any]]] = [
    ("task: no such argument of check. Arguments: plan, scene, robot, tolerances", lambda p: mp.check(p, task=3)),
    (
        "tolerance: no such argument of check. Did you mean 'tolerances'? Arguments: ",
        lambda p: mp.check(p, tolerance=1),
    ),
    (
        "vertexes: no such argument of Surface. Did you mean 'vertices_W'? "
        "Arguments: name, vertices_W, friction, grasp, thickness, end_effectors",
        lambda p: mp.model.Surface(vertexes=[]),
    ),
    ("Surface: takes arguments by name alone: name, vertices_W, ", lambda p: mp.model.Surface("ground")),
    ("name: must be a string, got 3", lambda p: mp.model.Surface(name=3)),
    ("grasp: must be True or False, got ", lambda p: mp.model.Surface(grasp="yes")),
    ("end_effectors[1]: must be a string, got 3", lambda p: mp.model.Surface(end_effectors=["a", 3])),
    (f'law: must be one of {LAWS}, got "wrench"', lambda p: mp.model.Phase(law="wrench")),
    ("t: must be a number, got an ndarray", lambda p: p.at(np.array([1.0]))),
    ("t: must be a number that a float can hold, got one of 1329 bits", lambda p: p.at(10**400)),
    ('phases: must be a whole number, got "x"', lambda p: mp.ddp.Options(phases="x")),
    ("phases: must be a whole number, got 2.5", lambda p: mp.ddp.Options(phases=2.5)),
    ("contacts: must be a mapping, got 3", lambda p: mp.model.Stance(contacts=3)),
    ("position_W: must be 3 numbers, got shape 2", lambda p: mp.model.Stance(position_W=[1.0, 2.0])),
    ('t: must be a number, got "x"', lambda p: p.at("x")),
    ("t: is required by at", lambda p: p.at()),
    ("since_start: is required by at_phase", lambda p: p.at_phase(0)),
    ("at: takes no more arguments than t, got 2", lambda p: p.at(0.0, 2)),
    ("duration: takes no argument, got 2", lambda p: p.duration(2)),
    ("plan: must be a Plan, got 3", lambda p: _core.plan_loads(3)),
    ("nam: no such argument of Violation. Did you mean 'name'? Arguments: ", lambda p: mp.model.Violation(nam=3)),
    ("value: must be a whole number, got ", lambda p: mp.Status("solved")),
    (
        "ForceLaw: must be one of 0 (pendulum), 1 (held), 2 (linear), 3 (wrench), got 7",
        lambda p: mp.model.ForceLaw(7),
    ),
    ("Status: must be one of 0 (solved), ", lambda p: mp.Status(-1)),
    ("seed: must be at least 0, got -1", lambda p: mp.ddp.Options(seed=-1)),
    ("seed: must be a whole number of 64 bits, got 1180591620717411303424", lambda p: mp.ddp.Options(seed=2**70)),
]

MEMBERS = [
    ("law", "wrench", f'law: must be one of {LAWS}, got "wrench"'),
    ("law", 3, f"law: must be one of {LAWS}, got 3"),
    ("duration", "x", 'duration: must be a number, got "x"'),
    ("intervals", 1.5, "intervals: must be a whole number, got 1.5"),
    ("intervals", 2**40, "intervals: must be a whole number of 32 bits, got 1099511627776"),
    ("contacts", 3, "contacts: must be a list, got 3"),
    ("contacts", [mp.model.Contact(), None], "contacts[1]: must be a Contact, got None"),
]


def says(found: Any, message: str) -> bool:
    return str(found.value).startswith(message) and "\n" not in str(found.value)


@pytest.mark.parametrize(("message", "call"), CALLS, ids=[message[:40] for message, _ in CALLS])
def test_arguments_that_fit_no_signature_are_one_line(message, call):
    with pytest.raises(InvalidArgument) as found:
        call(standing_plan())
    assert says(found, message), found.value


@pytest.mark.parametrize(("member", "value", "message"), MEMBERS)
def test_members_that_are_assigned_are_named(member, value, message):
    with pytest.raises(InvalidArgument) as found:
        setattr(standing_plan().phases[0], member, value)
    assert says(found, message), found.value


def test_vectors_say_how_many_numbers_they_have():
    plan = standing_plan()
    for value, message in (
        ([1, 2], "com_W: must be 3 numbers, got shape 2"),
        ("x", 'com_W: must be 3 numbers, got "x"'),
    ):
        with pytest.raises(InvalidArgument) as found:
            plan.knots[0].com_W = value
        assert says(found, message), found.value


def classes() -> Iterator[type]:
    for module in (_core, _core.ddp, _core.rhp, _core.sip, _core.nlp):
        yield from (each for each in vars(module).values() if isinstance(each, type))


@pytest.mark.parametrize("kind", sorted(set(classes()), key=str), ids=lambda kind: kind.__name__)
def test_no_class_lists_its_signatures_instead_of_what_is_wrong(kind):
    class Odd:
        pass

    texts = []
    for given, named in (((Odd(),) * 9, {}), ((), {"no_such_argument": Odd()})):
        try:
            kind(*given, **named)
        except TypeError as error:
            texts.append(str(error))
    try:
        made = kind()
    except TypeError:
        made = None
    for name, member in vars(kind).items() if made is not None else ():
        if isinstance(member, property) and not isinstance(member.fset, types.FunctionType | None):  # of the module
            with pytest.raises((TypeError, mp.InvalidInput)) as found:
                setattr(made, name, Odd())
            texts.append(str(found.value))
            assert texts[-1].startswith(name), texts[-1]
    assert texts
    for text in texts:
        assert "\n" not in text and "incompatible" not in text, text


def test_every_enum_has_its_members_alone():
    enums = [kind for kind in classes() if hasattr(kind, "__members__")]
    assert len(enums) > 10
    for kind in enums:
        for member in kind.__members__.values():
            assert kind(int(member)) == member == pickle.loads(pickle.dumps(member)) == copy.deepcopy(member)
        with pytest.raises(InvalidArgument, match=f"{kind.__name__}: must be one of 0 "):
            kind(max(int(member) for member in kind.__members__.values()) + 1)


def test_other_errors_stay_as_they_are():
    assert refusal("something else", (), {}, "") is None
    with pytest.raises(mp.errors.InvalidInput, match=r"vertices_W: must be an N x 3 array of numbers"):
        mp.model.Surface(vertices_W=[[1.0, 2.0]])
    with pytest.raises(mp.InvalidInput, match="t: must lie in"):
        standing_plan().at(-1.0)


def test_signatures_with_brackets_and_quotes_in_defaults_are_read():
    text = (
        "f(): incompatible function arguments. The following argument types are supported:\n"
        "    1. (a: str = \"x), b: (\", b: dict[str, float] = {'y': array([[1.,\n 2.]])}, "
        "*, c: mcplan._core.Scene = None) -> None\n"
        "\nInvoked with: 1"
    )
    for given, named, message in (
        ((1,), {}, "a: must be a string, got 1"),
        (("x", {"y": "z"}), {}, 'b["y"]: must be a number, got "z"'),
        ((), {"c": 3}, "c: must be a Scene or None, got 3"),
        ((), {"d": 3}, "d: no such argument of f. Arguments: a, b, c"),
        (("x",), {"a": "x"}, "a: must be given to f once, got two"),
    ):
        assert str(refusal(text, given, named, "")) == message


def test_functions_stay_what_they_are():
    assert isinstance(_core.plan_loads, types.BuiltinFunctionType)
    assert "plan: mcplan._core.Plan" in (_core.plan_loads.__doc__ or "")
    assert inspect.isclass(_core.Plan) and np.isfinite(standing_plan().duration())
