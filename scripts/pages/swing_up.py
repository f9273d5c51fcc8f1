"""The picture of the cart-pole example: postures of its swing-up, and its force over time."""

from __future__ import annotations

import runpy

import numpy as np

from pages.page import ROOT

EVERY = 2  # steps between postures
INCHES, DPI = (10.0, 3.6), 110


def save(example: str, picture: str) -> None:
    """Solve the example and draw what it finds.

    Args:
        example: Path of examples/cart_pole.py below the root of the repository.
        picture: Path of the PNG file.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    from mcplan import ipm

    made = runpy.run_path(str(ROOT / example))
    result = ipm.solve(made["swing_up"]())
    x, force = result.x["x"], result.x["u"][:, 0]
    figure, (motion, inputs) = pyplot.subplots(1, 2, figsize=INCHES, width_ratios=(3, 2), layout="constrained")
    colours = pyplot.get_cmap("viridis")(np.linspace(0.0, 0.9, len(x)))
    for k in range(0, len(x), EVERY):
        cart, angle = x[k, :2]
        tip = cart + made["LENGTH"] * np.sin(angle), -made["LENGTH"] * np.cos(angle)
        motion.plot([cart, tip[0]], [0.0, tip[1]], color=colours[k], linewidth=1.2)
        motion.plot(*tip, "o", color=colours[k], markersize=5)
        motion.plot(cart, 0.0, "s", color=colours[k], markersize=7)
    motion.plot([-made["RAIL"], made["RAIL"]], [0.0, 0.0], color="black", linewidth=0.8, zorder=0)
    for end in (-made["RAIL"], made["RAIL"]):
        motion.axvline(end, color="firebrick", linestyle=":", linewidth=1.0)
    motion.set(xlabel="position [m]", ylabel="height [m]", aspect="equal")
    motion.set_title(f"a posture each {EVERY * made['STEP']:g} s, dark to bright")
    times = made["STEP"] * np.arange(len(x))
    inputs.plot(times, force, color="tab:blue")
    for limit in (-made["FORCE"], made["FORCE"]):
        inputs.axhline(limit, color="firebrick", linestyle=":", linewidth=1.0)
    inputs.set(xlabel="time [s]", ylabel="force [N]", title="force of the motor, limits dotted")
    figure.savefig(picture, dpi=DPI)
