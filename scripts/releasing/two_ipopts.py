"""Solve with mcplan's Ipopt and with CasADi's in one process, in the order of the arguments, each twice."""

from __future__ import annotations

import sys


def casadi() -> None:
    import casadi as ca  # type: ignore[import-not-found]

    x = ca.SX.sym("x", 2)
    program = {"x": x, "f": (1 - x[0]) ** 2 + 100 * (x[1] - x[0] ** 2) ** 2}
    solver = ca.nlpsol("s", "ipopt", program, {"print_time": False, "ipopt.print_level": 0})
    found = solver(x0=[-1.2, 1.0])["x"]
    assert abs(float(found[0]) - 1) < 1e-6 and abs(float(found[1]) - 1) < 1e-6, found


def mcplan() -> None:
    import mcplan as mp

    walk = mp.walk("flat", fidelity="point", lookahead=2, solver="ipopt")
    assert walk.report.status == mp.model.Status.solved, walk.report


for _ in range(2):
    for name in sys.argv[1:]:
        {"casadi": casadi, "mcplan": mcplan}[name]()
maps = {line.split("/")[-1].strip() for line in open("/proc/self/maps") if "ipopt" in line}
print(f"{' then '.join(sys.argv[1:])}: both have solved; loaded {', '.join(sorted(maps))}")
