"""Contact sequences (.json) with the keys of LAAS's multicontact-api, curves as ndcurves has them.

The keys are those under which ContactSequence, ContactPhase and ContactPatch are serialised. The library itself reads archives
of Boost, which only it can write: there one `contact_phase` follows the other, here they are a list. Phases are joined where
contacts do not change, as its haveConsistentContacts asks.

A curve of vectors is piecewise polynomial: ``times`` (m + 1,) and for each piece ``coefficients`` (dim, degree + 1) in powers of
t - times[i]: what ndcurves.polynomial(coefficients, times[i], times[i + 1]) takes. A curve in SE(3) is piecewise linear, with
slerp: ``times``, ``translation`` (m + 1, 3) and ``rotation`` (m + 1, 3, 3), for ndcurves.SE3Curve.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mcplan.files.outputs import write_whole
from mcplan.kinematics.samples import Samples, sample_at
from mcplan.tracking.references import moment_about_com

if TYPE_CHECKING:
    from mcplan._core import Plan

    from .source import Source

Array = NDArray[np.float64]


def write(source: Source, path: Path) -> None:
    """Write the contact sequence of a plan."""
    plan = source.plan
    phases = [_phase(plan, stretch, source.rate_hz) for stretch in stretches(plan)]
    write_whole(json.dumps({"size": len(phases), "contact_phase": phases}, allow_nan=False), path)


@dataclass(frozen=True)
class Stretch:
    """Phases `first` to `last` of a plan, which have the same contacts, and their time [s]."""

    first: int
    last: int
    start_s: float
    end_s: float


def stretches(plan: Plan) -> list[Stretch]:
    """The plan cut where contacts change; a contact that is put elsewhere is another one."""
    sequence, times = plan.contact_sequence(), [float(t) for t in plan.knot_times()]
    found: list[Stretch] = []
    for k, contacts in enumerate(sequence):
        if found and contacts == sequence[k - 1]:
            found[-1] = Stretch(found[-1].first, k, found[-1].start_s, times[k + 1])
        else:
            found.append(Stretch(k, k, times[k], times[k + 1]))
    return found


@dataclass(frozen=True)
class _Sampled:
    """A phase sampled at m + 1 instants: what jumps at its ends is that of the phase."""

    samples: Samples
    acceleration_W: Array
    momentum_rate_W: Array
    forces_W: Array


def _phase(plan: Plan, stretch: Stretch, rate_hz: float) -> dict[str, Any]:
    """A ContactPhase."""
    pieces = [_sampled(plan, k, rate_hz) for k in range(stretch.first, stretch.last + 1)]
    curves: dict[str, list[Any]] = {key: [] for key in ("c", "dc", "ddc", "L", "dL", "root")}
    for piece in pieces:
        samples, times = piece.samples, piece.samples.times_s
        curves["c"].append(_cubic(times, samples.com_W, samples.com_velocity_W))
        curves["dc"].append(_cubic(times, samples.com_velocity_W, piece.acceleration_W))
        curves["ddc"].append(_linear(times, piece.acceleration_W))
        curves["L"].append(_cubic(times, samples.angular_momentum_W, piece.momentum_rate_W))
        curves["dL"].append(_linear(times, piece.momentum_rate_W))
        curves["root"].append(_poses(times, samples.com_W, samples.rotation_WB))
    phase: dict[str, Any] = {"t_init": stretch.start_s, "t_final": stretch.end_s}
    for end, piece, n in (("init", pieces[0], 0), ("final", pieces[-1], -1)):
        values = {"c": piece.samples.com_W, "dc": piece.samples.com_velocity_W, "ddc": piece.acceleration_W}
        values |= {"L": piece.samples.angular_momentum_W, "dL": piece.momentum_rate_W}
        phase |= {f"{key}_{end}": value[n].tolist() for key, value in values.items()}
    phase |= {key: _joined(parts) for key, parts in curves.items()}
    return {**phase, **_contacts(plan, stretch, pieces)}


def _contacts(plan: Plan, stretch: Stretch, pieces: list[_Sampled]) -> dict[str, Any]:
    """What a ContactPhase says of each end-effector."""
    forces, normal_forces, trajectories, patches = {}, {}, {}, {}
    contacts = plan.contact_sequence()[stretch.first]
    intervals = pieces[0].samples.intervals
    for e, (end, surface) in enumerate(zip(plan.robot.end_effectors, contacts, strict=True)):
        if surface < 0:
            trajectories[end.name] = _joined(
                [_poses(p.samples.times_s, p.samples.positions_W[:, e], p.samples.rotations_W[:, e]) for p in pieces]
            )
            continue
        middle = 0.5 * (stretch.start_s + stretch.end_s)
        interval = next(i for i in intervals if i.end_effector == e and i.start_s <= middle <= i.end_s)
        normal = interval.rotation_W[:, 2]
        patches[end.name] = {
            "placement": {"translation": interval.position_W.tolist(), "rotation": interval.rotation_W.tolist()},
            "mu": float(plan.scene.surfaces[surface].friction),
        }
        forces[end.name] = _joined([_linear(p.samples.times_s, p.forces_W[:, e]) for p in pieces])
        normal_forces[end.name] = _joined(
            [_linear(p.samples.times_s, (p.forces_W[:, e] @ normal)[:, None]) for p in pieces]
        )
    return {
        "effector_in_contact": sorted(patches),
        "contact_patches": patches,
        "contact_forces": forces,
        "contact_normal_force": normal_forces,
        "effector_trajectories": trajectories,
    }


def _sampled(plan: Plan, k: int, rate_hz: float) -> _Sampled:
    """A phase of the plan at about a rate, its ends among the instants."""
    knots = [float(t) for t in plan.knot_times()]
    start, end = knots[k], min(knots[k + 1], float(plan.duration()))
    times = np.linspace(start, end, max(1, int(np.ceil((end - start) * rate_hz))) + 1)
    samples = sample_at(plan, plan.scene, plan.robot, times)
    acceleration, forces = samples.com_acceleration_W.copy(), samples.forces_W.copy()
    rate = moment_about_com(samples)
    # The last instant belongs to the contacts before, not to those after.
    last = plan.at_phase(k, float(plan.phases[k].duration))
    acceleration[-1] = last.com_acceleration_W
    forces[-1] = [end.force_W for end in last.end_effectors]
    arms = np.array([end.position_W for end in last.end_effectors]) - last.com_W
    moments = np.array([end.moment_W for end in last.end_effectors])
    rate[-1] = (np.cross(arms, forces[-1]) + moments).sum(axis=0)
    return _Sampled(samples, acceleration, rate, forces)


def _joined(parts: list[dict[str, Any]]) -> dict[str, Any]:
    """Curves that follow each other as one: what is given at instants is not repeated where they meet."""
    whole = {key: list(values) for key, values in parts[0].items()}
    for part in parts[1:]:
        for key, values in part.items():
            whole[key] += values if key == "coefficients" else values[1:]
    return whole


def _cubic(times: Array, values: Array, rates: Array) -> dict[str, Any]:
    """Cubic pieces (Hermite) through values with given derivatives, (m + 1, dim) each."""
    pieces = []
    for i, h in enumerate(np.diff(times)):
        step, start, end = values[i + 1] - values[i], rates[i], rates[i + 1]
        square = (3.0 * step / h - 2.0 * start - end) / h
        cube = (start + end - 2.0 * step / h) / h**2
        pieces.append(np.column_stack([values[i], start, square, cube]).tolist())
    return {"times": times.tolist(), "coefficients": pieces}


def _linear(times: Array, values: Array) -> dict[str, Any]:
    """Linear pieces through values (m + 1, dim)."""
    rates = np.diff(values, axis=0) / np.diff(times)[:, None]
    pieces = [np.column_stack([value, rate]).tolist() for value, rate in zip(values[:-1], rates, strict=True)]
    return {"times": times.tolist(), "coefficients": pieces}


def _poses(times: Array, positions: Array, rotations: Array) -> dict[str, Any]:
    return {"times": times.tolist(), "translation": positions.tolist(), "rotation": rotations.tolist()}
