"""Plan scenes with one obstacle each, which a person would walk past, over or through, and print what each robot pays.

    python benchmarks/obstacle_scenes.py --jobs 2 --out before.json                    # before a change
    python benchmarks/obstacle_scenes.py --jobs 2 --against before.json                # after it
    python benchmarks/obstacle_scenes.py 'hole*' --robot talos --time-limit 60         # some
    python benchmarks/obstacle_scenes.py --save hole_both_sides scene.toml             # one as a file

Not every robot can do all of them: a wall in the way has to be walked round, a table beside a high step helps those with
hands. Read the table beside an earlier one. Exit code 1 if a scene that was solved is not, or costs 1.3 times as much.
"""

from __future__ import annotations

import argparse
import fnmatch
import json
import math
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from pathlib import Path

import numpy as np

import mcplan as mp
from mcplan.files.scenes import save_scene
from mcplan_bench.processes import each

ROBOTS = ("humanoid44", "talos", "g1", "anymal", "go2")
#: A plan that costs this much more than before is worse.
DEARER = 1.3

Interval = tuple[float, float]


def slab(name: str, x: Interval, y: Interval, z: float = 0.0, thickness: float | None = None) -> mp.model.Surface:
    """Level ground for feet; with a thickness [m] it is the top of a solid."""
    corners = [[x[0], y[0], z], [x[1], y[0], z], [x[1], y[1], z], [x[0], y[1], z]]
    surface = mp.model.Surface(name=name, vertices_W=corners, end_effectors=["foot"])
    if thickness is not None:
        surface.thickness = thickness
    return surface


def solid(name: str, x: Interval, y: Interval, height: float) -> mp.model.Surface:
    """What stands on the floor and only hands could touch."""
    surface = slab(name, x, y, height, height)
    surface.end_effectors = ["hand"]
    return surface


def scene(
    surfaces: Sequence[mp.model.Surface], to: tuple[float, float, float], yaw: float = 0.0, on: str = ""
) -> mp.Scene:
    """From the origin, heading along x, to a place [m] and heading [rad] on the surface `on`, or the first one."""
    first = surfaces[0].name
    return mp.Scene(
        surfaces=list(surfaces),
        start=mp.model.Stance(contacts={"foot": first}),
        goal=mp.model.Stance(position_W=list(to), yaw=yaw, contacts={"foot": on or first}),
    )


def floor(x: Interval = (-2.0, 6.0), y: Interval = (-4.0, 4.0)) -> mp.model.Surface:
    return slab("floor", x, y)


def on_floor(x: float, y: float, yaw_deg: float = 0.0) -> mp.Scene:
    """Nothing is in the way."""
    return scene([floor((-3.0, 10.0), (-5.0, 5.0))], (x, y, 0.0), math.radians(yaw_deg))


def past(*obstacles: mp.model.Surface, to: tuple[float, float, float] = (2.0, 0.0, 0.0)) -> mp.Scene:
    """A floor on which these stand."""
    return scene([floor(), *obstacles], to)


def hole(length: float, corridors: Sequence[Interval]) -> mp.Scene:
    """Two floors with a hole between them, and corridors across it."""
    beyond = 0.4 + length
    ground = [slab("near", (-1.0, 0.4), (-1.6, 1.6)), slab("far", (beyond, beyond + 2.0), (-1.6, 1.6))]
    bridges = [slab(f"bridge_{i}", (0.4, beyond), y) for i, y in enumerate(corridors)]
    return scene([*ground, *bridges], (beyond + 0.6, 0.0, 0.0), on="far")


def step_up(height: float, *, table: bool = False) -> mp.Scene:
    """A platform, perhaps with a table on each side of the way."""
    surfaces = [slab("floor", (-2.0, 0.4), (-2.0, 2.0)), slab("platform", (0.4, 3.0), (-2.0, 2.0), height, height)]
    if table:
        surfaces += [
            solid(f"table_{side}", (0.3, 0.9), (y - 0.15, y + 0.15), 0.9)
            for side, y in (("left", 0.55), ("right", -0.55))
        ]
    return scene(surfaces, (1.2, 0.0, height), on="platform")


def step_down(height: float) -> mp.Scene:
    ground = [slab("platform", (-2.0, 0.4), (-2.0, 2.0)), slab("floor", (0.4, 3.0), (-2.0, 2.0), -height)]
    return scene(ground, (1.2, 0.0, -height), on="floor")


def stairs(rise: float, tread: float, count: int = 4) -> mp.Scene:
    ground = [slab("floor", (-2.0, 0.35), (-1.0, 1.0))]
    for i in range(1, count + 1):
        begin = 0.35 + (i - 1) * tread
        end = begin + tread if i < count else begin + 2.0
        ground.append(slab(f"tread_{i}", (begin, end), (-1.0, 1.0), i * rise, i * rise))
    top = 0.35 + (count - 1) * tread + 0.5
    return scene(ground, (top, 0.0, count * rise), on=f"tread_{count}")


def l_floor(yaw_deg: float) -> mp.Scene:
    """Two strips at a right angle; the goal stands at the end of the second one."""
    ground = [slab("along", (-0.6, 2.6), (-0.6, 0.6)), slab("aside", (1.4, 2.6), (0.6, 2.6))]
    return scene(ground, (2.0, 2.0, 0.0), math.radians(yaw_deg), on="aside")


def u_floor() -> mp.Scene:
    """Three strips round a hole; the goal stands beside the start, across it."""
    ground = [
        slab("out", (-0.6, 2.0), (-0.5, 0.5)),
        slab("across", (1.0, 2.0), (0.5, 1.5)),
        slab("back", (-0.6, 2.0), (1.5, 2.5)),
    ]
    return scene(ground, (0.0, 2.0, 0.0), on="back")


def zigzag(pitch: float, aside: float) -> mp.Scene:
    """Stones to the left and to the right of the way in turn."""
    ground = [slab("near", (-1.0, 0.3), (-0.6, 0.6))]
    for i in range(4):
        x, y = 0.3 + (i + 0.6) * pitch, aside if i % 2 else -aside
        ground.append(slab(f"stone_{i}", (x - 0.17, x + 0.17), (y - 0.12, y + 0.12), 0.03 * (i % 3)))
    begin = 0.3 + 4.6 * pitch
    ground.append(slab("far", (begin - 0.17, begin + 1.5), (-0.6, 0.6)))
    return scene(ground, (begin + 0.5, 0.0, 0.0), on="far")


def beam(width: float, aside: float) -> mp.Scene:
    ground = [
        slab("near", (-1.0, 0.4), (-1.0, 1.0)),
        slab("beam", (0.4, 2.0), (aside - width / 2, aside + width / 2)),
        slab("far", (2.0, 4.0), (-1.0, 1.0)),
    ]
    return scene(ground, (2.6, 0.0, 0.0), on="far")


def door(width: float) -> mp.Scene:
    return past(
        solid("left_wall", (0.9, 1.1), (width / 2, 4.0), 2.0), solid("right_wall", (0.9, 1.1), (-4.0, -width / 2), 2.0)
    )


def fence(length: float, y: float = 0.0) -> mp.Scene:
    return past(solid("fence", (0.95, 1.05), (y - length / 2, y + length / 2), 0.9))


def block(half: float, height: float) -> mp.Scene:
    """A block on the line, which feet may stand on."""
    return past(slab("block", (1.0 - half, 1.0 + half), (-half, half), height, height))


def block_across(height: float, length: float) -> mp.Scene:
    """A block across the whole way, and floor on both sides of it."""
    end = 0.6 + length
    ground = [
        slab("near", (-1.0, 0.6), (-1.0, 1.0)),
        slab("block", (0.6, end), (-1.0, 1.0), height, height),
        slab("far", (end, end + 3.0), (-1.0, 1.0)),
    ]
    return scene(ground, (end + 1.0, 0.0, 0.0), on="far")


def uneven(seed: int) -> mp.Scene:
    """Strips across the way, each a little higher or lower than the floor."""
    random, x = np.random.default_rng(seed), 0.3
    ground = [slab("near", (-1.0, x), (-0.8, 0.8))]
    for i in range(random.integers(3, 6)):
        length, height = random.uniform(0.3, 0.7), random.uniform(-0.1, 0.12)
        ground.append(slab(f"strip_{i}", (x, x + length), (-0.8, 0.8), height, 0.3))
        x += length
    ground.append(slab("far", (x, x + 2.0), (-0.8, 0.8)))
    return scene(ground, (x + 0.6, 0.0, 0.0), on="far")


def bar(width: float, height: float) -> mp.Scene:
    """A bar across the whole floor, too narrow to stand on."""
    return past(solid("bar", (1.0 - width / 2, 1.0 + width / 2), (-4.0, 4.0), height))


def patches(seed: int) -> mp.Scene:
    """Two columns of patches, each tilted forwards, backwards or to a side by 5 to 14 degrees and shifted up or down."""
    random = np.random.default_rng(seed)
    length, slope, rows = (
        random.uniform(0.4, 0.7),
        math.tan(math.radians(random.uniform(5.0, 14.0))),
        random.integers(3, 6),
    )
    ground = [slab("start", (-1.0, 1.0), (-0.5, 0.5))]
    for row in range(rows):
        x = 1.0 + row * length
        for name, y in (("right", -0.5), ("left", 0.0)):
            aside, up = random.integers(2), slope * random.choice([-1.0, 1.0])
            patch = slab(f"{name}_{row + 1}", (x, x + length), (y, y + 0.5), random.uniform(-0.02, 0.02))
            middle = np.mean(patch.vertices_W, axis=0)
            patch.vertices_W = [corner + [0.0, 0.0, up * (corner - middle)[aside]] for corner in patch.vertices_W]
            patch.friction = 0.5
            ground.append(patch)
    end = 1.0 + rows * length
    ground.append(slab("end", (end, end + 2.0), (-0.5, 0.5)))
    walk = scene(ground, (end + 0.8, 0.0, 0.0), on="end")
    walk.start = mp.model.Stance(position_W=[0.6, 0.0, 0.0], contacts={"foot": "start"})
    return walk


def post(x: float, y: float) -> mp.model.Surface:
    return solid(f"post_{x:g}_{y:g}", (x - 0.04, x + 0.04), (y - 0.04, y + 0.04), 1.5)


SCENES: dict[str, Callable[[], mp.Scene]] = {
    **{f"side_{d:g}": partial(on_floor, 0.0, d) for d in (0.8, 1.5, 3.0)},
    "back_1": partial(on_floor, -1.0, 0.0),
    "diagonal_2": partial(on_floor, 1.4, 1.4),
    "far_6": partial(on_floor, 6.0, 0.0),
    "far_6_turned": partial(on_floor, 6.0, 0.0, 90.0),
    **{f"turn_{angle:g}": partial(on_floor, 0.0, 0.0, angle) for angle in (90.0, 180.0)},
    "hole_both_sides": partial(hole, 1.6, [(-0.9, -0.3), (0.3, 0.9)]),
    "hole_one_side": partial(hole, 1.6, [(0.5, 1.1)]),
    "hole_long": partial(hole, 3.0, [(-1.2, -0.5), (0.5, 1.2)]),
    "beam_0.4": partial(beam, 0.4, 0.0),
    "beam_0.4_off": partial(beam, 0.4, 0.3),
    "post": lambda: past(post(0.94, 0.0)),
    "posts": lambda: past(post(0.7, 0.1), post(1.4, -0.15)),
    **{f"fence_{length:g}": partial(fence, length) for length in (0.6, 2.0)},
    "fence_beside": partial(fence, 2.0, 0.75),
    "wall_4": lambda: past(solid("wall", (0.95, 1.05), (-2.0, 2.0), 2.0)),
    **{f"door_{width:g}": partial(door, width) for width in (0.8, 1.2)},
    **{f"block_{half:g}_{height:g}": partial(block, half, height) for half in (0.15, 0.3) for height in (0.15, 0.3)},
    **{
        f"across_{height:g}_{length:g}": partial(block_across, height, length)
        for height, length in ((0.08, 0.8), (0.1, 0.6), (0.14, 0.4))
    },
    **{f"uneven_{seed}": partial(uneven, seed) for seed in range(1, 7)},
    **{
        f"bar_{width:g}_{height:g}": partial(bar, width, height)
        for width, height in ((0.05, 0.1), (0.1, 0.1), (0.1, 0.2))
    },
    **{f"step_up_{height:g}": partial(step_up, height) for height in (0.1, 0.2, 0.3)},
    "step_up_0.3_table": partial(step_up, 0.3, table=True),
    **{f"step_down_{height:g}": partial(step_down, height) for height in (0.1, 0.2, 0.3)},
    **{f"stairs_{rise:g}_{tread:g}": partial(stairs, rise, tread) for rise, tread in ((0.1, 0.35), (0.17, 0.29))},
    **{f"patches_{seed}": partial(patches, seed) for seed in range(1, 13)},
    "l_floor": partial(l_floor, 0.0),
    "l_floor_turned": partial(l_floor, 90.0),
    "u_floor": u_floor,
    "zigzag": partial(zigzag, 0.36, 0.12),
    "zigzag_wide": partial(zigzag, 0.30, 0.25),
}


@dataclass(frozen=True)
class Task:
    """A scene and a robot, by name."""

    scene: str
    robot: str
    time_limit_s: float


@dataclass(frozen=True)
class Outcome:
    """What came of it."""

    scene: str
    robot: str
    status: str
    cost: float
    phases: int
    flights: int
    cpu_s: float
    message: str

    @property
    def solved(self) -> bool:
        return self.status == "solved"


def solve(task: Task) -> Outcome:
    begin = time.process_time()
    result = mp.plan(SCENES[task.scene](), task.robot, time_limit=task.time_limit_s, threads=1)
    cpu_s = time.process_time() - begin
    plan, report = result.plan, result.report
    feet = [e for e, end in enumerate(plan.robot.end_effectors) if end.kind == "foot"]
    air = sum(all(row[e] < 0 for e in feet) for row in plan.contact_sequence())
    message = "" if str(report.status) == "solved" else report.message
    return Outcome(task.scene, task.robot, str(report.status), report.cost, len(plan.phases), air, cpu_s, message)


def line(now: Outcome, before: Outcome | None) -> str:
    text = f"{now.scene:>18} {now.robot:>10} {now.status:>15} {now.cost:8.4f} {now.phases:3d} phases {now.cpu_s:6.2f} s"
    text += f"  {now.flights} in flight" if now.flights else ""
    if before:
        text += f"   before: {before.status} {before.cost:.4f} {before.phases} {before.cpu_s:.2f} s"
        text += "   WORSE" if worse(now, before) else ""
    return text if now.solved else f"{text}   {now.message[:110]}"


def worse(now: Outcome, before: Outcome) -> bool:
    return before.solved and (not now.solved or now.cost > DEARER * before.cost)


def main() -> int:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="Names or patterns; all without one.")
    parser.add_argument("--robot", action="append", metavar="R", help="Robot; several may be given.")
    parser.add_argument("--time-limit", type=float, default=60.0, metavar="S", help="Wall clock of a plan [s].")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="Number of processes.")
    parser.add_argument("--out", type=Path, metavar="FILE", help="JSON of what came of them.")
    parser.add_argument("--against", type=Path, metavar="FILE", help="JSON of an earlier run to compare with.")
    parser.add_argument("--save", nargs=2, metavar=("SCENE", "FILE"), help="Save a scene instead.")
    given = parser.parse_args()
    if given.save:
        save_scene(SCENES[given.save[0]](), Path(given.save[1]))
        return 0
    names = [n for n in SCENES if not given.scenes or any(fnmatch.fnmatch(n, p) for p in given.scenes)]
    tasks = [Task(name, robot, given.time_limit) for name in names for robot in given.robot or ROBOTS]
    earlier = [Outcome(**row) for row in json.loads(given.against.read_text())] if given.against else []
    known = {(outcome.scene, outcome.robot): outcome for outcome in earlier}
    outcomes: dict[int, Outcome] = {}
    for index, outcome in each(solve, tasks, given.jobs):
        outcomes[index] = outcome
        print(line(outcome, known.get((outcome.scene, outcome.robot))), flush=True)
    done = [outcomes[i] for i in range(len(tasks))]
    if given.out:
        given.out.write_text(json.dumps([asdict(outcome) for outcome in done], indent=1))
    lost = [o for o in done if (o.scene, o.robot) in known and worse(o, known[o.scene, o.robot])]
    print(f"{sum(o.solved for o in done)} of {len(done)} solved; {len(lost)} worse than before")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
