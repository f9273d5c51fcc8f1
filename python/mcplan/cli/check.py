"""mcplan check"""

from __future__ import annotations

import json as json_module
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from mcplan._core import CheckResult, Plan, PlanarPlan, Violation
    from mcplan._core.sip import Certificate
    from mcplan.tracking.findings import Feasibility, Finding
    from mcplan.wb.motion import Motion

#: Instants of a plan that are looked at, at most: as many as the checker takes.
MAX_SAMPLES = 2_000_000
#: Of one kind, beside the largest, in the table of --robot; --json has all.
OTHERS = 3


PlanArgument = Annotated[
    Path, typer.Argument(metavar="PLAN", help="File written by mcplan plan, rhp, sip or motion -o.")
]
CertifyOption = Annotated[
    bool,
    typer.Option("--certify", help="Prove the constraints of a whole-body plan at every instant, too."),
]
SelfCollisionOption = Annotated[
    bool, typer.Option("--self-collision", help="Check the collision pairs of a whole-body plan's robot, too.")
]
RobotOption = Annotated[
    str | None,
    typer.Option(
        "--robot", metavar="ROBOT", help="Robot with a URDF; checks whether its joints can follow the plan, too."
    ),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]


def check(
    plan: PlanArgument,
    certify: CertifyOption = False,
    self_collision: SelfCollisionOption = False,
    robot: RobotOption = None,
    json: JsonOption = False,
) -> int:
    """Check a saved plan or motion.

    Of a motion everything is worked out again at 1 kHz with the robot's URDF. The exit code is 1 if a constraint is violated,
    with --certify also if a constraint is not proved, and with --robot also if the robot cannot follow.

    Example: mcplan check plan.npz --robot talos
    """
    from mcplan._core import PlanarPlan
    from mcplan._core.sip import certify as prove
    from mcplan.checking import check as run
    from mcplan.errors import InvalidInput
    from mcplan.wb.loading import load_any
    from mcplan.wb.motion import Motion

    saved = load_any(plan)
    _require_short(plan, saved)
    if isinstance(saved, Motion):
        given = {"--certify": certify, "--self-collision": self_collision, "--robot": robot is not None}
        return _check_motion(plan, saved, given, json)
    certificate, feasibility = None, None
    if isinstance(saved, PlanarPlan):
        if robot is not None:
            raise InvalidInput("--robot", "needs a plan of mcplan plan or rhp; a whole-body plan has its own joints")
        result = run(saved, self_collision=self_collision)
        if certify:
            certificate = prove(saved, self_collision=self_collision)
        # "motion" is the earlier name of "task", for one more release.
        carried = {"task": saved.task.name, "motion": saved.task.name, "robot": saved.task.robot.name}
    elif certify or self_collision:
        option = "--certify" if certify else "--self-collision"
        raise InvalidInput(option, "needs a whole-body plan, as mcplan sip makes them")
    else:
        if robot is not None:
            feasibility = _feasibility(saved, robot)
        result = run(saved)
        carried = {"scene": saved.scene.name, "robot": saved.robot.name}
    if json:
        report = {
            "plan": str(plan),
            **carried,
            **result_dict(result),
            "certified": None if certificate is None else certificate.proved(),
            "certificate": None if certificate is None else certificate_dict(certificate),
            "feasibility": None if feasibility is None else feasibility_dict(feasibility),
            "solid_depths": _solid_depths(saved, result),
        }
        print(json_module.dumps(report))
    else:
        _print_result(plan, saved, result, certificate)
        if feasibility is not None:
            _print_feasibility(feasibility)
    proved, followed = certificate is None or certificate.proved(), feasibility is None or feasibility.ok()
    return 0 if result.ok() and proved and followed else 1


def _require_short(path: Path, saved: Plan | PlanarPlan | Motion) -> None:
    """Raise InvalidPlan for one that lasts longer than what is looked at once a millisecond can."""
    from mcplan._core import Tolerances
    from mcplan.errors import InvalidPlan
    from mcplan.wb.certificate import MotionTolerances
    from mcplan.wb.certificate.states import MAX_SAMPLES as MAX_MOTION_SAMPLES
    from mcplan.wb.motion import Motion

    certified = isinstance(saved, Motion)
    samples, step = (
        (MAX_MOTION_SAMPLES, MotionTolerances().sample_s) if certified else (MAX_SAMPLES, Tolerances().sample_s)
    )
    most = samples * step
    if saved.duration() > most:
        rule = f"must last at most {most:g} s for a check of every millisecond"
        raise InvalidPlan("durations", rule, f"{saved.duration():.6g} s", str(path))


def _check_motion(path: Path, motion: Motion, given: dict[str, bool], json: bool) -> int:
    """Certify a motion; raises InvalidInput for options that motions do not take."""
    from mcplan.cli.motion_text import certificate_lines, certificate_rows
    from mcplan.cli.table import print_table
    from mcplan.cli.terminal import printable
    from mcplan.errors import InvalidInput
    from mcplan.wb.certificate import certify

    for option, present in given.items():
        if present:
            raise InvalidInput(option, "needs a plan; of a motion all that is known is checked")
    result = certify(motion)
    if json:
        carried = {"motion": str(path), "scene": motion.plan.scene.name, "robot": motion.plan.robot.name}
        print(json_module.dumps({**carried, **result.as_dict()}))
    else:
        for line in certificate_lines(str(path), result):
            print(printable(line))
        print()
        head = ("constraint", "worst", "limit", "", "at", "where")
        print_table(certificate_rows(result), head)
    return 0 if result.ok() else 1


def _feasibility(plan: Plan, robot: str) -> Feasibility:
    from mcplan.files.robots import load_robot
    from mcplan.tracking.feasibility import assess

    return assess(plan, load_robot(robot))


def _print_result(path: Path, plan: Plan | PlanarPlan, result: CheckResult, certificate: Certificate | None) -> None:
    """What was checked and proved, and the loads of a plan of contacts and CoM."""
    from mcplan._core import Plan
    from mcplan.cli.loads_text import all_lines
    from mcplan.cli.table import print_table
    from mcplan.cli.terminal import printable

    if result.ok():
        print(printable(f"{path}: ok. Closest to its limit: {result.worst()}"))
    else:
        print(printable(f"{path}: {len(result.violations())} constraints violated"))
        print_table([[str(violation)] for violation in result.violations()])
        print(f"kept until t = {result.kept_until_s:.4g} s of {plan.duration():.4g} s")
    for line in start_lines(result):
        print(printable(line))
    for line in warning_lines(result.warnings):
        print(printable(line))
    if isinstance(plan, Plan):
        for line in all_lines(plan):
            print(printable(line))
    _print_not_asked(_solid_depths(plan, result))
    if certificate is not None:
        print("\n".join(printable(line) for line in str(certificate).rstrip().splitlines()))


def start_lines(result: CheckResult) -> list[str]:
    """A line for each limit that a measured start violates by itself."""
    return [line for line in str(result).splitlines() if line.startswith("at the start: ")]


def _solid_depths(plan: Plan | PlanarPlan, result: CheckResult) -> list[dict[str, object]]:
    """How deep every swinging end-effector of a whole-body plan goes into every solid, if it could be evaluated."""
    from mcplan._core import PlanarPlan, solid_depths

    if not isinstance(plan, PlanarPlan) or not any(found.name == "clearance" for found in result.constraints):
        return []
    task = plan.task
    return [
        {
            "end_effector": task.robot.end_effectors[found.end_effector].name,
            "surface": task.surfaces[found.surface].name,
            "depth_m": finite(found.depth_m),
            "phase": found.phase,
            "time_s": found.time_s,
            "asked": found.asked,
        }
        for found in solid_depths(plan)
    ]


def _print_not_asked(depths: list[dict[str, object]]) -> None:
    """Pairs that the task lets into each other, and how deep they are."""
    from mcplan.cli.terminal import printable

    for found in depths:
        if not found["asked"]:
            depth = found["depth_m"]
            where = f"depth {1e3 * depth:.3g} mm, phase {found['phase']}" if isinstance(depth, float) else "no number"
            print(printable(f"not asked: clearance of {found['end_effector']} and {found['surface']}: {where}"))


def _print_feasibility(feasibility: Feasibility) -> None:
    """The largest of each kind, and the worst that are beyond their limit."""
    from mcplan.cli.table import print_table
    from mcplan.cli.terminal import printable

    print(printable(feasibility.verdict))
    shown = [f for worst in feasibility.worst_of_each() for f in [worst, *_others_beyond(feasibility, worst)]]
    rows = [
        [
            "" if f.value <= f.limit else "!",
            f.name,
            f.where,
            f"{f.time_s:.2f}",
            f"{f.value:.3g}",
            f"{f.limit:.3g}",
            f.unit,
            f.note,
        ]
        for f in shown
    ]
    print_table(rows, ["", "limit of", "where", "t [s]", "asked", "limit", "unit", ""])


def _others_beyond(feasibility: Feasibility, worst: Finding) -> list[Finding]:
    return [f for f in feasibility.violations() if f.name == worst.name and f is not worst][:OTHERS]


def feasibility_dict(feasibility: Feasibility) -> dict[str, Any]:
    """A feasibility as plain data; numbers that are not finite become null."""
    data = feasibility.as_dict()
    for key in ("violations", "constraints"):
        data[key] = [{name: finite(value) for name, value in found.items()} for found in data[key]]
    return data


def result_dict(result: CheckResult) -> dict[str, Any]:
    """What the checker found as plain data."""
    return {
        "ok": result.ok(),
        "violations": [violation_dict(v) for v in result.violations()],
        "constraints": [violation_dict(v) for v in result.constraints],
        "warnings": [warning_dict(v) for v in result.warnings],
        "start": [violation_dict(v) for v in result.start],
        "start_slack_s": result.start_slack_s,
        "kept_until_s": result.kept_until_s,
        "checked_until_s": result.checked_until_s,
    }


def certificate_dict(certificate: Certificate) -> dict[str, Any]:
    """A certificate as plain data; numbers that are not finite become null."""
    keys = ("name", "bound", "reached", "tolerance", "unit", "phase", "where", "time_s")
    return {
        "constraints": [
            {"proof": proved.proof.name, **{key: finite(getattr(proved, key)) for key in keys}}
            for proved in certificate.constraints
        ],
        "subdivisions": certificate.subdivisions,
        "rounding": certificate.rounding,
        "time_s": certificate.time_s,
    }


def warning_lines(warnings: Sequence[Violation]) -> list[str]:
    """A line for each warning of the checker."""
    return [f"warning: {warning}: limbs are not planned around solids" for warning in warnings]


def warning_dict(warning: Violation) -> dict[str, object]:
    """A warning of the checker as plain data."""
    return {**violation_dict(warning), "surface": warning.surface}


def violation_dict(violation: object) -> dict[str, object]:
    """A Violation as plain data; numbers that are not finite become null."""
    keys = ("name", "phase", "end_effector", "time_s", "value", "tolerance", "unit")
    return {key: finite(getattr(violation, key)) for key in keys}


def finite(value: object) -> object:
    """The value, or None for a number that JSON cannot represent."""
    import math

    return None if isinstance(value, float) and not math.isfinite(value) else value
