"""Many scenes, robots, options and seeds planned at once, on this machine or on several.

    mcplan sweep examples/sweep.toml --out out/sweep --jobs 2

    sweep = mp.load_sweep("out/sweep")

``run`` is the command as a function; ``pool`` runs tasks in processes that may die. docs/sweeps.md says how it works.
"""

from mcplan.sweep.results import Plans, Sweep, load_sweep
from mcplan.sweep.runner import How, Outcome, Progress, run

__all__ = ["How", "Outcome", "Plans", "Progress", "Sweep", "load_sweep", "run"]
