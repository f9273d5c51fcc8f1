"""Reach of a limb: which positions relative to the CoM it can take, and the largest box inside.

The base stays upright and the other limbs stay in the nominal posture; the CoM moves with the limb, as it does on the robot.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

TOLERANCE_M = 1e-3
HEADING_STEP = 0.05  # [rad]
HEADING_MAX = 0.8  # [rad] legs that touch each other are not looked at
_TOLERANCE_RAD = 5e-3
_ITERATIONS = 40
_STEP_RAD = 0.4
_DAMPING = 1e-4


@dataclass
class Limb:
    """A limb on a fixed base.

    Attributes:
        model: Pinocchio model of the free base and this limb, all other joints locked in the nominal posture.
        base: Position and quaternion of the base, which is held there.
        frame: Index of the contact frame in the model.
        nominal: Joint positions in the nominal posture [rad].
        lower: Joint limits [rad].
        upper: Joint limits [rad].
        flat: Keep the contact frame's orientation of the nominal posture, as a sole on level ground.
    """

    model: Any
    base: np.ndarray
    frame: int
    nominal: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    flat: bool

    def __post_init__(self) -> None:
        self._data = self.model.createData()
        self.position(self.nominal)
        self._orientation = self._data.oMf[self.frame].rotation.copy()

    def position(self, joints: np.ndarray) -> np.ndarray:
        """Position of the contact frame relative to the CoM [m], axes of the upright base."""
        import pinocchio as pin

        com = pin.centerOfMass(self.model, self._data, np.concatenate([self.base, joints]))
        pin.updateFramePlacements(self.model, self._data)
        return self._data.oMf[self.frame].translation - com

    def rotation_error(self, joints: np.ndarray) -> np.ndarray:
        """Rotation vector [rad] from the contact frame's orientation to that of the nominal posture, base axes."""
        import pinocchio as pin

        self.position(joints)
        return pin.log3(self._orientation @ self._data.oMf[self.frame].rotation.T)

    def jacobian(self, joints: np.ndarray) -> np.ndarray:
        """Of the position relative to the CoM and of the frame's rotation, 6 x joints."""
        import pinocchio as pin

        whole = np.concatenate([self.base, joints])
        com = pin.jacobianCenterOfMass(self.model, self._data, whole)[:, 6:]
        out = pin.computeFrameJacobian(self.model, self._data, whole, self.frame, pin.LOCAL_WORLD_ALIGNED)[:, 6:].copy()
        out[:3] -= com
        return out

    def solve(self, target: np.ndarray, start: np.ndarray, heading: float = 0.0) -> np.ndarray | None:
        """Joint positions [rad] within the limits that put the contact frame at `target` [m], or None.

        Args:
            target: Position relative to the CoM.
            start: Joint positions to start from.
            heading: Turn of a flat frame about the vertical against the nominal posture [rad].
        """
        import pinocchio as pin

        joints = start.copy()
        orientation = pin.AngleAxis(heading, np.array([0.0, 0.0, 1.0])).matrix() @ self._orientation
        rows = 6 if self.flat else 3
        for _ in range(_ITERATIONS):
            error = np.zeros(6)
            error[:3] = target - self.position(joints)
            if self.flat:
                error[3:] = pin.log3(orientation @ self._data.oMf[self.frame].rotation.T)
            if np.linalg.norm(error[:3]) < TOLERANCE_M and np.linalg.norm(error[3:]) < _TOLERANCE_RAD:
                return joints
            jacobian = self.jacobian(joints)[:rows]
            # Joints at a limit that would have to go beyond it are left out, so that the others make up for them.
            free = np.ones(joints.size, dtype=bool)
            for _ in range(2):
                active = jacobian * free
                step = active.T @ np.linalg.solve(active @ active.T + _DAMPING * np.eye(rows), error[:rows])
                beyond = ((joints >= self.upper) & (step > 0)) | ((joints <= self.lower) & (step < 0))
                if not (beyond & free).any():
                    break
                free &= ~beyond
            joints = np.clip(joints + step * min(1.0, _STEP_RAD / (np.abs(step).max() + 1e-12)), self.lower, self.upper)
        return None


@dataclass
class Grid:
    """Points around the nominal one: nominal + step * (index - origin).

    Attributes:
        nominal: [m]
        step: [m]
        origin: Index of the nominal point on each axis.
        reached: Which points the limb reaches, 3-D.
    """

    nominal: np.ndarray
    step: float
    origin: np.ndarray
    reached: np.ndarray

    def point(self, index: Any) -> np.ndarray:
        """Position of a grid point [m]."""
        return self.nominal + self.step * (np.asarray(index) - self.origin)


def explore(limb: Limb, low: np.ndarray, high: np.ndarray, step: float, seed: int = 0) -> Grid:
    """Which points of a grid the limb reaches.

    Goes outwards from the nominal position, starting each inverse kinematics from the solutions of neighbours further in
    and from a random posture. Points without a reached neighbour further in are left out: no box of reached points around
    the nominal one can hold them.

    Args:
        limb: The limb.
        low, high: Box to look at, relative to the CoM [m]; must hold the nominal position.
        step: Distance of the grid points [m].
        seed: Of the random starts.
    """
    rng = np.random.default_rng(seed)
    nominal = limb.position(limb.nominal)
    below, above = ((nominal - low) / step).astype(int), ((high - nominal) / step).astype(int)
    grid = Grid(nominal, step, below, np.zeros(below + above + 1, dtype=bool))
    solutions: dict[tuple[int, ...], np.ndarray] = {}
    order = sorted(np.ndindex(*grid.reached.shape), key=lambda i: (np.abs(np.array(i) - below).sum(), i))
    for index in order:
        near = [solutions[n] for n in _neighbours(index) if n in solutions]
        if not near and index != tuple(below):
            continue
        for start in [*near[:2], rng.uniform(limb.lower, limb.upper)] if near else [limb.nominal]:
            found = limb.solve(grid.point(index), start)
            if found is not None:
                solutions[index] = found
                grid.reached[index] = True
                break
    return grid


def _neighbours(index: tuple[int, ...]) -> list[tuple[int, ...]]:
    return [tuple(i + d * (a == axis) for a, i in enumerate(index)) for axis in range(3) for d in (-1, 1)]


def largest_box(grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Corners [m] of the axis-aligned box of largest volume that holds only points reached, the nominal one among them.

    Boxes with the nominal point inside go before those with it on their surface.
    """
    counts = np.zeros(np.array(grid.reached.shape) + 1, dtype=int)
    counts[1:, 1:, 1:] = grid.reached.cumsum(0).cumsum(1).cumsum(2)
    (nx, ny, nz), (ox, oy, oz) = grid.reached.shape, grid.origin
    best, corners = 0, (grid.origin, grid.origin)
    # Rows: index of the lower z, columns: of the upper z.
    depth = np.arange(oz, nz)[None, :] - np.arange(oz + 1)[:, None]
    inside_z = (np.arange(oz + 1)[:, None] < oz) & (np.arange(oz, nz)[None, :] > oz)
    for x0, x1, y0, y1 in itertools.product(range(ox + 1), range(ox, nx), range(oy + 1), range(oy, ny)):
        area = (x1 - x0) * (y1 - y0)
        line = counts[x1 + 1, y1 + 1] - counts[x0, y1 + 1] - counts[x1 + 1, y0] + counts[x0, y0]
        full = line[oz + 1 :][None, :] - line[: oz + 1][:, None] == (depth + 1) * (x1 - x0 + 1) * (y1 - y0 + 1)
        margin = 1 + 999 * (inside_z & (x0 < ox < x1) & (y0 < oy < y1))
        worth = np.where(full, depth * area * margin, 0)
        if worth.max() > best:
            best = worth.max()
            z0, z1 = np.unravel_index(worth.argmax(), worth.shape)
            corners = (np.array([x0, y0, z0]), np.array([x1, y1, oz + z1]))
    return grid.point(corners[0]), grid.point(corners[1])


def headings_reached(
    limb: Limb,
    nominal: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    most: float = HEADING_MAX,
    top: Callable[[float], float] | None = None,
) -> tuple[float, float]:
    """How far a sole may be turned about the vertical, to the right (<= 0) and to the left (>= 0) [rad].

    Both at the nominal position and half way from there to each corner of the reach box, in steps of HEADING_STEP from
    posture to posture.

    Args:
        limb: With a flat end.
        nominal: Position of the sole relative to the CoM [m].
        low: Corner of the reach box [m].
        high: The opposite one [m].
        most: Where to stop [rad].
        top: Height [m] of the face that cuts the box at x [m].
    """
    corners = [
        np.array([x, y, min(z, top(x)) if top else z]) for x, y, z in itertools.product(*zip(low, high, strict=True))
    ]
    points = [nominal, *(0.5 * (nominal + corner) for corner in corners)]
    right = min(_turned(limb, point, -HEADING_STEP, most) for point in points)
    left = min(_turned(limb, point, HEADING_STEP, most) for point in points)
    return 0.0 - right, left


def _turned(limb: Limb, point: np.ndarray, step: float, most: float) -> float:
    """Angle [rad] up to which inverse kinematics follows the sole that turns on the spot by one step after the other."""
    joints, angle = limb.solve(point, limb.nominal), 0.0
    while joints is not None and abs(angle) + abs(step) < most + 1e-9:
        joints = limb.solve(point, joints, angle + step)
        if joints is not None:
            angle += step
    return round(abs(angle), 6)


def share_reached(
    limb: Limb,
    box: tuple[np.ndarray, np.ndarray],
    count: int,
    seed: int,
    headings: tuple[float, float] = (0.0, 0.0),
    holds: Callable[[np.ndarray], bool] = lambda point: True,
) -> float:
    """Share of random points of a box that the limb reaches from its nominal or a random posture.

    Args:
        limb: On its upright base.
        box: Two opposite corners, relative to the CoM [m].
        count: Of the points.
        seed: Of the points and postures.
        headings: Between which flat ends are turned at random [rad].
        holds: Whether a point of the box counts.
    """
    rng = np.random.default_rng(seed)
    reached = 0
    for _ in range(count):
        target = rng.uniform(*box)
        while not holds(target):
            target = rng.uniform(*box)
        heading = rng.uniform(*headings)
        starts = [limb.nominal, *(rng.uniform(limb.lower, limb.upper) for _ in range(4))]
        reached += any(limb.solve(target, start, heading) is not None for start in starts)
    return reached / count
