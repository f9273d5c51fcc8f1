"""Hash every built-in plan, walk, planar plan and page: does a change of the code leave them as they were?

    python benchmarks/same_plans.py record before.json          # before the change
    python benchmarks/same_plans.py compare before.json         # after it; exit code 1 and a line for each that differs
    python benchmarks/same_plans.py compare before.json --only "ddp flat"

Hashes hold for one machine and one way to compile: the last bits depend on both. Wall times, versions and what a page
shows of them are left out.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

import mcplan as mp

ROBOTS = {
    "talos": ("flat", "ramp", "stairs_broad", "stepping_stones"),
    "g1": ("flat", "ramp"),
    "anymal": ("flat", "ramp", "rubbles"),
}
WALKS = ("rubbles", "up_and_down", "v_shape", "stairs_up", "flat")


def saved(plan: mp.Plan | mp.PlanarPlan) -> str:
    """The hash of a plan's numbers, as it is saved."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plan.npz"
        plan.save(path)
        digest = hashlib.sha256()
        with np.load(path) as arrays:
            for name in sorted(arrays.files):
                if name != "header":
                    digest.update(name.encode() + arrays[name].tobytes())
    return digest.hexdigest()[:16]


def page(plan: mp.Plan | mp.PlanarPlan) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plan.html"
        mp.show(plan).save_html(path)
        return hashlib.sha256(path.read_bytes()).hexdigest()[:16]


def ddp(scene: str, robot: str, model: str) -> mp.Plan:
    return mp.plan(scene, robot, model=model).plan


def rhp(scene: str, fidelity: str) -> mp.Plan:
    return mp.walk(scene, fidelity=fidelity, lookahead=2, cycles=4, sequence=None).plan


def sip(task: str, minimise: str) -> mp.PlanarPlan:
    return mp.whole_body(task, minimise=minimise).plan


def cases() -> Iterator[tuple[str, Callable[[], mp.Plan | mp.PlanarPlan]]]:
    """Name and maker of each plan, quick ones first."""
    from mcplan.files.builtin import names

    for scene in names("scenes"):
        for model in ("wrench", "lipm"):
            yield f"ddp {scene} humanoid44 {model}", lambda scene=scene, model=model: ddp(scene, "humanoid44", model)
    for robot, scenes in ROBOTS.items():
        for scene in scenes:
            yield f"ddp {scene} {robot} wrench", lambda scene=scene, robot=robot: ddp(scene, robot, "wrench")
    for scene in WALKS:
        for fidelity in ("single", "point"):
            yield f"rhp {scene} {fidelity}", lambda scene=scene, fidelity=fidelity: rhp(scene, fidelity)
    for task in names("planar_tasks"):
        yield f"sip {task} none", lambda task=task: sip(task, "none")
    yield "sip cartwheel torque", lambda: sip("cartwheel", "torque")


def hashes(only: str) -> dict[str, list[str]]:
    found = {}
    for name, make in cases():
        if only in name:
            try:
                plan = make()
                found[name] = [saved(plan), page(plan)]
            except mp.InvalidInput as error:
                found[name] = [str(error)[:200], ""]
            print(name, *found[name], flush=True)
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("verb", choices=("record", "compare"))
    parser.add_argument("file", type=Path)
    parser.add_argument("--only", default="", help="only plans in whose name this occurs")
    arguments = parser.parse_args()
    before = json.loads(arguments.file.read_text()) if arguments.verb == "compare" else {}
    found = hashes(arguments.only)
    if arguments.verb == "record":
        arguments.file.write_text(json.dumps(found, indent=1) + "\n")
        return 0
    different = [
        f"{name}: {what} differs"
        for name in found
        for what, old, new in zip(("plan", "page"), before[name], found[name], strict=True)
        if old != new
    ]
    print(*different or [f"all {len(found)} plans and pages are the same"], sep="\n")
    return bool(different)


if __name__ == "__main__":
    sys.exit(main())
