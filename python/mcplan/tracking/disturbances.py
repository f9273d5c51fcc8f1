"""Disturbances drawn from a seed: what a plan, and the controller with it, does not know of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .options import Options, Push

#: Half widths: of the mass and the friction as ratios, of the ground's height [m]; and the largest push [N] and its
#: duration [s].
MASS, FRICTION, GROUND_M = 0.10, 0.20, 0.01
PUSH_N, PUSH_S = 40.0, 0.2
#: Of the motors and sensors: largest delay [s], bandwidths [Hz], largest noise.
DELAY_S, BANDWIDTH_HZ, NOISE = 0.002, (50.0, 200.0), 1.0
#: The mass for which PUSH_N is meant [kg]; lighter robots are pushed less.
PUSHED_MASS = 90.0


def disturbed(options: Options, seed: int, duration_s: float, mass: float = PUSHED_MASS) -> Options:
    """Options with mass, friction, height of the ground, a push, and lags and noise drawn from a seed, on top of what they
    hold.

    Args:
        options: To start from.
        seed: Seed of the draw.
        duration_s: Duration of the plan; the push comes at some time in it.
        mass: Mass of the robot [kg]; the push is in proportion to it, and 40 N at most for 90 kg and more.
    """
    random = np.random.default_rng(seed)
    mass_change, friction_change, ground = random.uniform(-1.0, 1.0, 3)
    force = PUSH_N * min(1.0, mass / PUSHED_MASS) * random.uniform()
    at, direction = random.uniform(0.0, duration_s), random.uniform(0.0, 360.0)
    delay_s, noise = random.uniform(0.0, DELAY_S), random.uniform(0.0, NOISE)
    bandwidth_hz = random.uniform(*BANDWIDTH_HZ)
    return replace(
        options,
        seed=seed,
        mass_scale=options.mass_scale * (1.0 + MASS * mass_change),
        friction_scale=options.friction_scale * (1.0 + FRICTION * friction_change),
        ground_shift_m=options.ground_shift_m + GROUND_M * ground,
        torque_delay_s=options.torque_delay_s + delay_s,
        torque_bandwidth_hz=min(options.torque_bandwidth_hz or np.inf, bandwidth_hz),
        noise_seed=seed,
        sensor_noise=options.sensor_noise + noise,
        pushes=(*options.pushes, Push(force, PUSH_S, at, direction)),
    )
