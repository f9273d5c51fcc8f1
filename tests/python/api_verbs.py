"""Random calls of the verbs of mcplan, such as mcplan.plan: `python api_verbs.py SEED CALLS SEEDS_FILE LOG`.

The arguments are drawn by the verbs' own annotations and the options by the setters of their classes, between random calls
of what is bound (api_fuzz), which edit the plans, scenes and robots. What a verb may raise is one of mcplan's own errors.
"""

from __future__ import annotations

import dataclasses
import inspect
import warnings
from pathlib import Path
from typing import Any

import mcplan as mp
from api_fuzz import SOLVE_LIMIT_S, Fuzzer, main
from api_values import JUNK, TEXTS
from mcplan import _core, errors
from mcplan.tracking import Options as TrackingOptions

RAISED = (
    errors.InvalidInput,
    errors.UnknownName,
    errors.MissingExtra,
    errors.PlanViolated,
    errors.Interrupted,
    OSError,
)
VERBS = [name for name in mp.__all__ if inspect.isfunction(getattr(mp, name))]
OPTIONS: dict[str, type] = {"plan": _core.ddp.Options, "replan": _core.ddp.Options, "walk": mp.rhp.Options}
OPTIONS |= {"receding_horizon": mp.rhp.Options, "whole_body": mp.sip.Options}
NAMES = ["flat", "gap", "humanoid44", "talos_wang", "climber9", "chimney", "climbing", "no_such_name", *TEXTS]
#: Keeps every call short; a large value is replaced by this one.
LIMITS = {"time_limit": SOLVE_LIMIT_S, "time_limit_s": SOLVE_LIMIT_S, "max_iterations": 5, "cycles": 2, "restarts": 1}
MAX_SHOWN_S = 20.0  # of plans that are drawn, frame by frame


class VerbFuzzer(Fuzzer):
    """Makes random calls of verbs on the pool of a Fuzzer, between the calls that it makes itself."""

    def step(self) -> None:
        if self.depth or self.rng.random() < 0.5:
            super().step()
            return
        name = self.rng.choice(VERBS)
        given = self.given(name)
        # A proof and a simulation take longer than a test has: the one is left out, the other refused in time.
        if name == "whole_body":
            given.pop("certify", None)
        if name == "track":
            given[self.rng.choice([field.name for field in dataclasses.fields(TrackingOptions)])] = object()
        if name == "show" and not self.short(given.get("plan")):
            return
        shown = ", ".join(f"{key}={ascii(value)[:60]}" for key, value in given.items())
        self.verb(f"mcplan.{name}({shown})", name, given)

    def given(self, name: str) -> dict[str, Any]:
        """Arguments of a verb: those without a default, and some of the others."""
        given: dict[str, Any] = {}
        kind = OPTIONS.get(name)
        for parameter in inspect.signature(getattr(mp, name)).parameters.values():
            if parameter.kind in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
                continue
            if kind and parameter.name == "options" and self.rng.random() < 0.3:
                given["options"] = self.values.instance(f"{kind.__module__}.{kind.__qualname__}")
            elif parameter.default is parameter.empty or self.rng.random() < 0.3:
                given[parameter.name] = self.drawn(parameter.annotation)
        if name == "check":
            for key in ("scene", "robot", "tolerances", "until_s", "self_collision"):
                if self.rng.random() < 0.2:
                    annotation = {"until_s": "float", "self_collision": "bool"}.get(key, key.capitalize())
                    given[key] = self.drawn(annotation)
        if kind is None:
            return given
        setters = {p.name: p.type for p in self.interface.properties if p.owner is kind and p.type}
        for option in self.rng.sample(list(setters), self.rng.randint(0, 3)):
            given[option] = self.values.of(setters[option] or "object")
        for option, limit in LIMITS.items():
            value = given.get(option, limit if option == "time_limit" or option in setters else None)
            too_long = isinstance(value, int | float) and not value <= limit
            if value is not None:
                given[option] = limit if too_long else value
        return {key: value for key, value in given.items() if key not in ("time_limit_s",)}

    def drawn(self, annotation: str) -> Any:
        """A value for an annotation such as "Scene | str | Path | None"; now and then one of another type."""
        if self.rng.random() < 0.1:
            pooled = [value for values in self.pool.values() for value in values]
            return self.rng.choice([*JUNK, *pooled])
        kind = self.rng.choice(annotation.split(" | "))
        core = f"{_core.__name__}.{kind}"
        if core in self.interface.classes:
            return self.values.instance(core)
        simple = {
            "None": lambda: None,
            "str": lambda: self.rng.choice(NAMES),
            "Path": lambda: Path(self.rng.choice(NAMES).encode("utf-8", "replace").decode()),
            "float": self.values.number,
            "int": self.values.integer,
            "bool": lambda: self.rng.random() < 0.5,
        }
        return simple.get(kind, self.values.anything)()

    @staticmethod
    def short(plan: Any) -> bool:
        """Whether a plan is drawn in a moment; what is no plan is refused in one."""
        try:
            return not isinstance(plan, mp.Plan | mp.PlanarPlan) or plan.duration() < MAX_SHOWN_S
        except errors.InvalidInput:
            return True

    def verb(self, text: str, name: str, given: dict[str, Any]) -> None:
        def make() -> Any:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    result = getattr(mp, name)(**given)
                except RAISED:
                    return None
                except ValueError as error:
                    if "raised in a callback" in str(error):
                        return None
                    raise AssertionError(f"{text} raised {error!r}") from error
                except TypeError as error:
                    raise AssertionError(f"{text} raised {error!r}") from error
            return [getattr(result, "plan", result), result]

        self.guarded(text, make)


if __name__ == "__main__":
    main(VerbFuzzer)
