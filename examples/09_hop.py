"""Let a quadruped hop: a plan by hand, its whole-body motion with a certificate, and the simulated robot that lands.

In Python alone: motions need ``pip install 'mcplan[view,sim]'``.
"""

import numpy as np

import mcplan as mp
from mcplan.model import Contact, ForceLaw, Knot, Phase, Stance, Surface, Swing

GRAVITY = 9.81  # [m/s^2]
STEP_S = 0.02  # of forces, which are linear in between


def push_off(steps: int, rise_m: float, speed: float) -> np.ndarray:
    """(steps + 1,) vertical force over the weight, from 1 to 0, after which the CoM is so much higher, at a speed [m/s].

    Of all such forces the one of least sum of squares of second differences and, with half their weight, of what it has
    beyond the weight.
    """
    unit = np.eye(steps + 1)
    height, velocity = np.zeros(steps + 1), np.zeros(steps + 1)  # of the CoM, as sums of accelerations at the nodes
    for i in range(steps):
        height = height + STEP_S * velocity + STEP_S**2 * (unit[i] / 3.0 + unit[i + 1] / 6.0)
        velocity = velocity + STEP_S * (unit[i] + unit[i + 1]) / 2.0
    rows = np.array([GRAVITY * velocity, GRAVITY * height, unit[0], unit[1], unit[-1]])
    sides = np.array([speed, rise_m, 0.0, 0.0, -1.0])
    second = np.diff(unit, 2, axis=0)
    kkt = np.block([[second.T @ second + 0.5 * unit, rows.T], [rows, np.zeros((5, 5))]])
    return 1.0 + np.linalg.solve(kkt, np.concatenate([np.zeros(steps + 1), sides]))[: steps + 1]


def hop(robot: mp.Robot, flight_s: float, push_s: float, rise_m: float, lift_m: float) -> mp.Plan:
    """Stand, push off, fly, land as in a film that runs backwards, stand; `rise_m` is the CoM's at take-off."""
    ends, weight = robot.end_effectors, robot.mass * GRAVITY
    corners = [[-2.0, -2.0, 0.0], [2.0, -2.0, 0.0], [2.0, 2.0, 0.0], [-2.0, 2.0, 0.0]]
    place = Stance(position_W=[0.0, 0.0, 0.0], contacts={"foot": "ground"})
    ground = Surface(name="ground", vertices_W=np.array(corners), friction=0.7)
    scene = mp.Scene(name="hop", surfaces=[ground], gravity=GRAVITY, start=place, goal=place)
    feet = np.array([[*end.nominal_B[:2], 0.0] for end in ends])
    below = np.vstack([np.ones(len(ends)), feet[:, :2].T])  # forces act below the CoM: no moment
    shares = np.linalg.lstsq(below, np.array([1.0, 0.0, 0.0]), rcond=None)[0]

    def phase(duration: float, force: np.ndarray) -> Phase:
        contacts = []
        for foot, share in zip(feet, shares, strict=True):
            forces = np.outer(share * weight * force, [0.0, 0.0, 1.0])
            contacts.append(Contact(surface=0, points_W=foot[None], point_forces_W=forces))
        return Phase(duration=duration, contacts=contacts, law=ForceLaw.linear, intervals=len(force) - 1)

    speed, steps = GRAVITY * flight_s / 2.0, round(push_s / STEP_S)
    push, stand = push_off(steps, rise_m, speed), np.ones(2)
    flight = Phase(duration=flight_s, contacts=[Contact()] * len(ends), law=ForceLaw.linear, intervals=1)
    landing = phase(steps * STEP_S, push[::-1])
    phases = [phase(0.3, stand), phase(steps * STEP_S, push), flight, landing, phase(0.3, stand)]
    still = np.zeros_like(feet)
    knots = []
    for rise, velocity in zip((0, 0, rise_m, rise_m, 0, 0), (0, 0, speed, -speed, 0, 0), strict=True):
        com_W, com_velocity_W = [0.0, 0.0, robot.com_height + rise], [0.0, 0.0, velocity]
        knot = Knot(com_W=com_W, com_velocity_W=com_velocity_W, end_effectors_W=feet, end_effector_velocities_W=still)
        knots.append(knot)
    swings = [Swing(end_effector=i, first_phase=2, end_phase=3, height=lift_m) for i in range(len(ends))]
    plan = mp.Plan(scene=scene, robot=robot, planner="by hand", phases=phases, knots=knots, swings=swings)
    plan.final_contacts = [0] * len(ends)
    plan.validate()
    return plan


def main() -> None:
    """Plan, find the motion, look at its certificate, simulate it."""
    plan = hop(mp.load_robot("go2"), flight_s=0.15, push_s=0.3, rise_m=-0.02, lift_m=0.02)
    result = mp.motion(plan)
    print(result.report)  # the certificate is part of it: torques, speeds, friction, the exact flight
    if result.status != "solved":
        raise SystemExit(1)
    height = 1e3 * GRAVITY * 0.15**2 / 8.0
    print(f"in the air for 0.15 s, {height:.0f} mm high, torques up to {result.certificate.measures['torque_use']:.2f}")
    result.motion.save("hop.npz")  # for mcplan show, check, track, export
    for seed in (0, 1):  # 1: another mass, friction, ground, push, delay
        run = mp.track(result.motion, seed=seed, hold_s=0.5)
        print(
            f"seed {seed}: {'landed' if run.completed else 'fell'}, CoM {1e3 * run.measures.com_rms_m:.1f} mm rms off"
        )
        if not run.completed:
            raise SystemExit(1)


if __name__ == "__main__":
    main()
