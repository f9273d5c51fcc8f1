"""Distances between the links of a robot, and of arms from the terrain, and rows that keep accelerations from closing them."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .arm_clearance import ArmPairs
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
#: Arms are kept so far off solids [m], and looked at from the second one on: their way to the side is longer.
ARM_APART_M, ARM_NEAR_M = 0.02, 0.1
#: Which solids arms may come near to is looked at anew after their shapes have moved so far [m]: there may be thousands.
AHEAD_M = 0.4
#: Number of rows of links, and of arms.
ROWS, ARM_ROWS = 8, 8
#: Gains [1/s^2, 1/s] by which a distance may approach APART_M, and the largest acceleration that it is opened with [m/s^2].
KP, KD, LARGEST = 900.0, 60.0, 50.0


class Separation:
    """Pairs of links that may touch each other, and of arms and solids.

    The distance of a pair is worked out only when it may have come below NEAR_M since the last time, by how far its shapes
    have moved.

    Args:
        model: The robot with shapes of its links; what is simulated is not looked at.
        terrain: Arms keep off the terrain too, as it is in the model; False: they do not know it.
    """

    def __init__(self, model: SimulationModel, terrain: bool = True) -> None:
        import mujoco

        self._model, self._mj, self._mujoco = model, model.mj, mujoco
        self._data: Any = mujoco.MjData(model.mj)
        self._arms = ArmPairs(model, terrain)
        links = np.array(_pairs(model), dtype=np.int64).reshape(-1, 2)
        self._pairs, self._links = np.vstack([links, self._arms.pairs]), len(links)
        self._geoms = np.setdiff1d(self._pairs, model.surface_geoms)  # what moves
        self._beside = np.arange(len(self._pairs))  # pairs that are looked at
        self._ahead_m = -1.0  # how far shapes may move until others are
        names = list(model.urdf_model.model.names)
        joint_of = {model.mj.joint(name).bodyid[0]: names.index(name) for name in model.joints}
        joint_of[0] = 0  # the world, which nothing moves
        geom_joint = [joint_of.get(int(body), 1) for body in model.mj.geom_bodyid]
        self._joints = np.array(geom_joint, dtype=np.int64)[self._pairs]
        # Exact where it was last worked out, less what shapes have moved since.
        self._distance = np.full(len(self._pairs), -np.inf)
        self._places: tuple[Array, Array] | None = None
        self._moved = np.zeros(model.mj.ngeom)
        self._margins = np.full(len(self._pairs), ARM_APART_M)
        self._margins[: self._links] = np.minimum(APART_M, MARGIN_RATIO * self._nominal_distances())
        self._near_m = np.where(np.arange(len(self._pairs)) < self._links, NEAR_M, ARM_NEAR_M)

    def rows(self, dynamics: RobotDynamics, free: NDArray[np.bool_] | None = None) -> tuple[Array, Array]:
        """Rows (r, nv) and least values (r,) of accelerations; rows that are not used are 0 and -inf.

        For a pair at distance d, of which n points from the first shape's nearest point to the second one's:
        n (J_2 - J_1) qdd >= -KP (d - margin) - KD n (J_2 - J_1) v, at most LARGEST. Of the near pairs of links
        these are the ROWS with the largest right-hand sides, then come ARM_ROWS of arms, if any is near.

        Args:
            dynamics: The state.
            free: (e,) end-effectors that are in the air and touch nothing later: arms of other hands keep off nothing. None: no
                arm does.
        """
        pairs, distances, points = self._near(dynamics, free)
        size = ROWS + (ARM_ROWS if (pairs >= self._links).any() else 0)
        rows, least = np.zeros((size, len(dynamics.velocity))), np.full(size, -np.inf)
        apart = points[:, 1] - points[:, 0]
        sizes = np.sqrt((apart * apart).sum(axis=1))
        normals = apart * (np.sign(distances) / np.maximum(sizes, 1e-9))[:, None]
        ways = dynamics.distance_rows(self._joints[pairs], points, normals)
        wanted = -KP * (distances - self._margins[pairs]) - KD * (ways @ dynamics.velocity)
        wanted[sizes < 1e-9] = -np.inf
        # The nearest ones would not do: thighs are near to each other in every stance, and a hand that comes towards them
        # fast has to be braked before it is as near as they are.
        for chosen, begin, count in ((pairs < self._links, 0, ROWS), (pairs >= self._links, ROWS, ARM_ROWS)):
            first = np.flatnonzero(chosen & (wanted > -np.inf))
            first = first[np.argsort(-wanted[first])[:count]]
            to = slice(begin, begin + len(first))
            rows[to], least[to] = ways[first], np.minimum(wanted[first], LARGEST)
        return rows, least

    def _near(
        self, dynamics: RobotDynamics, free: NDArray[np.bool_] | None = None
    ) -> tuple[NDArray[np.int64], Array, Array]:
        """Numbers (n,), distances (n,) and nearest points (n, 2, 3) of the pairs that are near."""
        mj, data, measure = self._mj, self._data, self._mujoco.mj_geomDistance
        data.qpos[:], _ = to_mujoco(self._model, dynamics.configuration, dynamics.velocity)
        self._mujoco.mj_kinematics(mj, data)
        self._shrink()
        if self._ahead_m < 0.0:
            self._look_about()
        pairs = self._beside[self._distance[self._beside] < self._near_m[self._beside]]
        if len(pairs) and pairs[-1] >= self._links:
            pairs = self._of_arms(pairs, free)
        points, distances = np.zeros((len(pairs), 6)), np.zeros(len(pairs))
        for k, (first, second) in enumerate(self._pairs[pairs].tolist()):
            # Beyond some distance its value is of no interest, but how long it need not be looked at is.
            distances[k] = measure(mj, data, first, second, FAR_M, points[k])
        self._distance[pairs] = distances
        near = distances < self._near_m[pairs]
        return pairs[near], distances[near], points[near].reshape(-1, 2, 3)

    def _of_arms(self, pairs: NDArray[np.int64], free: NDArray[np.bool_] | None) -> NDArray[np.int64]:
        """Of numbers of pairs those of links, and those of arms whose hands are free that a bound does not rule out."""
        arms = pairs[pairs >= self._links]
        at_least = self._arms.at_least(self._data, arms - self._links)
        self._distance[arms] = np.maximum(self._distance[arms], at_least)
        near = self._distance[arms] < ARM_NEAR_M
        if free is not None:
            near &= free[self._arms.hands[arms - self._links]]
        return np.concatenate([pairs[pairs < self._links], arms[near] if free is not None else arms[:0]])

    def _look_about(self) -> None:
        """Look at the solids that arms may come near to before they have moved by AHEAD_M, and at all links."""
        arms = np.arange(self._links, len(self._pairs))
        self._distance[arms] = self._arms.at_least(self._data, arms - self._links)
        near = self._distance[arms] < ARM_NEAR_M + AHEAD_M
        self._beside, self._ahead_m = np.concatenate([np.arange(self._links), arms[near]]), AHEAD_M

    def _nominal_distances(self) -> Array:
        """(n,) distance of each pair of links in the nominal posture, at most FAR_M."""
        urdf_model = self._model.urdf_model
        self._data.qpos[:], _ = to_mujoco(self._model, urdf_model.neutral, np.zeros(urdf_model.model.nv))
        self._mujoco.mj_kinematics(self._mj, self._data)
        links = self._pairs[: self._links]
        distances = [self._mujoco.mj_geomDistance(self._mj, self._data, *pair, FAR_M, None) for pair in links]
        return np.maximum(distances, 0.0)

    def _shrink(self) -> None:
        """Take from each distance what its two shapes may have come nearer since the last time."""
        places = self._data.geom_xpos[self._geoms].copy(), self._data.geom_xmat[self._geoms].copy()
        if self._places is not None:
            shift, turn = (now - before for now, before in zip(places, self._places, strict=True))
            turned = np.sqrt(np.einsum("ij,ij->i", turn, turn)) * self._mj.geom_rbound[self._geoms]
            self._moved[self._geoms] = np.sqrt(np.einsum("ij,ij->i", shift, shift)) + turned
            self._distance[self._beside] -= self._moved[self._pairs[self._beside]].sum(axis=1)
            self._ahead_m -= float(self._moved.max())
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
