"""Rendered pictures: things appear where a pinhole camera would see them."""

import os
import subprocess
import sys

import numpy as np
import pytest

from mcplan.kinematics.rotations import pose
from mcplan.view.colours import GROUND
from mcplan.view.figure import Figure, Part
from mcplan.view.pictures import rendering
from mcplan.view.pictures.rendering import FIELD, Arrow, Eye, NoGraphics, Path, Renderer
from mcplan.view.scene_drawing import SurfaceDrawing
from mcplan.view.shapes import box, prism

pytest.importorskip("mujoco")

SIZE = (320, 200)
EYE = Eye(np.array([0.2, 0.1, 0.5]), 4.0, 70.0, -20.0)
PLACES = np.array([[0.0, 0.0, 0.6], [0.5, -0.3, 0.9]])


def pixel_of(point_W, eye=EYE, size=SIZE):
    """Column and row at which a pinhole camera sees a point."""
    a, e = np.radians(eye.azimuth_deg), np.radians(eye.elevation_deg)
    ahead = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([np.sin(a), -np.cos(a), 0.0])
    down = np.cross(ahead, right)
    away = point_W - (eye.target_W - eye.distance_m * ahead)
    focal = 0.5 * size[1] / np.tan(np.radians(0.5 * FIELD))
    depth = away @ ahead
    return np.array([0.5 * size[0] + focal * (away @ right) / depth, 0.5 * size[1] + focal * (away @ down) / depth])


def centre(mask):
    rows, columns = np.nonzero(mask)
    return np.array([columns.mean() + 0.5, rows.mean() + 0.5])


def reddish(pixels):
    rgb = pixels.astype(int)
    return (rgb[..., 0] > 2 * rgb[..., 1]) & (rgb[..., 0] > 60)


@pytest.fixture(scope="module")
def renderer():
    figure = Figure("urdf", [Part("cube", box((0.2, 0.2, 0.2)), "#d00000", pose(np.eye(3), PLACES))])
    outline = np.array([[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, 2.0, 0.0], [-2.0, 2.0, 0.0]])
    ground = SurfaceDrawing(
        "ground", outline, np.array([0.0, 0.0, 1.0]), prism(outline, 0.1), GROUND, 1.0, np.zeros((0, 2, 3))
    )
    with Renderer(figure, [ground], SIZE, np.array([0.3, -0.5, 1.0])) as made:
        yield made


def test_a_cube_is_seen_where_a_pinhole_camera_sees_it(renderer):
    for sample, place in enumerate(PLACES):
        pixels = renderer.picture([sample], EYE)
        assert pixels.shape == (SIZE[1], SIZE[0], 3)
        assert centre(reddish(pixels)) == pytest.approx(pixel_of(place), abs=2.5)


def test_the_picture_has_sky_above_and_ground_below(renderer):
    pixels = renderer.picture([0], Eye(np.array([0.0, 0.0, 0.3]), 5.0, 90.0, -5.0)).astype(int)
    sky, ground = pixels[5, 160], pixels[150, 160]
    assert sky[2] > sky[0] + 10  # blue
    assert np.ptp(ground) < 15  # grey
    assert pixels.std() > 10


def test_two_postures_share_one_picture_and_the_faded_one_is_paler(renderer):
    pixels = renderer.picture([0, 1], EYE, fades=[0.5, 0.0])
    pale, full = (pixels[tuple(pixel_of(p).astype(int)[::-1])].astype(int) for p in PLACES)
    assert full[0] > 2 * full[1]
    assert pale[1] > full[1] + 40


def test_an_arrow_is_seen_through_the_body_that_hides_it(renderer):
    arrow = Arrow(PLACES[0] - [0.0, 0.0, 0.1], PLACES[0] + [0.0, 0.0, 0.1], "#00c000", 0.02)
    pixels = renderer.picture([0], EYE, [arrow]).astype(int)
    green = (pixels[..., 1] > 2 * pixels[..., 0]) & (pixels[..., 1] > 60)
    assert green.sum() > 20
    assert centre(green) == pytest.approx(pixel_of(PLACES[0]), abs=6)


def test_a_path_is_hidden_by_a_body_in_front(renderer):
    ends = np.array([PLACES[0] - [0.6, 0.0, 0.0], PLACES[0] + [0.6, 0.0, 0.0]])
    pixels = renderer.picture([0], EYE, paths=[Path(ends, "#00c000", 0.02)]).astype(int)
    green = (pixels[..., 1] > 2 * pixels[..., 0]) & (pixels[..., 1] > 60)
    column, row = pixel_of(PLACES[0]).astype(int)
    assert green.sum() > 40 and not green[row - 3 : row + 3, column - 3 : column + 3].any()


def test_shadows_can_be_left_out(renderer):
    figure, lit = renderer.figure, renderer.picture([0], EYE).astype(int)
    with Renderer(figure, [], SIZE, np.array([0.3, -0.5, 1.0]), shadows=False) as other:
        assert other.picture([0], EYE).shape == lit.shape
    # Below the cube, away from the sun, the ground is darker than elsewhere.
    sun = np.array([0.3, -0.5, 1.0])
    shaded = pixel_of(PLACES[0] - sun * PLACES[0][2]).astype(int)
    beside = pixel_of(np.array([1.0, 0.6, 0.0])).astype(int)
    assert lit[shaded[1], shaded[0]].mean() < lit[beside[1], beside[0]].mean() - 40


def test_without_graphics_the_packages_are_named(monkeypatch):
    def missing(name):
        raise AttributeError("'NoneType' object has no attribute 'eglQueryString'")

    monkeypatch.setattr(rendering.importlib, "import_module", missing)
    with pytest.raises(NoGraphics, match="apt-get install libegl1 libgl1-mesa-dri"):
        Renderer(Figure("urdf", []), [], SIZE, np.array([0.0, 0.0, 1.0]))


def test_it_renders_where_mujoco_was_imported_without_a_screen_before():
    script = """
import mujoco, numpy as np
from mcplan.view.figure import Figure
from mcplan.view.pictures.rendering import Eye, Renderer
with Renderer(Figure("urdf", []), [], (32, 32), np.array([0.0, 0.0, 1.0])) as renderer:
    print(renderer.picture([0], Eye(np.zeros(3), 2.0, 0.0, 0.0)).shape)
"""
    hidden = {"MUJOCO_GL", "DISPLAY", "PYOPENGL_PLATFORM"}
    environment = {k: v for k, v in os.environ.items() if k not in hidden} | {"PYTHONPATH": ":".join(sys.path)}
    found = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment, check=False)
    assert found.stdout.strip() == "(32, 32, 3)", found.stderr
