"""Plans made without a planner: contacts by hand, the CoM by least squares over the closed form."""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

import mcplan as mp

RIGHT, LEFT = 0, 1


def humanoid() -> mp.Robot:
    """A robot of the size of the paper's: two feet, two hands, 44 kg, CoM at 0.7 m."""
    ends = []
    for name, side in (("right", -1.0), ("left", 1.0)):
        ends.append(
            mp.model.EndEffector(
                name=f"{name}_foot",
                kind="foot",
                half_size=[0.10, 0.05],
                nominal_B=[0.0, 0.10 * side, -0.7],
                reach_min_B=[-0.4, min(0.02 * side, 0.3 * side), -0.78],
                reach_max_B=[0.4, max(0.02 * side, 0.3 * side), -0.5],
                max_force=2000.0,
            )
        )
    for name, side in (("right", -1.0), ("left", 1.0)):
        ends.append(
            mp.model.EndEffector(
                name=f"{name}_hand",
                kind="hand",
                nominal_B=[0.0, 0.225 * side, 0.0],
                reach_min_B=[-0.3, min(0.1 * side, 0.45 * side), -0.2],
                reach_max_B=[0.3, max(0.1 * side, 0.45 * side), 0.9],
                max_force=1000.0,
            )
        )
    return mp.Robot(
        name="humanoid44",
        mass=44.0,
        inertia=[5.0, 5.0, 5.0],
        com_height=0.7,
        swing_height=0.08,
        end_effectors=ends,
    )


def rectangle(name: str, x: tuple[float, float], y: tuple[float, float], z: float, **fields) -> mp.model.Surface:
    corners = [(x[0], y[0], z), (x[1], y[0], z), (x[1], y[1], z), (x[0], y[1], z)]
    return mp.model.Surface(name=name, vertices_W=np.array(corners), friction=0.8, **fields)


def stairs() -> mp.Scene:
    treads = [(-1.0, 0.15, 0.0), (0.40, 0.65, 0.1), (0.90, 1.15, 0.2), (1.40, 2.0, 0.3)]
    surfaces = [rectangle(f"tread_{i}", (a, b), (-0.5, 0.5), z) for i, (a, b, z) in enumerate(treads)]
    return _scene("stairs", surfaces, [1.6, 0.0, 0.3], "tread_0", "tread_3")


def flat() -> mp.Scene:
    return _scene("flat", [rectangle("ground", (-1.0, 5.0), (-5.0, 5.0), 0.0)], [1.6, 0.0, 0.0], "ground", "ground")


def gap() -> mp.Scene:
    banks = [rectangle("near", (-1.0, 0.5), (-1.5, 1.5), 0.0), rectangle("far", (1.1, 5.0), (-1.5, 1.5), 0.0)]
    pads = [
        rectangle(
            f"{side}_pad",
            (0.7, 0.9),
            (0.3 * s - 0.06, 0.3 * s + 0.06),
            0.5,
            grasp=True,
            end_effectors=[f"{side}_hand"],
        )
        for side, s in (("right", -1.0), ("left", 1.0))
    ]
    return _scene("gap", banks + pads, [1.5, 0.0, 0.0], "near", "far")


def walk(scene: mp.Scene, robot: mp.Robot) -> mp.Plan:
    """Alternate the feet along the scene's treads, double support between."""
    goal = np.asarray(scene.goal.position_W)
    places = []  # centre of each pair of footholds
    if len(scene.surfaces) == 1:
        places = [(np.array([x, 0.0, 0.0]), 0) for x in np.linspace(0.0, goal[0], 6)]
    else:
        for i, surface in enumerate(scene.surfaces):
            centre = np.mean(surface.vertices_W, axis=0)
            places.append(
                (
                    np.array(
                        [
                            0.0 if i == 0 else goal[0] if i == len(scene.surfaces) - 1 else centre[0],
                            0.0,
                            centre[2],
                        ]
                    ),
                    i,
                )
            )
    feet, on = [_foothold(robot, places[0][0], RIGHT), _foothold(robot, places[0][0], LEFT)], [0, 0]
    steps = []  # per phase: contacts of the feet, their places, duration
    steps.append((list(on), [f.copy() for f in feet], 0.45))
    for place, surface in places[1:]:
        for foot in (RIGHT, LEFT):
            lifted = list(on)
            lifted[foot] = -1
            steps.append((lifted, [f.copy() for f in feet], 0.45))
            feet[foot], on[foot] = _foothold(robot, place, foot), surface
            steps.append((list(on), [f.copy() for f in feet], 0.25))
    steps[-1] = (steps[-1][0], steps[-1][1], 0.6)
    return _solve(scene, robot, steps, yaw=0.0)


def jump(scene: mp.Scene, robot: mp.Robot) -> mp.Plan:
    """Stand, push, fly over the gap, land, stand; the hands pass over the pads and touch them in the air."""
    start, end = np.array([0.25, 0.0, 0.0]), np.array([1.35, 0.0, 0.0])
    before = [_foothold(robot, start, f) for f in (RIGHT, LEFT)]
    after = [_foothold(robot, end, f) for f in (RIGHT, LEFT)]
    steps = [([0, 0], before, 0.3), ([0, 0], before, 0.3), ([0, 0], before, 0.3), ([-1, -1], before, 0.38)]
    steps += [([1, 1], after, 0.3), ([1, 1], after, 0.3), ([1, 1], after, 0.4)]
    return _solve(scene, robot, steps, yaw=0.0, start=start, goal=end)


def _scene(name: str, surfaces: list[mp.model.Surface], goal: list[float], first: str, last: str) -> mp.Scene:
    return mp.Scene(
        name=name,
        description="made by hand for a test",
        surfaces=surfaces,
        start=mp.model.Stance(position_W=[0.0, 0.0, 0.0], contacts={"foot": first}),
        goal=mp.model.Stance(position_W=goal, contacts={"foot": last}),
    )


def _foothold(robot: mp.Robot, place: np.ndarray, foot: int) -> np.ndarray:
    return place + np.array([0.0, robot.end_effectors[foot].nominal_B[1], 0.0])


def balanced(scene, robot, steps, start=None, goal=None) -> mp.Plan:
    """A plan that goes from rest to rest over steps: contacts of the feet, their places, duration [s] of each phase."""
    return _solve(scene, robot, steps, yaw=0.0, start=start, goal=goal)


def _solve(scene, robot, steps, yaw, start=None, goal=None) -> mp.Plan:
    """Stiffnesses and centres of pressure that take the pendulum from rest to rest, smoothly."""
    n, g, h = len(steps), float(scene.gravity), float(robot.com_height)
    durations = np.array([s[2] for s in steps])
    standing = np.array([[c >= 0 for c in s[0]] for s in steps])
    supports = np.array(
        [
            np.mean([p for p, on in zip(s[1], row, strict=True) if on], axis=0) if row.any() else np.full(3, np.nan)
            for s, row in zip(steps, standing, strict=True)
        ]
    )
    for k in range(n):
        if np.isnan(supports[k, 0]):
            supports[k] = 0.5 * (supports[k - 1] + supports[k + 1])
    up = np.array([0.0, 0.0, h])
    first = np.asarray(start if start is not None else scene.start.position_W) + up
    last = np.asarray(goal if goal is not None else scene.goal.position_W) + up

    def simulate(x):
        mu = np.where(standing.any(axis=1), np.maximum(x[:n], 0.1) * g / h, 0.0)
        cop = supports + np.column_stack([x[n : 2 * n], x[2 * n :], np.zeros(n)])
        p, v = [first], [np.zeros(3)]
        for k in range(n):
            z = mu[k] * durations[k] ** 2
            root = np.sqrt(z) if z > 0 else 0.0
            f0, f1, f2 = (np.cosh(root), np.sinh(root) / root, (np.cosh(root) - 1) / z) if z > 0 else (1.0, 1.0, 0.5)
            a = mu[k] * (p[k] - cop[k]) - np.array([0.0, 0.0, g])
            p.append(p[k] + durations[k] * f1 * v[k] + durations[k] ** 2 * f2 * a)
            v.append(f0 * v[k] + durations[k] * f1 * a)
        return mu, cop, np.array(p), np.array(v)

    reference = np.vstack([supports[:1], 0.5 * (supports[1:] + supports[:-1]), supports[-1:]]) + up

    def residuals(x):
        _, _, p, v = simulate(x)
        regular = np.concatenate([0.3 * (x[:n] - 1.0), 3.0 * x[n : 2 * n], 6.0 * x[2 * n :]])
        return np.concatenate([1e3 * (p[-1] - last), 1e3 * v[-1], ((p - reference) * [0.3, 0.3, 2.0]).ravel(), regular])

    best = least_squares(residuals, np.concatenate([np.ones(n), np.zeros(2 * n)]), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    mu, cop, p, v = simulate(best.x)
    return _assemble(scene, robot, steps, standing, durations, mu, cop, p, v, yaw)


def _assemble(scene, robot, steps, standing, durations, mu, cop, p, v, yaw) -> mp.Plan:
    n = len(steps)
    hands = len(robot.end_effectors) - 2
    phases, knots = [], []
    for k in range(n):
        contacts = []
        for foot in (RIGHT, LEFT):
            if not standing[k, foot]:
                contacts.append(mp.model.Contact())
                continue
            if standing[k].all():  # share the stiffness so that the two anchors average to the centre of pressure
                right, left = steps[k][1]
                span = left - right
                share = np.clip(np.dot(cop[k] - right, span) / np.dot(span, span), 0.02, 0.98)
                share = share if foot == LEFT else 1.0 - share
                shift = cop[k] - (right + np.clip(np.dot(cop[k] - right, span) / np.dot(span, span), 0.02, 0.98) * span)
                contacts.append(
                    mp.model.Contact(
                        surface=steps[k][0][foot], stiffness=share * mu[k], anchor_W=steps[k][1][foot] + shift
                    )
                )
            else:
                contacts.append(mp.model.Contact(surface=steps[k][0][foot], stiffness=mu[k], anchor_W=cop[k]))
        contacts += [mp.model.Contact()] * hands
        phases.append(mp.model.Phase(duration=float(durations[k]), contacts=contacts))
    for k in range(n + 1):
        # A knot belongs to the phase that it begins; a foot in the air is half way to its next place.
        i = min(k, n - 1)
        feet = []
        for foot in (RIGHT, LEFT):
            lifting = not standing[i, foot] and k < n and (k == 0 or standing[k - 1, foot])
            feet.append(
                np.array(steps[i][1][foot] if standing[i, foot] or lifting else steps[min(k + 1, n - 1)][1][foot])
            )
        swing = 0.10 * np.sin(2.0 * np.pi * k / max(n, 1))
        arms = [p[k] + robot.end_effectors[2 + i].nominal_B + [swing * (2 * i - 1), 0.0, 0.0] for i in range(hands)]
        arm_velocity = [v[k]] * hands
        knots.append(
            mp.model.Knot(
                com_W=p[k],
                com_velocity_W=v[k],
                base_rpy=[0.0, 0.0, yaw],
                end_effectors_W=np.array(feet + arms),
                end_effector_velocities_W=np.array([np.zeros(3)] * 2 + arm_velocity),
            )
        )
    swings = []
    for foot in (RIGHT, LEFT):
        swings += [
            mp.model.Swing(end_effector=foot, first_phase=k, end_phase=k + 1, height=float(robot.swing_height))
            for k in range(n)
            if not standing[k, foot]
        ]
    plan = mp.Plan(
        scene=scene,
        robot=robot,
        planner="by hand",
        knots=knots,
        phases=phases,
        swings=swings,
        final_contacts=[*steps[-1][0], *[-1] * hands],
    )
    plan.validate()
    return plan


def talos() -> mp.Robot:
    """Talos from example-robot-data, with numbers read off its model in the half-sitting posture."""
    import example_robot_data
    import pinocchio as pin

    wrapper = example_robot_data.load("talos")
    model, data = wrapper.model, wrapper.data
    pin.framesForwardKinematics(model, data, wrapper.q0)
    com = pin.centerOfMass(model, data, wrapper.q0)
    ends = []
    for kind, frame, half, low, high in (
        ("foot", "{}_sole_link", [0.10, 0.06], [-0.4, -0.12, -0.06], [0.4, 0.12, 0.3]),
        ("hand", "gripper_{}_fingertip_1_link", [0.0, 0.0], [-0.3] * 3, [0.3] * 3),
    ):
        for side in ("right", "left"):
            name = frame.format(side)
            nominal = data.oMf[model.getFrameId(name)].translation - com
            ends.append(
                mp.model.EndEffector(
                    name=f"{side}_{kind}",
                    kind=kind,
                    frame=name,
                    half_size=half,
                    nominal_B=nominal,
                    reach_min_B=nominal + low,
                    reach_max_B=nominal + high,
                    max_force=3000.0,
                )
            )
    mass = float(sum(inertia.mass for inertia in model.inertias))
    return mp.Robot(
        name="talos",
        mass=mass,
        inertia=[10.0, 10.0, 5.0],
        com_height=-float(ends[0].nominal_B[2]),
        swing_height=0.08,
        end_effectors=ends,
        urdf="example-robot-data:talos",
    )
