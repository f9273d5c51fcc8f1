"""mcplan check"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer


def check(
    plan: Annotated[Path, typer.Argument(metavar="PLAN", help="File written by mcplan plan -o.")],
    json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> int:
    """Check a plan against the scene and robot, or the motion, it carries; exit code 1 if it violates a constraint.

    Example: mcplan check plan.npz
    """
    from mcplan._core import WholeBodyPlan
    from mcplan._core import check as run
    from mcplan.cli.table import print_table
    from mcplan.files.whole_body_plans import load_any_plan

    loaded = load_any_plan(plan)
    if isinstance(loaded, WholeBodyPlan):
        result = run(loaded)
        carried = {"motion": loaded.motion.name, "robot": loaded.motion.robot.name}
    else:
        result = run(loaded)
        carried = {"scene": loaded.scene.name, "robot": loaded.robot.name}
    if json:
        report = {
            "plan": str(plan),
            **carried,
            "ok": result.ok(),
            "violations": [violation_dict(v) for v in result.violations()],
            "constraints": [violation_dict(v) for v in result.constraints],
        }
        print(json_module.dumps(report))
    elif result.ok():
        print(f"{plan}: ok. Closest to its limit: {result.worst()}")
    else:
        print(f"{plan}: {len(result.violations())} constraints violated")
        print_table([[str(violation)] for violation in result.violations()])
    return 0 if result.ok() else 1


def violation_dict(violation: object) -> dict[str, object]:
    """A Violation as plain data; numbers that are not finite become null."""
    keys = ("name", "phase", "end_effector", "time_s", "value", "tolerance", "unit")
    return {key: finite(getattr(violation, key)) for key in keys}


def finite(value: object) -> object:
    """The value, or None for a number that JSON cannot hold."""
    import math

    return None if isinstance(value, float) and not math.isfinite(value) else value
