"""Random solves of every engine: `python api_solves.py SEED CALLS SEEDS_FILE LOG`.

Among random calls of everything bound (api_fuzz) few come to an engine with input that it takes. Here each call is one: a
valid scene, robot, task or plan with up to two edits each, and options with up to four. What an engine refuses ends in a typed
error; what it takes ends with a result, within the CPU time of a call.
"""

from __future__ import annotations

import copy
from typing import Any

from api_fuzz import Fuzzer, main
from api_stage_problems import stage_problem
from mcplan import _core, ipm

LIMITS_S = [0.001, 0.01, 0.03, 0.1]
LONG_WAYS = [1, 2, 5, 40, 100, 288]  # phases
EDITS, OPTION_EDITS = [0, 0, 1, 1, 2], [0, 1, 2, 4]


class SolveFuzzer(Fuzzer):
    """Makes random solves, with inputs of its own for each."""

    def step(self) -> None:
        self.rng.choice([self.search, self.search, self.walk, self.whole_body, self.stages])()

    def solve(self, text: str, engine: Any, inputs: list[Any], options: Any, run: Any) -> None:
        options.logger = None
        options.time_limit_s = min(options.time_limit_s, self.rng.choice(LIMITS_S))
        self.guarded(f"{text} for {options.time_limit_s} s", lambda: run(engine(*inputs, options)))

    def search(self) -> None:
        options = self.edited(_core.ddp.Options(), OPTION_EDITS)
        if self.rng.random() < 0.3:
            options.phases = self.rng.choice(LONG_WAYS)
        warm = [self.varied("Plan", [0, 1, 2])] if self.rng.random() < 0.3 else []
        inputs = [self.varied("Scene"), self.varied("Robot")]
        self.solve("ddp", _core.ddp.SwitchedDdp, inputs, options, lambda planner: planner.solve(*warm))

    def walk(self) -> None:
        options = self.edited(_core.rhp.Options(), OPTION_EDITS)
        inputs = [self.varied("Scene"), self.varied("Robot")]
        self.solve("rhp", _core.rhp.RecedingHorizon, inputs, options, lambda walker: walker.step())

    def whole_body(self) -> None:
        options = self.edited(_core.sip.Options(), OPTION_EDITS)
        self.solve("sip", _core.sip.Planner, [self.varied("PlanarTask")], options, lambda planner: planner.solve())

    def stages(self) -> None:
        solver, limit_s = self.rng.choice(["ipm", "ipopt", "auto"]), self.rng.choice(LIMITS_S)

        def run() -> None:
            problem = stage_problem(self.rng, self.reenter)
            if self.rng.random() < 0.2:
                ipm.check_derivatives(problem)
            result = ipm.solve(problem, solver=solver, time_limit_s=limit_s)
            ipm.solve(problem, result, solver=solver, time_limit_s=limit_s, adaptive_barrier=True)

        self.guarded(f"stages by {solver} for {limit_s} s", run)

    def varied(self, name: str, edits: list[int] = EDITS) -> Any:
        return self.edited(copy.deepcopy(self.rng.choice(self.valid[f"mcplan._core.{name}"])), edits)

    def edited(self, value: Any, edits: list[int]) -> Any:
        for _ in range(self.rng.choice(edits)):
            self.guarded("edit", lambda: self.values.edit(value))
        return value


if __name__ == "__main__":
    main(SolveFuzzer)
