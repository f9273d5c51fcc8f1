"""Arms beside solids: pairs of their shapes and surfaces of the scene, of which plans know no more than the hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from .mujoco_model import SimulationModel

Array = NDArray[np.float64]


class ArmPairs:
    """Shapes of what moves a hand alone, each with each surface of the scene.

    Args:
        model: The robot, with shapes of its links, and the terrain.
        terrain: False: there are no pairs.

    Attributes:
        pairs: (n, 2) geoms: the shape and the surface.
        hands: (n,) end-effector that the shape belongs to.
    """

    def __init__(self, model: SimulationModel, terrain: bool) -> None:
        arms = _arm_geoms(model) if terrain else []
        rows = [(geom, surface, hand) for geom, hand in arms for surface in model.surface_geoms]
        table = np.array(rows, dtype=np.int64).reshape(-1, 3)
        self.pairs, self.hands = table[:, :2], table[:, 2]
        self._radii = np.asarray(model.mj.geom_rbound)[self.pairs[:, 0]]
        self._boxes: tuple[Array, Array] | None = None
        self._aabb = np.asarray(model.mj.geom_aabb)

    def at_least(self, data: Any, of: NDArray[np.int64]) -> Array:
        """Lower bounds of the distances of pairs by number [m], by the ball about the shape and the box about the solid.

        Of a ball whose centre is in the box nothing is known: -inf.
        """
        shapes, surfaces = self.pairs[of].T
        low, high = self._surface_boxes(data)
        center = data.geom_xpos[shapes]
        gap = np.maximum(np.maximum(low[surfaces] - center, center - high[surfaces]), 0.0)
        apart = np.sqrt((gap * gap).sum(axis=1))
        return np.where(apart > 0.0, apart - self._radii[of], -np.inf)

    def _surface_boxes(self, data: Any) -> tuple[Array, Array]:
        """Corners of the boxes about all geoms, those of surfaces for good: (g, 3) each [m]."""
        if self._boxes is None:
            turn = data.geom_xmat.reshape(-1, 3, 3)
            middle = data.geom_xpos + np.einsum("gij,gj->gi", turn, self._aabb[:, :3])
            half = np.einsum("gij,gj->gi", np.abs(turn), self._aabb[:, 3:])
            self._boxes = middle - half, middle + half
        return self._boxes


def _arm_geoms(model: SimulationModel) -> list[tuple[int, int]]:
    """Geoms of what moves one end-effector alone, a hand, or is moved with it as fingers are; and that end-effector."""
    urdf_model, mj = model.urdf_model, model.mj
    movers = [set(before) for before in urdf_model.model.supports]  # of each joint's link, itself among them
    of_end = [movers[urdf_model.model.frames[frame].parentJoint] for frame in urdf_model.frames]
    names = list(urdf_model.model.names)
    joint_of = {int(mj.joint(name).bodyid[0]): names.index(name) for name in model.joints}
    out = []
    for hand, end in enumerate(urdf_model.robot.end_effectors):
        if end.kind == "foot":
            continue
        arm = of_end[hand].difference(*(joints for e, joints in enumerate(of_end) if e != hand))
        for geom in sorted(model.geom_names):
            joint = joint_of.get(int(mj.geom_bodyid[geom]))
            if joint is not None and movers[joint] & arm:
                out.append((geom, hand))
    return out
