"""Time an iteration of Crocoddyl's FDDP on a linear-quadratic problem; run by compare.py in Crocoddyl's own environment.

    python one_iteration.py NX NU N REPEATS

prints one JSON object. The models are Crocoddyl's C++ class ActionModelLQR, so no Python is called inside an iteration.
"""

import json
import sys
import time

import crocoddyl
import numpy as np


def stable_problem(nx: int, nu: int, n: int, seed: int = 0) -> crocoddyl.ShootingProblem:
    """N different well-conditioned steps and a terminal cost, with affine terms so that there is something to solve."""
    random = np.random.default_rng(seed)

    def model() -> crocoddyl.ActionModelLQR:
        a = np.eye(nx) + 0.1 * random.standard_normal((nx, nx)) / np.sqrt(nx)
        b = random.standard_normal((nx, nu)) / np.sqrt(nu)
        root = random.standard_normal((nx + nu, nx + nu)) / np.sqrt(nx + nu)
        h = root @ root.T + np.eye(nx + nu)
        f, q, r = 0.1 * random.standard_normal(nx), random.standard_normal(nx), random.standard_normal(nu)
        return crocoddyl.ActionModelLQR(a, b, h[:nx, :nx], h[nx:, nx:], h[:nx, nx:], f, q, r)

    return crocoddyl.ShootingProblem(np.ones(nx), [model() for _ in range(n)], model())


def main() -> None:
    nx, nu, n, repeats = (int(word) for word in sys.argv[1:5])
    problem = stable_problem(nx, nu, n)
    problem.nthreads = 1
    solver = crocoddyl.SolverFDDP(problem)
    guess = [np.ones(nx)] * (n + 1), [np.zeros(nu)] * n
    solver.setCandidate(*guess, False)
    direction, step = [], []
    for _ in range(repeats):
        begin = time.perf_counter()
        solver.computeDirection(True)  # calcDiff and backward pass
        middle = time.perf_counter()
        solver.tryStep(1.0)  # forward pass
        direction.append(middle - begin)
        step.append(time.perf_counter() - middle)
    total = np.array(direction) + np.array(step)
    solver.setCandidate(*guess, False)
    if not solver.solve([], [], 5, False):  # a linear-quadratic problem takes one or two iterations
        sys.exit("Crocoddyl did not solve a linear-quadratic problem")
    result = {"direction_ms": direction, "step_ms": step, "iteration_ms": total}
    medians = {name: 1e3 * float(np.median(values)) for name, values in result.items()}
    print(json.dumps({"version": crocoddyl.__version__, **medians}))


if __name__ == "__main__":
    main()
