"""Random calls of everything the compiled module binds: `python api_fuzz.py SEED CALLS SEEDS_FILE LOG`.

One process, so that its parent sees a crash. Each call is written to the log before it is made.
"""

from __future__ import annotations

import copy
import faulthandler
import gc
import os
import pickle
import random
import resource
import signal
import sys
import tempfile
from collections.abc import Callable
from typing import Any

from api_signatures import Argument, Call, Interface, Property, full_name, interface_of
from api_values import CALLBACKS, Values
from mcplan import errors

MEMORY_LIMIT = 3 << 30  # address space [B]: a size that nobody checks becomes a MemoryError, not a full machine
CALL_LIMIT_S = 20.0  # CPU time of one call; beyond it the process is ended by SIGPROF
SOLVE_LIMIT_S = 0.03
ALLOWED = (errors.InvalidInput, errors.UnknownName, errors.PlanViolated, TypeError, ValueError)
FILES = ("save", "load")  # their paths may not exist
POOLED = 12  # objects kept of each class


class Unexpected(Exception):
    """A call raised what it must not raise."""


class Fuzzer:
    """Makes random calls on a pool of objects that starts with valid ones."""

    def __init__(self, seed: int, valid: list[Any], log: Callable[[str], None]) -> None:
        self.rng = random.Random(seed)
        self.interface: Interface = interface_of()
        self.pool: dict[str, list[Any]] = {}
        self.log = log
        self.values = Values(self.rng, self.interface, self.pool)
        self.valid: dict[str, list[Any]] = {}
        for value in valid:
            self.keep(value)
            self.valid.setdefault(full_name(type(value)), []).append(value)
        CALLBACKS.append(lambda *_: self.reenter())
        self.depth = 0
        self.methods: dict[str, list[Call]] = {}
        for call in self.interface.methods:
            assert call.owner
            self.methods.setdefault(full_name(call.owner), []).append(call)
        self.properties: dict[str, list[Property]] = {}
        for p in self.interface.properties:
            self.properties.setdefault(full_name(p.owner), []).append(p)

    def reenter(self) -> None:
        """What a logger may do to a planner that is at work: anything."""
        if self.depth < 3:
            self.depth += 1
            try:
                self.step()
            finally:
                self.depth -= 1

    def keep(self, value: Any) -> None:
        """Pool an object, or those of a list."""
        for item in value if isinstance(value, list | tuple) else [value]:
            name = full_name(type(item))
            if name in self.interface.classes:
                kept = self.pool.setdefault(name, [])
                kept.append(item)
                if len(kept) > POOLED:
                    del kept[self.rng.randrange(len(kept))]

    def step(self) -> None:
        draw = self.rng.random()
        if draw < 0.10:
            self.refresh()
        elif draw < 0.22:
            self.call(self.rng.choice(self.interface.constructors))
        elif draw < 0.32:
            self.call(self.rng.choice(self.interface.functions))
        else:
            name = self.rng.choice(list(self.pool))
            if self.rng.random() < 0.35:  # what has most to answer is asked most
                name = self.rng.choice([n for n in self.pool if self.methods.get(n)])
            target = self.rng.choice(self.pool[name])
            if draw < 0.62 and self.methods.get(name):
                self.call(self.rng.choice(self.methods[name]), target)
            elif draw < 0.92 and self.properties.get(name):
                self.property(target, self.rng.choice(self.properties[name]))
            else:
                self.protocol(target)

    def refresh(self) -> None:
        """A valid object again, whole or with an edit."""
        name = self.rng.choice(list(self.valid))
        value = copy.deepcopy(self.rng.choice(self.valid[name]))
        if self.rng.random() < 0.7:
            self.guarded(f"edit a {name}", lambda: self.values.edit(value))
        self.keep(value)

    def call(self, call: Call, target: Any = None) -> None:
        given, named = [], {}
        for argument in call.arguments:
            limits = argument.type.endswith("Options")  # without them a solve takes as long as it likes
            if argument.optional and not limits and self.rng.random() < 0.5:
                continue
            value = self.argument(argument)
            if argument.keyword_only or argument.optional:
                named[argument.name] = value
            else:
                given.append(value)
        if target is not None and self.bound_to_instance(call):
            given.insert(0, target)
        self.guarded(f"{call.text}({shown(given, named)})", lambda: call.target(*given, **named), call.name in FILES)

    @staticmethod
    def bound_to_instance(call: Call) -> bool:
        assert call.owner
        return not isinstance(vars(call.owner).get(call.name), staticmethod)

    def argument(self, argument: Argument) -> Any:
        if argument.name == "path":
            return self.rng.choice(["plan.npz", "no/such/folder/x.npz", "", "x.txt", "/dev/null", b"x", None, "x\0y"])
        value = self.values.of(argument.type)
        if argument.name == "time_limit_s" and isinstance(value, int | float):
            return min(value, SOLVE_LIMIT_S)
        if argument.type.endswith("Options") and hasattr(value, "time_limit_s") and value.time_limit_s > SOLVE_LIMIT_S:
            value.time_limit_s = SOLVE_LIMIT_S
        return value

    def property(self, target: Any, chosen: Property) -> None:
        where = f"{chosen.owner.__qualname__}.{chosen.name}"
        if chosen.type is None or self.rng.random() < 0.5:
            self.guarded(f"get {where}", lambda: getattr(target, chosen.name))
            return

        def assign() -> None:
            old = getattr(target, chosen.name)  # a reference into what is replaced
            setattr(target, chosen.name, self.values.replacement(target, chosen.name, chosen.type or "object"))
            self.keep(old)
            repr(old)

        self.guarded(f"set {where}", assign)

    def protocol(self, target: Any) -> None:
        kind = type(target)
        name = full_name(kind)

        def uninitialised() -> Any:
            blank = kind.__new__(kind)
            call = self.rng.choice(self.methods[name])
            given = [self.argument(a) for a in call.arguments]
            self.guarded(f"uninitialised {call.text}", lambda: call.target(blank, *given), call.name in FILES)

        def forget() -> None:
            self.pool[name].remove(target) if len(self.pool[name]) > 1 else None
            gc.collect()

        actions: dict[str, Callable[[], Any]] = {
            "repr": lambda: repr(target) and None,
            "str": lambda: str(target) and None,
            "copy": lambda: copy.copy(target),
            "deepcopy": lambda: copy.deepcopy(target),
            "pickle": lambda: pickle.loads(pickle.dumps(target)),
            "forget": forget,
            "compare": lambda: (target == target, hash(target), bool(target)) and None,
            "edit": lambda: self.values.edit(target),
            "again": lambda: target.__init__(),
        }
        if self.methods.get(name):
            actions["uninitialised"] = uninitialised
        action = self.rng.choice(list(actions))
        self.guarded(f"{action} {name}", actions[action])

    def guarded(self, text: str, make: Callable[[], Any], reads_files: bool = False) -> None:
        self.log(text)
        if not self.depth:
            signal.setitimer(signal.ITIMER_PROF, CALL_LIMIT_S)
        try:
            self.keep(make())
        except ALLOWED as error:
            str(error)
        except OSError:
            if not reads_files:
                raise
        finally:
            if not self.depth:
                signal.setitimer(signal.ITIMER_PROF, 0.0)


def shown(given: list[Any], named: dict[str, Any]) -> str:
    texts = [short(v) for v in given] + [f"{k}={short(v)}" for k, v in named.items()]
    return ", ".join(texts)


def short(value: Any) -> str:
    if isinstance(value, int | float | str | bool | None):
        return ascii(value)[:40]
    return f"<{type(value).__name__}>"


def main(kind: type[Fuzzer] = Fuzzer) -> None:
    seed, calls, valid_path, log_path = int(sys.argv[1]), int(sys.argv[2]), sys.argv[3], sys.argv[4]
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    faulthandler.enable()
    signal.signal(signal.SIGPROF, signal.SIG_DFL)
    with open(valid_path, "rb") as file:
        valid = pickle.load(file)
    log = os.open(log_path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_APPEND)
    count = 0

    def write(text: str) -> None:
        os.write(log, f"{count}: {text}\n".encode("ascii", "backslashreplace"))

    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        fuzzer = kind(seed, valid, write)
        for count in range(calls):  # noqa: B007 -- the log reads it
            fuzzer.step()


if __name__ == "__main__":
    main()
