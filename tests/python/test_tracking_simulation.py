"""The simulation against statics: weight, centre of pressure, friction angles, pushes, and runs that blow up."""

import numpy as np
import pytest

import mcplan as mp
import simulated

mujoco = pytest.importorskip("mujoco")
pin = pytest.importorskip("pinocchio")
pytest.importorskip("example_robot_data")

from mcplan.tracking import Options  # noqa: E402
from mcplan.tracking.mujoco_model import build  # noqa: E402
from mcplan.tracking.simulation import Simulation  # noqa: E402


@pytest.fixture(scope="module", params=["talos", "g1"])
def standing(request):
    """A robot that has stood for four seconds, its joints held, on ground that is 3 mm higher than z = 0."""
    model = build(mp.load_robot(request.param), simulated.level(), Options(ground_shift_m=0.003))
    simulation = Simulation(model)
    configuration = simulated.standing(model, lift_m=0.003)
    simulation.reset(configuration)
    simulated.stiffen(model, configuration)
    simulation.advance(np.zeros(len(model.joints)), steps=4000)
    return simulation, configuration


def test_a_robot_that_stands_is_borne_by_its_soles(standing):
    simulation, configuration = standing
    robot, forces = simulation.model.urdf_model.robot, simulation.contact_forces_W()
    weight = robot.mass * 9.81
    assert np.linalg.norm(forces.sum(axis=0) - [0, 0, weight]) < 0.01 * weight
    for end, force in zip(robot.end_effectors, forces, strict=True):
        assert (force[2] > 0.3 * weight) if end.kind == "foot" else not force.any()
    now, _ = simulation.state()
    assert np.abs(now[:3] - configuration[:3]).max() < 0.03
    assert simulation.time_s == pytest.approx(4.0)
    assert simulation.warnings == 0 and not simulation.broke


def test_pressure_lies_on_the_soles_and_its_moment_is_the_contacts(standing):
    simulation, _ = standing
    robot, centres = simulation.model.urdf_model.robot, simulation.centres_of_pressure_W()
    wrenches, forces = simulation.contact_wrenches_W(), simulation.contact_forces_W()
    np.testing.assert_array_equal(wrenches[:, :3], forces)
    for number, end in enumerate(robot.end_effectors):
        if end.kind != "foot":
            assert np.isnan(centres[number]).all() and not wrenches[number].any()
            continue
        assert centres[number][2] == pytest.approx(0.003, abs=5e-4)  # the ground's height
        # Level ground: forces at the centre of pressure have no moment about it but a vertical one.
        moment = wrenches[number][3:] - np.cross(centres[number], forces[number])
        assert np.abs(moment[:2]).max() < 0.02 * abs(forces[number][2]) * 0.1


@pytest.fixture
def block_on(tmp_path):
    def make(angle, options=None, **surface):
        (tmp_path / "block.urdf").write_text(simulated.block())
        robot = mp.load_robot("anymal")
        robot.name, robot.urdf, robot.posture = "block", str(tmp_path / "block.urdf"), {}
        end = mp.model.EndEffector(
            name="sole", frame="base", frame_offset=[0, 0, -0.05], half_size=[0.1, 0.1],
            nominal_B=[0, 0, -0.05], reach_min_B=[-1, -1, -1], reach_max_B=[1, 1, 1],
        )  # fmt: skip
        robot.end_effectors = [end]
        scene = simulated.tilted(angle, half_size=3.0, **surface)
        simulation = Simulation(build(robot, scene, options))
        configuration = simulation.model.urdf_model.neutral.copy()
        configuration[:3] = 0.0502 * np.array([-np.sin(angle), 0.0, np.cos(angle)])
        configuration[3:7] = [0.0, -np.sin(angle / 2), 0.0, np.cos(angle / 2)]
        simulation.reset(configuration)
        return simulation

    return make


@pytest.mark.parametrize(("share", "scale"), [(0.95, 1.0), (1.05, 1.0), (0.95, 0.5), (1.05, 0.5)])
def test_a_block_slides_beyond_the_friction_angle_and_not_before(block_on, share, scale):
    friction = 0.4
    angle = share * np.arctan(friction * scale)
    simulation = block_on(angle, Options(friction_scale=scale), friction=friction)
    simulation.advance(np.zeros(1), steps=100)
    before, _ = simulation.state()
    simulation.advance(np.zeros(1), steps=500)
    after, _ = simulation.state()
    slid = np.linalg.norm(after[:3] - before[:3])
    if share < 1.0:
        assert slid < 1e-3
    else:  # from the start it gains g (sin - mu cos) t, less what the soft contact takes
        expected = 9.81 * (np.sin(angle) - friction * scale * np.cos(angle)) * (0.6**2 - 0.1**2) / 2
        assert slid == pytest.approx(expected, rel=0.15)


def test_forces_on_a_slope_are_vertical_and_the_weight(block_on):
    simulation = block_on(0.2, friction=0.7)
    simulation.advance(np.zeros(1), steps=500)
    (force,), weight = simulation.contact_forces_W(), 5.01 * 9.81
    np.testing.assert_allclose(force, [0, 0, weight], atol=0.01 * weight)


def test_a_wrench_on_the_base_lifts_half_the_weight(block_on):
    simulation = block_on(0.0)
    simulation.advance(np.zeros(1), np.array([0, 0, 25.0, 0, 0, 0]), steps=500)
    assert simulation.contact_forces_W()[0, 2] == pytest.approx(5.01 * 9.81 - 25.0, rel=0.01)
    simulation.advance(np.zeros(1), steps=500)  # and no longer
    assert simulation.contact_forces_W()[0, 2] == pytest.approx(5.01 * 9.81, rel=0.01)


def test_heavier_robots_press_harder(block_on):
    simulation = block_on(0.0, Options(mass_scale=1.3))
    simulation.advance(np.zeros(1), steps=500)
    assert simulation.contact_forces_W()[0, 2] == pytest.approx(1.3 * 5.01 * 9.81, rel=0.01)


def test_torques_are_clipped_to_the_limits(block_on):
    simulation = block_on(0.0)
    simulation.advance(np.array([50.0]))
    assert simulation.data.actuator_force[0] == pytest.approx(1.0)


def test_flight_is_a_parabola(block_on):
    simulation = block_on(0.0)
    start, _ = simulation.state()
    start[2] += 1.0
    velocity = np.array([0.3, -0.2, 1.0, 0.0, 0.0, 0.0, 0.0])
    simulation.reset(start, velocity)
    simulation.advance(np.zeros(1), steps=300)
    now, _ = simulation.state()
    np.testing.assert_allclose(now[:3] - start[:3], [0.09, -0.06, 0.3 - 9.81 * 0.09 / 2], atol=2e-3)
    assert not simulation.contact_forces_W().any()


def test_a_run_that_blows_up_is_seen_and_stands_still(block_on, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    simulation = block_on(0.0)
    simulation.advance(np.zeros(1), np.array([1e12, 0, 0, 0, 0, 0]), steps=20)
    assert simulation.broke and simulation.warnings > 0
    assert not list(tmp_path.glob("MUJOCO_LOG*"))
    stopped = simulation.time_s
    simulation.advance(np.zeros(1), steps=5)
    assert simulation.time_s == stopped
    simulation.reset(simulation.model.urdf_model.neutral)
    assert not simulation.broke and simulation.time_s == 0.0 and simulation.warnings == 0
