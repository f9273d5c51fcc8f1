"""The certificate of a motion: every constraint at instants a millisecond apart."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from mcplan._core import Plan, check
from mcplan.errors import InvalidArgument, InvalidInput, shown
from mcplan.extras import require

from . import balance, contacts, flight, limits, nodes, surfaces, terrain
from .correction import Correction, corrected
from .distances import counted, self_distance
from .footholds import footholds_of
from .inputs import CertifiedMotion
from .result import RATIO, MotionCheckResult, MotionViolation
from .robot import CertifiedRobot, certified_robot
from .stances import about_lines, rotations_at_ends, stances
from .states import States, equally_spaced, states_of
from .tolerances import MotionTolerances

Array = NDArray[np.float64]

#: Instants at which what the motion says of itself is compared.
COMPARED = 50
NO_SHAPES = "self_distance was not looked at: the URDF has no collision shapes that can be read"


def certify(motion: CertifiedMotion, tolerances: MotionTolerances | None = None) -> MotionCheckResult:
    """Check a motion against its plan, its scene and the limits of its robot.

    All is worked out again from the motion's numbers, with Pinocchio and the robot's URDF.

    Args:
        motion: The motion.
        tolerances: What is accepted; None: as MotionTolerances has them.

    Raises:
        InvalidArgument: The tolerances are no MotionTolerances.
        MissingExtra: Pinocchio or SciPy is not installed.
        InvalidRobot: The URDF cannot be read.
        InvalidPlan: The joints are not those of the URDF.
        InvalidOptions: A tolerance is no number.
    """
    tolerances = MotionTolerances() if tolerances is None else tolerances
    if not isinstance(tolerances, MotionTolerances):
        raise InvalidArgument("tolerances", "must be a MotionTolerances or None", shown(tolerances))
    tolerances.validate()
    require("the check of a motion", "view", "pinocchio", "scipy")
    start = time.perf_counter()
    robot = certified_robot(motion)
    states = states_of(motion, robot, equally_spaced(motion, tolerances.sample_s))
    footholds = footholds_of(motion.plan)
    on_lines = stances(motion, robot)
    about_W = about_lines(motion, states, on_lines)
    accepted = max(tolerances.corrected_N, tolerances.corrected_Nm)
    correction = corrected(motion, robot, states, states.residual_W - about_W, accepted)
    com_W = np.asarray(motion.plan.sample(states.times).com_W)
    plan = motion.plan
    constraints = [
        consistency(motion, robot, states, tolerances),
        contacts.contact_times(motion, tolerances),
        *limits.joint_limits(robot, states, tolerances),
        limits.at_rest(states, not plan.measured_start, not plan.open_end, tolerances),
        *contacts.forces(motion, states, tolerances),
        *contacts.pressure(motion, states, tolerances),
        *contacts.drift(motion, states, footholds, tolerances),
        *surfaces.on_surfaces(motion, states, footholds, tolerances),
        nodes.balance_at_nodes(motion, robot, tolerances),
        *balance.balance(states, correction, tolerances),
        *rotations_at_ends(motion, robot, on_lines, flight.landings(motion, robot, tolerances)),
        *terrain.clearance(motion, states, footholds, tolerances),
        self_distance(robot, states, tolerances),
        *balance.off_the_plan(states, com_W, tolerances),
    ]
    notes = [*([] if counted(robot)[0] else [NO_SHAPES]), *_of_the_plan(plan)]
    found = MotionCheckResult(tuple(constraints), {}, len(states.times), time.perf_counter() - start, tuple(notes))
    return replace(found, measures=_measures(found, states, correction, about_W))


def _of_the_plan(plan: Plan) -> list[str]:
    """A note on what the check of plans says of the plan, if it does not accept it: a motion may be better than its plan."""
    try:
        violations = check(plan).violations()
    except InvalidInput as found:
        return [f"the plan that the motion carries out cannot be checked: {str(found).splitlines()[0]}"]
    if not violations:
        return []
    more = f", and {len(violations) - 1} more" * (len(violations) > 1)
    return [f"the plan that the motion carries out does not keep all of its own constraints: {violations[0]}{more}"]


def consistency(
    motion: CertifiedMotion, robot: CertifiedRobot, states: States, tolerances: MotionTolerances
) -> MotionViolation:
    """Largest difference of what the motion says of its states from what its numbers mean, relative to their size."""
    at = np.unique(np.linspace(0, len(states.times) - 1, COMPARED).astype(int))
    said = motion.sample(states.times[at])
    columns = np.concatenate([np.arange(6), robot.moving])
    pairs = (
        (said.v, states.v[at][:, columns]),
        (said.a, states.a[at][:, columns]),
        (said.tau, states.tau[at]),
        (said.com_W, states.com_W[at]),
        (said.end_effectors_W, states.positions_W[at]),
        (said.rotations_W, states.rotations_W[at]),
        (said.wrenches_W[..., :3], states.corner_forces_W[at].sum(axis=2)),
    )
    worst = MotionViolation("consistency", 0.0, tolerances.consistency, RATIO)
    for theirs, ours in pairs:
        off = np.abs(theirs - ours).reshape(len(at), -1).max(axis=1) / max(1.0, float(np.abs(ours).max()))
        k = int(np.argmax(off))
        if not off[k] <= worst.value:
            worst = replace(worst, value=float(off[k]), time_s=float(states.times[at[k]]))
    return worst


def _measures(found: MotionCheckResult, states: States, correction: Correction, about_W: Array) -> dict[str, float]:
    value = {constraint.name: constraint.value for constraint in found.constraints}
    free = ~(states.contacts >= 0).any(axis=1)
    in_flight = np.linalg.norm(states.residual_W[free, :3], axis=1)
    return {
        "base_residual_N": value["residual_force"],
        "base_residual_Nm": value["residual_moment"],
        "corrected_residual_N": value["corrected_force"],
        "corrected_residual_Nm": value["corrected_moment"],
        "correction_N": float(correction.change_N.max(initial=0.0)),
        "corrected_torque_use": float(np.nanmax(correction.torque_use, initial=0.0)),
        "corrected_by_solver": float(correction.solved),
        "line_residual_Nm": float(np.linalg.norm(about_W, axis=1).max(initial=0.0)),
        "flight_residual_N": float(in_flight.max(initial=0.0)),
        "drift_m": value["drift"],
        "drift_deg": value["drift_angle"],
        "drift_speed": value["drift_speed"],
        "torque_use": value["torque"],
        "torque_step_use": value["torque_step"],
        "velocity_use": value["velocity"],
        "position_excess": value["position"],
        "self_distance_m": value["self_distance"],
        "clearance_m": -value["clearance"],
        "mid_swing_m": value["mid_swing"],
        "landing_m": value["landing"],
        "com_rms_m": value["com_rms"],
        "com_max_m": value["com_max"],
    }
