"""Table II of Wang et al.: the prediction horizon that a walk needs, by the planner's measures and by tracking it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .wang_runs import METHODS, NOISE, TERRAINS, TIME_LIMIT_S, Config, Run
from .wang_tables import TITLES, find, horizons
from .wang_tracking import LONGEST, ROBOT, Tracked

#: Minimum number of predicted steps; None: fails.
PUBLISHED: dict[str, tuple[int | None, ...]] = {
    "single": (1, 1, 1),
    "com": (None, None, None),
    "rectangle": (2, 1, 2),
    "point": (2, 2, 2),
}

#: A walk is called quiet when its cost per metre is at most so many times that of the baseline with one predicted step on
#: the same terrain. Chosen after the first runs: candidates 2 and 3 cost 0.8 to 1.9 times as much with two predicted
#: steps and 3 to 5 times with one.
QUIET_COST = 2.5

#: Columns of what was tracked: transcription, with limits of speed and contacts of links, key of the row.
COLUMNS = (
    ("euler", True, "followed"),
    ("euler", False, "followed_without"),
    ("trapezoidal", True, "followed_trapezoidal"),
    ("trapezoidal", False, "followed_trapezoidal_without"),
)


def quiet(run: Run, runs: list[Run]) -> bool | None:
    """Whether it succeeds at a cost near the baseline's; None without a baseline that succeeds."""
    baseline = find(runs, run.config.terrain, "single", 1)
    if baseline is None or not baseline.success:
        return None
    return run.success and run.cost_per_m <= QUIET_COST * baseline.cost_per_m


def followed(tracked: Sequence[Tracked], limits: bool) -> list[Tracked]:
    """Of each walk the run that says whether it is followed; without limits one that was followed with them counts."""
    return [t for t in tracked if t.limits == limits or (not limits and t.followed)]


def rows(everything: list[Run], tracked: Sequence[Tracked]) -> list[dict[str, Any]]:
    """One row per method and terrain: minimum number of predicted steps; "fail", or "" where nothing was run.

    Args:
        everything: Walks of both transcriptions.
        tracked: Runs of the simulation, of all starts.
    """
    runs = [run for run in everything if run.config.transcription == "euler"]
    out = []
    for method in METHODS:
        for terrain, published in zip(TERRAINS, PUBLISHED[method], strict=True):
            tried = [run for p in horizons(runs, method) if (run := find(runs, terrain, method, p)) is not None]
            good = [run.config.predicted for run in tried if run.success]
            near = [run.config.predicted for run in tried if quiet(run, runs)]
            nothing: int | str = "fail" if tried else ""
            row: dict[str, Any] = {
                "method": method,
                "terrain": terrain,
                "published": "fail" if published is None else published,
                "tried_up_to": max((run.config.predicted for run in tried), default=""),
                "converges": min(good, default=nothing),
                "converges_and_quiet": min(near, default=nothing),
            }
            here = [run for run in everything if _place(run.config) == (method, terrain, 0)]
            results = [t for t in tracked if _place(t.config) == (method, terrain, 0)]
            for transcription, limits, key in COLUMNS:
                of_form = [run for run in here if run.config.transcription == transcription]
                row[key] = _least_followed(of_form, followed(results, limits))
            failures = [f"{_horizon(run)}: {run.failure}" for run in here if not run.success]
            out.append({**row, "failures": "; ".join(failures)})
    return out


def _place(config: Config) -> tuple[str, str, int]:
    return config.method, config.terrain, config.seed


def _horizon(run: Run) -> str:
    form = "" if run.config.transcription == "euler" else f", {run.config.transcription}"
    return f"{run.config.predicted}-step PH{form}"


def _least_followed(runs: list[Run], results: list[Tracked]) -> int | str:
    """Of walks of one form: the least horizon that was followed, "fail" where none was, "" where that is not known."""
    verdicts = {t.config: t.followed for t in results} | {run.config: False for run in runs if not run.success}
    known = [verdicts[run.config] for run in runs if run.config in verdicts]
    least = [run.config.predicted for run in runs if verdicts.get(run.config)]
    return min(least, default="fail" if known else "")


def table(rows: list[dict[str, Any]], runs: list[Run], tracked: Sequence[Tracked]) -> list[str]:
    """Table II as Markdown, what its columns mean, and what did not end well; runs: those in the paper's form."""
    lines = [
        "| method | terrain | paper | followed | torque limits alone | trapezoidal: followed | torque limits alone "
        "| converges | and quiet |",
        "|---" * 9 + "|",
    ]
    keys = ["published", *(key for _, _, key in COLUMNS), "converges", "converges_and_quiet"]
    for row in rows:
        cells = [TITLES[row["method"]], row["terrain"], *(str(row[key]) for key in keys)]
        lines.append(f"| {' | '.join(cells)} |")
    lines += ["", *_compared(rows, tracked), "", *_meaning(runs, tracked), *_failures(rows)]
    return lines


def agreement(rows: list[dict[str, Any]], key: str) -> tuple[int, int]:
    """In how many cells a column says what the paper says, and of how many that were tried."""
    tried = [row for row in rows if row[key] != ""]
    return sum(row[key] == row["published"] for row in tried), len(tried)


def relapses(tracked: Sequence[Tracked], limits: bool) -> list[Config]:
    """Walks from the scene's start that fell though one of the same form with a shorter horizon was followed."""
    results = [t for t in followed(tracked, limits) if not t.config.seed]

    def shorter_followed(c: Config) -> bool:
        same = [t for t in results if (_place(t.config), t.config.transcription) == (_place(c), c.transcription)]
        return any(t.followed and t.config.predicted < c.predicted for t in same)

    return [t.config for t in results if not t.followed and shorter_followed(t.config)]


def _compared(rows: list[dict[str, Any]], tracked: Sequence[Tracked]) -> list[str]:
    counts = ["{} of {}".format(*agreement(rows, key)) for key in (*(k for _, _, k in COLUMNS), "converges")]
    counts.append("{} of {}".format(*agreement(rows, "converges_and_quiet")))
    again = "; ".join(config.title for config in relapses(tracked, True))
    lines = [f"Cells as in the paper, from left to right: {', '.join(counts)}."]
    if again:
        lines += [f"Walks that fell (`followed`) though one with a shorter horizon did not: {again}."]
    return lines


def _meaning(runs: list[Run], tracked: Sequence[Tracked]) -> list[str]:
    drift = max((cycle["drift_com_m"] for run in runs if run.success for cycle in run.cycles), default=0.0)
    longest = max((t.config.predicted for t in tracked), default=LONGEST)
    return [
        "The least number of predicted steps with which a walk from the scene's start is a success. In the paper it is one",
        "if a whole-body inverse dynamics controller can track it in simulation. Here:",
        "",
        f"- **followed**: [`mcplan track`](../tracking.md) with robot `{ROBOT}` comes to the end of the walk without a fall, in",
        "  MuJoCo, by joint torques within the URDF's limits, which fall with speed, with links that make contact with each",
        f"  other and with the ground. Walks with up to {longest} predicted steps were tracked, each once; one that does not",
        "  converge counts as not followed.",
        "- **torque limits alone**: the same, but walks that fell were tracked again with full torque at any speed and no",
        "  contacts but those of soles. A walk that is followed with these limits counts as followed without them.",
        '- **trapezoidal**: walks with `transcription="trapezoidal"`, planned alike otherwise, which are the exact integral of',
        "  their forces, with one and two predicted steps. The motion of the paper's Euler steps is not: its forces, replayed",
        f"  from the start of a step, miss its end by up to {100 * drift:.1f} cm. What is tracked is the integral of each phase",
        "  from its first node, and where the next phase begins the reference jumps.",
        "- **converges**: every cycle converged within its constraints. **And quiet**: the cost per metre, too, is at most",
        f"  {QUIET_COST:g} times that of the baseline with one predicted step on that terrain, a limit chosen between two groups",
        "  that we saw (0.8 to 1.9 times with two predicted steps, 3 to 5 times with one).",
        "",
        "What differs from the paper: its controller is another (task-space inverse dynamics of Del Prete and Mansard), and it",
        "states neither its simulator, gains and limits nor the paths of its swinging feet. The walks here use the middle 0.80",
        "of the sole (`sole_ratio`) and all of the friction.",
    ]


def _failures(rows: list[dict[str, Any]]) -> list[str]:
    failures = [row for row in rows if row["failures"]]
    if not failures:
        return []
    return [
        "",
        "Walks that did not converge:",
        "",
        *(f"- {TITLES[row['method']]}, {row['terrain']}: {row['failures']}" for row in failures),
        "",
        f"A cycle of `com` has at most {TIME_LIMIT_S['com']:g} s. It fails because its first step, with no angular momentum",
        "in the prediction, ends with the CoM moving past the next stance foot: nothing catches it within the bounds on the",
        "rate of L.",
    ]


def start_rows(tracked: Sequence[Tracked]) -> list[dict[str, Any]]:
    """One row per walk with one or two predicted steps in the paper's form: how many starts were followed."""
    out = []
    form = [t for t in tracked if t.config.transcription == "euler"]
    for method in METHODS:
        for predicted in (1, 2):
            for terrain in TERRAINS:
                cell = (method, predicted, terrain)
                here = [t for t in form if (t.config.method, t.config.predicted, t.config.terrain) == cell]
                with_limits, without = followed(here, True), followed(here, False)
                if with_limits:
                    out.append(
                        {
                            "method": method,
                            "predicted": predicted,
                            "terrain": terrain,
                            "starts": len(with_limits),
                            "followed": sum(t.followed for t in with_limits),
                            "followed_without": sum(t.followed for t in without),
                        }
                    )
    return out


def starts(rows: list[dict[str, Any]]) -> list[str]:
    """How many starts were followed, as Markdown; nothing where no noisy one was tracked."""
    if max((row["starts"] for row in rows), default=0) < 2:
        return []
    lines = [
        "",
        f"From the scene's start and from noisy ones, each number moved by up to {100 * NOISE:.0f} % of its scale, how many",
        "walks were tracked (those that converged) and how many of them were followed, in the paper's form:",
        "",
        "| method | PH | terrain | tracked | followed | torque limits alone |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        cells = [TITLES[row["method"]], *(str(row[k]) for k in ("predicted", "terrain", "starts", "followed"))]
        lines.append(f"| {' | '.join([*cells, str(row['followed_without'])])} |")
    return lines


def run_rows(tracked: Sequence[Tracked]) -> list[dict[str, Any]]:
    """One row per run of the simulation, for a CSV file."""
    return [
        {
            **{key: getattr(t.config, key) for key in ("terrain", "method", "predicted", "seed", "transcription")},
            "limits": t.limits,
            "followed": t.followed,
            "duration_s": t.duration_s,
            "completed_s": t.completed_s,
            "refused": t.refused,
            **(t.measures or {}),
        }
        for t in sorted(tracked, key=lambda t: t.refused != "")
    ]


def details(tracked: Sequence[Tracked]) -> list[str]:
    """The runs from the scene's start, as Markdown."""
    here = [t for t in tracked if not t.config.seed]
    if not here:
        return []
    lines = [
        "",
        "Each run from the scene's start; CoM: its distance from the plan until the end or the fall; base: in the ground plane",
        "from where the plan ends.",
        "",
        "| method | PH | terrain | transcription | limits | how it ends | CoM rms, largest | base at the end |",
        "|---|---|---|---|---|---|---|---|",
    ]
    order = {terrain: i for i, terrain in enumerate(TERRAINS)}
    for t in sorted(
        here,
        key=lambda t: (
            METHODS.index(t.config.method),
            t.config.predicted,
            order[t.config.terrain],
            t.config.transcription,
        ),
    ):
        c, m = t.config, t.measures or {}
        com = f"{1e3 * m['com_rms_m']:.1f} mm, {1e3 * m['com_max_m']:.0f} mm" if m else "-"
        base = f"{1e3 * m['final_base_error_m']:.0f} mm" if m and t.followed else "-"
        which = "all" if t.limits else "torque"
        lines.append(
            f"| `{c.method}` | {c.predicted} | {c.terrain} | {c.transcription} | {which} | {t.ending} | {com} | {base} |"
        )
    return lines
