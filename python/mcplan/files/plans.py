"""Plans in .npz files: arrays and a JSON header, no pickles. In .json files, which C++ reads and writes, they have format 4.

The header (bytes of UTF-8 JSON) holds the format's version, the units, the version of mcplan, the planner, and the scene
and the robot with the keys of their files. N phases, L end-effectors and S swings give these arrays:

    durations (N)  surfaces (N, L)  stiffness (N, L)  anchors_W, moments_W (N, L, 3)  final_contacts (L)
    com_W, com_velocity_W, base_rpy, base_rpy_rate (N+1, 3)  end_effectors_W, end_effector_velocities_W (N+1, L, 3)
    swings (S, 3: end-effector, first phase, end phase)  swing_heights (S)  swing_normals_W (S, 2, 3)

and swing_elapsed_s (S), the time since lift-off, where a swing is under way at the plan's start; older versions do not look
at it. That is format 1, for plans of the pendulum alone. A plan with forces at points has format 2, with these in addition:

    laws (N: 0 pendulum, 1 held, 2 linear)  intervals (N)  angular_momentum_W (N+1, 3)
    point_counts (N, L)  points_W (P, 3)  point_forces_W (F, 3)

Points stand phase by phase and end-effector by end-effector; so do forces, and within a contact node by node. A plan of
contact wrenches, or with headings of soles, has format 3: the arrays of format 2 (laws up to 3, wrench), and

    centers_of_pressure_W (N, L, 3)  end_effector_yaw (N+1, L; no columns where soles head where the base does)
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from mcplan._core import (
    Contact,
    ForceLaw,
    Knot,
    Phase,
    Plan,
    Swing,
    __version__,
    plan_from_json,
    plan_to_json,
)
from mcplan.errors import InvalidInput, InvalidPlan, written
from mcplan.files.archives import archive_bytes, read_arrays, read_header, require_kind, require_members
from mcplan.files.plan_files import load_plan_file, write_plan_file
from mcplan.files.robots import robot_from_dict, robot_to_dict
from mcplan.files.scenes import scene_from_dict, scene_to_dict

#: 2 since forces may act at points, 3 since contacts have wrenches. A plan is written in the least that holds it, so that
#: older versions read what they know.
FORMATS = (1, 2, 3)
UNITS = "SI: m, kg, s, N, rad; stiffness in 1/s^2; _W: world frame, z up"
_INTEGERS = {"surfaces", "final_contacts", "swings", "laws", "intervals", "point_counts"}
#: The first format that has a law; a law's number in files is its place here, so that new ones stand at the end.
_FORMAT_OF_LAW = {ForceLaw.pendulum: 1, ForceLaw.held: 2, ForceLaw.linear: 2, ForceLaw.wrench: 3}
_LAWS = tuple(_FORMAT_OF_LAW)
#: Limits that a plan claims to keep; a file says those that are finite.
_CLAIMS = ("momentum_max", "momentum_rate_max")
#: Of a plan in a file: each takes a hundred times the memory of its numbers once it is read.
MAX_PHASES, MAX_SWINGS = 10_000, 40_000


def save_plan(plan: Plan, path: str | Path) -> None:
    """Write a plan to a file, which is complete or not there at all.

    Args:
        plan: The plan.
        path: Where to; used as it stands, no ending is added, and one other than .npz or .json is refused. A device or a pipe is
            written through, a link goes on pointing where it points.

    Raises:
        InvalidInput: The name promises another kind of file.
        OSError: The file cannot be written.
        InvalidPlan: Its sizes do not fit together or a number is not finite.
    """
    write_plan_file(plan, path, plan_to_json, plan_to_bytes)


def load_plan(path: str | Path) -> Plan:
    """Read a plan written by save_plan, or by Plan::save in C++.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
        FileNotFoundError: There is no such file.
    """
    return load_plan_file(path, plan_from_json, plan_from_bytes)


def plan_to_bytes(plan: Plan) -> bytes:
    """The content of a plan file."""
    plan.validate()
    _require_few("phases", len(plan.phases), MAX_PHASES)
    _require_few("swings", len(plan.swings), MAX_SWINGS)
    version = _format(plan)
    count, ends = len(plan.phases), plan.end_effector_count()
    contacts = [contact for phase in plan.phases for contact in phase.contacts]
    header = {
        "format": version,
        "units": UNITS,
        "mcplan": __version__,
        "planner": plan.planner,
        "measured_start": plan.measured_start,
        "open_end": plan.open_end,
        **({"start_slack_s": plan.start_slack_s} if plan.start_slack_s else {}),
        **{name: getattr(plan, name) for name in _CLAIMS if np.isfinite(getattr(plan, name))},
        "scene": scene_to_dict(plan.scene),
        "robot": robot_to_dict(plan.robot),
    }
    arrays = {
        "durations": np.array([phase.duration for phase in plan.phases]),
        "surfaces": np.array([c.surface for c in contacts], dtype=np.int32).reshape(count, ends),
        "stiffness": np.array([c.stiffness for c in contacts]).reshape(count, ends),
        "anchors_W": np.array([c.anchor_W for c in contacts]).reshape(count, ends, 3),
        "moments_W": np.array([c.moment_W for c in contacts]).reshape(count, ends, 3),
        "final_contacts": np.array(plan.final_contacts, dtype=np.int32),
        "swings": np.array([[s.end_effector, s.first_phase, s.end_phase] for s in plan.swings], dtype=np.int32).reshape(
            -1, 3
        ),
        "swing_heights": np.array([s.height for s in plan.swings], dtype=float),
        "swing_normals_W": np.array([[s.lift_normal_W, s.land_normal_W] for s in plan.swings]).reshape(-1, 2, 3),
    }
    if any(s.elapsed_s for s in plan.swings):
        arrays["swing_elapsed_s"] = np.array([s.elapsed_s for s in plan.swings], dtype=float)
    for name in (
        "com_W",
        "com_velocity_W",
        "base_rpy",
        "base_rpy_rate",
        "end_effectors_W",
        "end_effector_velocities_W",
    ):
        arrays[name] = np.array([getattr(knot, name) for knot in plan.knots])
    if version >= 2:
        arrays.update(_point_arrays(plan))
    if version >= 3:
        arrays["centers_of_pressure_W"] = np.array([c.center_of_pressure_W for c in contacts]).reshape(count, ends, 3)
        arrays["end_effector_yaw"] = np.array([knot.end_effector_yaw for knot in plan.knots], dtype=float)
    return archive_bytes(header, arrays)


def plan_from_bytes(data: bytes) -> Plan:
    """The plan of the content of a plan file.

    Raises:
        InvalidPlan: Not such a file, or its content does not fit together.
    """
    arrays = read_arrays(data)
    header = _read_header(arrays)
    scene = _part("header.scene", scene_from_dict, header["scene"])
    robot = _part("header.robot", robot_from_dict, header["robot"])
    _check_shapes(arrays, len(robot.end_effectors), header["format"])
    plan = Plan(
        measured_start=header.get("measured_start", False) is True,
        open_end=header.get("open_end", False) is True,
        start_slack_s=_slack(header.get("start_slack_s", 0.0)),
        **{name: _claim(name, header[name]) for name in _CLAIMS if name in header},
        scene=scene,
        robot=robot,
        planner=header["planner"],
        knots=_knots(arrays),
        phases=_phases(arrays, header["format"]),
        final_contacts=[int(surface) for surface in arrays["final_contacts"]],
        swings=_swings(arrays),
    )
    plan.validate()
    return plan


def _claim(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not value > 0.0:
        raise InvalidPlan(f"header.{name}", "must be a positive number", written(value))
    return float(value)


def _slack(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.0 <= value <= sys.float_info.max:
        raise InvalidPlan("header.start_slack_s", "must lie in [0, inf) s", written(value))
    return float(value)


def _knots(arrays: dict[str, np.ndarray]) -> list[Knot]:
    return [
        Knot(
            com_W=com,
            com_velocity_W=velocity,
            base_rpy=rpy,
            base_rpy_rate=rate,
            end_effectors_W=ends,
            end_effector_velocities_W=end_velocities,
            angular_momentum_W=momentum,
            end_effector_yaw=yaw.tolist(),
        )
        for com, velocity, rpy, rate, ends, end_velocities, momentum, yaw in zip(
            arrays["com_W"],
            arrays["com_velocity_W"],
            arrays["base_rpy"],
            arrays["base_rpy_rate"],
            arrays["end_effectors_W"],
            arrays["end_effector_velocities_W"],
            arrays.get("angular_momentum_W", np.zeros_like(arrays["com_W"])),
            arrays.get("end_effector_yaw", np.zeros((len(arrays["com_W"]), 0))),
            strict=True,
        )
    ]


def _phases(arrays: dict[str, np.ndarray], version: int) -> list[Phase]:
    laws, points = _read_points(arrays, version)
    return [
        Phase(
            duration=duration,
            law=law,
            intervals=intervals,
            contacts=[
                Contact(
                    surface=int(surface),
                    stiffness=stiffness,
                    anchor_W=anchor,
                    moment_W=moment,
                    center_of_pressure_W=center,
                    **at_points,
                )
                for surface, stiffness, anchor, moment, center, at_points in zip(*row, strict=True)
            ],
        )
        for duration, (law, intervals), *row in zip(
            arrays["durations"],
            laws,
            arrays["surfaces"],
            arrays["stiffness"],
            arrays["anchors_W"],
            arrays["moments_W"],
            arrays.get("centers_of_pressure_W", np.zeros_like(arrays["anchors_W"])),
            points,
            strict=True,
        )
    ]


def _swings(arrays: dict[str, np.ndarray]) -> list[Swing]:
    return [
        Swing(
            end_effector=int(end),
            first_phase=int(first),
            end_phase=int(last),
            height=height,
            lift_normal_W=normals[0],
            land_normal_W=normals[1],
            elapsed_s=elapsed_s,
        )
        for (end, first, last), height, normals, elapsed_s in zip(
            arrays["swings"],
            arrays["swing_heights"],
            arrays["swing_normals_W"],
            arrays.get("swing_elapsed_s", np.zeros_like(arrays["swing_heights"])),
            strict=True,
        )
    ]


def _format(plan: Plan) -> int:
    """The least format that holds all that the plan says."""
    if any(knot.end_effector_yaw for knot in plan.knots) or any(
        contact.center_of_pressure_W.any() for phase in plan.phases for contact in phase.contacts
    ):
        return 3
    laws = max((_FORMAT_OF_LAW[phase.law] for phase in plan.phases), default=1)
    return max(laws, 2) if any(knot.angular_momentum_W.any() for knot in plan.knots) else laws


def _point_arrays(plan: Plan) -> dict[str, np.ndarray]:
    contacts = [contact for phase in plan.phases for contact in phase.contacts]
    counts = [len(contact.points_W) for contact in contacts]
    return {
        "laws": np.array([_LAWS.index(phase.law) for phase in plan.phases], dtype=np.int32),
        "intervals": np.array([phase.intervals for phase in plan.phases], dtype=np.int32),
        "angular_momentum_W": np.array([knot.angular_momentum_W for knot in plan.knots]),
        "point_counts": np.array(counts, dtype=np.int32).reshape(len(plan.phases), -1),
        "points_W": np.concatenate([contact.points_W for contact in contacts]),
        "point_forces_W": np.concatenate([contact.point_forces_W for contact in contacts]),
    }


def _read_points(arrays: dict[str, np.ndarray], version: int) -> tuple[list[Any], list[list[dict[str, Any]]]]:
    """Law and number of intervals of every phase; points and forces of every phase and contact."""
    count, ends = arrays["surfaces"].shape
    if version == 1:
        return [(ForceLaw.pendulum, 0)] * count, [[{}] * ends] * count
    last_law = sum(first <= version for first in _FORMAT_OF_LAW.values()) - 1
    for name, most in (("laws", last_law), ("intervals", 100_000), ("point_counts", 100_000)):
        bad = arrays[name][(arrays[name] < 0) | (arrays[name] > most)]
        if bad.size:
            raise InvalidPlan(name, f"must lie in [0, {most}]", str(bad[0]))
    laws = [(_LAWS[law], int(n)) for law, n in zip(arrays["laws"], arrays["intervals"], strict=True)]
    nodes = [Phase(law=law, intervals=intervals).node_count() for law, intervals in laws]
    sizes = arrays["point_counts"].astype(np.int64)
    for name, wanted in (("points_W", sizes), ("point_forces_W", sizes * np.array(nodes, dtype=np.int64)[:, None])):
        if len(arrays[name]) != wanted.sum():
            raise InvalidPlan(
                name, f"must have the {wanted.sum()} rows that point_counts imply", str(len(arrays[name]))
            )
    contacts: list[list[dict[str, Any]]] = []
    point = force = 0
    for n, row in zip(nodes, sizes.tolist(), strict=True):
        contacts.append([])
        for size in row:
            contacts[-1].append(
                {
                    "points_W": arrays["points_W"][point : point + size],
                    "point_forces_W": arrays["point_forces_W"][force : force + n * size],
                }
            )
            point, force = point + size, force + n * size
    return laws, contacts


def _part(field: str, read: Callable[[Any], Any], data: Any) -> Any:
    try:
        return read(data)
    except InvalidInput as found:
        raise found.moved(InvalidPlan, prefix=field) from None


def _read_header(arrays: dict[str, np.ndarray]) -> dict[str, Any]:
    header = read_header(arrays)
    if header.get("kind") is not None:
        raise InvalidPlan("header.kind", "must be none: a plan of contacts and CoM", written(header["kind"]))
    if type(header.get("format")) is not int or header["format"] not in FORMATS:
        raise InvalidPlan(
            "header.format", "must be 1, 2 or 3 for this version of mcplan", written(header.get("format"))
        )
    require_members(header, planner=str, scene=dict, robot=dict)
    return header


def _rows(arrays: dict[str, np.ndarray], name: str) -> int:
    return len(arrays[name]) if name in arrays and arrays[name].ndim else 0


def _check_shapes(arrays: dict[str, np.ndarray], ends: int, version: int) -> None:
    count = arrays["durations"].size if "durations" in arrays else 0
    swings = arrays["swing_heights"].size if "swing_heights" in arrays else 0
    _require_few("durations", count, MAX_PHASES)
    _require_few("swing_heights", swings, MAX_SWINGS)
    expected = {
        "durations": (count,),
        "surfaces": (count, ends),
        "stiffness": (count, ends),
        "anchors_W": (count, ends, 3),
        "moments_W": (count, ends, 3),
        "final_contacts": (ends,),
        "com_W": (count + 1, 3),
        "com_velocity_W": (count + 1, 3),
        "base_rpy": (count + 1, 3),
        "base_rpy_rate": (count + 1, 3),
        "end_effectors_W": (count + 1, ends, 3),
        "end_effector_velocities_W": (count + 1, ends, 3),
        "swings": (swings, 3),
        "swing_heights": (swings,),
        "swing_normals_W": (swings, 2, 3),
    }
    if "swing_elapsed_s" in arrays:
        expected["swing_elapsed_s"] = (swings,)
    if version >= 2:
        expected |= {
            "laws": (count,),
            "intervals": (count,),
            "angular_momentum_W": (count + 1, 3),
            "point_counts": (count, ends),
            "points_W": (_rows(arrays, "points_W"), 3),
            "point_forces_W": (_rows(arrays, "point_forces_W"), 3),
        }
    if version >= 3:
        expected["centers_of_pressure_W"] = (count, ends, 3)
        without = arrays.get("end_effector_yaw", np.empty(1)).shape == (count + 1, 0)
        expected["end_effector_yaw"] = (count + 1, 0 if without else ends)
    for name, shape in expected.items():
        require_kind(arrays, name, integers=name in _INTEGERS)
        if arrays[name].shape != shape:
            raise InvalidPlan(name, f"must have shape {shape}", str(arrays[name].shape))
        if name in _INTEGERS and arrays[name].size:
            low, high = int(arrays[name].min()), int(arrays[name].max())
            if low < -(2**31) or high >= 2**31:
                raise InvalidPlan(name, "must hold numbers of 32 bits", str(low if low < -(2**31) else high))


def _require_few(name: str, count: int, most: int) -> None:
    if count > most:
        raise InvalidPlan(name, f"may be {most} at most", str(count))
