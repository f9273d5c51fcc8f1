"""Terrain solids: their tops are the surfaces, and they hide in nothing that may be stepped on."""

import numpy as np
import pytest

import mcplan as mp
from mcplan.files import builtin
from mcplan.kinematics.rotations import polygon_normal
from mcplan.tracking.terrain import add_terrain, prism

mujoco = pytest.importorskip("mujoco")

SCENES = [name for name in builtin.names("scenes")]


def ground_of(scene, **options):
    spec = mujoco.MjSpec()
    add_terrain(spec, scene, **options)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def hit(model, data, origin, direction):
    geom = np.zeros(1, np.int32)
    args = [model, data, np.asarray(origin, float), np.asarray(direction, float), None, 1, -1, geom]
    try:
        distance = mujoco.mj_ray(*args, None)
    except TypeError:  # before 3.4 it gave no normal
        distance = mujoco.mj_ray(*args)
    return distance, int(geom[0])


def points_inside(outline, rng, count):
    weights = rng.dirichlet(np.ones(len(outline)), size=count)
    return 0.98 * weights @ outline + 0.02 * outline.mean(axis=0)


@pytest.mark.parametrize("name", SCENES)
def test_rays_against_the_normal_hit_every_surface_at_its_top(name):
    scene = mp.load_scene(name)
    model, data = ground_of(scene, shift_m=0.01)
    rng = np.random.default_rng(0)
    for number, surface in enumerate(scene.surfaces):
        outline = np.asarray(surface.vertices_W)
        normal = polygon_normal(outline)
        for point in points_inside(outline, rng, 5):
            distance, geom = hit(model, data, point + [0, 0, 0.01] + 0.01 * normal, -normal)
            assert geom == number
            assert distance == pytest.approx(0.01, abs=2e-4)  # built-in scenes round their corners


@pytest.mark.parametrize("name", SCENES)
def test_no_solid_rises_above_another_surface_that_is_stepped_on(name):
    """Straight down from above every point of a level or sloped surface, that surface is what is hit first."""
    scene = mp.load_scene(name)
    model, data = ground_of(scene)
    rng = np.random.default_rng(1)
    for surface in scene.surfaces:
        outline = np.asarray(surface.vertices_W)
        if polygon_normal(outline)[2] < 0.5:
            continue
        for point in points_inside(outline, rng, 20):
            distance, _ = hit(model, data, point + [0, 0, 0.3], [0, 0, -1])
            assert distance == pytest.approx(0.3, abs=5e-4)


@pytest.mark.parametrize("outline", ["floor", "slope", "wall"])
def test_a_prism_is_closed_and_has_the_volume_of_its_surface_times_its_depth(outline):
    slope = 0.3
    corners = {
        "floor": [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]],
        "slope": [[0, 0, 0], [2, 0, 2 * slope], [2, 1, 2 * slope], [0, 1, 0]],
        "wall": [[0, 0, 0], [2, 0, 0], [2, 0, 1], [0, 0, 1]],
    }[outline]
    points, triangles = prism(mp.model.Surface(name="s", vertices_W=corners, thickness=0.05))
    a, b, c = (points[triangles[:, i]] for i in range(3))
    assert (np.einsum("ni,ni->n", a, np.cross(b, c)) / 6.0).sum() == pytest.approx(2.0 * 0.05)  # outward all over
    assert np.cross(b - a, c - a).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)
    np.testing.assert_array_equal(points[:4], np.asarray(corners, float))


def test_what_may_be_grasped_is_not_slid_on_and_thin_surfaces_are_solid():
    scene = mp.load_scene("gap_with_rail")
    rail = next(i for i, surface in enumerate(scene.surfaces) if surface.end_effectors != ("foot",))
    surfaces = list(scene.surfaces)
    surfaces[rail].grasp, surfaces[rail].thickness = True, 1e-4
    scene.surfaces = surfaces
    model, _ = ground_of(scene, friction_scale=0.9)
    assert model.geom_friction[rail][0] == pytest.approx(4.5)
    points, _ = prism(scene.surfaces[rail])
    assert np.ptp(points[:, 2]) >= 0.02
