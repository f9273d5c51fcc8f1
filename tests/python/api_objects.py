"""Valid objects of every kind that the API fuzz test starts from: `python api_objects.py FILE` pickles them."""

from __future__ import annotations

import pickle
import sys
from pathlib import Path
from typing import Any

import mcplan as mp
from mcplan import _core


def valid_objects() -> list[Any]:
    """Scenes, robots, options, and a plan of each force law and of each planner."""
    humanoid, walker, scene = mp.load_robot("humanoid44"), mp.load_robot("talos_wang"), mp.load_scene("flat")
    wrench = mp.plan(scene, humanoid, phases=6, max_iterations=8, restarts=0).plan
    pendulum = mp.plan(scene, humanoid, phases=6, max_iterations=8, restarts=0, model="lipm").plan
    walk = mp.walk("rubbles", walker, cycles=1, lookahead=1)
    task = mp.load_planar_task("chimney")
    whole_body = mp.whole_body(task, forces="uniform", minimise="none", max_iterations=3).plan
    climb = mp.whole_body("climbing", forces="parameters", minimise="none", max_iterations=3).plan
    scenes = [scene, mp.load_scene("gap_with_rail"), mp.load_scene("rubbles")]
    return [*scenes, humanoid, walker, wrench, pendulum, walk.plan, task, whole_body, climb]


def save(path: Path) -> None:
    with path.open("wb") as file:
        pickle.dump(valid_objects(), file)


if __name__ == "__main__":
    assert _core.__version__ == mp.__version__
    save(Path(sys.argv[1]))
