"""Mode schedule and target trajectories (.info) for OCS2, in the syntax of Boost's property trees.

`initialModeSchedule` has `modeSequence` and `eventTimes`, as ocs2_legged_robot's loadModeSchedule reads them, and
`defaultModeSequenceTemplate` has `modeSequence` and `switchingTimes`, for loadModeSequenceTemplate. `targetTrajectories` is
for loadStdVector (`timeTrajectory`) and loadEigenMatrix (`stateTrajectory`, `inputTrajectory`, a row an instant): OCS2 builds
its TargetTrajectories in code and names no file for them.

The state is that of its centroidal model: momentum over mass (linear [m/s], angular about the CoM), base position [m], base
angles about z, y, x [rad], joints [rad]. The input has the contact forces [N] of the end-effectors, points before soles, which
have moments [N m] too, then joint velocities [rad/s].
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mcplan.errors import InvalidRobot
from mcplan.files.outputs import write_whole
from mcplan.kinematics.inverse_kinematics import has_sole
from mcplan.kinematics.rotations import rotations_of

from .orders import order_of

if TYPE_CHECKING:
    from mcplan._core import Robot

    from .source import Source

Array = NDArray[np.float64]

#: Feet of four-legged robots as ocs2_legged_robot orders them, the first one worth 8; and those of two-legged ones.
QUADRUPED, BIPED = ("LF", "RF", "LH", "RH"), ("LF", "RF")


def write(source: Source, path: Path) -> None:
    """Write schedule and trajectories of a source.

    Raises:
        InvalidRobot: The robot has neither two feet, left and right, nor four.
    """
    names = feet_of(source.robot)
    sequence = source.plan.contact_sequence()
    modes = [mode_name([contacts[names[foot]] >= 0 for foot in names], tuple(names)) for contacts in sequence]
    times = [float(t) for t in source.plan.knot_times()]
    modes, events = joined(modes, times)
    final = mode_name([source.plan.final_contacts[names[foot]] >= 0 for foot in names], tuple(names))
    order = order_of(source.motion.urdf_model, breadth_first=False)
    states, inputs = trajectories(source, order.joints)
    lines = [f"; mcplan: {source.robot.name}, {source.plan.scene.name}", f"; feet: {' '.join(names)}"]
    lines += [
        f"; joints: {' '.join(order.joints)}",
        *_schedule("initialModeSchedule", [*modes, final], "eventTimes", events[1:]),
    ]
    lines += _schedule("defaultModeSequenceTemplate", modes, "switchingTimes", events)
    lines += ["targetTrajectories", "{", *_vector("timeTrajectory", [f"{t:.17g}" for t in source.times_s])]
    lines += [*_matrix("stateTrajectory", states), *_matrix("inputTrajectory", inputs), "}", ""]
    write_whole("\n".join(lines), path)


def feet_of(robot: Robot) -> dict[str, int]:
    """Index of the end-effector that is each foot, in the order of the modes.

    Raises:
        InvalidRobot: There are not two or four feet that are told by their names.
    """
    feet = {end.name: e for e, end in enumerate(robot.end_effectors) if end.kind == "foot"}
    for legs, words in (
        (BIPED, {"LF": "left_foot", "RF": "right_foot"}),
        (QUADRUPED, {"LF": "lf_foot", "RF": "rf_foot", "LH": "lh_foot", "RH": "rh_foot"}),
    ):
        if set(feet) == set(words.values()):
            return {leg: feet[words[leg]] for leg in legs}
    rule = "must have the feet left_foot and right_foot, or lf_foot, rf_foot, lh_foot and rh_foot, in this format"
    raise InvalidRobot("end_effectors", rule, ", ".join(feet) or "none", robot.name)


def mode_name(down: Sequence[bool], feet: tuple[str, ...]) -> str:
    """STANCE, FLY, or the feet that are down: the name of a ModeNumber."""
    if all(down):
        return "STANCE"
    return "_".join(foot for foot, is_down in zip(feet, down, strict=True) if is_down) or "FLY"


def joined(modes: list[str], times: list[float]) -> tuple[list[str], list[float]]:
    """Modes without repetitions, and the times [s] at which they begin, and the last one ends."""
    kept = [k for k, mode in enumerate(modes) if k == 0 or mode != modes[k - 1]]
    return [modes[k] for k in kept], [*(times[k] for k in kept), times[-1]]


def trajectories(source: Source, joints: list[str]) -> tuple[Array, Array]:
    """States (n, 12 + nj) and inputs (n, 3 points + 6 soles + nj)."""
    import pinocchio as pin  # type: ignore[import-untyped]

    motion = source.motion
    model = motion.urdf_model.model
    data = model.createData()
    mass = sum(inertia.mass for inertia in model.inertias)
    q, v = motion.in_order(joints)
    states = np.zeros((len(q), 12 + q.shape[1]))
    rotations = rotations_of(motion.configurations[:, 3:7])
    for n in range(len(q)):
        momentum = pin.computeCentroidalMomentum(model, data, motion.configurations[n], motion.velocities[n])
        states[n, :3], states[n, 3:6] = momentum.linear / mass, momentum.angular / mass
    states[:, 6:9] = motion.configurations[:, :3]
    states[:, 9] = np.unwrap(np.arctan2(rotations[:, 1, 0], rotations[:, 0, 0]))
    states[:, 10] = np.arcsin(np.clip(-rotations[:, 2, 0], -1.0, 1.0))
    states[:, 11] = np.arctan2(rotations[:, 2, 1], rotations[:, 2, 2])
    states[:, 12:] = q
    ends = source.robot.end_effectors
    points = [e for e, end in enumerate(ends) if end.kind == "foot" and not has_sole(end)]
    soles = [e for e, end in enumerate(ends) if end.kind == "foot" and has_sole(end)]
    columns = [source.forces_W[:, e] for e in points]
    for e in soles:
        columns += [source.forces_W[:, e], source.moments_W[:, e]]
    return states, np.concatenate([*columns, v], axis=1)


def _schedule(name: str, modes: list[str], key: str, times: list[float]) -> list[str]:
    return [name, "{", *_vector("modeSequence", modes), *_vector(key, [f"{t:.17g}" for t in times]), "}", ""]


def _vector(name: str, values: list[str]) -> list[str]:
    return [f"  {name}", "  {", *(f"    [{i}] {value}" for i, value in enumerate(values)), "  }"]


def _matrix(name: str, values: Array) -> list[str]:
    entries = [f"    ({i},{j}) {value:.17g}" for i, row in enumerate(values) for j, value in enumerate(row)]
    return [f"  {name}", "  {", *entries, "  }"]
