"""sl1m's L1 relaxation on surfaces; runs in sl1m's own environment.

    python sl1m_inside.py SOURCES problem.json

The problem has "surfaces", corners (4, 3) of each [m], the index "last", "steps" and "feet", both feet at the start. Any
step but the last two may take any surface. One JSON line: found or not, the surfaces taken, times.
"""

from __future__ import annotations

import contextlib
import io
import json
import sys
import time
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
sys.path.insert(0, sys.argv[1])
from sl1m import fix_sparsity  # noqa: E402
from sl1m.problem_definition import copyKin, genFootRelativeConstraints, genKinematicConstraints  # noqa: E402
from sl1m.stand_alone_scenarios.constraints import (  # noqa: E402
    left_foot_constraints,
    left_foot_in_rf_frame_constraints,
    right_foot_constraints,
    right_foot_in_lf_frame_constraints,
)


def main() -> None:
    given = json.loads(Path(sys.argv[2]).read_text())
    surfaces = [np.array(corners).T for corners in given["surfaces"]]
    last = [surfaces[given["last"]]]
    candidates = [list(surfaces) for _ in range(given["steps"] - 2)] + [last, last]
    reach = genKinematicConstraints(left_foot_constraints, right_foot_constraints)
    relative = genFootRelativeConstraints(right_foot_in_lf_frame_constraints, left_foot_in_rf_frame_constraints)
    phases = [
        {
            "moving": i % 2,
            "fixed": (i + 1) % 2,
            "K": [copyKin(reach) for _ in choices],
            "relativeK": [relative[i % 2] for _ in choices],
            "S": choices,
        }
        for i, choices in enumerate(candidates)
    ]
    feet = [np.array(foot) for foot in given["feet"]]
    problem = {"p0": feet, "c0": None, "nphases": len(phases), "phaseData": phases}
    kept = [list(choices) for choices in candidates]
    cpu = time.process_time()
    said, found, error = io.StringIO(), None, ""
    try:
        with contextlib.redirect_stdout(said):
            found = fix_sparsity.solveL1(problem, kept, None, plot=False)
    except Exception as failure:  # whatever a peer raises is what it answers
        error = f"{type(failure).__name__}: {failure}"
    cpu = time.process_time() - cpu
    report = {"found": found is not None, "cpu_s": cpu, "error": error, "said": said.getvalue()[-300:]}
    if found is not None:
        report["feet"] = [np.asarray(foot).tolist() for foot in found[3]]
    print(json.dumps(report))


if __name__ == "__main__":
    main()
