"""A Robot from a URDF: mass, inertia, CoM height, and the reach of each limb from its kinematics.

    mcplan robots --from-urdf talos -o talos.toml

How each number comes about is written in the file's header; see also ``mcplan.files.reach`` and
``mcplan.files.strength``.
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mcplan._core import EndEffector, Polytope, Robot
from mcplan.errors import InvalidInput, did_you_mean, shown, written
from mcplan.extras import require
from mcplan.files.builtin import exists
from mcplan.files.far_reach import add_far_reach
from mcplan.files.leg_geometry import legs_of
from mcplan.files.leg_shape import add_leg_shapes
from mcplan.files.limb_limits import add_limb_limits
from mcplan.files.reach import HEADING_MAX, Limb, explore, headings_reached, largest_box
from mcplan.files.reach_cut import LIFT, Cut, cut_of
from mcplan.files.strength import POINTS, rounded_down, sole_torsion, strengths_in_box
from mcplan.files.trunk import trunk_of
from mcplan.files.urdf_limbs import contact_frame, limb_of, own_joints
from mcplan.files.urdf_packages import packaged_robot
from mcplan.files.urdf_reading import build_model, read_urdf, read_xml
from mcplan.files.urdf_setups import HEADER, SETUPS, End, Setup, search_box

GRAVITY = 9.81
MAX_COM_HEIGHT = 50.0  # [m] beyond, lengths are not in metres
#: Largest speed of the CoM in sqrt(gravity com_height). Chosen: 5 m/s for a robot as tall as TALOS.
FAST_RUN = 1.7
SWING_HEIGHT_M = 0.10  # of robots without a setup
HAND_INSET_M = 0.03  # of a hand's nominal position in its box: an arm hanging down is at the edge of what it reaches
SOLE_FRICTION = 0.7  # surfaces' default; half of it is left for forces along the ground
PHASE_DURATION = (0.3, 0.6)  # [s] of robots with soles: legs of such a weight follow no shorter swing
#: Ratio of a sole for the planned centre of pressure: swinging legs need the rest, g1 fell without it.
PRESSURE_RATIO = 0.75
#: Fields of robots with soles.
_SOLED: dict[str, Any] = {
    "phase_duration": PHASE_DURATION,
    "sole_support": 1.0,
    "pressure_ratio": PRESSURE_RATIO,
    "tracked": True,
}
#: Shortest and longest phase of robots on four point feet and more, in sqrt(com_height / gravity).
STEP_PHASES = (0.93, 2.3)
_MIN_STEP = 0.01  # of the grid of reach boxes, in CoM heights, so that its points can be counted


@dataclass(frozen=True)
class _Reach:
    """What a limb can do, relative to the CoM, axes of the base.

    Attributes:
        nominal: Position of the end [m].
        low: Corner of the reach box [m].
        high: The opposite one [m].
        force: Largest one [N].
        headings: How far the sole may be turned to the right (<= 0) and to the left [rad]; None: no sole.
        cut: Face that cuts the box; None: none does.
    """

    nominal: np.ndarray
    low: np.ndarray
    high: np.ndarray
    force: float = np.inf
    headings: tuple[float, float] | None = None
    cut: Cut | None = None


def robot_from_urdf(
    source: str,
    ends: tuple[End, ...] = (),
    srdf: str | None = None,
    posture: Mapping[str, float] | None = None,
    step: float = 0.02,
    seed: int = 0,
) -> Robot:
    """Work out a robot from its URDF.

    Args:
        source: A name of example-robot-data ("talos", "anymal"), or the path of a URDF file.
        ends: End-effectors; may be empty for the names in SETUPS.
        srdf: SRDF file with the nominal posture (its first one), for a URDF file; None: the neutral one.
        posture: Angles [rad] by joint, set on top of that.
        step: Grid of the reach boxes [m].
        seed: Of the random starts of inverse kinematics.

    Raises:
        MissingExtra: Pinocchio is not installed.
        InvalidInput: No such URDF, frame, joint or setup (an argument is named), or something in a file (the file is).
    """
    require("mcplan robots --from-urdf", "view", "pinocchio", "example_robot_data")
    setup = SETUPS.get(source)
    model, nominal, urdf = load_model(source, ends, srdf, posture)
    ends = ends_of(source, ends)
    if not any(end.kind == "foot" for end in ends):
        raise InvalidInput("ends", "needs one of kind foot at least, whose height is the ground's")

    mass, inertia, com_height = _centroidal(model, nominal, ends, source)
    limbs = {end.name: limb_of(model, nominal, end, ends, source) for end in ends}
    boxes = {}
    step = max(step, _MIN_STEP * com_height)
    for end in ends:
        limb = limbs[end.name]
        position = limb.position(limb.nominal)
        low, high = search_box(position, end, com_height, setup.lift if setup else Setup.lift)
        boxes[end.name] = _Reach(position, *largest_box(explore(limb, low, high, step, seed)))
    shared = {end.name: _same_box(boxes, end, com_height) for end in ends}
    shared = _lifted(limbs, shared, ends, step, seed)
    able = {end.name: _with_strength(limbs[end.name], shared[end.name], end.kind == "foot", seed) for end in ends}
    robot = Robot(
        name=Path(source).stem,
        description=setup.description if setup else "",
        mass=round(mass, 3),
        inertia=np.diag(inertia).round(3),
        com_height=round(com_height, 3),
        max_com_speed=round(FAST_RUN * float(np.sqrt(GRAVITY * com_height)), 1),
        swing_height=setup.swing_height if setup else SWING_HEIGHT_M,
        end_effectors=[_end_effector(end, _same_strength(able, end), mass * GRAVITY) for end in ends],
        trunk=trunk_of(model, nominal, ends, {end.name: own_joints(model, end, ends) for end in ends}, source),
        urdf=urdf,
        posture=_posture_of(model, nominal),
        **_as_tracked(ends, com_height),
    )
    if (legs := legs_of(model, nominal, ends, limbs)) is not None:
        add_limb_limits(robot, legs, ends, seed)
        add_leg_shapes(robot, legs, source)
        add_far_reach(robot, legs, step, seed)
    return robot


def _as_tracked(ends: tuple[End, ...], com_height: float) -> dict[str, Any]:
    """Fields of robots whose plans a controller follows: those on soles, and those on four point feet and more."""
    if any(any(end.half_size) for end in ends):
        return _SOLED
    if sum(end.kind == "foot" for end in ends) < 4:
        return {}
    unit = float(np.sqrt(com_height / GRAVITY))
    return {"phase_duration": [round(phase * unit, 2) for phase in STEP_PHASES], "tracked": True}


def _centroidal(model: Any, nominal: np.ndarray, ends: tuple[End, ...], source: str) -> tuple[float, np.ndarray, float]:
    """Mass [kg], inertia about the CoM [kg m^2] and height of the CoM above the feet [m] in the nominal posture."""
    import pinocchio as pin

    frames = [contact_frame(model, end) for end in ends]
    data = model.createData()
    pin.ccrba(model, data, nominal, np.zeros(model.nv))
    mass, com, inertia = float(pin.computeTotalMass(model)), data.com[0].copy(), data.Ig.inertia.copy()
    pin.framesForwardKinematics(model, data, nominal)
    soles = [data.oMf[f].translation[2] for f, end in zip(frames, ends, strict=True) if end.kind == "foot"]
    com_height = float(com[2] - np.mean(soles))
    _require_size(mass, com_height, inertia, source)
    return mass, inertia, com_height


def _posture_of(model: Any, nominal: np.ndarray) -> dict[str, float]:
    """Angles [rad] by joint."""
    return {
        model.names[j]: round(float(nominal[model.idx_qs[j]]), 4) for j in range(2, model.njoints) if model.nqs[j] == 1
    }


def _require_size(mass: float, com_height: float, inertia: np.ndarray, source: str) -> None:
    """A robot that stands and is no larger than a crane: lengths of URDFs are easily given in millimetres."""
    if not (np.isfinite(mass) and mass > 0.0):
        raise InvalidInput("mass", "must be a positive number: links need their inertial", f"{mass:g} kg", source)
    if not (np.isfinite(inertia).all() and np.diag(inertia).min() > 0.0):
        raise InvalidInput("inertia", "must be positive about every axis", written(np.diag(inertia).tolist()), source)
    if not 1e-3 < com_height < MAX_COM_HEIGHT:
        rule = f"must lie between 0.001 and {MAX_COM_HEIGHT:g} m above the feet; lengths are in metres"
        raise InvalidInput("com_height", rule, f"{com_height:g} m", source)


def header(command: str, step: float = 0.02, own_posture: bool = False) -> str:
    """Comment on top of a file made from a URDF: the command, and where each number comes from.

    Args:
        command: That made it.
        step: Grid of the reach boxes [m].
        own_posture: The nominal posture is not the SRDF's.
    """
    text = HEADER.format(
        posture="the posture below" if own_posture else "the SRDF's posture",
        fast=FAST_RUN,
        step=step,
        points=POINTS,
        heading=HEADING_MAX,
        inset=HAND_INSET_M,
        friction=0.5 * SOLE_FRICTION,
        full=SOLE_FRICTION,
    )
    return f"Made by: {command}\n{textwrap.fill(text, 116)}"


def ends_of(source: str, ends: tuple[End, ...] = ()) -> tuple[End, ...]:
    """The end-effectors given, or those in SETUPS.

    Raises:
        InvalidInput: None are given and there are none in SETUPS.
    """
    if not ends and source not in SETUPS:
        raise InvalidInput("ends", f"must be given for a robot other than {', '.join(SETUPS)}", shown(source))
    return ends or SETUPS[source].ends


def load_model(
    source: str, ends: tuple[End, ...] = (), srdf: str | None = None, posture: Mapping[str, float] | None = None
) -> tuple[Any, np.ndarray, str]:
    """Pinocchio model with a free base, nominal posture, and what to write as `urdf` of the robot.

    Args:
        source: A name of example-robot-data, or the path of a URDF file.
        ends: Whose links must exist; may be empty for the names in SETUPS.
        srdf: With the nominal posture, for a URDF file.
        posture: Angles [rad] by joint, set on top of that; None: those in SETUPS.

    Raises:
        InvalidInput: No such file and no such name in example-robot-data, no such link or joint, or no ends.
    """
    model, nominal, urdf = _read(source, srdf)
    for end in ends_of(source, ends):
        if not model.existBodyName(end.frame):
            links = [frame.name for frame in model.frames if model.existBodyName(frame.name)]
            rule = f"must name a link of the URDF. {did_you_mean(end.frame, links)}".rstrip(" .")
            raise InvalidInput(f"ends.{end.name}", rule, shown(end.frame))
    if posture is None:
        posture = SETUPS[source].posture if source in SETUPS else {}
    for joint, angle in posture.items():
        if not model.existJointName(joint) or model.nqs[model.getJointId(joint)] != 1:
            near = did_you_mean(joint, [name for name, size in zip(model.names, model.nqs, strict=True) if size == 1])
            rule = f"must name a joint of the URDF that has one angle. {near}".rstrip(" .")
            raise InvalidInput(f"posture.{joint}", rule)
        nominal[model.idx_qs[model.getJointId(joint)]] = angle
    return model, nominal, urdf


def _read(source: str, srdf: str | None) -> tuple[Any, np.ndarray, str]:
    import pinocchio as pin

    if exists(source):
        model = build_model(read_urdf(source, InvalidInput), InvalidInput, source)
        if srdf is None:
            return model, pin.neutral(model), source
        return model, _first_posture(model, srdf), source
    try:
        packaged = packaged_robot(source)
    except Exception as found:  # its loaders raise what the file system or the parser happen to raise
        raise InvalidInput("source", "must be a URDF file or a name of example-robot-data", shown(source)) from found
    return pin.Model(packaged.model), packaged.posture.copy(), f"example-robot-data:{source}"


def _first_posture(model: Any, srdf: str) -> np.ndarray:
    import pinocchio as pin

    xml = read_xml(srdf, InvalidInput)
    try:
        pin.loadReferenceConfigurationsFromXML(model, xml.text)
        posture = np.array(next(iter(model.referenceConfigurations)).data())
    except Exception as found:  # of Pinocchio's parser; StopIteration: there is none
        raise InvalidInput("", "must hold a posture (group_state) of the robot", "none", srdf) from found
    if posture.shape != (model.nq,) or not np.isfinite(posture).all():
        raise InvalidInput("group_state", "must hold a posture of finite angles", "another", srdf)
    return posture


def _same_box(boxes: Mapping[str, _Reach], end: End, com_height: float) -> _Reach:
    """Nominal position and box shared with the twin: the mean position, the intersection of the boxes."""
    own = boxes[end.name]
    nominal, low, high = own.nominal.copy(), own.low.copy(), own.high.copy()
    if end.twin in boxes:
        flip, twin = np.array([1.0, -1.0, 1.0]), boxes[end.twin]
        other_low, other_high = flip * twin.low, flip * twin.high
        other_low[1], other_high[1] = other_high[1], other_low[1]
        nominal = 0.5 * (nominal + flip * twin.nominal)
        low, high = np.maximum(low, other_low), np.minimum(high, other_high)
    if end.kind == "foot":
        nominal[2] = -round(com_height, 3)  # all soles on the ground
    inset = 0.0 if end.kind == "foot" else HAND_INSET_M
    low, high = low.round(3), high.round(3)
    return _Reach(np.clip(nominal, low + inset, high - inset).round(3) + 0.0, low, high)  # no -0.0


def _lifted(
    limbs: Mapping[str, Limb], shared: Mapping[str, _Reach], ends: tuple[End, ...], step: float, seed: int
) -> dict[str, _Reach]:
    """The boxes, of soles with the face up to which they are lifted, the same for both twins."""
    faces: dict[str, Cut | None] = {}
    out = dict(shared)
    for end in ends:
        reach = shared[end.name]
        if end.twin in faces or not limbs[end.name].flat:
            face = faces.get(end.twin)
        else:
            sides = [(limbs[n], shared[n].low, shared[n].high) for n in (end.name, end.twin) if n in limbs]
            face = cut_of(sides, -LIFT * float(reach.nominal[2]), step, seed)
        faces[end.name] = face
        if face is not None:
            top = np.floor(face.top(float(reach.high[0])) * 1e3) / 1e3
            out[end.name] = replace(reach, high=np.array([*reach.high[:2], top]), cut=face)
    return out


def _with_strength(limb: Limb, reach: _Reach, foot: bool, seed: int) -> _Reach:
    """With the median of the forces that the limb bears, and how far its sole can be turned.

    Feet bear most of the weight near the height at which the robot stands, where legs are stretched: the box reaches
    higher for swings. Walking forces lie between upright ones and those that point at the CoM.
    """
    low, high = reach.low.copy(), reach.high.copy()
    if foot:
        low[2] = high[2] = reach.nominal[2]
    forces = strengths_in_box(limb, low, high, seed=seed, through_com=foot)
    top = reach.cut.top if reach.cut else None
    headings = headings_reached(limb, reach.nominal, reach.low, reach.high, top=top) if limb.flat else None
    return replace(reach, force=float(np.median(forces)) if len(forces) else 0.0, headings=headings)


def _same_strength(able: Mapping[str, _Reach], end: End) -> _Reach:
    """Force and turn that both twins are capable of."""
    own, twin = able[end.name], able.get(end.twin)
    if twin is None:
        return own
    headings = own.headings
    if headings is not None and twin.headings is not None:
        headings = (max(headings[0], -twin.headings[1]), min(headings[1], -twin.headings[0]))
    return replace(own, force=min(own.force, twin.force), headings=headings)


def _end_effector(end: End, reach: _Reach, weight: float) -> EndEffector:
    return EndEffector(
        name=end.name,
        kind=end.kind,
        frame=end.frame,
        frame_offset=end.frame_offset,
        half_size=end.half_size,
        nominal_B=reach.nominal,
        reach_min_B=reach.low,
        reach_max_B=reach.high,
        reach_cut=reach.cut.polytope() if reach.cut else Polytope(),
        max_force=rounded_down(reach.force),
        max_moment=[0, 0, round(sole_torsion(end.half_size, 0.5 * weight, 0.5 * SOLE_FRICTION), 2)],
        yaw_range=EndEffector().yaw_range if reach.headings is None else reach.headings,
    )
