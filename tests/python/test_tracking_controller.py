"""The controller's torques against statics, the equations of motion, cones and limits; contacts that switch; flight."""

from dataclasses import replace

import numpy as np
import pytest

import mcplan as mp
import simulated
import tracked

pin = pytest.importorskip("pinocchio")
pytest.importorskip("mujoco")
pytest.importorskip("proxsuite")
pytest.importorskip("example_robot_data")

from mcplan.kinematics.inverse_kinematics import follow  # noqa: E402
from mcplan.kinematics.samples import sample_at  # noqa: E402
from mcplan.tracking import Gains, Options  # noqa: E402
from mcplan.tracking.actuators import TorqueSpeed  # noqa: E402
from mcplan.tracking.contacts import SEARCH_SPEED, Mode  # noqa: E402
from mcplan.tracking.controller import SPEED_HORIZON_S, Controller, Restraints  # noqa: E402
from mcplan.tracking.mujoco_model import build  # noqa: E402
from mcplan.tracking.references import references  # noqa: E402
from mcplan.tracking.separation import Separation  # noqa: E402
from mcplan.tracking.simulation import Simulation  # noqa: E402

#: Of ProxQP's residuals, in newtons, newton metres and [rad/s^2] together.
LOOSE = 1e-3


def controller_of(name="talos", plan=None, desired=None, urdf_model=None):
    """A controller that is watched, and the configuration with which the plan starts."""
    urdf_model = urdf_model or tracked.urdf_model(name)
    if plan is None:
        plan, desired = tracked.still(name)
    start = follow(urdf_model, sample_at(plan, plan.scene, plan.robot, np.zeros(1))).configurations[0]
    controller = Controller(urdf_model, plan.scene, desired, start, Gains())
    controller.qp = tracked.Watched()
    return controller, start


def parts_of(controller):
    """Accelerations (nv,), forces [(point_W, force_W, surface)] of the last solution."""
    solution, nv = controller.qp.solution, controller.nv
    found, at = [], nv
    for i, contact in enumerate(controller.contacts):
        if contact.mode is not Mode.CONTACT:
            continue
        motion = controller.dynamics.end_effector(i)
        for offset in controller.points[i].offsets:
            found.append((i, motion.position_W + motion.rotation_W @ offset, solution[at : at + 3]))
            at += 3
    assert at == len(solution) - 1
    return solution[:nv], found


def generalised(controller, forces):
    """(nv,) of forces at points, by the Jacobians of points fixed to the links, made from differences."""
    urdf_model, dynamics, h = controller.urdf_model, controller.dynamics, 1e-6
    model, result = urdf_model.model, np.zeros(controller.nv)
    for column, unit in enumerate(np.eye(controller.nv)):
        data = model.createData()
        pin.framesForwardKinematics(model, data, pin.integrate(model, dynamics.configuration, h * unit))
        for end, point, force in forces:
            before, after = dynamics.end_effector(end), data.oMf[urdf_model.frames[end]]
            moved = after.act(before.rotation_W.T @ (point - before.position_W))
            result[column] += force @ (moved - point) / h
    return result


def assert_obeys(controller, command):
    """Equations of motion, limits and cones, worked out from the solution anew."""
    acceleration, forces = parts_of(controller)
    dynamics, urdf_model = controller.dynamics, controller.urdf_model
    data = urdf_model.model.createData()
    wrench = np.zeros(6)
    scale = 1.0 + sum(np.linalg.norm(force) for _, _, force in forces)
    for _, point, force in forces:
        arm = point - dynamics.configuration[:3]
        wrench += [*(dynamics.base_WB.T @ force), *(dynamics.base_WB.T @ np.cross(arm, force))]
    inverse = pin.rnea(urdf_model.model, data, dynamics.configuration, dynamics.velocity, acceleration)
    np.testing.assert_allclose(inverse[:6], wrench, atol=1e-5 * scale)
    assert (np.abs(command.torques) <= controller.limits).all()
    # Limits are in the program: what is cut off its torques is no more than its tolerance.
    torques = inverse[6:].copy()
    for end, point, force in forces:
        motion = dynamics.end_effector(end)
        torques -= motion.jacobian[:, 6:].T @ [*force, *np.cross(point - motion.position_W, force)]
    np.testing.assert_allclose(command.torques, torques, atol=LOOSE)
    for end, _, force in forces:
        surface = max(controller._surface(0, end), 0)
        normal, friction = controller.normals[surface], controller.friction[surface]
        along = force @ normal
        assert along > -LOOSE
        assert np.linalg.norm(force - along * normal) <= friction * along + LOOSE
    return acceleration, forces


@pytest.fixture(autouse=True)
def keep_friction(monkeypatch):
    """Friction of the surfaces beside their normals, for the checks above."""
    made = Controller.__init__

    def init(self, urdf_model, scene, *rest):
        made(self, urdf_model, scene, *rest)
        self.friction = [surface.friction for surface in scene.surfaces]

    monkeypatch.setattr(Controller, "__init__", init)


def contacts_at(controller, n=0):
    return controller.references.surfaces[n] >= 0


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_standing_is_statics(name):
    controller, start = controller_of(name)
    command = controller.step(0, start, np.zeros(controller.nv), contacts_at(controller))
    assert command.solved
    acceleration, forces = assert_obeys(controller, command)
    weight = controller.dynamics.mass * 9.81
    total = np.sum([force for _, _, force in forces], axis=0)
    np.testing.assert_allclose(total, [0.0, 0.0, weight], atol=0.1 * weight)
    # What is not statics is the inertia of the small accelerations asked for: none without them.
    model, data = controller.urdf_model.model, controller.urdf_model.model.createData()
    gravity = pin.computeGeneralizedGravity(model, data, start)
    expected = gravity + controller.dynamics.inertia @ acceleration - generalised(controller, forces)
    np.testing.assert_allclose(expected[6:], command.torques, atol=0.05)


def test_a_robot_that_is_where_it_should_be_stands_by_its_weight_alone():
    """References and posture are put exactly where the robot is: nothing accelerates, forces are the weight."""
    plan, desired = tracked.still()
    controller, start = controller_of()
    dynamics = controller.dynamics
    dynamics.update(start, np.zeros(controller.nv))
    n = desired.count
    ends = [dynamics.end_effector(i) for i in range(len(controller.contacts))]
    desired = replace(
        desired,
        com_W=np.repeat(dynamics.com_W[None], n, axis=0),
        base_WB=np.repeat(dynamics.base_WB[None], n, axis=0),
        com_acceleration_W=np.zeros((n, 3)),
        end_effectors_W=np.repeat(np.array([e.position_W for e in ends])[None], n, axis=0),
        soles_W=np.repeat(np.array([e.rotation_W for e in ends])[None], n, axis=0),
    )
    controller, _ = controller_of(plan=plan, desired=desired)
    command = controller.step(0, start, np.zeros(controller.nv), contacts_at(controller))
    acceleration, forces = assert_obeys(controller, command)
    assert np.abs(acceleration).max() < 0.02
    total = np.sum([force for _, _, force in forces], axis=0)
    weight = dynamics.mass * 9.81
    np.testing.assert_allclose(total, [0.0, 0.0, weight], atol=2e-3 * weight)
    model = controller.urdf_model.model
    pulls = pin.StdVec_Force()
    data = model.createData()
    pin.framesForwardKinematics(model, data, start)
    outer = [pin.Force.Zero() for _ in range(model.njoints)]
    for end, point, force in forces:
        joint = model.frames[controller.urdf_model.frames[end]].parentJoint
        local = data.oMi[joint].rotation.T @ force
        outer[joint] += pin.Force(local, np.cross(data.oMi[joint].actInv(point), local))
    pulls.extend(outer)
    static = pin.computeStaticTorque(model, data, start, pulls)
    np.testing.assert_allclose(command.torques, static[6:], atol=0.5)
    np.testing.assert_allclose(static[:6], 0.0, atol=2.0)


@pytest.mark.parametrize("name", ["talos", "g1"])
def test_any_state_and_any_contacts_are_solved(name):
    controller, start = controller_of(name)
    model, rng = controller.urdf_model.model, np.random.default_rng(21)
    low, high = controller.lower, controller.upper
    modes = [Mode.FREE, Mode.CONTACT, Mode.SEARCH]
    for draw in range(100):
        configuration = pin.integrate(model, start, rng.normal(size=model.nv) * rng.choice([0.05, 0.3, 1.0]))
        if draw % 2:  # joints at their limits and beyond
            at = rng.uniform(size=len(low)) < 0.3
            beyond = np.where(rng.uniform(size=len(low)) < 0.5, low - 0.05, high + 0.05)
            configuration[7:] = np.where(at, beyond, np.clip(configuration[7:], low, high))
        velocity = rng.normal(size=model.nv) * rng.choice([0.0, 1.0, 5.0, 20.0])
        flags = rng.integers(3, size=len(controller.contacts))
        for contact, flag in zip(controller.contacts, flags, strict=True):
            contact.mode = modes[flag]
            contact.position_W, contact.rotation_W = np.zeros(3), np.eye(3)
        # As the plan may have it that all are in contact, none changes its mode.
        in_contact = np.array([flag == 1 for flag in flags])
        surfaces = np.where(flags == 0, -1, 0)
        controller.references = replace(
            controller.references,
            surfaces=np.repeat(surfaces[None], controller.references.count, axis=0),
            swing_fraction=np.full(controller.references.swing_fraction.shape, 0.5),
            returns=np.full(controller.references.returns.shape, bool(draw % 3)),
        )
        command = controller.step(0, configuration, velocity, in_contact)
        assert [c.mode for c in controller.contacts] == [modes[f] for f in flags]
        assert command.solved, f"draw {draw}: contacts {flags}, speed {np.abs(velocity).max():.1f}"
        assert np.isfinite(command.torques).all()
        assert_obeys(controller, command)
    assert controller.qp.failures == 0


def test_joints_beyond_their_limits_are_brought_back():
    controller, start = controller_of()
    low, high = controller.lower, controller.upper
    for joint in range(0, len(low), 3):
        for limit, sign in ((high, -1.0), (low, 1.0)):
            configuration = start.copy()
            configuration[7 + joint] = limit[joint] - sign * 0.02
            fresh, _ = controller_of()
            assert fresh.step(0, configuration, np.zeros(controller.nv), contacts_at(controller)).solved
            assert sign * parts_of(fresh)[0][6 + joint] > 1.0, controller.urdf_model.model.names[2 + joint]


def test_torques_of_the_last_solution_are_held_when_there_is_none():
    controller, start = controller_of()
    before = controller.step(0, start, np.zeros(controller.nv), contacts_at(controller))
    controller.qp.solve = lambda problem, structure: None
    after = controller.step(1, start, np.ones(controller.nv), contacts_at(controller))
    assert not after.solved
    np.testing.assert_array_equal(after.torques, before.torques)


def test_in_flight_the_com_falls_and_the_torques_leave_the_angular_momentum():
    plan, desired = tracked.still()
    desired = replace(
        desired, surfaces=np.full_like(desired.surfaces, -1), swing_fraction=np.zeros(desired.swing_fraction.shape)
    )
    simulation = Simulation(build(mp.load_robot("talos"), plan.scene, Options()))
    controller, start = controller_of(plan=plan, desired=desired, urdf_model=simulation.model.urdf_model)
    rng = np.random.default_rng(2)
    start[2] += 1.0
    simulation.reset(start, 0.3 * rng.normal(size=controller.nv))
    momenta, com, speed, gravity = [], [], [], np.array([0.0, 0.0, -plan.scene.gravity])
    for n in range(100):
        configuration, velocity = simulation.state()
        command = controller.step(n, configuration, velocity, np.zeros(len(controller.contacts), bool))
        assert command.solved
        acceleration, forces = assert_obeys(controller, command)
        assert not forces
        dynamics = controller.dynamics
        np.testing.assert_allclose(dynamics.com_jacobian @ acceleration + dynamics.com_drift, gravity, atol=1e-4)
        momenta.append(dynamics.momentum_W)
        com.append(dynamics.com_W)
        speed.append(dynamics.com_velocity_W)
        simulation.advance(command.torques, steps=2)
    assert not simulation.contact_forces_W().any()
    times = 0.002 * np.arange(100)[:, None]
    # Velocities are integrated before positions are: half a step of MuJoCo's more.
    np.testing.assert_allclose(com, com[0] + speed[0] * times + 0.5 * gravity * times * (times + 0.001), atol=2e-5)
    moved = np.linalg.norm(np.ptp(momenta, axis=0)) / np.linalg.norm(momenta[0])
    assert moved < 0.004, moved  # in proportion to MuJoCo's step
    assert np.abs(velocity[6:]).max() > 0.1  # it does move its limbs


def test_contact_that_is_not_felt_bears_nothing_and_the_foot_is_lowered():
    robot, plan = mp.load_robot("talos"), tracked.step_ahead()
    desired = references(plan, robot, 0.002, 0.2)
    foot = int(np.flatnonzero(desired.returns.any(axis=0))[0])
    landing = int(np.flatnonzero(desired.returns[:, foot])[-1]) + 1
    controller, start = controller_of(plan=plan, desired=desired)
    in_contact, rest = contacts_at(controller, landing), np.zeros(controller.nv)
    in_contact[foot] = False
    for contact, planned in zip(controller.contacts, desired.surfaces[landing - 1] >= 0, strict=True):
        contact.mode = Mode.CONTACT if planned else Mode.FREE
    controller.step(landing, start, rest, in_contact)
    assert controller.contacts[foot].mode is Mode.SEARCH
    assert {end for end, _, _ in parts_of(controller)[1]} == {1 - foot}
    first = controller.dynamics.end_effector(foot).jacobian[2] @ parts_of(controller)[0]
    # From rest it is set in motion at once: to follow the depth alone would leave it 0.14 s behind.
    assert first < -0.5 * 2.0 * np.sqrt(Gains().swing_kp) * SEARCH_SPEED
    for n in range(50):
        controller.step(landing + n, start, rest, in_contact)
    lower = controller.dynamics.end_effector(foot).jacobian[2] @ parts_of(controller)[0]
    assert lower < first - 0.5 * Gains().swing_kp * controller.contacts[foot].search_depth_m
    in_contact[foot] = True
    controller.step(landing + 50, start, rest, in_contact)
    assert controller.contacts[foot].mode is Mode.CONTACT
    np.testing.assert_array_equal(
        controller.contacts[foot].position_W, controller.dynamics.end_effector(foot).position_W
    )
    assert {end for end, _, _ in parts_of(controller)[1]} == {foot, 1 - foot}


def test_a_hand_that_brushes_something_does_not_stay_there():
    controller, start = controller_of()
    desired = controller.references
    hands = ~desired.returns.any(axis=0) & (desired.surfaces < 0).all(axis=0)
    late = int(np.flatnonzero((desired.swing_fraction[:, hands] > 0.9).all(axis=1))[0])
    controller.step(late, start, np.zeros(controller.nv), np.ones(len(hands), bool))
    assert [contact.mode for contact in controller.contacts] == [Mode.FREE if h else Mode.CONTACT for h in hands]
    assert {end for end, _, _ in parts_of(controller)[1]} == set(np.flatnonzero(~hands))


def test_a_foot_that_lands_tilted_is_laid_flat_in_its_own_direction():
    controller, start = controller_of()
    tilted = start.copy()
    turn = pin.rpy.rpyToMatrix(0.1, -0.15, 0.3)
    tilted[3:7] = pin.Quaternion(turn @ pin.Quaternion(start[3:7]).matrix()).coeffs()
    controller.dynamics.update(tilted, np.zeros(controller.nv))
    foot = int(np.flatnonzero(controller.flat)[0])
    motion = controller.dynamics.end_effector(foot)
    landed = controller._landed(0, foot, motion)
    np.testing.assert_allclose(landed[:, 2], [0, 0, 1], atol=1e-12)
    np.testing.assert_allclose(landed.T @ landed, np.eye(3), atol=1e-12)
    # No rotation is smaller than the angle between the soles' normals.
    angle = np.linalg.norm(pin.log3(landed @ motion.rotation_W.T))
    assert angle == pytest.approx(np.arccos(motion.rotation_W[2, 2]), abs=1e-9)


@pytest.mark.parametrize("yaw", [0.0, 0.6, -1.2])
def test_the_ground_that_a_sole_overhangs_is_no_ground(yaw):
    urdf_model, (plan, desired) = tracked.urdf_model("talos"), tracked.still()
    scene = simulated.level(2.0)
    foot = int(np.flatnonzero(desired.surfaces[0] >= 0)[0])
    edge = desired.end_effectors_W[0, foot, 0] + 0.02
    scene.surfaces[0].vertices_W = [[-2, -2, 0], [edge, -2, 0], [edge, 2, 0], [-2, 2, 0]]
    turn = pin.rpy.rpyToMatrix(0.0, 0.0, yaw)
    desired = replace(desired, soles_W=np.broadcast_to(turn, desired.soles_W.shape))
    start = follow(urdf_model, sample_at(plan, plan.scene, plan.robot, np.zeros(1))).configurations[0]
    controller = Controller(urdf_model, scene, desired, start, Gains())
    points = desired.end_effectors_W[0, foot] + controller.points[foot].offsets @ turn.T
    assert points[:, 0].max() == pytest.approx(edge, abs=1e-9) and points[:, 0].min() < edge - 0.05


def test_accelerations_keep_joints_within_their_speeds():
    """Joints that are fast towards their velocity limit are not accelerated beyond it; without limits they are."""
    plan, desired = tracked.still()
    urdf_model = tracked.urdf_model("talos")
    limits = urdf_model.model.velocityLimit[6:]
    nj = len(limits)
    found = {}
    for limited in (True, False):
        motors = TorqueSpeed.of(urdf_model.model.effortLimit[6:], limits, limited)
        start = follow(urdf_model, sample_at(plan, plan.scene, plan.robot, np.zeros(1))).configurations[0]
        away = start.copy()
        elbow = list(urdf_model.model.names)[2:].index("arm_left_4_joint")
        away[7 + elbow] -= 1.2  # the posture pulls it back
        controller = Controller(urdf_model, plan.scene, desired, start, Gains(), Restraints(motors))
        controller.qp = tracked.Watched()
        velocity = np.zeros(controller.nv)
        velocity[6 + elbow] = 0.97 * limits[elbow]
        controller.gains = replace(controller.gains, posture_kp=400.0, posture_weight=10.0)
        assert controller.step(0, away, velocity, contacts_at(controller)).solved
        found[limited] = velocity[6:] + SPEED_HORIZON_S * controller.qp.solution[6 : 6 + nj]
        if limited:
            slack = controller.qp.solution[-1]
            assert (np.abs(found[limited]) <= limits + SPEED_HORIZON_S * abs(slack) + LOOSE).all()
    assert found[False][elbow] > found[True][elbow] + 0.1


@pytest.mark.parametrize(
    ("weight", "part"), [("posture_weight", "arm_left_1_joint"), ("leg_posture_weight", "leg_left_6_joint")]
)
def test_each_weight_of_the_posture_pulls_its_own_joints(weight, part):
    """With a weight so large that no task counts beside it, a joint accelerates as its posture asks."""
    controller, start = controller_of()
    joint = list(controller.urdf_model.model.names)[2:].index(part)
    away = start.copy()
    away[7 + joint] += 0.01
    for weights in ({"posture_weight": 0.0, "leg_posture_weight": 0.0}, {weight: 1e5}):
        controller.gains = replace(Gains(posture_weight=0.0, leg_posture_weight=0.0), **weights)
        assert controller.step(0, away, np.zeros(controller.nv), contacts_at(controller)).solved
        desired = -controller.gains.posture_kp * 0.01
        asked = weights[weight] > 0.0
        assert (abs(controller.qp.solution[6 + joint] - desired) < 0.05 * abs(desired)) == asked


def test_torques_are_those_that_motors_have_at_the_measured_speed():
    controller, start = controller_of()
    rng = np.random.default_rng(2)
    for _ in range(10):
        velocity = np.zeros(controller.nv)
        velocity[6:] = rng.uniform(-1.3, 1.3, controller.nv - 6) * controller.motors.velocity_limits
        command = controller.step(0, start, velocity, contacts_at(controller))
        low, high = controller.motors.bounds(velocity[6:])
        assert command.solved and (low <= command.torques).all() and (command.torques <= high).all()


def test_a_program_with_links_too_near_to_each_other_is_solved():
    """Postures drawn at random, in which arms and legs are in each other: rows of distance have a slack, too."""
    model = build(mp.load_robot("talos"), simulated.level())
    plan, desired = tracked.still()
    start = follow(model.urdf_model, sample_at(plan, plan.scene, plan.robot, np.zeros(1))).configurations[0]
    restraints = Restraints(model.motors, Separation(model))
    controller = Controller(model.urdf_model, plan.scene, desired, start, Gains(), restraints)
    rng, near = np.random.default_rng(12), 0
    for _ in range(30):
        configuration = pin.integrate(model.urdf_model.model, start, 0.6 * rng.normal(size=controller.nv))
        velocity = rng.normal(size=controller.nv)
        assert controller.step(0, configuration, velocity, contacts_at(controller)).solved
        near += int(np.isfinite(restraints.separation.rows(controller.dynamics)[1]).sum())
    assert near > 30
