"""An iteration of mcplan beside one of Crocoddyl with as many states, inputs and steps, on one thread, in one run.

    .venv/bin/python benchmarks/crocoddyl/compare.py [--repeats 200] [--venv build/crocoddyl]

The first run makes a virtual environment for Crocoddyl (about 200 MB): version 3.2.1 crashes with pin 4.1 and works with
pin 4.0.0, so it cannot share mcplan's. What may be compared and what not: benchmarks/README.md.
"""

import argparse
import json
import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGES = ("crocoddyl==3.2.1", "pin==4.0.0", "numpy")
PHASES = 18

#: Sizes nx, nu of the search: humanoid44 uses its feet alone on gap and its hands as well on gap_with_rail
#: (cpp/src/ddp/layout.hpp with one active base axis, the yaw).
SIZES = {"gap": (14, 11), "gap_with_rail": (20, 19)}


def environment(folder: Path) -> Path:
    """Python of the environment, made if it is not there."""
    python = folder / "bin/python"
    ready = folder / "ready"
    if not ready.exists():
        print(f"Making {folder} with {', '.join(PACKAGES)} (once)", flush=True)
        venv.create(folder, with_pip=True, clear=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", *PACKAGES], check=True)
        ready.touch()
    return python


def crocoddyl_ms(python: Path, nx: int, nu: int, repeats: int) -> dict[str, float]:
    """Medians of Crocoddyl's parts of an iteration [ms]."""
    words = [str(python), str(HERE / "one_iteration.py"), *(str(value) for value in (nx, nu, PHASES, repeats))]
    # PYTHONPATH may lead to packages of the other environment.
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {"OMP_NUM_THREADS": "1"}
    done = subprocess.run(words, env=env, stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(f"error: Crocoddyl ended with exit code {done.returncode}")
    return json.loads(done.stdout)


def mcplan_ms(scene: str, repeats: int) -> dict[str, float]:
    """Medians of mcplan's parts of an iteration with the sequence free [ms]."""
    import mcplan
    from mcplan_bench.speed import iterations, searching_iterations

    model, robot = mcplan.load_scene(scene), mcplan.load_robot("humanoid44")
    first = searching_iterations(mcplan.plan(model, robot).report)
    options = {"phases": PHASES, "max_iterations": first, "restarts": 0}
    timing, _ = iterations(model, robot, max(3, repeats // 20), options)
    return {**timing.parts_ms, "iteration": timing.ms}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=200, help="Iterations behind each median (default 200)")
    parser.add_argument(
        "--venv", type=Path, default=HERE.parents[1] / "build/crocoddyl", help="Crocoddyl's environment"
    )
    parser.add_argument("--json", action="store_true", help="Print one JSON object")
    words = parser.parse_args()
    if words.repeats < 1:
        parser.error("--repeats must be at least 1")
    python = environment(words.venv.absolute())
    rows = []
    for scene, (nx, nu) in SIZES.items():
        peer, ours = crocoddyl_ms(python, nx, nu, words.repeats), mcplan_ms(scene, words.repeats)
        ddp = ours["linearise"] + ours["value_backward"] + ours["line_search"]
        rows.append(
            {"scene": scene, "nx": nx, "nu": nu, "N": PHASES, "crocoddyl": peer, "mcplan": ours, "mcplan_ddp": ddp}
        )
    if words.json:
        print(json.dumps(rows))
        return
    print("Median time of an iteration [ms], one thread")
    print(
        f"{'scene':14} {'nx':>3} {'nu':>3} {'N':>3}  {'Crocoddyl FDDP':>14} {'mcplan, DDP part':>17} {'mcplan, all':>12}"
    )
    for row in rows:
        print(
            f"{row['scene']:14} {row['nx']:3} {row['nu']:3} {row['N']:3}  {row['crocoddyl']['iteration_ms']:14.3f} "
            f"{row['mcplan_ddp']:17.3f} {row['mcplan']['iteration']:12.3f}"
        )
    print("DDP part: linearise, backward, line search. All: also forward value functions, pricing, switches.")


if __name__ == "__main__":
    main()
