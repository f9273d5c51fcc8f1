"""What the program needs of a scene and a robot, as plain arrays: SI units, world frame W, z up, heading along x."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FEET = ("left_foot", "right_foot")


@dataclass(frozen=True)
class Patch:
    """A convex quadrilateral on which a foot may land."""

    vertices: Array  # 4 x 3 [m], counter-clockwise about the outward normal
    friction: float  # [-]

    @property
    def frame(self) -> Array:
        """3 x 3, columns t1 (heading projected on the plane), t2, n."""
        n = np.cross(self.vertices[1] - self.vertices[0], self.vertices[2] - self.vertices[0])
        n /= np.linalg.norm(n)
        t1 = np.array([1.0, 0.0, 0.0]) - n[0] * n
        t1 /= np.linalg.norm(t1)
        return np.column_stack([t1, np.cross(n, t1), n])

    @property
    def edges(self) -> tuple[Array, Array]:
        """Outward unit directions E (4 x 3) in the plane and offsets e (4) [m]: E p <= e inside."""
        along = np.roll(self.vertices, -1, axis=0) - self.vertices
        outward = np.cross(along, self.frame[:, 2])
        outward /= np.linalg.norm(outward, axis=1)[:, None]
        return outward, np.sum(outward * self.vertices, axis=1)

    def shrunk(self, half_size: Array) -> Array:
        """Offsets [m] of the edges for the centre of a sole (half length, half width) that must lie inside."""
        outward, offset = self.edges
        return offset - np.abs(outward @ self.frame[:, :2]) @ half_size

    def nearest(self, point: Array, half_size: Array) -> Array:
        """Centre of a sole [m] on the patch near a point: onto the plane, then over one edge after the other."""
        outward, _ = self.edges
        offset, n = self.shrunk(half_size), self.frame[:, 2]
        p = point - n * (n @ (point - self.vertices[0]))
        for _ in range(50):
            excess = outward @ p - offset
            worst = int(np.argmax(excess))
            if excess[worst] <= 1e-12:
                break
            p = p - excess[worst] * outward[worst]
        return p


@dataclass(frozen=True)
class Walker:
    """A robot on two feet, 0 left and 1 right, on a sequence of patches."""

    mass: float  # [kg]
    gravity: float  # [m/s^2]
    half_size: Array  # [m] of a sole
    max_force: float  # [N] of a foot
    com_height: float  # [m]
    com_reach: tuple[tuple[Array, Array], tuple[Array, Array]]  # A, b of A (c - p) <= b for each foot
    foot_reach: tuple[tuple[Array, Array], tuple[Array, Array]]  # A, b of A (p_other - p) <= b for each foot
    start_com: Array  # [m]
    start_feet: Array  # 2 x 3 [m]
    start_patches: tuple[Patch, Patch]
    goal_com: Array  # [m]
    steps: tuple[tuple[int, Patch], ...]  # the foot that swings and where it lands

    def step(self, i: int) -> tuple[int, Patch]:
        """Step i; after the last one the feet go on in turn on its patch."""
        last = len(self.steps) - 1
        if i <= last:
            return self.steps[i]
        foot, patch = self.steps[last]
        return (foot + i - last) % 2, patch


def load_patches(scene: str) -> list[Patch]:
    """Surfaces of a scene, in its order."""
    import mcplan

    return [Patch(np.array(s.vertices_W), s.friction) for s in mcplan.load_scene(scene).surfaces]


def load_walker(scene: str = "rubbles", robot: str = "talos_wang") -> Walker:
    """A scene with steps and a robot with reach polytopes, by mcplan's files."""
    import mcplan

    world, model = mcplan.load_scene(scene), mcplan.load_robot(robot)
    feet = [next(e for e in model.end_effectors if e.name == name) for name in FEET]
    patches = dict(zip((s.name for s in world.surfaces), load_patches(scene), strict=True))
    contacts = world.start.contacts
    stand = [patches[contacts.get(foot.name, contacts.get(foot.kind, ""))] for foot in feet]
    up = np.array([0.0, 0.0, model.com_height])
    start = np.array(world.start.position_W) + up

    def faces(polytope: Any) -> tuple[Array, Array]:
        return np.array(polytope.A), np.array(polytope.b)

    return Walker(
        mass=model.mass,
        gravity=world.gravity,
        half_size=np.array(feet[0].half_size),
        max_force=feet[0].max_force,
        com_height=model.com_height,
        com_reach=(faces(feet[0].com_reach), faces(feet[1].com_reach)),
        foot_reach=(faces(feet[0].partner_reach[FEET[1]]), faces(feet[1].partner_reach[FEET[0]])),
        start_com=start,
        start_feet=np.array([start + foot.nominal_B for foot in feet]),
        start_patches=(stand[0], stand[1]),
        goal_com=np.array(world.goal.position_W) + up,
        steps=tuple((FEET.index(step.end_effector), patches[step.surface]) for step in world.steps),
    )
