"""The program of a horizon arranged in stages, for fatrop: the same variables and rows, in another order.

Stage i has states x_i and controls u_i. The rows are those of x_{i+1} = F(x_i, u_i), then the path rows of stage i, for one
stage after the other. Forward Euler has a stage for each node; linear forces have one for each control node, so that a
boundary between two phases has two.

- States: CoM, velocity, angular momentum where there is one; footholds and durations in use, which stay as they are; with
  linear forces, acceleration and momentum rate of the node, because the interval before depends on them.
- Controls: forces; footholds and durations at the first stage that uses them; with linear forces, acceleration and momentum
  rate of the next node. Accelerations and rates that no interval before depends on are inserted into the rows.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass, field
from typing import Any

import casadi as ca
import numpy as np
from horizon import Horizon, N, Settings
from program import Outcome, Program, Values, solve_with
from walker import Walker

Name = Any  # of a variable: its kind, then where it belongs


@dataclass
class Stage:
    """What a stage has of its own; what lasts from stage to stage is added to it later."""

    states: list[Name]
    controls: list[Name]  # forces
    ahead: list[Name] = field(default_factory=list)  # states of the next stage that are controls here
    inserted: list[Name] = field(default_factory=list)
    terms: list[ca.SX] = field(default_factory=list)
    rows: list[tuple[ca.SX, list[float], list[float]]] = field(default_factory=list)
    motion: dict[Name, ca.SX] = field(default_factory=dict)  # rows that say what a state of the next stage is
    local: dict[Name, ca.SX] = field(default_factory=dict)  # the stage's own copy of each variable

    @property
    def has(self) -> set[Name]:
        return {*self.states, *self.controls, *self.ahead, *self.inserted}


def stages_of(horizon: Horizon) -> list[Stage]:
    """The stages with their variables but for footholds and durations."""
    x = horizon.program.x

    def known(names: Iterable[Name]) -> list[Name]:
        return [name for name in names if name in x]

    out = []
    for s, q, k in horizon.control_nodes():
        g = 3 * N * s + N * q + k
        motion = [("c", g), ("v", g)] + ([("L", g)] if horizon.euler or horizon.model(s) == "single" else [])
        accelerations = [("a", s, q, k), ("R", s, q, k)]
        forces = [name for name in x if name[0] == "f" and name[3:] == (s, q, k)]
        if horizon.euler or k == 0:
            stage = Stage(known(motion), forces, inserted=known(accelerations))
        else:
            stage = Stage(known(motion + accelerations), forces)
        if not horizon.euler and k < N:
            stage.ahead = known([("a", s, q, k + 1), ("R", s, q, k + 1)])
        out.append(stage)
    if horizon.euler:
        end = len(out)
        out.append(Stage(known([("c", end), ("v", end), ("L", end)]), []))
    return out


class Arrangement:
    """Every row and term of the objective of a horizon at its stage."""

    def __init__(self, horizon: Horizon) -> None:
        self.program = horizon.program
        self.stages = stages_of(horizon)
        self._owner = {entry.element_hash(): name for name, x in self.program.x.items() for entry in ca.vertsplit(x)}
        self._used: dict[Name, tuple[int, int]] = {}  # first and last stage of a foothold or duration
        self._place_all()
        self._carry()

    def _names(self, expression: ca.SX) -> set[Name]:
        hashes = (symbol.element_hash() for symbol in ca.symvar(expression))
        return {self._owner[each] for each in hashes if each in self._owner}

    def _place_all(self) -> None:
        """First what belongs to one stage only: it says which footholds and durations a stage uses anyway."""
        inserted = {name for stage in self.stages for name in stage.inserted}
        skipped = {index for name, (index, _) in self.program.definitions.items() if name in inserted}
        first, several = 0, []
        items: list[tuple[ca.SX, list[float] | None, list[float] | None]] = [
            (term, None, None) for term in self.program.terms
        ]
        for index, row in enumerate(self.program.rows):
            last = first + row.numel()
            if index not in skipped:
                items.append((row, self.program.low[first:last], self.program.high[first:last]))
            first = last
        for item in items:
            names = self._names(item[0])
            where = self._possible(names)
            if len(where) == 1:
                self._place(where[0], item, names)
            elif names:
                several.append((item, names))
        for item, names in several:
            self._place(min(self._possible(names), key=lambda i: self._stretch(i, names)), item, names)
        for i, stage in enumerate(self.stages):
            for name in stage.inserted:
                low, high = self.program.bounds[name]
                _, expression = self.program.definitions[name]
                self._use(i, self._names(expression))
                if np.all(np.isfinite(low)):
                    stage.rows.append((self.program.x[name], list(low), list(high)))

    def _possible(self, names: set[Name]) -> list[int]:
        own = {name for name in names if name[0] not in "wT"}
        where = [i for i, stage in enumerate(self.stages) if own <= stage.has]
        if where:
            return where
        pairs = zip(self.stages, self.stages[1:], strict=False)
        return [i for i, (stage, then) in enumerate(pairs) if own <= stage.has | set(then.states)]

    def _stretch(self, i: int, names: set[Name]) -> int:
        """Stages for which footholds and durations would have to be kept longer if a row were at stage i."""
        spans = [self._used[name] for name in names if name in self._used]
        return sum(max(first - i, 0) + max(i - last, 0) for first, last in spans)

    def _use(self, i: int, names: set[Name]) -> None:
        for name in names:
            if name[0] in "wT":
                first, last = self._used.get(name, (i, i))
                self._used[name] = min(first, i), max(last, i)

    def _place(self, i: int, item: tuple, names: set[Name]) -> None:
        stage, (expression, low, high) = self.stages[i], item
        self._use(i, names)
        coming = [name for name in names if name[0] not in "wT" and name not in stage.has]
        if low is None:
            stage.terms.append(expression)
        elif coming:
            stage.motion[coming[0]] = expression
        else:
            stage.rows.append((expression, low, high))

    def _carry(self) -> None:
        for name, (first, last) in self._used.items():
            self.stages[first].controls.append(name)
            for stage in self.stages[first + 1 : last + 1]:
                stage.states.append(name)


class StagedProgram:
    """Solves as Program does, with names, guesses and solutions of the horizon's own program."""

    def __init__(self, horizon: Horizon, plugin: str, options: dict[str, Any]) -> None:
        self.program: Program = horizon.program
        self.x, self.p = self.program.x, self.program.p
        self.stages = Arrangement(horizon).stages
        self.names: list[Name] = []
        self.bounds: list[tuple[np.ndarray, np.ndarray]] = []
        self._first: dict[Name, int] = {}
        x, g, low, high, f, sizes = [], [], [], [], ca.SX(0), {"nx": [], "nu": [], "ng": []}
        for stage in self.stages:
            self._copy_variables(stage)
        original: dict[Name, ca.SX] = {}
        for i, stage in enumerate(self.stages):
            then = self.stages[i + 1] if i + 1 < len(self.stages) else Stage([], [])
            terms, motion, rows, inserted = self._localised(stage)
            f += sum(terms, ca.SX(0))
            gaps = [motion[name] if name in motion else then.local[name] - stage.local[name] for name in then.states]
            gaps = [self._with_next(gap, then) for gap in gaps]
            g += [*gaps, *rows]
            width = sum(gap.numel() for gap in gaps)
            low += [0.0] * width + [value for row in stage.rows for value in row[1]]
            high += [0.0] * width + [value for row in stage.rows for value in row[2]]
            x += list(stage.local.values())
            sizes["nx"].append(sum(self.x[name].numel() for name in stage.states))
            sizes["nu"].append(sum(self.x[name].numel() for name in [*stage.controls, *stage.ahead]))
            sizes["ng"].append(sum(row.numel() for row in rows))
            for name, value in [*stage.local.items(), *inserted.items()]:
                original.setdefault(name, value)
        self.low, self.high, self.sizes = low, high, sizes
        self._build(ca.vertcat(*x), f, ca.vertcat(*g), original, plugin, options)

    def _copy_variables(self, stage: Stage) -> None:
        """The stage's own symbols; bounds only where a variable comes up first."""
        for name in [*stage.states, *stage.controls, *stage.ahead]:
            stage.local[name] = ca.SX.sym(f"{name}", self.x[name].numel())
            low, high = self.program.bounds[name]
            # A control that is the next stage's state is bounded there.
            free = name in stage.ahead or name in self._first
            self.bounds.append((np.full_like(low, -np.inf), np.full_like(high, np.inf)) if free else (low, high))
            if name not in stage.ahead:
                self._first.setdefault(name, len(self.names))
            self.names.append(name)

    def _localised(self, stage: Stage) -> tuple[list[ca.SX], dict[Name, ca.SX], list[ca.SX], dict[Name, ca.SX]]:
        """Terms, rows of motion, path rows and inserted variables in the stage's own symbols."""
        inserted = {name: self.program.definitions[name][1] for name in stage.inserted}
        rows = [row[0] for row in stage.rows]
        everything = [*stage.terms, *stage.motion.values(), *rows]
        if inserted:
            everything = ca.substitute(everything, [self.x[name] for name in inserted], list(inserted.values()))
        everything = ca.substitute(
            [*everything, *inserted.values()], [self.x[name] for name in stage.local], list(stage.local.values())
        )
        a = len(stage.terms)
        b = a + len(stage.motion)
        c = b + len(rows)
        motion = dict(zip(stage.motion, everything[a:b], strict=True))
        return everything[:a], motion, everything[b:c], dict(zip(inserted, everything[c:], strict=True))

    def _with_next(self, gap: ca.SX, then: Stage) -> ca.SX:
        """A row of motion with the next stage's symbols for its states."""
        return ca.substitute([gap], [self.x[name] for name in then.states], [then.local[name] for name in then.states])[
            0
        ]

    def _build(
        self, x: ca.SX, f: ca.SX, g: ca.SX, original: dict[Name, ca.SX], plugin: str, options: dict[str, Any]
    ) -> None:
        p = ca.vertcat(*(ca.vec(each) for each in self.p.values()))
        structure: dict[str, Any] = {}
        if plugin == "fatrop":
            structure = self.sizes | {"structure_detection": "manual", "N": len(self.stages) - 1}
            structure["equality"] = [a == b for a, b in zip(self.low, self.high, strict=True)]
        self.solver = ca.nlpsol(
            "staged",
            plugin,
            {"x": x, "p": p, "f": f, "g": g},
            {"print_time": False, "error_on_fail": False} | structure | options,
        )
        self._original = ca.Function("original", [x, p], [ca.vertcat(*(original[name] for name in self.x))])

    def solve(self, guess: Values, parameters: Values, fixed: Values) -> Outcome:
        """Solve from a guess of the horizon's own variables; those in `fixed` are held at the given values."""
        bounds = list(self.bounds)
        for name, value in fixed.items():
            bounds[self._first[name]] = (value, value)
        p = self.program.vector(parameters)
        return solve_with(
            self.program,
            self.solver,
            {
                "x0": np.concatenate([np.ravel(guess[name]) for name in self.names]),
                "p": p,
                "lbx": np.concatenate([low for low, _ in bounds]),
                "ubx": np.concatenate([high for _, high in bounds]),
                "lbg": self.low,
                "ubg": self.high,
            },
            lambda x: self._original(x, p).full().ravel(),
        )


class StagedHorizon(Horizon):
    """A horizon whose program is solved stage by stage, for Loop."""

    def __init__(
        self, walker: Walker, settings: Settings, first_foot: int, plugin: str, options: dict[Hashable, Any]
    ) -> None:
        super().__init__(walker, settings, first_foot)
        self.whole = self.program
        self.program = StagedProgram(self, plugin, options)  # type: ignore[assignment]
