"""The ground as solids: behind its surfaces, joined in corners, under every tread."""

import numpy as np
import pytest

from mcplan._core import PlanarContact, PlanarPhase, PlanarSurface, PlanarTask
from mcplan.planar.view.ground import cone_outline, slabs_of
from reference_solutions import reference_task


def task_on(*surfaces: PlanarSurface, contacts: dict[int, tuple[float, float]]) -> PlanarTask:
    """Contacts at points by surface."""
    touching = [PlanarContact(end_effector=0, surface=s, position_W=at, angle=0.0) for s, at in contacts.items()]
    robot = reference_task("walking").robot
    phases = [PlanarPhase(contacts=[contact]) for contact in touching]
    return PlanarTask(name="made", robot=robot, surfaces=list(surfaces), phases=phases)


POINTS = np.array([[-0.3, 0.0], [1.0, 1.5]])


def test_floor_reaches_under_the_motion_and_no_further():
    (slab,) = slabs_of(task_on(PlanarSurface(name="floor"), contacts={0: (0.0, 0.0)}), POINTS, 0.1, 0.2)
    assert slab.front_W == pytest.approx(np.array([[-0.4, 0.0], [1.1, 0.0]]))
    assert slab.outline_W[:, 1].min() == pytest.approx(-0.2)
    assert not slab.is_wall


def test_floor_and_wall_end_where_they_meet_and_share_the_corner():
    wall = PlanarSurface(name="wall", origin_W=(-0.2, 0.0), angle=-0.5 * np.pi)
    slabs = slabs_of(
        task_on(PlanarSurface(name="floor"), wall, contacts={0: (0.0, 0.0), 1: (-0.2, 1.0)}), POINTS, 0.1, 0.2
    )
    floor, wall = sorted(slabs, key=lambda slab: slab.name)
    assert floor.front_W[0] == pytest.approx([-0.2, 0.0])
    assert wall.front_W[-1] == pytest.approx([-0.2, 0.0])  # its tangent points down
    assert wall.is_wall
    for slab in slabs:
        assert np.linalg.norm(slab.outline_W - [-0.4, -0.2], axis=1).min() < 1e-9  # no notch behind the corner


def test_a_surface_that_ends_is_drawn_to_its_end():
    plank = PlanarSurface(name="plank", origin_W=(0.2, 0.5), from_=-0.1, to=0.3)
    slabs = slabs_of(
        task_on(PlanarSurface(name="floor"), plank, contacts={0: (0.0, 0.0), 1: (0.2, 0.5)}), POINTS, 0.1, 0.2
    )
    drawn = {slab.name: slab for slab in slabs}
    assert drawn["plank"].front_W == pytest.approx(np.array([[0.1, 0.5], [0.5, 0.5]]))
    assert drawn["plank"].outline_W[:, 1].min() == pytest.approx(-0.2)  # down to the bottom of the floor
    assert [slab.name for slab in slabs] == ["floor", "plank"]  # what stands on the floor is painted over it


def test_a_riser_in_the_solid_of_its_tread_has_none_of_its_own():
    riser = PlanarSurface(name="riser", origin_W=(0.3, 0.0), angle=0.5 * np.pi, from_=0.0, to=0.12)
    tread = PlanarSurface(name="tread", origin_W=(0.3, 0.12), from_=0.0, to=0.4)
    slabs = slabs_of(task_on(riser, tread, contacts={1: (0.4, 0.12)}), POINTS, 0.1, 0.2)
    drawn = {slab.name: slab for slab in slabs}
    assert len(drawn["riser"].outline_W) == 0
    assert drawn["riser"].front_W == pytest.approx(np.array([[0.3, 0.0], [0.3, 0.12]]))
    assert len(drawn["tread"].outline_W) == 4


@pytest.mark.parametrize("name", ["cartwheel", "climbing", "climbing_steep", "walking"])
def test_solids_are_convex_counter_clockwise_and_behind_their_surface(name):
    task = reference_task(name)
    slabs = slabs_of(task, POINTS, 0.1, 0.1)
    assert len(slabs) == len(task.surfaces)
    for slab in slabs:
        edges = np.roll(slab.outline_W, -1, axis=0) - slab.outline_W
        after = np.roll(edges, -1, axis=0)
        assert (edges[:, 0] * after[:, 1] - edges[:, 1] * after[:, 0]).min() > 0.0
        surface = task.surfaces[slab.surface]
        assert ((slab.outline_W - surface.origin_W) @ surface.normal_W).max() < 1e-9


def test_cone_is_as_wide_as_friction_about_the_normal():
    for angle, friction in ((0.0, 0.5), (0.7, 2.0), (-1.5, 0.0)):
        rim = cone_outline(angle, friction, 0.2)[1:]
        assert np.linalg.norm(rim, axis=1) == pytest.approx(0.2)
        tangent, normal = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
        assert (rim @ tangent / (rim @ normal)).max() == pytest.approx(friction, abs=1e-9)
        assert (rim @ tangent / (rim @ normal)).min() == pytest.approx(-friction, abs=1e-9)
