"""The rows of the tables of Lengagne et al., and the options that each is run with."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from mcplan.errors import InvalidInput, shown

from .lengagne_paper import CASES, MOTIONS

STEEP = "climbing_steep"

#: mcplan's own solver, which Tables III and IV have beside Ipopt.
KERNEL = "ipm"

#: Free-flyer of the tables of kinematics.
FREE_FLYER = {1: "parameterised", 2: "computed"}
NEQ = (0, 1, 2, 3)

#: Half width of the band of coefficients [m], [rad].
BAND = 1e-3
#: Half width of a tube that replaces equalities at the points of a grid [m], [rad].
EQUAL = 1e-5

#: Limits on the iterations of each attempt of the solver, as in the paper for Tables I to III. It says none for Table IV,
#: where its motion 2 takes 1572 in case 2: ours is above that.
ITERATIONS = {1: 200, 2: 200, 3: 1000, 4: 2000}

#: Wall clock of a run [s]: none of the runs that converge comes near it.
TIME_LIMIT_S = {1: 60.0, 2: 60.0, 3: 120.0, 4: 600.0}
#: Wall clock of runs that mostly end without a result [s]: climbing_steep with uniform weights by Ipopt, equal contacts.
HOPELESS_S, EQUAL_S = 30.0, 20.0


@dataclass(frozen=True)
class Config:
    """One row to be run."""

    table: int  #: of the paper
    motion: str
    hold: str  #: form of the contact constraints: band, tube, strict, or equal (a tube of EQUAL)
    neq: int = -1  #: highest coefficient that band and strict constrain; -1: none
    forces: str = ""  #: where contact forces come from; empty: kinematics alone
    continuous: str = "hull"  #: constraints between knots
    solver: str = "ipopt"  #: of the nonlinear programs; ipm: mcplan's own

    @property
    def title(self) -> str:
        """For lines of progress."""
        held = self.hold if self.neq < 0 else f"{self.hold} 0..{self.neq}"
        parts = [f"Table {'I II III IV'.split()[self.table - 1]}", self.motion, self.forces, held]
        parts += ["" if self.continuous == "hull" else self.continuous, "" if self.solver == "ipopt" else self.solver]
        return ", ".join(p for p in parts if p)

    @property
    def key(self) -> str:
        """Name of its plan's file."""
        solver = "" if self.solver == "ipopt" else f"_{self.solver}"
        return f"table_{self.table}_{self.motion}_{self.forces}{solver}"

    @property
    def clearance(self) -> bool:
        """Whether swinging feet are kept out of solids: with contacts as mcplan holds them, but not with the paper's."""
        return self.hold == "tube"

    def options(self) -> dict[str, Any]:
        """Arguments of mcplan.whole_body."""
        out: dict[str, Any] = {
            "max_iterations": ITERATIONS[self.table],
            "time_limit": self.time_limit_s,
            "contact": "tube" if self.hold == "equal" else self.hold,
            "continuous": self.continuous,
            "minimise": "none",
            "clearance": self.clearance,
            "solver": self.solver,
        }
        if self.neq >= 0:
            out["neq"] = self.neq
        if self.hold in ("band", "equal"):
            out["tube_m"] = out["tube_rad"] = BAND if self.hold == "band" else EQUAL
        if self.table in FREE_FLYER:
            return out | {"dynamics": False, "free_flyer": FREE_FLYER[self.table], "order": 5}
        if self.table == 3:
            return out | {"forces": self.forces, "torque_limits": False, "free_durations": False}
        return out | {"forces": self.forces, "minimise": "torque"}

    @property
    def time_limit_s(self) -> float:
        """Wall clock of the run."""
        if self.hold == "equal":
            return EQUAL_S
        hopeless = self.motion == STEEP and self.forces == "uniform" and self.solver == "ipopt"
        return HOPELESS_S if hopeless else TIME_LIMIT_S[self.table]


def configs(tables: Iterable[int], motions: Sequence[str], quick: bool = False) -> list[Config]:
    """The rows of the tables, in their order; quick: few of the variants that the paper lacks."""
    out = []
    for table in tables:
        for motion in motions:
            if table in FREE_FLYER and motion != STEEP:
                out += _kinematic(table, motion, quick)
            elif table == 3:
                for forces in CASES.values():
                    out += [Config(3, motion, "band", 2, forces), Config(3, motion, "tube", forces=forces)]
                out += [Config(3, motion, "tube", forces=forces, solver=KERNEL) for forces in CASES.values()]
            elif table == 4 and motion != STEEP:
                for solver in ("ipopt", KERNEL):
                    out += [Config(4, motion, "tube", forces=forces, solver=solver) for forces in CASES.values()]
        if table == 3 and "cartwheel" in motions:
            out += [
                Config(3, "cartwheel", "band", 2, "parameters"),
                Config(3, "cartwheel", "tube", forces="parameters"),
            ]
    return out


def _kinematic(table: int, motion: str, quick: bool) -> list[Config]:
    out = [Config(table, motion, hold, neq) for hold in ("band", "strict") for neq in NEQ]
    out.append(Config(table, motion, "tube"))
    out += [Config(table, motion, "band", neq, continuous="grid") for neq in (NEQ[:1] if quick else NEQ)]
    out += [Config(table, motion, hold, continuous="grid") for hold in ("tube", "equal")]
    return [
        *out,
        Config(table, motion, "band", 2, continuous="extremum"),
        Config(table, motion, "tube", continuous="extremum"),
    ]


def chosen_motions(motions: Sequence[str] | None) -> list[str]:
    """Names in the paper's order.

    Raises:
        InvalidInput: A name that is none of its motions.
    """
    known = [*MOTIONS, STEEP]
    for name in motions or ():
        if name not in known:
            raise InvalidInput("motions", f"must be among {', '.join(known)}", shown(name))
    return [name for name in known if motions is None or name in motions]
