"""Distances between the links of a robot, and rows that keep the controller's accelerations from closing them."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .states import to_mujoco

if TYPE_CHECKING:
    from .mujoco_model import SimulationModel
    from .robot_dynamics import RobotDynamics

Array = NDArray[np.float64]

#: Links are kept this far apart [m], but at most this ratio of their distance in the nominal posture: a knee and a foot of
#: one leg are nearer to each other than that in every stance.
APART_M, MARGIN_RATIO = 0.01, 0.5
#: Pairs nearer than this [m] are looked at; beyond the second one distances are not worked out.
NEAR_M, FAR_M = 0.05, 0.5
#: Number of rows.
ROWS = 8
#: Gains [1/s^2, 1/s] by which a distance may approach APART_M, and the largest acceleration that it is opened with [m/s^2].
KP, KD, LARGEST = 900.0, 60.0, 50.0


@dataclass(frozen=True)
class _NearPair:
    """A pair of shapes near to each other: its number, nearest points, direction from the first to the second one, and the
    least acceleration of its distance."""

    pair: int
    points_W: tuple[Array, Array]
    normal_W: Array
    least: float


class Separation:
    """Pairs of links that may touch each other.

    The distance of a pair is worked out only when it may have come below NEAR_M since the last time, by how far its shapes
    have moved.

    Args:
        model: The robot with shapes of its links; what is simulated is not looked at.
    """

    def __init__(self, model: SimulationModel) -> None:
        import mujoco

        self._model, self._mj, self._mujoco = model, model.mj, mujoco
        self._data: Any = mujoco.MjData(model.mj)
        self._pairs = np.array(_pairs(model), dtype=np.int64).reshape(-1, 2)
        self._geoms = np.unique(self._pairs)
        names = list(model.urdf_model.model.names)
        joint_of = {model.mj.joint(name).bodyid[0]: names.index(name) for name in model.joints}
        self._joint_of = {geom: joint_of.get(int(model.mj.geom_bodyid[geom]), 1) for geom in self._geoms}
        # Exact where it was last worked out, less what shapes have moved since.
        self._distance = np.full(len(self._pairs), -np.inf)
        self._places: tuple[Array, Array] | None = None
        self._moved = np.zeros(model.mj.ngeom)
        self._margins = np.minimum(APART_M, MARGIN_RATIO * self._nominal_distances())

    def rows(self, dynamics: RobotDynamics) -> tuple[Array, Array]:
        """Rows (ROWS, nv) and least values (ROWS,) of accelerations; rows that are not used are 0 and -inf.

        For a pair at distance d, of which n points from the first shape's nearest point to the second one's:
        n (J_2 - J_1) qdd >= -KP (d - margin) - KD n (J_2 - J_1) v, at most LARGEST. Of the near pairs these are the ROWS
        with the largest right-hand sides.
        """
        rows, least = np.zeros((ROWS, len(dynamics.velocity))), np.full(ROWS, -np.inf)
        for row, near in enumerate(self._most_urgent(dynamics)):
            first, second = (self._joint_of[geom] for geom in self._pairs[near.pair])
            here, there = near.points_W
            rows[row] = near.normal_W @ (dynamics.point_jacobian(second, there) - dynamics.point_jacobian(first, here))
            least[row] = min(near.least, LARGEST)
        return rows, least

    def _most_urgent(self, dynamics: RobotDynamics) -> list[_NearPair]:
        """The near pairs with the largest least accelerations, the largest first.

        The nearest ones would not do: thighs are near to each other in every stance, and a hand that comes towards them
        fast has to be braked before it is as near as they are.
        """
        found = []
        for pair, distance, (here, there) in self._near(dynamics):
            size = float(np.linalg.norm(there - here))
            if size < 1e-9:
                continue
            normal = np.sign(distance) * (there - here) / size
            first, second = (self._joint_of[geom] for geom in self._pairs[pair])
            rate = float(normal @ (dynamics.point_velocity(second, there) - dynamics.point_velocity(first, here)))
            least = -KP * (distance - self._margins[pair]) - KD * rate
            found.append(_NearPair(pair, (here, there), normal, least))
        return sorted(found, key=lambda near: -near.least)[:ROWS]

    def _near(self, dynamics: RobotDynamics) -> list[tuple[int, float, Array]]:
        """Number, distance and nearest points (2, 3) of the pairs nearer than NEAR_M."""
        mj, data = self._mj, self._data
        data.qpos[:], _ = to_mujoco(self._model, dynamics.configuration, dynamics.velocity)
        self._mujoco.mj_kinematics(mj, data)
        self._shrink()
        found = []
        points = np.zeros(6)
        for i in np.flatnonzero(self._distance < NEAR_M):
            # Beyond some distance its value is of no interest, but how long it need not be looked at is.
            distance = self._mujoco.mj_geomDistance(mj, data, *self._pairs[i], FAR_M, points)
            self._distance[i] = distance
            if distance < NEAR_M:
                found.append((int(i), float(distance), points.reshape(2, 3).copy()))
        return found

    def _nominal_distances(self) -> Array:
        """(n,) distance of each pair in the nominal posture, at most FAR_M."""
        urdf_model = self._model.urdf_model
        self._data.qpos[:], _ = to_mujoco(self._model, urdf_model.neutral, np.zeros(urdf_model.model.nv))
        self._mujoco.mj_kinematics(self._mj, self._data)
        distances = [self._mujoco.mj_geomDistance(self._mj, self._data, *pair, FAR_M, None) for pair in self._pairs]
        return np.maximum(distances, 0.0)

    def _shrink(self) -> None:
        """Take from each distance what its two shapes may have come nearer since the last time."""
        places = self._data.geom_xpos[self._geoms].copy(), self._data.geom_xmat[self._geoms].copy()
        if self._places is not None:
            shift = np.linalg.norm(places[0] - self._places[0], axis=1)
            turn = np.linalg.norm(places[1] - self._places[1], axis=1) * self._mj.geom_rbound[self._geoms]
            self._moved[self._geoms] = shift + turn
            self._distance -= self._moved[self._pairs].sum(axis=1)
        self._places = places


def _pairs(model: SimulationModel) -> list[tuple[int, int]]:
    """Pairs of the robot's geoms between which the simulation makes contacts."""
    mj = model.mj
    excluded = {int(signature) for signature in mj.exclude_signature}
    geoms = [geom for geom in sorted(model.geom_names) if geom not in model.surface_geoms]
    pairs = []
    for first, second in itertools.combinations(geoms, 2):
        a, b = sorted((int(mj.geom_bodyid[first]), int(mj.geom_bodyid[second])))
        own = a == b or mj.body_parentid[b] == a
        touches = mj.geom_contype[first] & mj.geom_conaffinity[second]
        if touches and not own and (a << 16) + b not in excluded:
            pairs.append((first, second))
    return pairs
