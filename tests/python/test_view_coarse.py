"""mcplan.view.coarse, and pictures of plans: robots with a URDF are drawn with their meshes, of few triangles."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import mcplan as mp
from mcplan.errors import SimplerDrawing
from mcplan.view.coarse import coarse
from mcplan.view.pictures.picture import _figure, picture
from mcplan.view.shapes import ellipsoid


def volume(mesh) -> float:
    corners = mesh.vertices[mesh.faces]
    return float(np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6.0


def fine_ball() -> object:
    """A ball of radius 1 m whose triangles are each split into four, three times."""
    mesh = ellipsoid((1.0, 1.0, 1.0))
    for _ in range(3):
        corners = mesh.vertices[mesh.faces]
        a, b, c = (0.5 * (corners[:, i] + corners[:, (i + 1) % 3]) for i in range(3))
        split = [(corners[:, 0], a, c), (a, corners[:, 1], b), (c, b, corners[:, 2]), (a, b, c)]
        vertices = np.concatenate([np.stack(triangle, axis=1) for triangle in split]).reshape(-1, 3)
        vertices /= np.maximum(np.linalg.norm(vertices, axis=1, keepdims=True), 1e-9)
        mesh = dataclasses.replace(mesh, vertices=vertices, faces=np.arange(len(vertices)).reshape(-1, 3))
    return mesh


def test_a_coarse_ball_is_a_ball_of_fewer_triangles():
    ball, cell_m = fine_ball(), 0.1
    small = coarse(ball, cell_m)
    assert 100 < len(small.faces) < 0.2 * len(ball.faces)
    assert volume(small) == pytest.approx(4.0 / 3.0 * np.pi, rel=0.03)
    # A mean of points in one cube is no farther from the ball's surface than the cube is long.
    assert np.abs(np.linalg.norm(small.vertices, axis=1) - 1.0).max() < cell_m * np.sqrt(3.0)
    assert not any(len(set(face)) < 3 for face in small.faces.tolist())


def test_a_mesh_that_is_coarse_already_stays():
    ball = ellipsoid((1.0, 1.0, 1.0))
    same = coarse(ball, 1e-4)
    assert len(same.faces) <= len(ball.faces) and volume(same) == pytest.approx(volume(ball), rel=1e-9)


@pytest.fixture(scope="module")
def talos_plan():
    pytest.importorskip("pinocchio")
    return mp.plan("flat", "talos").plan


def orange(path) -> int:
    """Pixels of the colour of TALOS's finger tips, which nothing else in a picture of it has."""
    pixels = (255.0 * pytest.importorskip("matplotlib.image").imread(path)[..., :3]).astype(int)
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(((red > 240) & (abs(green - 150) < 25) & (abs(blue - 50) < 35)).sum())


def test_a_robot_with_a_urdf_is_drawn_with_its_meshes(talos_plan, tmp_path):
    pixels = {
        meshes: orange(picture(talos_plan, path=tmp_path / "p.png", poses=2, meshes=meshes)) for meshes in (True, False)
    }
    assert pixels[True] > 100 and pixels[False] == 0


@pytest.mark.parametrize("ending", ["svg", pytest.param("pdf", marks=pytest.mark.slow)])
def test_pictures_in_vectors_have_meshes_as_an_image(talos_plan, tmp_path, ending):
    assert picture(talos_plan, path=tmp_path / f"p.{ending}", poses=2).stat().st_size < 3e6


def test_without_the_urdf_a_picture_has_a_stick_robot_and_says_why(talos_plan, tmp_path):
    plan = mp.Plan.load(talos_plan.save(tmp_path / "plan.npz") or tmp_path / "plan.npz")
    plan.robot.urdf = str(tmp_path / "gone.urdf")
    with pytest.warns(SimplerDrawing, match="gone.urdf.*; drawing a stick robot instead"):
        assert orange(picture(plan, path=tmp_path / "p.png", poses=2)) == 0


@pytest.mark.slow
def test_meshes_do_not_hide_contact_forces(talos_plan, tmp_path, monkeypatch):
    """Where a picture without links has arrows, one with links has the same, but for blurred edges."""
    read = pytest.importorskip("matplotlib.image").imread
    module, figure = "mcplan.view.pictures.picture", _figure

    def pixels(links: bool, forces: bool = True) -> np.ndarray:
        with monkeypatch.context() as change:
            if not links:
                change.setattr(f"{module}._figure", lambda *given: dataclasses.replace(figure(*given), parts=[]))
            if not forces:
                change.setattr(f"{module}._paint_forces", lambda *given, **named: None)
            return read(picture(talos_plan, path=tmp_path / "p.png", poses=2))

    alone = pixels(links=False)
    arrows = np.abs(alone - pixels(links=False, forces=False)).max(axis=2) > 0.2
    same = np.abs(alone - pixels(links=True)).max(axis=2) < 0.02
    assert arrows.sum() > 1000 and (arrows & same).sum() > 0.9 * arrows.sum()
