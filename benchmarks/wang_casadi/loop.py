"""The receding loop: guesses, warm starts, the state handed on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from horizon import DOUBLE_SUPPORT, FORCE_UNIT, LEVER, SINGLE_SUPPORT, Horizon, N, Settings, relaxation
from program import Outcome, Values
from walker import Array, Patch, Walker

STEP, FIRST_STEP = 0.3, 0.25  # [m] of the guess


@dataclass(frozen=True)
class State:
    """Where the robot is at the start of a cycle."""

    com: Array
    velocity: Array
    momentum: Array
    feet: Array  # 2 x 3
    patches: tuple[Patch, Patch]

    @staticmethod
    def start(walker: Walker) -> State:
        return State(walker.start_com, np.zeros(3), np.zeros(3), walker.start_feet, walker.start_patches)


@dataclass
class Cycle:
    """A solved horizon."""

    index: int
    start: State
    outcome: Outcome
    footholds: Array  # lookahead x 3 [m]
    durations: Array  # [s] of the executed step
    end: State


class Loop:
    """Cycle after cycle of one walker with one setting; the two programs (left or right first) are built once."""

    def __init__(self, walker: Walker, settings: Settings, horizons: dict[int, Horizon] | None = None) -> None:
        self.walker, self.settings = walker, settings
        self.state = State.start(walker)
        self.cycles: list[Cycle] = []
        self.origins: Array = np.zeros((0, 3))  # [m] from which the footholds of the last cycle were counted
        self.horizons = horizons if horizons is not None else {}

    def horizon(self, index: int) -> Horizon:
        foot, _ = self.walker.step(index)
        if foot not in self.horizons:
            self.horizons[foot] = Horizon(self.walker, self.settings, foot)
        return self.horizons[foot]

    def run(self, cycles: int) -> list[Cycle]:
        """Until `cycles` are done or one fails."""
        while len(self.cycles) < cycles and (not self.cycles or self.cycles[-1].outcome.success):
            self.step()
        return self.cycles

    def step(self, state: State | None = None, perturb: Callable[[Values], Values] = lambda guess: guess) -> Cycle:
        """One cycle from a state, by default the one handed on, and a guess that `perturb` may change."""
        index, start = len(self.cycles), state or self.state
        horizon = self.horizon(index)
        foot = horizon.first_foot
        patches = [self.walker.step(index + i)[1] for i in range(self.settings.lookahead)]
        if index < 2:
            footholds = self.nominal_footholds(index, start, patches)
            guess = self.nominal(horizon, start, footholds, patches)
        else:
            footholds, guess = self.moved(self.cycles[index - 2], start, patches, horizon)
        self.origins = footholds
        outcome = horizon.program.solve(
            perturb(guess),
            self.parameters(start, foot, patches, footholds),
            {("c", 0): start.com, ("v", 0): start.velocity, ("L", 0): start.momentum},
        )
        self.cycles.append(self._finish(index, start, horizon, patches, footholds, outcome))
        self.state = self.cycles[-1].end
        return self.cycles[-1]

    def _finish(
        self, index: int, start: State, horizon: Horizon, patches: list[Patch], origins: Array, outcome: Outcome
    ) -> Cycle:
        x, foot = outcome.values, horizon.first_foot
        w = [x["w", i + 2] for i in range(len(patches))]
        if self.settings.form == "plain":
            footholds = np.array(w)
        else:
            footholds = np.array(
                [o + patch.frame[:, :2] @ each for o, patch, each in zip(origins, patches, w, strict=True)]
            )
        feet, stand = start.feet.copy(), list(start.patches)
        feet[foot], stand[foot] = footholds[0], patches[0]
        end = State(x["c", 3 * N], x["v", 3 * N], x["L", 3 * N], feet, (stand[0], stand[1]))
        durations = np.array([float(x["T", 0, q][0]) for q in range(3)])
        return Cycle(index, start, outcome, footholds, durations, end)

    def parameters(self, start: State, foot: int, patches: list[Patch], origins: Array) -> Values:
        """Of the program of one cycle."""
        out: Values = {"goal": self.walker.goal_com, ("p", 0): start.feet[foot], ("p", 1): start.feet[1 - foot]}
        all_patches = [start.patches[foot], start.patches[1 - foot], *patches]
        for j, patch in enumerate(all_patches):
            out["frame", j], out["friction", j] = patch.frame, np.array([patch.friction])
            if j >= 2:
                out["o", j] = origins[j - 2]
                out["E", j], out["e", j] = patch.edges
        return out

    # Guesses

    def nominal_footholds(self, index: int, start: State, patches: list[Patch]) -> Array:
        """Each foot 0.3 m ahead of where it was, the very first 0.25 m, on the patch."""
        feet = start.feet.copy()
        out = []
        for i, patch in enumerate(patches):
            foot = self.walker.step(index + i)[0]
            ahead = FIRST_STEP if index + i == 0 else STEP
            feet[foot] = patch.nearest(feet[foot] + [ahead, 0, 0], self.walker.half_size)
            out.append(feet[foot].copy())
        return np.array(out)

    def nominal(self, horizon: Horizon, start: State, footholds: Array, patches: list[Patch]) -> Values:
        """The guess that needs no earlier solution."""
        foot, nodes = horizon.first_foot, 3 * N * self.settings.lookahead
        centres = [start.feet[foot], start.feet[1 - foot], *footholds]
        frames = [patch.frame for patch in (start.patches[foot], start.patches[1 - foot], *patches)]
        out: Values = {}
        for name in horizon.program.x:
            kind = name[0]
            if kind == "c":
                out[name] = start.com + np.array([STEP * self.settings.lookahead * name[1] / nodes, 0, 0])
            elif kind == "v":
                out[name] = np.array([0.2, 0.0, 0.0])
            elif kind in ("L", "R", "a"):
                out[name] = np.zeros(3)
            elif kind == "T":
                out[name] = np.array([np.mean(SINGLE_SUPPORT if name[2] == 1 else DOUBLE_SUPPORT)])
            elif kind == "w":
                out[name] = centres[name[1]] if self.settings.form == "plain" else np.zeros(2)
            else:
                _, j, i, s, q, k = name
                points = horizon.points(s)
                share = self.walker.mass * self.walker.gravity / (len(points) * len(horizon.standing(s, q)))
                force = np.array([0, 0, share])
                if kind == "f":
                    out[name] = (force if self.settings.form == "plain" else frames[j].T @ force) / FORCE_UNIT
                else:
                    lever = centres[j] + frames[j][:, :2] @ points[i] - out["c", 3 * N * s + N * q + k]
                    most = self.walker.max_force / len(points)
                    out[name] = np.array(relaxation(lever / LEVER, force / most))
        return out

    def moved(self, before: Cycle, start: State, patches: list[Patch], horizon: Horizon) -> tuple[Array, Values]:
        """The solution of two cycles before, moved along with the CoM; footholds and guess."""
        by = start.com - before.start.com
        footholds = np.array(
            [patch.nearest(p + by, self.walker.half_size) for patch, p in zip(patches, before.footholds, strict=True)]
        )
        guess = dict(before.outcome.values)
        for name, value in guess.items():
            if name[0] == "c":
                guess[name] = value + by
            elif name[0] == "w":
                guess[name] = footholds[name[1] - 2] if self.settings.form == "plain" else np.zeros(2)
        assert set(guess) == set(horizon.program.x)
        return footholds, guess
