"""What a plan of contact wrenches asks for at most: angular momentum, force and friction of each end-effector."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from mcplan._core import ForceLaw

from .rotations import polygon_normal

if TYPE_CHECKING:
    from mcplan import Plan

#: [s] between the instants that are looked at, at most; both ends of every phase are among them.
STEP_S = 0.005
#: Weights: a contact with a smaller force has no friction to speak of.
NOTHING = 1e-6


@dataclass
class Loads:
    """Largest values over a plan.

    Attributes:
        angular_momentum: Length of the angular momentum about the CoM [kg m^2/s].
        forces: Of each end-effector that touches something: its force in weights of the robot.
        frictions: Likewise: tangential over normal force, infinite for a pull.
    """

    angular_momentum: float = 0.0
    forces: dict[str, float] = field(default_factory=dict)
    frictions: dict[str, float] = field(default_factory=dict)


def loads_of(plan: Plan) -> Loads | None:
    """Loads of a plan of ForceLaw.wrench; None for others."""
    if not plan.phases or any(phase.law != ForceLaw.wrench for phase in plan.phases):
        return None
    loads, weight = Loads(), float(plan.robot.mass) * float(plan.scene.gravity)
    normals = [polygon_normal(np.asarray(s.vertices_W)) for s in plan.scene.surfaces]
    for k, phase in enumerate(plan.phases):
        for since in np.linspace(0.0, phase.duration, int(np.ceil(phase.duration / STEP_S)) + 1):
            state = plan.at_phase(k, float(since))
            loads.angular_momentum = max(loads.angular_momentum, float(np.linalg.norm(state.angular_momentum_W)))
            for body, end in zip(plan.robot.end_effectors, state.end_effectors, strict=True):
                if end.surface < 0:
                    continue
                size, normal = float(np.linalg.norm(end.force_W)), float(end.force_W @ normals[end.surface])
                across = np.sqrt(max(size**2 - normal**2, 0.0))
                ratio = 0.0 if size < NOTHING * weight else float(across / normal) if normal > 0.0 else np.inf
                loads.forces[body.name] = max(loads.forces.get(body.name, 0.0), size / weight)
                loads.frictions[body.name] = max(loads.frictions.get(body.name, 0.0), ratio)
    return loads
