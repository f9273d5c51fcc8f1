"""Plans with forces at the corners of the feet, made without a planner."""

from __future__ import annotations

import numpy as np

import mcplan as mp

RIGHT, LEFT = 0, 1
NODES = 8


def corners(robot: mp.Robot, foot: int, centre_W: np.ndarray, normal_W: np.ndarray) -> np.ndarray:
    """The sole's corners (4, 3) [m], heading along x on a surface with this normal."""
    along = np.array([1.0, 0.0, 0.0]) - normal_W[0] * normal_W
    along /= np.linalg.norm(along)
    across = np.cross(normal_W, along)
    half = robot.end_effectors[foot].half_size
    return np.array([centre_W + x * half[0] * along + y * half[1] * across for x in (1, -1) for y in (1, -1)])


def stepping_plan(steps: int = 1, scene: mp.Scene | None = None, robot: mp.Robot | None = None) -> mp.Plan:
    """A walk on the surfaces of scene.steps (level ground where there are none), left foot first, that ends at rest.

    The centre of pressure waits under the stance foot, or between the feet; the divergent motion xi = c + c' / omega of
    the pendulum then follows backwards from the end. The corners share the force that points from the centre of pressure
    to the CoM. Knots are replayed from the forces.
    """
    scene = scene or mp.load_scene("flat")
    robot = robot or mp.load_robot("humanoid44")
    ends = len(robot.end_effectors)
    right, left = (robot.end_effector_index(f"{side}_foot") for side in ("right", "left"))
    com = np.array([*scene.start.position_W[:2], scene.start.position_W[2] + robot.com_height])
    surface = {right: 0, left: 0}
    foot_W = {i: _put_down(scene, 0, com + robot.end_effectors[i].nominal_B) for i in (right, left)}
    stretches = []  # duration, feet in contact, their places and surfaces
    for step in range(steps):
        swing, stance = ((left, right), (right, left))[step % 2]
        stretches.append((0.2 if step else 0.7, (swing, stance), foot_W, surface))
        stretches.append((0.6, (stance,), foot_W, surface))
        target = scene.steps[step].surface if step < len(scene.steps) else scene.surfaces[-1].name
        surface = {**surface, swing: scene.surface_index(target)}
        length = 0.14 if step in (0, steps - 1) else 0.28
        foot_W = {**foot_W, swing: _put_down(scene, surface[swing], foot_W[swing] + [length, 0, 0])}
        stretches.append((0.2, (swing, stance), foot_W, surface))
    stretches.append((0.6, (right, left), foot_W, surface))

    omega = np.sqrt(scene.gravity / robot.com_height)
    centres = [np.mean([feet[i] for i in active], axis=0)[:2] for _, active, feet, _ in stretches]
    divergent = [centres[-1]]
    for (duration, *_), centre in zip(reversed(stretches), reversed(centres), strict=True):
        divergent.insert(0, centre + (divergent[0] - centre) * np.exp(-omega * duration))
    grown = np.exp(omega * stretches[0][0])
    centres[0] = (divergent[1] - com[:2] * grown) / (1.0 - grown)  # from rest instead

    state, phases, swings = (com, np.zeros(3), np.zeros(3)), [], []
    knots = [_knot(robot, *state, stretches[0][2])]
    for k, (stretch, centre) in enumerate(zip(stretches, centres, strict=True)):
        wanted = (centre, divergent[k + 1], omega)
        phase, state = _phase(scene, robot, state, stretch, wanted)
        phases.append(phase)
        knots.append(_knot(robot, *state, stretches[min(k + 1, len(stretches) - 1)][2]))
        if len(stretch[1]) == 1:
            swings.append((left if stretch[1][0] == right else right, k))
    plan = mp.Plan(
        scene=scene,
        robot=robot,
        planner="by hand",
        knots=knots,
        phases=phases,
        final_contacts=[surface.get(i, -1) for i in range(ends)],
        swings=[
            mp.model.Swing(end_effector=i, first_phase=k, end_phase=k + 1, height=robot.swing_height) for i, k in swings
        ],
        open_end=True,
    )
    plan.validate()
    return plan


def _put_down(scene: mp.Scene, surface: int, point_W: np.ndarray) -> np.ndarray:
    vertices, normal = _plane(scene, surface)
    return point_W - [0.0, 0.0, float(normal @ (point_W - vertices[0]) / normal[2])]


def _plane(scene: mp.Scene, surface: int) -> tuple[np.ndarray, np.ndarray]:
    vertices = np.asarray(scene.surfaces[surface].vertices_W)
    normal = np.cross(vertices[1] - vertices[0], vertices[2] - vertices[0])
    return vertices, normal / np.linalg.norm(normal)


def _knot(robot, com, velocity, momentum, foot_W) -> mp.model.Knot:
    ends = [foot_W.get(i, com + end.nominal_B) for i, end in enumerate(robot.end_effectors)]
    velocities = [np.zeros(3) if i in foot_W else velocity for i in range(len(ends))]
    return mp.model.Knot(
        com_W=com,
        com_velocity_W=velocity,
        angular_momentum_W=momentum,
        end_effectors_W=ends,
        end_effector_velocities_W=velocities,
    )


def _phase(scene, robot, state, stretch, wanted):
    """One phase from a state, and the state at its end."""
    duration, active, foot_W, surface = stretch
    centre, divergent, omega = wanted
    points = {i: corners(robot, i, foot_W[i], _plane(scene, surface[i])[1]) for i in active}
    all_W = np.concatenate([points[i] for i in active])
    position, velocity, momentum = state
    gravity = np.array([0.0, 0.0, -scene.gravity])
    ground = np.mean([foot_W[i][2] for i in foot_W])
    h = duration / (NODES - 1)
    nodes = []
    for node in range(NODES):
        # Where xi should be by now, and a centre of pressure that steers back to it.
        xi = position[:2] + velocity[:2] / omega
        reference = centre + (divergent - centre) * np.exp(-omega * (duration - node * h))
        pressure = np.array([*(centre + np.clip(1.5 * (xi - reference), -0.03, 0.03)), ground])
        lift = robot.mass * (scene.gravity + 16.0 * (ground + robot.com_height - position[2]) - 8.0 * velocity[2])
        force = lift * (position - pressure) / (position[2] - ground)
        system = np.vstack([np.tile(np.eye(3), len(all_W)), np.hstack([_cross(p - position) for p in all_W])])
        nodes.append(np.linalg.lstsq(system, np.concatenate([force, -momentum]), rcond=None)[0].reshape(-1, 3))
        if len(nodes) > 1:
            position, velocity, momentum = _advance(
                robot, gravity, all_W, position, velocity, momentum, nodes[-2], nodes[-1], h
            )
    forces = np.array(nodes)
    contacts = []
    for i in range(len(robot.end_effectors)):
        if i not in active:
            contacts.append(mp.model.Contact())
            continue
        first = 4 * active.index(i)
        contacts.append(
            mp.model.Contact(
                surface=surface[i], points_W=points[i], point_forces_W=forces[:, first : first + 4].reshape(-1, 3)
            )
        )
    phase = mp.model.Phase(duration=duration, contacts=contacts, law=mp.model.ForceLaw.linear, intervals=NODES - 1)
    return phase, (position, velocity, momentum)


def _cross(p: np.ndarray) -> np.ndarray:
    return np.array([[0.0, -p[2], p[1]], [p[2], 0.0, -p[0]], [-p[1], p[0], 0.0]])


def _advance(robot, gravity, points, position, velocity, momentum, begin, end, h, cuts=20):
    """Simpson's rule over short pieces: exact for the CoM, and for L as far as it matters."""
    for n in range(cuts):
        d, s = h / cuts, np.array([n, n + 0.5, n + 1.0]) / cuts
        a = [((1 - x) * begin + x * end).sum(axis=0) / robot.mass + gravity for x in s]
        middle = position + 0.5 * d * velocity + d * d / 24.0 * (2.0 * a[0] + a[1])
        after = position + d * velocity + d * d / 6.0 * (2.0 * a[0] + a[2])
        rates = [
            np.cross(points - c, (1 - x) * begin + x * end).sum(axis=0)
            for x, c in zip(s, (position, middle, after), strict=True)
        ]
        momentum = momentum + d / 6.0 * (rates[0] + 4.0 * rates[1] + rates[2])
        position, velocity = after, velocity + 0.5 * d * (a[0] + a[2])
    return position, velocity, momentum
