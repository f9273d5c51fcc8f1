"""Snapshots of runs: as many as asked for, each with its robot."""

import numpy as np
import pytest

import mcplan as mp
import recordings
from mcplan.kinematics.rotations import pose
from mcplan.view import save_run_postures, save_run_strip
from mcplan.view.figure import Figure, Part
from mcplan.view.pictures.rendering import Eye
from mcplan.view.pictures.run_scene import RunScene
from mcplan.view.pictures.run_strip import _with_pushes, fitted, framed
from mcplan.view.shapes import box
from test_view_pictures_rendering import pixel_of

pytest.importorskip("mujoco")
pytest.importorskip("pinocchio")
Image = pytest.importorskip("PIL.Image")


def rotations(count, random):
    """Turns about the vertical, with some lean."""
    for yaw, lean in zip(random.uniform(-0.5, 0.5, count), random.uniform(-0.3, 0.3, count), strict=True):
        c, s = np.cos([yaw, lean]), np.sin([yaw, lean])
        yield np.array([[c[0], -s[0], 0], [s[0], c[0], 0], [0, 0, 1]]) @ np.array(
            [[c[1], 0, s[1]], [0, 1, 0], [-s[1], 0, c[1]]]
        )


def scene_with(part):
    """A run of nothing but one part."""
    count = len(part.poses)
    return RunScene(
        times_s=np.arange(count, dtype=float),
        com_W=part.poses[:, :3, 3],
        reach_W=part.poses[:, None, :3, 3],
        figure=Figure("urdf", [part]),
        arrows=[[] for _ in range(count)],
        drawings=[],
        footholds=[],
        forward=np.array([1.0, 0.0]),
        sun_W=np.array([0.3, -0.5, 1.0]),
        height_m=float(np.ptp(part.mesh.vertices[:, 2])),
    )


@pytest.fixture(scope="module")
def recording():
    return recordings.walking()


def test_a_strip_has_a_robot_in_every_frame_and_they_differ(recording, tmp_path):
    path = save_run_strip(recording, tmp_path / "strip.png", frames=[0.0, 1.5, 3.0], width=480)
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB"), float)
    gap, cell = 2, (480 - 2 * 2) // 3
    assert pixels.shape[1] == 480
    high = pixels.shape[0] - 23  # without the line of the times
    cells = [pixels[:high, n * (cell + gap) : n * (cell + gap) + cell] for n in range(3)]
    for one in cells:
        assert one[60:200].min(axis=2).min() < 60  # Talos' legs are black
        assert one[: high // 20].std() < 15  # nothing above its head
    assert np.abs(cells[0] - cells[1]).mean() > 2 and np.abs(cells[1] - cells[2]).mean() > 2


def test_every_push_has_an_instant_of_its_own_and_the_run_its_ends():
    class Run:
        options = mp.tracking.Options(
            pushes=(
                mp.tracking.Push(100.0, 0.2, 1.75),
                mp.tracking.Push(100.0, 0.2, 3.0),
                mp.tracking.Push(1.0, 0.2, 9.9),
            )
        )

    even = np.linspace(0.0, 10.0, 6)
    np.testing.assert_allclose(_with_pushes(even, Run()), [0.0, 1.85, 3.1, 6.0, 8.0, 10.0])
    np.testing.assert_allclose(_with_pushes(even, object()), even)
    np.testing.assert_allclose(_with_pushes(even[:2], Run()), even[:2])


def test_postures_stand_side_by_side_in_one_scene(recording, tmp_path):
    path = save_run_postures(recording, tmp_path / "postures.png", postures=2, size=(480, 240))
    one = save_run_postures(recording, tmp_path / "one.png", postures=[3.0], size=(480, 240))
    width = []
    for file in (path, one):
        with Image.open(file) as image:
            pixels = np.asarray(image.convert("RGB"), int)
            assert pixels.shape == (240, 480, 3)
        dark = (pixels.max(axis=2) < 130) & (np.ptp(pixels, axis=2) < 30)  # legs and their shadows
        width.append(np.ptp(np.nonzero(dark.sum(axis=0) >= 5)[0]))
    assert width[0] > 1.3 * width[1]


@pytest.mark.parametrize("seed", range(5))
def test_a_fitted_eye_sees_every_point_and_is_as_near_as_can_be(seed):
    random = np.random.default_rng(seed)
    points = random.normal(size=(30, 3)) * [2.0, 0.5, 0.7] + random.normal(size=3)
    size = (640, 360)
    eye = fitted(points, Eye(np.zeros(3), 1.0, 80.0 + 20 * random.random(), -12.0), size, margin=0.0)
    seen = np.array([pixel_of(p, eye, size) for p in points])
    assert (seen >= -1e-6).all() and (seen <= np.array(size) + 1e-6).all()
    slack = np.minimum(seen, np.array(size) - seen).min()
    assert slack == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("size", [(0.7, 0.3, 0.4), (0.3, 0.3, 1.7), (7e-3, 3e-3, 4e-3), (20.0, 9.0, 12.0)])
def test_every_frame_of_a_strip_holds_all_of_the_robot_large_and_at_one_scale(size):
    """A dog is longer than a human is wide, and once lost its head and tail to a frame made for humans."""
    random = np.random.default_rng(7)
    poses = [pose(R, p * max(size)) for R, p in zip(rotations(4, random), random.normal(size=(4, 3)), strict=True)]
    scene = scene_with(Part("trunk", box(size), "#d00000", np.array(poses)))
    width = 120
    eyes, height = framed(scene, range(4), width)
    assert len({eye.distance_m for eye in eyes}) == 1
    share = []
    for n, eye in enumerate(eyes):
        corners = scene.figure.parts[0].mesh.moved(poses[n]).vertices
        seen = np.array([pixel_of(corner, eye, (width, height)) for corner in corners])
        assert (seen >= 0.0).all() and (seen <= [width, height]).all()
        assert 0.5 * (seen.min(axis=0) + seen.max(axis=0)) == pytest.approx(
            [0.5 * width, 0.5 * height], abs=0.12 * width
        )
        share.append((np.ptp(seen, axis=0) / [width, height]).max())
    assert max(share) > 0.75


@pytest.mark.parametrize(("size", "rows"), [((0.7, 0.3, 0.4), 2), ((0.3, 0.3, 1.7), 1)])
def test_frames_that_are_wider_than_tall_stand_four_in_a_row(recording, size, rows, tmp_path):
    """Eight of them in a row were as small as stamps."""
    scene = scene_with(Part("trunk", box(size), "#d00000", np.array([np.eye(4)] * 8)))
    path = save_run_strip(recording, tmp_path / "strip.png", width=480, lay_out=lambda run, rate_hz: scene)
    with Image.open(path) as image:
        pixels = np.asarray(image.convert("RGB"), int)
    red = ((pixels[:, :, 0] - pixels[:, :, 1]) > 60).any(axis=1)
    assert np.count_nonzero(np.diff(red.astype(int)) == 1) == rows
    assert image.width == 480 and image.height > 120


@pytest.mark.parametrize(
    ("frames", "name", "message"),
    [
        (0, "a.png", "frames: must be at least 1, got 0"),
        ([], "a.png", "frames: needs at least one instant"),
        ([0.0, 99.0], "a.png", "frames[1]: must lie in the run, from 0 to 3 s, got 99"),
        (3, "a.jpg", "path: must end in .png"),
    ],
)
def test_bad_requests_are_named(recording, tmp_path, frames, name, message):
    with pytest.raises(mp.InvalidInput) as error:
        save_run_strip(recording, tmp_path / name, frames=frames)
    assert message in str(error.value)
