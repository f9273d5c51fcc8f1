"""Pages and plots of motions: what they draw is what the motion has."""

from __future__ import annotations

import io

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("matplotlib")

import matplotlib.image  # noqa: E402

import mcplan as mp  # noqa: E402
from mcplan.view.colours import rgb  # noqa: E402
from mcplan.view.motion_samples import motion_frames  # noqa: E402
from mcplan.view.pages.joint_maps import COLUMNS, OVER, STOPS, Line, joint_panel, map_png  # noqa: E402
from mcplan.wb.certificate.curves import curves_of  # noqa: E402
from motions_by_hand import Talos, lifting_motion  # noqa: E402


@pytest.fixture(scope="module")
def lifting() -> mp.wb.Motion:
    return lifting_motion(Talos())


def test_a_map_has_the_largest_ratio_of_each_stretch_and_red_beyond_the_limit():
    ratios = np.zeros((3 * COLUMNS, 2))
    ratios[4, 0], ratios[7, 1] = 1.0, 1.001
    pixels = matplotlib.image.imread(io.BytesIO(map_png(ratios)), format="png")
    assert pixels.shape == (2, COLUMNS, 3)
    np.testing.assert_allclose(pixels[0, 1], rgb(STOPS[-1][1]), atol=1 / 255)
    np.testing.assert_allclose(pixels[1, 2], rgb(OVER), atol=1 / 255)
    np.testing.assert_allclose(pixels[0, 0], rgb(STOPS[0][1]), atol=1 / 255)


def test_lines_of_the_panel_stop_where_there_is_nothing():
    values = np.array([0.0, 1.0, np.nan, 0.5, 0.5])
    line = Line("height <&>", np.arange(5.0), values, 1.0, 0.1, "#123456")
    text = joint_panel(["knee_joint"], [], [line], 4.0)
    assert "M0.0,100.0L250.0,0.0M750.0,50.0L1000.0,50.0" in text
    assert "height &lt;&amp;&gt;" in text and "<div>knee</div>" in text


def test_frames_have_the_motion_s_forces_at_their_centres_of_pressure(lifting):
    samples, configurations = motion_frames(lifting, 50.0)
    states = lifting.sample(samples.times_s)
    np.testing.assert_allclose(samples.forces_W, states.wrenches_W[..., :3])
    # About the centre of pressure no moment is left but that along the normal, which here is z.
    lever = samples.pressure_W - states.end_effectors_W
    moments = states.wrenches_W[..., 3:] - np.cross(lever, samples.forces_W)
    pressed = samples.forces_W[..., 2] > 1.0
    assert pressed.any()
    np.testing.assert_allclose(moments[pressed][:, :2], 0.0, atol=1e-9)
    assert configurations.shape == (len(samples.times_s), lifting.model.complete.model.nq)


def test_curves_are_the_measures_of_the_certificate(lifting):
    curves, check = curves_of(lifting, 1000.0), lifting.check()
    assert curves.torque_use.max() == pytest.approx(check.measures["torque_use"])
    assert curves.speed_use.max() == pytest.approx(check.measures["velocity_use"])
    assert curves.residual[:, 0].max() == pytest.approx(check.measures["base_residual_N"])
    assert np.nanmax(curves.drift_m) == pytest.approx(check.measures["drift_m"])
    assert curves.distance_m.min() == pytest.approx(check.measures["self_distance_m"], abs=1e-3)
    assert curves.flights == []
