"""Floors in pieces: tiles, and the convex parts of a plane that was seen."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mcplan as mp


def tile(name: str, x: tuple[float, float], y: tuple[float, float]) -> mp.model.Surface:
    corners = [[x[0], y[0], 0.0], [x[1], y[0], 0.0], [x[1], y[1], 0.0], [x[0], y[1], 0.0]]
    return mp.model.Surface(name=name, vertices_W=corners, end_effectors=["foot"])


def floor(size: float, to: tuple[float, float], yaw: float, half: float = 1.75) -> mp.Scene:
    """Square tiles about the origin, with an edge under each end of the way."""
    count = round(2.0 * half / size)
    edges = [-half + size * i for i in range(count + 1)]
    surfaces = [
        tile(f"t{i}_{j}", (edges[i], edges[i + 1]), (edges[j], edges[j + 1]))
        for i in range(count)
        for j in range(count)
    ]

    def below(x: float, y: float) -> str:
        return f"t{int((x + half) // size)}_{int((y + half) // size)}"

    aside = np.array([-math.sin(yaw), math.cos(yaw)]) * 0.085
    left, right = np.array(to) + aside, np.array(to) - aside
    return mp.Scene(
        surfaces=surfaces,
        start=mp.model.Stance(contacts={"left_foot": below(0.0, 0.085), "right_foot": below(0.0, -0.085)}),
        goal=mp.model.Stance(
            position_W=[*to, 0.0], yaw=yaw, contacts={"left_foot": below(*left), "right_foot": below(*right)}
        ),
    )


def whole(scene: mp.Scene) -> mp.Scene:
    joined = scene.__copy__()
    joined.surfaces = [tile("floor", (-1.75, 1.75), (-1.75, 1.75))]
    joined.start = mp.model.Stance(contacts={"foot": "floor"})
    joined.goal = mp.model.Stance(position_W=scene.goal.position_W, yaw=scene.goal.yaw, contacts={"foot": "floor"})
    return joined


@pytest.mark.parametrize("robot", ["talos", "g1"])
@pytest.mark.parametrize(("to", "yaw"), [((0.0, 0.0), math.pi / 2.0), ((1.0, 0.6), 0.4)])
def test_tiles_are_walked_over_as_a_floor_is(robot: str, to: tuple[float, float], yaw: float) -> None:
    """TALOS paid 23 instead of 0.05 for a turn on tiles, or found none: its whole soles had to be within each."""
    scene = floor(0.25, to, yaw)
    tiled, floored = mp.plan(scene, robot), mp.plan(whole(scene), robot)
    assert tiled.report.status == mp.Status.solved, tiled.report.message
    assert tiled.report.cost < 1.1 * floored.report.cost
    assert [surface.name for surface in tiled.plan.scene.surfaces] == [surface.name for surface in scene.surfaces]
    assert mp.check(tiled.plan, scene, tiled.plan.robot).ok()
    for k, phase in enumerate(tiled.plan.phases):
        for contact, place in zip(phase.contacts, tiled.plan.knots[k].end_effectors_W, strict=True):
            if contact.surface >= 0:
                polygon = mp.model.Polygon(scene.surfaces[contact.surface].vertices_W)
                assert polygon.outside(place) < 0.02
                assert abs(polygon.height(place)) < 1e-3


def test_tiles_give_the_same_plan_with_any_number_of_threads_and_from_a_sequence() -> None:
    scene = floor(0.25, (0.6, 0.0), 0.0)
    one, two = (mp.plan(scene, "talos", threads=threads) for threads in (1, 2))
    assert one.plan == two.plan
    again = mp.plan(scene, "talos", initial_sequence=[*one.plan.contact_sequence(), one.plan.final_contacts])
    assert again.report.status == mp.Status.solved, again.report.message
    warm = mp.ddp.SwitchedDdp(scene, mp.load_robot("talos")).solve(one.plan)
    assert warm.report.status == mp.Status.solved, warm.report.message


def test_soles_may_press_on_what_goes_on_in_the_plane_and_on_nothing_else() -> None:
    """A plan on a floor that is cut under the feet: accepted where the other half is ground, and the foot on both."""
    plan = mp.plan("flat", "talos").plan
    floored = plan.scene.surfaces[0]
    assert len(plan.scene.surfaces) == 1 and mp.check(plan).ok()
    corners = np.array(floored.vertices_W)
    low, high = corners.min(axis=0), corners.max(axis=0)

    def cut(at: float, drop: float = 0.0, friction: float | None = None, who: list[str] | None = None) -> mp.Scene:
        scene = plan.scene.__copy__()
        halves = []
        for name, x in ((floored.name, (float(low[0]), at)), ("beyond", (at, float(high[0])))):
            half = floored.__copy__()
            half.name = name
            half.vertices_W = np.array(tile(name, x, (float(low[1]), float(high[1]))).vertices_W)
            halves.append(half)
        halves[1].vertices_W = np.array(halves[1].vertices_W) - [0.0, 0.0, drop]
        if friction is not None:
            halves[1].friction = friction
        if who is not None:
            halves[1].end_effectors = who
        scene.surfaces = halves
        return scene

    seam = max(float(knot.end_effectors_W[foot][0]) for knot in plan.knots for foot in (0, 1)) - 0.015
    assert mp.check(plan, cut(seam), plan.robot).ok()
    for broken in (cut(seam - 0.3), cut(seam, drop=0.01), cut(seam, friction=0.3), cut(seam, who=["hand"])):
        names = {violation.name for violation in mp.check(plan, broken, plan.robot).violations()}
        assert "contact_polygon" in names or "center_of_pressure" in names


def test_a_run_walks_to_a_goal_on_other_tiles() -> None:
    pytest.importorskip("mujoco")
    pytest.importorskip("pinocchio")
    scene = floor(0.25, (0.6, 0.0), 0.0)
    result = mp.run(scene, "talos", goal=(0.5, 0.3), latency=0.02, duration=1.5)
    assert not result.measures.fell
    assert result.online.statuses == {"solved": result.online.replans}
    assert len(result.plans[0].plan.scene.surfaces) == 1


@pytest.mark.parametrize("robot", ["talos", "g1"])
def test_what_follows_a_plan_over_tiles_has_them_whole(robot: str) -> None:
    """A sole whose middle was on a seam pressed on one tile alone: both robots fell at the end of a turn."""
    pytest.importorskip("mujoco")
    pytest.importorskip("pinocchio")
    plan = mp.plan(floor(0.25, (0.0, 0.0), math.pi / 2.0), robot).plan
    result = mp.track(plan)
    assert result.followed and result.measures.com_max_m < 0.02
    assert len(result.recording.plan.scene.surfaces) == len(plan.scene.surfaces)
    assert robot == "g1" or str(mp.motion(plan).status) == "solved"
