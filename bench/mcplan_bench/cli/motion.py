"""mcplan bench motion"""

from __future__ import annotations

import json as json_module
from pathlib import Path
from typing import Annotated

import typer

from mcplan_bench.cli.output import say


def motion(
    case: Annotated[
        list[str] | None,
        typer.Option("--case", metavar="ROBOT/SCENE", help="Robot and scene of a motion; may stand several times."),
    ] = None,
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for JSON and CSV.")] = Path("out/motion"),
    json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> int:
    """Measure whole-body motions and their certificates.

    A row has iterations, CPU time per second of the plan, that of a certificate apart, residual, drift, use of torques and
    speeds, distances, and how far the CoM is from the plan's; and the reason where a motion is not certified.

    Example: mcplan bench motion --case go2/flat --case talos/stairs_broad
    """
    import mcplan
    from mcplan.errors import InvalidOptions, shown
    from mcplan.extras import require
    from mcplan_bench import motion as bench
    from mcplan_bench import records

    require("mcplan bench motion", "view", "pinocchio", "scipy")
    cases = []
    for given in case or []:
        robot, slash, scene = given.partition("/")
        if not (robot and slash and scene):
            raise InvalidOptions("--case", "must be a robot and a scene, such as go2/flat", shown(given))
        mcplan.load_robot(bench.OWN_ROBOTS.get(robot, robot)), mcplan.load_scene(scene)  # wrong names are refused first
        cases.append((robot, scene))
    rows = bench.motions(cases or bench.CASES, progress=say)
    result = {"machine": records.machine(), "motions": rows}
    records.write_csv(out / "motion.csv", rows)
    records.write_json(out / "motion.json", result)
    if json:
        print(json_module.dumps(records.plain(result)))
        return 0
    print(f"Certified: {sum(row['certified'] for row in rows)} of {len(rows)}")
    print(f"Wrote {out}/motion.json, motion.csv")
    return 0
