"""Whatever way its triangles are wound, a mesh is drawn whole."""

import gzip

import numpy as np
import pytest

from mcplan.kinematics.rotations import pose
from mcplan.view.figure import Figure, Part
from mcplan.view.pictures.rendering import Eye, Renderer
from mcplan.view.shapes import Mesh, box, capsule
from mcplan.view.winding import both_sides, whole

CUBE = box((0.4, 0.4, 0.4))


def unshared(mesh):
    """As files have it: three vertices of its own for each triangle."""
    return Mesh(mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def mixed(mesh, seed=3):
    """Every triangle turned or not, at random."""
    turned = np.random.default_rng(seed).random(len(mesh.faces)) < 0.5
    return Mesh(mesh.vertices, np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces))


def volume(mesh):
    corners = mesh.vertices[mesh.faces]
    return np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6.0


@pytest.mark.parametrize("mesh", [CUBE, unshared(CUBE), capsule(0.3, 0.1, 0.05)])
def test_a_closed_skin_stays_as_it_is_and_its_mirror_image_is_turned(mesh):
    assert whole(mesh) is mesh
    mirrored = Mesh(mesh.vertices * [1.0, -1.0, 1.0], mesh.faces)
    assert volume(mirrored) < 0.0
    mended = whole(mirrored)
    assert not mended.two_sided
    assert volume(mended) == pytest.approx(volume(mesh))


@pytest.mark.parametrize("mesh", [mixed(CUBE), mixed(unshared(CUBE)), Mesh(CUBE.vertices, CUBE.faces[:-1])])
def test_mixed_and_open_ones_are_seen_from_both_sides(mesh):
    mended = whole(mesh)
    assert mended.two_sided
    assert mended.moved(pose(np.eye(3), np.ones(3))).two_sided
    doubled = both_sides(mended)
    assert len(doubled.faces) == 2 * len(mesh.faces)
    corners = doubled.vertices[doubled.faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert areas.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-12)  # a back for each front


def test_size_does_not_matter():
    for scale in (1e-4, 1e4):
        assert not whole(Mesh(scale * CUBE.vertices, CUBE.faces)).two_sided
        assert whole(Mesh(scale * CUBE.vertices, mixed(CUBE).faces)).two_sided


def test_pages_ask_for_both_sides():
    pytest.importorskip("meshcat")
    from mcplan.view.stage import Stage

    sides = []
    for mesh in (CUBE, whole(mixed(CUBE))):
        stage = Stage()
        stage.mesh("cube", mesh, "#d00000")
        raw = gzip.decompress(stage.payload())
        at = raw.index(b"side") + 4
        sides.append(raw[at])
    assert sides == [0, 2]


def covered(mesh):
    """Pixels of a red thing in a picture of MuJoCo's."""
    eye = Eye(np.zeros(3), 2.5, 70.0, -25.0)
    part = Part("cube", mesh, "#d00000", pose(np.eye(3)[None], np.zeros((1, 3))))
    with Renderer(Figure("urdf", [part]), [], (160, 120), np.array([0.3, -0.5, 1.0])) as renderer:
        pixels = renderer.picture([0], eye).astype(int)
    red = (pixels[..., 0] > 2 * pixels[..., 1]) & (pixels[..., 0] > 40)
    return red.sum(), pixels[red][:, 0].mean()


@pytest.mark.parametrize("make", [mixed, unshared, lambda m: Mesh(m.vertices, m.faces[:, ::-1])])
def test_videos_and_strips_show_all_of_it_lit_alike(make):
    pytest.importorskip("mujoco")
    expected, bright = covered(CUBE)
    found, lit = covered(whole(make(CUBE)))
    assert expected > 500
    assert found == pytest.approx(expected, rel=0.01)
    assert lit == pytest.approx(bright, rel=0.05)


def test_the_thighs_of_go2_are_there():
    """Its right thighs are wound either way; half of their triangles used to be missing."""
    pytest.importorskip("mujoco")
    pytest.importorskip("pinocchio")
    models = pytest.importorskip("example_robot_data")
    from mcplan.view.robot_urdf import _mesh

    model = models.load("go2").visual_model
    thigh = next(_mesh(item) for item in model.geometryObjects if item.name == "FR_thigh_0")
    assert thigh.two_sided
    silhouette = Mesh(thigh.vertices, np.vstack([thigh.faces, thigh.faces[:, ::-1]]))
    assert covered(thigh)[0] == pytest.approx(covered(silhouette)[0], rel=0.01)
