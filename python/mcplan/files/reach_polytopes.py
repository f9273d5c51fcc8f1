"""Reach polytopes of feet from a URDF: where the CoM may be relative to a sole, and where the other feet may stand.

    mcplan robots --from-urdf talos --reach-polytopes -o talos_walk.toml

1. Draw joint positions of a leg within its limits, a third of the joints at a limit, where the edge of the reach is. The base
   is upright, the other limbs are nominal. Turn the sole level by Newton's method; keep the sample if the sole's orientation
   comes within 5 degrees of level and ahead. Point feet are kept as drawn.
2. com_reach: CoM relative to the sole, of the samples whose foot is at most half a sole's width past the CoM sideways.
3. partner_reach: the other foot relative to the sole while the robot stands on that sole, its CoM above it: sums of a sample
   of one leg with one of the other. The feet stay on their sides, 1.25 sole widths apart at least.
4. Take N / 2 + 2 of the points and their convex hull, which has N triangles: the nominal stance and its farthest points first,
   then again and again the point farthest outside of the hull so far.

The result lies inside of the convex hull of what was reached, hence is smaller than the hull of the whole reach; since the
reach is not quite convex, it may still hold points that are not reached. What leans (a base that tilts) is left out.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import Polytope, Robot
from mcplan.errors import InvalidInput
from mcplan.extras import require
from mcplan.files.reach import Limb
from mcplan.files.reach_cut import uncut_top
from mcplan.files.urdf import ends_of, load_model
from mcplan.files.urdf_limbs import limb_of
from mcplan.files.urdf_setups import End

if TYPE_CHECKING:
    from scipy.spatial import ConvexHull

FACES = 30  # of a polytope at most
SAMPLES = 20_000  # of each leg
PAIRS = 200_000  # of samples of two legs
LEVEL_RAD = np.radians(5.0)
AT_LIMIT = 1.0 / 3.0  # share of joints drawn at one of their limits
FEET_APART = 1.25  # least sideways distance of two feet over the width of a sole
_ITERATIONS = 8
_DAMPING = 1e-4
ROUNDING_M = 2e-6  # added to a polytope whose numbers are rounded, so that it holds its corners

HEADER = (
    "Reach polytopes: joint positions of each leg drawn within their limits ({samples}, seed {seed}; base upright, other "
    "limbs nominal), soles within 5 degrees of level and ahead, feet not past the CoM by more than half a sole's width; "
    "partners: put down while the CoM is above the sole, {apart} sole widths apart or more. Each is the convex hull of "
    "points reached, with {faces} faces at most."
)


@dataclass(frozen=True)
class Origin:
    """What a robot was worked out from: the arguments of robot_from_urdf.

    Attributes:
        source: A name of example-robot-data, or the path of a URDF file.
        ends: End-effectors; may be empty for the names in SETUPS.
        srdf, posture: As given to robot_from_urdf.
    """

    source: str
    ends: Sequence[End] = ()
    srdf: str | None = None
    posture: Mapping[str, float] | None = None


def add_reach_polytopes(
    robot: Robot,
    origin: Origin,
    faces: int = FACES,
    samples: int = SAMPLES,
    seed: int = 0,
    progress: Callable[[str], None] = lambda line: None,
) -> None:
    """Set com_reach and partner_reach of the feet of a robot.

    Args:
        robot: As worked out by robot_from_urdf.
        origin: What it was worked out from.
        faces: Largest number of faces of a polytope, 6 at least.
        samples: Postures drawn for each leg, 1000 at least.
        seed: Of the draws; the same seed gives the same polytopes.
        progress: Called with a line for each polytope.

    Raises:
        MissingExtra: Pinocchio or SciPy is not installed.
        InvalidInput: A number is out of range, or a leg hardly ever reaches a level sole.
        InvalidRobot: A polytope does not hold the nominal stance.
    """
    require("mcplan robots --reach-polytopes", "view", "pinocchio", "example_robot_data", "scipy")
    if faces < 6:
        raise InvalidInput("faces", "must be at least 6", str(faces))
    if samples < 1000:
        raise InvalidInput("samples", "must be at least 1000", str(samples))
    source, given = origin.source, tuple(origin.ends)
    model, nominal, _ = load_model(source, given, origin.srdf, origin.posture)
    ends = ends_of(source, given)
    feet = [end for end in ends if end.kind == "foot"]
    made = {end.name: end for end in robot.end_effectors}
    clouds = {}
    for number, foot in enumerate(feet):
        limb = limb_of(model, nominal, foot, tuple(ends), source)
        clouds[foot.name] = leg_samples(limb, samples, np.random.default_rng([seed, number]))
        if len(clouds[foot.name]) < 100:
            raise InvalidInput(
                f"ends.{foot.name}", "must reach a level sole", f"{len(clouds[foot.name])} of {samples} samples"
            )
    for number, foot in enumerate(feet):
        own = made[foot.name]
        com = com_points(clouds[foot.name], own)
        own.reach_max_B = [*own.reach_max_B[:2], max(uncut_top(own), own.nominal_B[2])]
        own.reach_cut = Polytope()
        own.com_reach, line = _reduced(com, -own.nominal_B, faces)
        progress(f"{foot.name}: CoM, {line}")
        partners = {}
        for other_number, other in enumerate(feet):
            if other.name == foot.name:
                continue
            rng = np.random.default_rng([seed, number, other_number])
            points = partner_points(com, clouds[other.name], own, made[other.name], rng)
            partners[other.name], line = _reduced(points, made[other.name].nominal_B - own.nominal_B, faces)
            progress(f"{foot.name}: {other.name}, {line}")
        own.partner_reach = partners
    robot.validate()


def header(faces: int, seed: int, samples: int = SAMPLES) -> str:
    """Comment for the file: how the polytopes were made."""
    text = HEADER.format(samples=samples, seed=seed, faces=faces, apart=FEET_APART)
    return textwrap.fill(text, 116)


def leg_samples(limb: Limb, count: int, rng: np.random.Generator) -> np.ndarray:
    """Positions of the contact frame relative to the CoM [m], N x 3, N at most `count`."""
    found = []
    for _ in range(count):
        joints = rng.uniform(limb.lower, limb.upper)
        side = rng.random(joints.size)
        joints = np.where(side < 0.5 * AT_LIMIT, limb.lower, np.where(side < AT_LIMIT, limb.upper, joints))
        level = _levelled(limb, joints) if limb.flat else joints
        if level is not None:
            found.append(limb.position(level))
    return np.array(found).reshape(-1, 3)


def com_points(cloud: np.ndarray, foot: Any) -> np.ndarray:
    """CoM relative to the sole [m] of those samples whose foot is on its side of the CoM, N x 3."""
    side = np.sign(foot.nominal_B[1])
    return -cloud[side * cloud[:, 1] >= -foot.half_size[1] - 1e-9]


def partner_points(
    com: np.ndarray, cloud: np.ndarray, foot: Any, other: Any, rng: np.random.Generator, count: int = PAIRS
) -> np.ndarray:
    """The other foot relative to this one [m] with the CoM above this one's sole, N x 3.

    Args:
        com: CoM relative to this foot [m].
        cloud: The other foot relative to the CoM [m].
        foot, other: EndEffector.
        rng: Source of the pairs.
        count: Pairs to draw.
    """
    above = com[(np.abs(com[:, :2]) <= np.maximum(foot.half_size, 0.02)).all(axis=1)]
    between = (other.nominal_B - foot.nominal_B)[:2]
    distance = float(np.linalg.norm(between))
    apart = min(max(FEET_APART * (foot.half_size[1] + other.half_size[1]), 0.5 * distance), 0.9 * distance)
    if not len(above) or not distance:
        return np.zeros((0, 3))
    pairs = above[rng.integers(len(above), size=count)] + cloud[rng.integers(len(cloud), size=count)]
    return pairs[pairs[:, :2] @ between / distance >= apart]


def inner_polytope(points: np.ndarray, faces: int) -> Polytope:
    """Convex hull of a few of the points, chosen so that it is large: inside the hull of all.

    Starts from the first point and those farthest along each axis, then adds the point farthest outside of the hull so far,
    until the hull has `faces` triangles or holds all points within 1 mm. Triangles in one plane count once.

    Args:
        points: N x 3 [m], not all in one plane; the first one is always held.
        faces: Largest number of faces.
    """
    from scipy.spatial import ConvexHull

    chosen = [0, *_extremes(points, max(4, min(6, faces // 2 + 1)))]
    while True:
        hull = ConvexHull(points[chosen])
        outside = (points @ hull.equations[:, :3].T + hull.equations[:, 3]).max(axis=1)
        farthest = int(outside.argmax())
        if len(hull.vertices) >= faces // 2 + 2 or outside[farthest] < 1e-3:
            return _polytope(hull)
        chosen.append(farthest)


def _extremes(points: np.ndarray, count: int) -> list[int]:
    """Indices of the points farthest along x, y, z, -x, -y, -z, as many as asked for."""
    signed = np.hstack([points, -points])
    return list(dict.fromkeys(int(i) for i in signed.argmax(axis=0)))[:count]


def _polytope(hull: ConvexHull) -> Polytope:
    rows = np.unique(hull.equations.round(6), axis=0)
    return Polytope(A=rows[:, :3], b=(ROUNDING_M - rows[:, 3]).round(6))


def _reduced(points: np.ndarray, nominal: np.ndarray, faces: int) -> tuple[Polytope, str]:
    """The polytope, and a line that says how much smaller it is than the hull of all points."""
    from scipy.spatial import ConvexHull

    if len(points) < 100:
        raise InvalidInput("samples", "must give 100 points within the rules at least", str(len(points)))
    whole = ConvexHull(points)
    polytope = inner_polytope(np.vstack([nominal, points]), faces)
    share = volume(polytope) / whole.volume
    return polytope, f"{len(whole.equations)} faces -> {len(polytope.b)}, {share:.0%} of the volume"


def volume(polytope: Polytope) -> float:
    """Volume of a bounded polytope [m^3]."""
    from scipy.optimize import linprog
    from scipy.spatial import ConvexHull, HalfspaceIntersection

    rows = np.hstack([polytope.A, -polytope.b[:, None]])
    ball = linprog(
        [0, 0, 0, -1], A_ub=np.hstack([polytope.A, np.ones((len(rows), 1))]), b_ub=polytope.b, bounds=(None, None)
    )
    return float(ConvexHull(HalfspaceIntersection(rows, ball.x[:3]).intersections).volume)


def _levelled(limb: Limb, joints: np.ndarray) -> np.ndarray | None:
    """Joint positions near the given ones that turn the sole level, or None."""
    for _ in range(_ITERATIONS):
        error = limb.rotation_error(joints)
        if np.linalg.norm(error) < LEVEL_RAD:
            return joints
        jacobian = limb.jacobian(joints)[3:]
        step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + _DAMPING * np.eye(3), error)
        joints = np.clip(joints + step, limb.lower, limb.upper)
    return None
