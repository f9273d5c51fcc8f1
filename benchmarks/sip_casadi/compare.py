"""Rows, Jacobian and Hessian of the whole-body planner beside CasADi: the walking motion, case 3, on one thread.

    python benchmarks/sip_casadi/compare.py build/bench/benchmarks/sip_evaluation [--repeats 20]

The first argument is the compiled sip_evaluation.cpp, which is run before and after CasADi. Needs CasADi (pip install
mcplan[bench]). What may be compared and what not: benchmarks/README.md.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import time
from pathlib import Path
from typing import Any

for _library in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_library, "1")

import casadi as ca  # noqa: E402
import numpy as np  # noqa: E402
from interval import Interval, chained, interval, lobatto  # noqa: E402

import mcplan  # noqa: E402

INSTANTS = 9  # as many as a polynomial of order 8 has Bernstein coefficients


class Kind:
    """Intervals with the same contacts and the same swinging feet: one function, evaluated for all of them at once."""

    def __init__(self, plan: Any, contacts: tuple[int, ...], swinging: tuple[int, ...], friction: float) -> None:
        begin = time.thread_time()
        robot = plan.task.robot
        self.made: Interval = interval(robot, list(contacts), list(swinging), friction, INSTANTS)
        it = self.made
        inputs = [it.variables, it.places]
        self.rows = ca.Function("rows", inputs, [it.rows])
        self.physics = ca.Function("physics", inputs, [it.torques, it.forces])
        self.jacobian = ca.Function("jacobian", inputs, [it.rows, ca.jacobian(it.rows, it.variables)])
        self.build_s = time.thread_time() - begin
        self.hessian: Any = None
        self.chained = chained(robot, list(contacts), list(swinging), friction)
        self.columns: list[np.ndarray] = []
        self.places: list[np.ndarray] = []

    def add_hessian(self) -> None:
        begin = time.thread_time()
        it = self.made
        multipliers = ca.SX.sym("multiplier", it.rows.numel())
        lagrangian = it.cost + ca.dot(multipliers, it.rows)
        hessian = ca.triu(ca.hessian(lagrangian, it.variables)[0])
        self.hessian = ca.Function("hessian", [it.variables, it.places, multipliers], [hessian])
        self.build_s += time.thread_time() - begin

    def arguments(self) -> list[np.ndarray]:
        return [np.column_stack(self.columns), np.column_stack(self.places)]


def spacings(plan: Any) -> np.ndarray:
    """Lengths of the five intervals about each; outside, those at the ends repeat."""
    h = np.array(plan.interval_lengths())
    padded = np.concatenate([[h[0]] * 2, h, [h[-1]] * 2])
    return np.stack([padded[k : k + 5] for k in range(len(h))])


def kinds_of(plan: Any) -> dict[Any, Kind]:
    """The functions, with the variables of every interval of the plan."""
    task = plan.task
    kinds: dict[Any, Kind] = {}
    around = spacings(plan)
    control = np.array(plan.control_points)
    k = 0
    for phase, weights in zip(task.phases, plan.weights, strict=True):
        contacts = tuple(contact.end_effector for contact in phase.contacts)
        swinging = tuple(clearance.end_effector for clearance in phase.clearances)
        friction = task.surfaces[phase.contacts[0].surface].friction
        for _ in range(phase.intervals):
            key = (contacts, swinging, friction)
            if key not in kinds:
                kinds[key] = Kind(plan, *key)
            kinds[key].columns.append(np.concatenate([control[:, k : k + 4].ravel(), around[k], np.log(weights)]))
            kinds[key].places.append(np.array([[*c.position_W, c.angle] for c in phase.contacts]).T)
            k += 1
    for kind in kinds.values():
        kind.places = [place.reshape(3, -1) for place in kind.places]
    return kinds


def largest_error(plan: Any, kinds: dict[Any, Kind]) -> tuple[float, float]:
    """Of torques [N m] and forces [N] at all instants, against mcplan's exact kinematics and dynamics."""
    torque = force = 0.0
    taken = dict.fromkeys(kinds, 0)
    lengths = plan.interval_lengths()
    k = 0
    for p, phase in enumerate(plan.task.phases):
        contacts = tuple(contact.end_effector for contact in phase.contacts)
        swinging = tuple(clearance.end_effector for clearance in phase.clearances)
        key = (contacts, swinging, plan.task.surfaces[phase.contacts[0].surface].friction)
        for i in range(phase.intervals):
            n = taken[key]
            taken[key] += 1
            tau, f = (np.array(found) for found in kinds[key].physics(kinds[key].columns[n], kinds[key].places[n]))
            for j, s in enumerate(0.5 * (lobatto(INSTANTS)[0] + 1.0)):
                state = plan.at_phase(p, (i + s) * lengths[k])
                torque = max(torque, np.abs(tau[:, j] - state.torque).max())
                mine = np.array([[v.tangential, v.normal] for v in state.forces]).ravel()
                force = max(force, np.abs(f[:, j] - mine).max())
            k += 1
    return torque, force


def median_ms(calls: list[tuple[Any, list[Any]]], repeats: int) -> float:
    """Processor time of all calls, in turn."""
    times = []
    for _ in range(repeats):
        begin = time.thread_time()
        for function, arguments in calls:
            function(*arguments)
        times.append(1e3 * (time.thread_time() - begin))
    return float(np.median(times))


def compiled(function: Any, folder: Path, name: str) -> Any:
    """The function as C, by the system's compiler."""
    folder.mkdir(parents=True, exist_ok=True)
    source, library = folder / f"{name}.c", folder / f"{name}.so"
    generator = ca.CodeGenerator(source.name)
    generator.add(function)
    generator.generate(f"{folder}/")
    subprocess.run(["gcc", "-O3", "-march=native", "-shared", "-fPIC", source, "-o", library], check=True)
    return ca.external(function.name(), str(library))


def measure(kinds: dict[Any, Kind], what: str, repeats: int) -> float:
    """One kind of function over all intervals [ms]."""
    todo = []
    for kind in kinds.values():
        function = getattr(kind, what)
        arguments = [ca.DM(argument) for argument in kind.arguments()]
        if what == "hessian":
            arguments.append(ca.DM.ones(function.size1_in(2), len(kind.columns)))
        todo.append((function.map(len(kind.columns)), arguments))
    return median_ms(todo, repeats)


def measure_chained(kinds: dict[Any, Kind], repeats: int, folder: Path) -> float:
    """Rows and Jacobian instant by instant, as C [ms]."""
    todo = []
    for number, kind in enumerate(kinds.values()):
        function = compiled(kind.chained, folder, f"chained_{number}")
        variables, places = kind.arguments()
        per = places.shape[1] // variables.shape[1]
        repeated = np.repeat(places.reshape(3, -1, per), INSTANTS, axis=1).reshape(3, -1)
        s = np.tile(lobatto(INSTANTS)[0], variables.shape[1])[None, :]
        arguments = [ca.DM(np.repeat(variables, INSTANTS, axis=1)), ca.DM(repeated), ca.DM(s)]
        todo.append((function.map(s.size), arguments))
        largest = kind.jacobian(kind.columns[0], kind.places[0])[1]
        mine = function(kind.columns[0], kind.places[0], -1.0)[1]
        np.testing.assert_allclose(np.array(mine), np.array(largest)[: mine.shape[0]], rtol=1e-9, atol=1e-6)
    return median_ms(todo, repeats)


def ours(binary: Path, repeats: int) -> dict[str, float]:
    """What sip_evaluation prints."""
    done = subprocess.run([binary, str(repeats), "--json"], check=True, capture_output=True, text=True)
    found: dict[str, float] = json.loads(done.stdout)
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", type=Path)
    parser.add_argument("--repeats", type=int, default=20)
    parser.add_argument("--out", type=Path, default=Path("build/sip_casadi"), help="Folder for C code")
    chosen = parser.parse_args()

    plan = mcplan.whole_body("walking", minimise="none").plan
    kinds = kinds_of(plan)
    torque, force = largest_error(plan, kinds)
    print(f"CasADi {ca.__version__}; torques differ by at most {torque:.0e} N m, forces by {force:.0e} N")
    for kind in kinds.values():
        kind.add_hessian()
    rows = sum(kind.rows.numel_out(0) * len(kind.columns) for kind in kinds.values())
    print(
        f"{rows} rows, {len(kinds)} kinds of intervals, built in {sum(kind.build_s for kind in kinds.values()):.1f} s"
    )
    before = ours(chosen.binary, chosen.repeats)
    times = {what: measure(kinds, what, chosen.repeats) for what in ("rows", "jacobian", "hessian")}
    chained_ms = measure_chained(kinds, chosen.repeats, chosen.out)
    after = ours(chosen.binary, chosen.repeats)
    print(f"mcplan: {before['rows']:.0f} rows, {before['parameters']:.0f} parameters; processor time, medians:")
    for what, casadi_ms in times.items():
        ours_ms = 0.5 * (before[f"{what}_ms"] + after[f"{what}_ms"])
        print(f"  {what:9} mcplan {ours_ms:.2f} ms, CasADi {casadi_ms:.2f} ms (x {casadi_ms / ours_ms:.1f})")
        if what == "jacobian":
            print(f"            CasADi's C code, by joints first: {chained_ms:.2f} ms (x {chained_ms / ours_ms:.1f})")


if __name__ == "__main__":
    main()
