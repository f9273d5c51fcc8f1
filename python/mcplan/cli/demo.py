"""mcplan demo"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mcplan.cli.terminal import printable, say

if TYPE_CHECKING:
    from mcplan._core import PlanResult, Violation

#: The paper's four scenes.
SCENES = ("flat", "stairs", "gap", "gap_with_rail")


def demo(
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Folder in which plans, pages and pictures are written.")
    ] = Path("out"),
    scene: Annotated[
        list[str] | None,
        typer.Option("--scene", metavar="NAME", help="Scene to plan instead of the four; may be repeated."),
    ] = None,
    robot: Annotated[
        str, typer.Option("--robot", metavar="R", help="Robot: built-in name or TOML file.")
    ] = "humanoid44",
) -> int:
    """Plan four scenes; write a table, plans, pages and pictures.

    The scenes are flat, stairs, gap and gap_with_rail. The exit code is 0 only if all of them are solved.

    Example: mcplan demo --out out
    """
    import mcplan
    from mcplan.extras import require

    require("mcplan demo", "view", "meshcat", "matplotlib")
    from mcplan.files.outputs import require_folder
    from mcplan.view.pictures.picture import picture

    require_folder("--out", out)
    scenes = [mcplan.load_scene(name) for name in scene or SCENES]
    model = mcplan.load_robot(robot)
    out.mkdir(parents=True, exist_ok=True)
    results = []
    for i, each in enumerate(scenes):
        lead = f"[{i + 1}/{len(scenes)}] {each.name}:"
        print(printable(f"{lead} planning"), flush=True)
        result = mcplan.plan(each, model)
        results.append(result)
        took = f"{result.report.status} in {result.report.time_s:.2f} s"
        print(printable(f"{lead} {took}, drawing"), flush=True)
        if not result.plan.phases:  # no contact sequence joins start and goal: nothing to draw
            continue
        result.plan.save(out / f"{each.name}.npz")
        mcplan.show(result.plan, report=result.report).save_html(out / f"{each.name}.html")
        picture(result.plan, path=out / f"{each.name}.png")
    say()
    print_results(results)
    say()
    say(f"In {out}/: NAME.npz (mcplan check {out}/{scenes[0].name}.npz), NAME.html (open in a browser), NAME.png")
    return 0 if all(str(result.report.status) == "solved" for result in results) else 1


def print_results(results: list[PlanResult]) -> None:
    """A line per result."""
    from mcplan.cli.plan import flight_phases
    from mcplan.cli.table import print_table

    rows = []
    for result in results:
        plan, report = result.plan, result.report
        rows.append(
            [
                plan.scene.name,
                str(report.status),
                f"{report.cost:.3f}",
                str(len(plan.phases)),
                str(flight_phases(plan.contact_sequence())),
                str(report.switches),
                str(report.iterations),
                f"{report.time_s:.2f} s",
                f"{plan.duration():.2f} s" if plan.phases else "-",
                margin(report.worst_violation),
            ]
        )
    head = ["scene", "status", "cost", "phases", "in flight", "switches", "iterations", "time", "length"]
    print_table(rows, [*head, "worst constraint"])


def margin(violation: Violation) -> str:
    """The worst constraint beside its tolerance: "reach at left_foot, phase 7: 0.0004 of 0.001 m"."""
    if not violation.name:
        return "-"
    where = f" at {violation.end_effector}" if violation.end_effector else ""
    when = f", phase {violation.phase}" if violation.phase >= 0 else ""
    unit = "" if violation.unit in ("", "-") else f" {violation.unit}"
    return f"{violation.name}{where}{when}: {violation.value:.2g} of {violation.tolerance:g}{unit}"
