"""Plan random scenes that a robot can cross by construction, and replay every plan that is called solved.

python benchmarks/solvable_scenes.py --scenes 1000 --seed 0 --jobs 2
python benchmarks/solvable_scenes.py --save 17 humanoid44 scene.toml       # the scene of a seed

Exit code 1 unless 97 % are solved, with a median of at most 0.5 s of processor time, and no replay disagrees.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import mcplan as mp
from mcplan.files.scenes import save_scene
from mcplan.files.solvable_scenes import solvable_scene
from mcplan_bench import records, solvable


def main() -> int:
    """Run it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--scenes", type=int, default=100, metavar="N", help="Number of scenes.")
    parser.add_argument("--seed", type=int, default=0, metavar="K", help="Seed of the first scene.")
    parser.add_argument("--robot", action="append", metavar="R", help="Robot; several take turns.")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="Number of processes.")
    parser.add_argument(
        "--out", type=Path, default=Path("out/solvable"), metavar="DIR", help="Folder for JSON and CSV."
    )
    parser.add_argument("--save", nargs=3, metavar=("SEED", "ROBOT", "FILE"), help="Save the scene of a seed instead.")
    given = parser.parse_args()
    if given.save:
        seed, robot, file = given.save
        save_scene(solvable_scene(int(seed), mp.load_robot(robot)), Path(file))
        return 0
    tasks = solvable.tasks(given.scenes, given.seed, given.robot or solvable.ROBOTS)
    outcomes = solvable.run(tasks, given.jobs, lambda text: print(text, flush=True))
    rows = solvable.summary(outcomes)
    for row in rows:
        print(
            f"{row['of']:>12}: {row['solved']} of {row['scenes']} solved ({100 * row['solved'] / row['scenes']:.1f} %), "
            f"{row['rejected']} rejected, CPU median {row['median_cpu_s']:.2f} s, largest {row['largest_cpu_s']:.1f} s; "
            f"{row['failures']}"
        )
    records.write_csv(given.out / "solvable.csv", solvable.rows(outcomes))
    records.write_json(given.out / "solvable.json", {"machine": records.machine(), "summary": rows})
    whole = rows[0]
    good = whole["solved"] >= 0.97 * whole["scenes"] and whole["rejected"] == 0 and whole["median_cpu_s"] <= 0.5
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
