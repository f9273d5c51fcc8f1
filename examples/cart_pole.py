"""A cart swings its pole up within a short rail and with a weak motor: the interior-point kernel on a problem of one's own."""

import math

import numpy as np

from mcplan import ipm

CART, POLE, LENGTH, GRAVITY = 1.0, 0.3, 0.5, 9.81  # masses [kg], rod [m], [m/s^2]
RAIL, FORCE = 0.6, 12.0  # the cart keeps within +-RAIL [m], its motor gives +-FORCE [N]
STEPS, STEP = 50, 0.04  # [s]


# At each stage: position of the cart [m], angle of the pole from hanging [rad], their velocities; then force of the motor [N]
# and the two accelerations. The equations of motion tie them:
#     (CART + POLE) a + POLE LENGTH (alpha cos(angle) - omega^2 sin(angle)) = force
#     LENGTH alpha + a cos(angle) + GRAVITY sin(angle) = 0
def motion(x, u):
    (_, angle, _, omega), (force, a, alpha) = x, u
    s, c = math.sin(angle), math.cos(angle)
    return [
        (CART + POLE) * a + POLE * LENGTH * (alpha * c - omega**2 * s) - force,
        LENGTH * alpha + a * c + GRAVITY * s,
    ]


def motion_jacobian(x, u):
    (_, angle, _, omega), (_, a, alpha) = x, u
    s, c, ml = math.sin(angle), math.cos(angle), POLE * LENGTH
    return [
        [0.0, -ml * (alpha * s + omega**2 * c), 0.0, -2.0 * ml * omega * s, -1.0, CART + POLE, ml * c],
        [0.0, -a * s + GRAVITY * c, 0.0, 0.0, 0.0, c, LENGTH],
    ]


def motion_hessian(x, u, weights):  # of weights[0] times the first equation plus weights[1] times the second
    (_, angle, _, omega), (_, a, alpha) = x, u
    s, c, ml = math.sin(angle), math.cos(angle), POLE * LENGTH
    H = np.zeros((7, 7))  # the lower triangle is enough
    H[1, 1] = weights[0] * ml * (omega**2 * s - alpha * c) - weights[1] * (a * c + GRAVITY * s)
    H[3, 1] = -weights[0] * 2.0 * ml * omega * c
    H[3, 3] = -weights[0] * 2.0 * ml * s
    H[5, 1] = -weights[1] * s
    H[6, 1] = -weights[0] * ml * s
    return H


def swing_up():
    problem = ipm.Problem()
    x, u = [], []
    for k in range(STEPS + 1):
        rail = [RAIL, np.inf, np.inf, np.inf]
        guess = [0.0, math.pi * k / STEPS, 0.0, 0.0]
        x.append(problem.variables("x", 4, k, lower=np.negative(rail), upper=rail, start=guess))
        motor = [FORCE, np.inf, np.inf]
        u.append(problem.variables("u", 3, k, lower=np.negative(motor), upper=motor))
    for k, rest in ((0, [0.0, 0.0, 0.0, 0.0]), (STEPS, [0.0, math.pi, 0.0, 0.0])):
        problem.change(x[k], lower=rest, upper=rest)  # hanging, and standing

    equations = ipm.Function(motion, motion_jacobian, motion_hessian)
    for k in range(STEPS + 1):
        problem.equality("motion", [x[k], u[k]], equations)
        trapezoid = STEP / 2.0 if k in (0, STEPS) else STEP
        problem.cost("effort", [u[k]], ipm.Quadratic(np.diag([2.0 * trapezoid, 0.0, 0.0])))  # integral of force^2

    # x[k+1] = x[k] + STEP / 2 (rate[k] + rate[k+1]), where the rates are velocities and accelerations
    rate_of_x = np.eye(4, k=2) * STEP / 2.0
    rate_of_u = np.vstack([np.zeros((2, 3)), np.eye(2, 3, k=1)]) * STEP / 2.0
    step = ipm.Linear([np.eye(4) + rate_of_x, rate_of_u, rate_of_x - np.eye(4), rate_of_u])
    for k in range(STEPS):
        problem.equality("step", [x[k], u[k], x[k + 1], u[k + 1]], step)
    return problem


if __name__ == "__main__":
    problem = swing_up()
    for wrong in ipm.check_derivatives(problem):
        print(wrong)
    result = ipm.solve(problem, tolerance=1e-7, constraint_tolerance=1e-7)
    x, force = result.x["x"], result.x["u"][:, 0]
    print(
        f"{result.status}: integral of force^2 = {result.objective:.4f} N^2 s, violation below 1e-7: {result.violation < 1e-7}"
    )
    print(
        f"cart between {x[:, 0].min():.4f} and {x[:, 0].max():.4f} m, force between {force.min():.4f} and {force.max():.4f} N"
    )
    for k in range(0, STEPS + 1, 10):
        print(f"t = {k * STEP:.1f} s: cart {x[k, 0]:7.4f} m, pole {x[k, 1]:7.4f} rad, force {force[k]:8.4f} N")
    if str(result.status) != "solved":
        raise SystemExit(1)
