"""Whole-body planning of planar robots: options, a solve, a result that has the plan and a report.

    from mcplan import sip

    options = sip.Options(forces=sip.Forces.uniform, order=10)
    result = sip.plan("climbing", options)  # or sip.plan("climbing", forces="uniform", order=10)
    result.plan.save("climb.npz"), result.report.status

``Planner`` is behind it, one object for several solves; ``certify`` proves what holds at every instant,
``solid_depths`` tells how deep swinging end-effectors go into the ground.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from mcplan._core import PlanarPlan, PlanarTask, solid_depths
from mcplan._core.sip import (
    Certificate,
    ContactMode,
    Continuous,
    Forces,
    FreeFlyer,
    HessianChoice,
    Options,
    Planner,
    Proof,
    ProvedConstraint,
    Result,
    Solver,
    TaylorModel,
    certify,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from mcplan.option_types import SipOptions

__all__ = [
    "Certificate",
    "ContactMode",
    "Continuous",
    "Forces",
    "FreeFlyer",
    "HessianChoice",
    "Options",
    "Planner",
    "Proof",
    "ProvedConstraint",
    "Result",
    "Solver",
    "TaylorModel",
    "certify",
    "plan",
    "solid_depths",
    "whole_body",
]


def whole_body(
    task: PlanarTask | str | Path,
    options: Options | None = None,
    *,
    minimise: str | None = None,
    warm_start: PlanarPlan | str | Path | None = None,
    certify: bool = False,
    **named: Unpack[SipOptions],
) -> Result:
    """Plan the whole body of a planar robot through a sequence of contact stances.

        result = mp.whole_body("climbing")
        result.plan.at(0.5).torque  # any instant: joints, base, torques, contact forces

    Joint trajectories are splines, and constraints hold at every instant between knots, not only at samples. Ctrl-C
    ends the search with Interrupted, which carries the result with the best motion so far.

    Args:
        task: A planar task, or what load_planar_task takes: its robot, surfaces and the stance of each phase.
        options: How to plan; None: the defaults.
        minimise: "torque" (integral of the squared torques), "time" or "none" (any motion within the constraints, in
            one duration for all intervals). None: what `options` say; without them "torque", or "none" with
            ``dynamics=False``. It sets weights of the cost; those that are named stand above it.
        warm_start: A plan of the same robot and phases, or the path of one, to start from.
        certify: Prove the constraints of what was found, at every instant: ``result.certificate``.
        **named: Fields of ``sip.Options`` by name, which stand above those of `options`. ``forces``: where contact forces
            come from, "uniform", "per_body" or "per_point" (default) weights of the least norm (the paper's cases 1, 2
            and 3), or "parameters" (polynomials of time). ``contact``: how contacts are held, "tube" (default, within
            ``tube_m`` and ``tube_rad`` at every instant), "band" or "strict" (polynomial coefficients 0 to ``neq``).
            ``order``: of the Taylor polynomials, 3 to 12. ``free_flyer``: the base, "computed" from the joints or
            "parameterised" by splines of its own. ``free_durations``: a duration for each phase, or one for all
            intervals. ``time_limit``: wall clock of the whole search [s]; None: none.

    Returns:
        The motion: ``plan``, ``report``, ``parameters`` and ``constraints`` (size of the program), ``drift_m``,
        ``drift_rad``, ``certificate``. The report's status is ``solved`` only if the checker accepts the plan.

    Raises:
        InvalidArgument: An argument is of another type.
        InvalidOptions: No such option, its value is out of range, or it does not go with another one.
        InvalidPlanarTask: The task is malformed.
        InvalidRobot: Its robot is malformed.
        InvalidPlan: The warm start has other phases or joints, or is malformed.
        UnknownPlanarTask, UnknownRobot: No such name and no such file.
    """
    from mcplan.planar.planning import whole_body as solve

    return solve(task, warm_start, certify, minimise, named, options)


plan = whole_body
