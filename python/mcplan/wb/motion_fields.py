"""What the members of a motion have to be: their types, sizes and ranges, each refused by its name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import Plan
from mcplan.errors import InvalidPlan, shown, written

from . import splines

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .certificate.inputs import CertifiedMotion

#: Points of each end-effector at which forces act.
CORNERS = 4
#: Of a motion in a file.
MAX_NODES, MAX_JOINTS = 100_000, 500
#: Of coordinates [m, rad] and forces [N] in it: beyond, sums of squares are no numbers any more.
MAX_COORDINATE, MAX_FORCE_N = 1e6, 1e9
#: How far the last node may be from the end of the plan, and a position of the sole's points from it [s, m].
SAME_TIME_S, MAX_POINT_M = 1e-9, 10.0
#: Members that are arrays.
ARRAYS = ("times_s", "coefficients", "corner_points_S", "corner_forces_S", "contacts")


def number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise InvalidPlan(name, "must be a number", shown(value)) from None


def require_kinds(motion: CertifiedMotion) -> None:
    """Raise InvalidPlan for a member of another type."""
    if not isinstance(motion.plan, Plan):
        raise InvalidPlan("plan", "must be a Plan", shown(type(motion.plan).__name__))
    if not isinstance(motion.urdf, str):
        raise InvalidPlan("urdf", "must be a string", shown(motion.urdf))
    if isinstance(motion.joints, str) or not isinstance(motion.joints, Sequence):
        raise InvalidPlan("joints", "must be a sequence of names", shown(motion.joints))
    if not isinstance(motion.locked, Mapping):
        raise InvalidPlan("locked", "must be a mapping of names to positions", shown(motion.locked))


def as_array(name: str, values: Any) -> NDArray[Any]:
    """A copy of an array in the type that a motion has it in; what that type cannot hold is refused."""
    try:
        array = np.array(values, order="C")
        if array.dtype.kind not in "biuf":
            raise TypeError
    except (TypeError, ValueError, OverflowError):
        raise InvalidPlan(name, "must be an array of real numbers", shown(values)) from None
    if name != "contacts":
        return array.astype(np.float64)
    limits = np.iinfo(np.int32)
    whole = (array == np.floor(array)) & (array >= limits.min) & (array <= limits.max)
    _require_all(name, array, whole, "must be the index of a surface, or -1")
    return array.astype(np.int32)


def require_header(header: Mapping[str, Any]) -> None:
    """Raise InvalidPlan for a member of the header of another type."""
    if not isinstance(header.get("urdf"), str):
        raise InvalidPlan("header.urdf", "must be a string", written(header.get("urdf")))
    joints, locked = header.get("joints"), header.get("locked")
    if not isinstance(joints, list) or not all(isinstance(name, str) for name in joints):
        raise InvalidPlan("header.joints", "must be a list of strings", written(joints))
    if not isinstance(locked, dict) or not all(type(at) in (int, float) for at in locked.values()):
        raise InvalidPlan("header.locked", "must be an object of numbers", written(locked))


def require_valid(motion: CertifiedMotion) -> None:
    """Raise InvalidPlan for sizes that do not fit together and values that no motion has."""
    if len(set(motion.joints)) != len(motion.joints) or set(motion.joints) & set(motion.locked):
        raise InvalidPlan("joints", "must be named once, and not among the locked ones", shown(list(motion.joints)))
    nodes, joints, ends = motion.times_s.size, len(motion.joints), len(motion.plan.robot.end_effectors)
    for name, count, least, most in (
        ("times_s", nodes, splines.MIN_INTERVALS + 1, MAX_NODES),
        ("joints", joints, 1, MAX_JOINTS),
    ):
        if not least <= count <= most:
            raise InvalidPlan(name, f"must have {least} to {most} entries", str(count))
    expected = {
        "times_s": (nodes,),
        "coefficients": (nodes + 2, 6 + joints),
        "corner_points_S": (ends, CORNERS, 3),
        "corner_forces_S": (nodes, ends, CORNERS, 3),
        "contacts": (nodes - 1, ends),
    }
    for name, shape in expected.items():
        array = getattr(motion, name)
        if array.shape != shape:
            raise InvalidPlan(name, f"must have shape {shape}", str(array.shape))
        _require_all(name, array, np.isfinite(array), "must be finite")
    for name, at in motion.locked.items():
        if not abs(at) <= MAX_COORDINATE:
            raise InvalidPlan(f"locked.{name}", f"must lie within {MAX_COORDINATE:g} rad or m", shown(at))
    times, end, surfaces = motion.times_s, motion.plan.duration(), len(motion.plan.scene.surfaces)
    _require_all("times_s", times, np.diff(times, prepend=-1.0) > 0.0, "must ascend")
    if times[0] != 0.0 or abs(times[-1] - end) > SAME_TIME_S:
        wrong = 0 if times[0] != 0.0 else nodes - 1
        raise InvalidPlan(f"times_s[{wrong}]", f"must be {0.0 if wrong == 0 else end:.9g} s", f"{times[wrong]:.9g}")
    _require_all(
        "contacts",
        motion.contacts,
        (motion.contacts >= -1) & (motion.contacts < surfaces),
        f"must lie in [-1, {surfaces - 1}]",
    )
    for name, bound, unit in (("coefficients", MAX_COORDINATE, "m or rad"), ("corner_forces_S", MAX_FORCE_N, "N")):
        array = getattr(motion, name)
        _require_all(name, array, np.abs(array) <= bound, f"must lie within {bound:g} {unit}")
    points = motion.corner_points_S
    _require_all("corner_points_S", points, np.abs(points) <= MAX_POINT_M, f"must lie within {MAX_POINT_M:g} m")


def _require_all(name: str, array: Any, holds: Any, rule: str) -> None:
    for at in np.argwhere(~holds)[:1]:
        index = "".join(f"[{i}]" for i in at)
        raise InvalidPlan(f"{name}{index}", rule, shown(array[tuple(at)].item()))
