"""References into members of bound objects: they stay valid whatever is assigned, and nothing is kept for longer."""

from __future__ import annotations

import gc
import resource
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import mcplan as mp
from mcplan import _core


def resident_kb() -> int:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize() // 1024


def knot(end_effectors: int = 100) -> mp.model.Knot:
    return mp.model.Knot(
        end_effectors_W=np.ones((end_effectors, 3)), end_effector_velocities_W=np.ones((end_effectors, 3))
    )


def assign_points() -> Callable[[int], None]:
    owner, rows = knot(), [np.full((n, 3), 2.0) for n in (100, 90)]

    def assign(i: int) -> None:
        owner.end_effectors_W = rows[i % 2]

    return assign


def assign_items() -> Callable[[int], None]:
    owner, items = mp.Plan(), [[mp.model.Phase(duration=0.1)] * n for n in (30, 29)]

    def assign(i: int) -> None:
        owner.phases = items[i % 2]

    return assign


def assign_struct() -> Callable[[int], None]:
    owner, scene = mp.Plan(), mp.Scene(surfaces=[mp.model.Surface(vertices_W=np.ones((8, 3)))] * 5)

    def assign(_: int) -> None:
        owner.scene = scene

    return assign


def assign_matrix() -> Callable[[int], None]:
    owner, matrices = mp.PlanarPlan(), [np.ones((9, n)) for n in (30, 31)]

    def assign(i: int) -> None:
        owner.control_points = matrices[i % 2]

    return assign


def assign_while_read() -> Callable[[int], None]:
    """A reference is held over each assignment, and dropped at the next."""
    owner, rows, held = knot(), np.ones((100, 3)), []

    def assign(_: int) -> None:
        held[:] = [owner.end_effectors_W]
        owner.end_effectors_W = rows

    return assign


@pytest.mark.parametrize(
    "make", [assign_points, assign_items, assign_struct, assign_matrix, assign_while_read], ids=lambda m: m.__name__
)
def test_assignments_leave_nothing_behind(make: Callable[[], Callable[[int], None]]) -> None:
    assign = make()
    for i in range(2000):
        assign(i)
    before = resident_kb()
    for i in range(20000):  # each at least 2 kB: 40 MB if they were kept
        assign(i)
    assert resident_kb() - before < 4000


@pytest.mark.slow
def test_a_million_assignments_leave_nothing_behind() -> None:
    assign = assign_points()
    for i in range(2000):
        assign(i)
    before = resident_kb()
    for i in range(1_000_000):
        assign(i)
    assert resident_kb() - before < 4000


def churn() -> None:
    """Give freed memory to somebody else, who writes into it."""
    gc.collect()
    kept = [knot(n) for n in range(200)]
    del kept
    gc.collect()


def test_a_view_of_points_outlives_their_replacement_and_their_owner() -> None:
    owner = mp.model.Knot(end_effectors_W=np.arange(30.0).reshape(10, 3))
    views = []
    for n in range(1, 6):
        views.append(owner.end_effectors_W)
        owner.end_effectors_W = np.full((n, 3), float(n))
    del owner
    churn()
    assert np.array_equal(views[0], np.arange(30.0).reshape(10, 3))
    for n in range(1, 5):
        assert np.array_equal(views[n], np.full((n, 3), float(n)))


def test_items_outlive_their_replacement() -> None:
    plan = mp.Plan(
        phases=[mp.model.Phase(duration=float(i), contacts=[mp.model.Contact(surface=i)]) for i in range(10)]
    )
    phase, contact, anchor = plan.phases[7], plan.phases[8].contacts[0], plan.phases[9].contacts[0].anchor_W
    anchor[:] = [1.0, 2.0, 3.0]
    plan.phases = []
    plan.phases = [mp.model.Phase(duration=0.5)]
    churn()
    assert (phase.duration, contact.surface) == (7.0, 8)
    assert np.array_equal(anchor, [1.0, 2.0, 3.0])
    phase.contacts = [mp.model.Contact(surface=3)] * 5
    assert [c.surface for c in phase.contacts] == [3] * 5
    assert [p.duration for p in plan.phases] == [0.5]


def test_references_into_a_struct_outlive_its_replacement() -> None:
    plan = mp.Plan(scene=mp.Scene(surfaces=[mp.model.Surface(name="old", vertices_W=np.full((4, 3), 5.0))]))
    scene, surface = plan.scene, plan.scene.surfaces[0]
    vertices = surface.vertices_W
    plan.scene = mp.Scene(name="new")
    churn()
    assert surface.name == "old"
    assert np.array_equal(vertices, np.full((4, 3), 5.0))
    assert (scene.name, scene.surfaces) == ("new", ())  # the member itself shows what it holds now


def test_a_matrix_outlives_its_replacement() -> None:
    state = _core.PlanarConfiguration(q=np.arange(9.0))
    q = state.q
    q[0] = 7.0
    assert state.q[0] == 7.0
    state.q = np.zeros(3)
    churn()
    assert np.array_equal(q, [7.0, *range(1, 9)])
    plan = mp.PlanarPlan(weights=[np.full(4, 1.0), np.full(4, 2.0)])
    weights = plan.weights
    plan.weights = []
    churn()
    assert np.array_equal(weights[1], np.full(4, 2.0))


def test_assigning_a_member_to_itself_keeps_it() -> None:
    plan = mp.Plan(scene=mp.Scene(surfaces=[mp.model.Surface(name="a"), mp.model.Surface(name="b")]))
    plan.scene = plan.scene
    plan.scene.surfaces = plan.scene.surfaces[1:]
    plan.scene = plan.scene
    assert [s.name for s in plan.scene.surfaces] == ["b"]
    view = knot(3)
    view.end_effectors_W = view.end_effectors_W[:2]
    assert view.end_effectors_W.shape == (2, 3)


def test_owners_end_with_their_last_reference() -> None:
    class Watched(mp.Plan):
        pass

    owner = Watched(phases=[mp.model.Phase(duration=1.0)])
    gone = weakref.ref(owner)
    phase = owner.phases[0]
    owner.phases = []
    del owner
    assert gone() is not None, "a phase keeps its plan"
    del phase
    assert gone() is None


@pytest.mark.parametrize(
    "kind", [mp.Plan, mp.Scene, mp.model.Knot, _core.ddp.Options, mp.Status, _core.sip.TaylorModel]
)
def test_an_object_without_a_value_is_a_type_error(kind: Any) -> None:
    blank = kind.__new__(kind)
    with pytest.raises(TypeError, match="never initialised"):
        blank.validate() if kind is _core.ddp.Options else repr(blank)
