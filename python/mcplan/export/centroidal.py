"""The centroidal plan as a table (.csv) or with its phases (.json): CoM, momentum, base, contacts, forces."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import __version__
from mcplan.files.outputs import write_whole
from mcplan.kinematics.rotations import quat_xyzw

if TYPE_CHECKING:
    from .source import Source

AXES = ("x", "y", "z")


def write(source: Source, path: Path) -> None:
    """Write the plan sampled; as the name ends, a table or JSON with the phases beside it. Numbers are exact."""
    if path.suffix.lower() == ".csv":
        columns = table(source)
        rows = zip(*columns.values(), strict=True)
        lines = [",".join(columns), *(",".join(f"{value:.17g}" for value in row) for row in rows)]
        write_whole("\n".join(lines) + "\n", path)
    else:
        write_whole(json.dumps(document(source), allow_nan=False), path)


def table(source: Source) -> dict[str, Any]:
    """Columns by name, SI units, world frame W: ``com_x_W`` [m], ``force_left_foot_z_W`` [N], and so on."""
    samples = source.samples
    columns: dict[str, Any] = {"time_s": samples.times_s}
    vectors = {
        "com": samples.com_W,
        "com_velocity": samples.com_velocity_W,
        "com_acceleration": samples.com_acceleration_W,
        "angular_momentum": samples.angular_momentum_W,
    }
    for name, values in vectors.items():
        columns |= {f"{name}_{axis}_W": values[:, i] for i, axis in enumerate(AXES)}
    quats = quat_xyzw(samples.rotation_WB)[:, [3, 0, 1, 2]]
    columns |= {f"base_quat_{axis}": quats[:, i] for i, axis in enumerate("wxyz")}
    parts = (
        ("position", samples.positions_W),
        ("force", samples.forces_W),
        ("pressure", samples.pressure_W),
        ("moment", samples.moments_W),
    )
    for e, end in enumerate(source.end_effector_names):
        columns[f"surface_{end}"] = samples.surfaces[:, e]
        for name, values in parts:
            columns |= {f"{name}_{end}_{axis}_W": values[:, e, i] for i, axis in enumerate(AXES)}
    return columns


def document(source: Source) -> dict[str, Any]:
    """Header, phases, and the same columns."""
    plan = source.plan
    surfaces = [surface.name for surface in plan.scene.surfaces]
    times = np.asarray(plan.knot_times(), float)
    phases = [
        {
            "start_s": times[k],
            "duration_s": float(phase.duration),
            "contacts": {
                end: surfaces[surface]
                for end, surface in zip(source.end_effector_names, contacts, strict=True)
                if surface >= 0
            },
        }
        for k, (phase, contacts) in enumerate(zip(plan.phases, plan.contact_sequence(), strict=True))
    ]
    return {
        "format": "mcplan centroidal plan",
        "version": 1,
        "mcplan": __version__,
        "units": "SI, world frame W with z up, forces and moments on the robot, moments about the centre of pressure",
        "robot": {"name": plan.robot.name, "mass_kg": plan.robot.mass},
        "gravity": plan.scene.gravity,
        "end_effectors": source.end_effector_names,
        "surfaces": [{"name": s.name, "vertices_W": np.asarray(s.vertices_W).tolist()} for s in plan.scene.surfaces],
        "phases": phases,
        "columns": {name: np.asarray(values).tolist() for name, values in table(source).items()},
    }
