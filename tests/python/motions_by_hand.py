"""Motions that are right by hand: Talos stands still, sways, lifts a foot. Nothing of a solver is used.

The base is put where it is wanted, Newton's method finds the joints of the legs at each node, splines go through them, and
forces at the corners of soles are the non-negative least squares of what inverse dynamics ask for.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

import mcplan as mp
from mcplan.wb import Motion, splines
from standing import standing_scene

NODE_S = 0.0125
RIGHT, LEFT = 0, 1
#: Edges of the pyramids inside the cones.
EDGES = 8


class Talos:
    """Talos with its neutral posture on the ground, grippers, head and arms held."""

    def __init__(self, urdf: str | None = None) -> None:
        import pinocchio as pin

        from mcplan.kinematics.urdf_model import load_model

        self.pin, self.robot = pin, mp.load_robot("talos")
        self.robot.urdf = urdf or self.robot.urdf
        urdf_model = load_model(self.robot)
        self.urdf_path = urdf_model.path
        names = list(urdf_model.model.names)[2:]
        self.joints = tuple(name for name in names if "leg" in name or "torso" in name)
        posture = urdf_model.neutral.copy()
        whole = urdf_model.model
        self.locked = {name: float(posture[whole.idx_qs[whole.getJointId(name)]]) for name in names}
        for name in self.joints:
            del self.locked[name]
        self.model = whole
        self.frames, self.posture = urdf_model.frames, posture
        self.columns = [whole.idx_qs[whole.getJointId(name)] for name in self.joints]
        self.model.gravity.linear = np.array([0.0, 0.0, -standing_scene().gravity])
        self.data = self.model.createData()
        poses = self.poses(posture)
        self.posture[2] -= poses[RIGHT].translation[2]
        self.feet = self.poses(self.posture)[:2]

    def poses(self, q: np.ndarray) -> list:
        self.pin.framesForwardKinematics(self.model, self.data, q)
        return [self.data.oMf[frame].copy() for frame in self.frames]

    def com(self, q: np.ndarray) -> np.ndarray:
        return self.pin.centerOfMass(self.model, self.data, q).copy()

    def legs(self, q: np.ndarray, base: np.ndarray, feet: list) -> np.ndarray:
        """The posture with the base at a position, upright, and the soles at given poses, by Newton's method."""
        pin, q = self.pin, q.copy()
        q[:3], q[3:7] = base, [0.0, 0.0, 0.0, 1.0]
        legs = [i for i, name in enumerate(self.joints) if "leg" in name]
        velocities = [self.columns[i] - 1 for i in legs]
        for _ in range(20):
            pin.computeJointJacobians(self.model, self.data, q)
            pin.updateFramePlacements(self.model, self.data)
            errors, rows = [], []
            for frame, goal in zip(self.frames[:2], feet, strict=True):
                errors.append(pin.log6(self.data.oMf[frame].actInv(goal)).vector)
                rows.append(pin.getFrameJacobian(self.model, self.data, frame, pin.LOCAL)[:, velocities])
            error = np.concatenate(errors)
            if np.abs(error).max() < 1e-13:
                break
            q[[self.columns[i] for i in legs]] += np.linalg.solve(np.vstack(rows), error)
        return q


def plan_for(talos: Talos, phases: list[tuple[float, list[int]]]) -> mp.Plan:
    """A plan that stands where Talos does in its posture; of durations and the feet in contact."""
    scene, robot = standing_scene(), talos.robot
    com_W = talos.com(talos.posture)
    ends_W = np.array([pose.translation for pose in talos.poses(talos.posture)])
    ends_W[:2, 2] = 0.0
    knot = mp.model.Knot(com_W=com_W, end_effectors_W=ends_W, end_effector_velocities_W=np.zeros((len(ends_W), 3)))
    stiffness = scene.gravity / com_W[2]
    made, swings = [], []
    for k, (duration, feet) in enumerate(phases):
        contacts = [mp.model.Contact() for _ in ends_W]
        for foot in feet:
            # Anchored below the CoM, so that the plan's CoM rests.
            contacts[foot] = mp.model.Contact(surface=0, stiffness=stiffness / len(feet), anchor_W=[*com_W[:2], 0.0])
        made.append(mp.model.Phase(duration=duration, contacts=contacts))
        free = [e for e in range(2) if e not in feet]
        swings += [mp.model.Swing(end_effector=e, first_phase=k, end_phase=k + 1, height=0.03) for e in free]
    swings += [mp.model.Swing(end_effector=e, first_phase=0, end_phase=len(made)) for e in range(2, len(ends_W))]
    return mp.Plan(
        scene=scene,
        robot=robot,
        planner="by hand",
        knots=[knot] * (len(made) + 1),
        phases=made,
        final_contacts=[0 if e in phases[-1][1] else -1 for e in range(len(ends_W))],
        swings=swings,
    )


def motion_by(
    talos: Talos,
    plan: mp.Plan,
    posture: Callable[[float], tuple[np.ndarray, list]],
    shares: Callable[[float], np.ndarray],
) -> Motion:
    """A motion whose base and soles are where `posture` says at each node; `shares` weighs the feet's forces."""
    times, contacts = nodes_of(plan)
    q, rows = talos.posture.copy(), []
    for t in times:
        q = talos.legs(q, *posture(float(t)))
        rows.append(np.concatenate([q[:3], np.zeros(3), q[talos.columns]]))
    coefficients = splines.interpolating(times, np.array(rows))
    half = np.array([end.half_size for end in plan.robot.end_effectors])
    signs = np.array([[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]])
    points = np.concatenate([0.9 * half[:, None] * signs, np.zeros((len(half), 4, 1))], axis=2)
    bare = Motion(
        plan=plan,
        urdf=plan.robot.urdf,
        joints=talos.joints,
        locked=talos.locked,
        times_s=times,
        coefficients=coefficients,
        corner_points_S=points,
        corner_forces_S=np.zeros((len(times), len(half), 4, 3)),
        contacts=contacts,
    )
    forces = [node_forces(talos, bare, k, shares(float(t))) for k, t in enumerate(times)]
    return Motion(**{**bare.__getstate__(), "corner_forces_S": np.array(forces)})


def nodes_of(plan: mp.Plan) -> tuple[np.ndarray, np.ndarray]:
    """Nodes NODE_S apart or less, all switches among them, and the contacts between them."""
    knots = plan.knot_times()
    times, contacts = [0.0], []
    for k, phase in enumerate(plan.phases):
        count = int(np.ceil((knots[k + 1] - knots[k]) / NODE_S - 1e-9))
        times += np.linspace(knots[k], knots[k + 1], count + 1)[1:].tolist()
        contacts += [[contact.surface for contact in phase.contacts]] * count
    return np.array(times), np.array(contacts)


def node_forces(talos: Talos, motion: Motion, k: int, shares: np.ndarray) -> np.ndarray:
    """(L, 4, 3) forces on the edges of pyramids that balance the base at a node, least in the norm of f / share."""
    from scipy.optimize import nnls

    pin, model, data = talos.pin, talos.model, talos.data
    x, dx, ddx = (array[0] for array in motion.coordinates(motion.times_s[k : k + 1]))
    assert np.abs(x[3:6]).max() < 1e-12, "the base is upright throughout, so that its axes are those of the world"
    q, v, a = talos.posture.copy(), np.zeros(model.nv), np.zeros(model.nv)
    q[:3], q[talos.columns] = x[:3], x[6:]
    for array, rates in ((v, dx), (a, ddx)):
        array[:3], array[np.array(talos.columns) - 1] = rates[:3], rates[6:]
    needed = pin.rnea(model, data, q, v, a)[:6]
    poses = talos.poses(q)
    edges = 2.0 * np.pi * np.arange(EDGES) / EDGES
    friction = 0.9 * motion.plan.scene.surfaces[0].friction
    rays = np.stack([friction * np.cos(edges), friction * np.sin(edges), np.ones(EDGES)], axis=1)
    columns, back = [], []
    for foot in (RIGHT, LEFT):
        for corner, point in enumerate(motion.corner_points_S[foot]):
            lever = poses[foot].act(point) - q[:3]
            for ray in rays if shares[foot] > 0.0 else []:
                force = shares[foot] * poses[foot].rotation @ ray
                columns.append(np.concatenate([force, np.cross(lever, force)]))
                back.append((foot, corner, shares[foot] * ray))
    grasp, weight = np.array(columns).T, 1e3
    found = nnls(
        np.vstack([weight * grasp, 1e-3 * np.eye(len(back))]), np.concatenate([weight * needed, np.zeros(len(back))])
    )
    forces = np.zeros(motion.corner_forces_S.shape[1:])
    for size, (foot, corner, force) in zip(found[0], back, strict=True):
        forces[foot, corner] += size * force
    return forces


def standing_motion(talos: Talos, duration_s: float = 0.5) -> Motion:
    """Talos stands still on two feet."""
    plan = plan_for(talos, [(duration_s, [RIGHT, LEFT])])
    base = talos.posture[:3]
    return motion_by(talos, plan, lambda t: (base, talos.feet), lambda t: np.ones(2))


def swaying_motion(talos: Talos, duration_s: float = 1.0, size_m: float = 0.01) -> Motion:
    """Talos sways sideways and up and down once, from rest to rest."""
    plan = plan_for(talos, [(duration_s, [RIGHT, LEFT])])

    def posture(t: float) -> tuple[np.ndarray, list]:
        ahead = smooth(t / duration_s)
        angle = 2.0 * np.pi * ahead
        return talos.posture[:3] + size_m * np.array([0.0, np.sin(angle), 0.5 * (np.cos(angle) - 1.0)]), talos.feet

    return motion_by(talos, plan, posture, lambda t: np.ones(2))


def lifting_motion(talos: Talos, lift_m: float = 0.03) -> Motion:
    """Talos moves over its right foot, lifts the left one, puts it down again, and moves back."""
    shift, swing = 1.0, 0.8
    plan = plan_for(talos, [(shift, [RIGHT, LEFT]), (swing, [RIGHT]), (shift, [RIGHT, LEFT])])
    aside = talos.feet[RIGHT].translation[1] - talos.com(talos.posture)[1]

    def over_right(t: float) -> float:
        return smooth(t / shift) if t < shift else smooth((2.0 * shift + swing - t) / shift)

    def posture(t: float) -> tuple[np.ndarray, list]:
        ahead = np.clip((t - shift) / swing, 0.0, 1.0)
        lifted = talos.feet[LEFT].copy()
        lifted.translation = lifted.translation + [0.0, 0.0, lift_m * 64.0 * (ahead * (1.0 - ahead)) ** 3]
        base = talos.posture[:3] + [0.0, aside * over_right(t), -0.02 * over_right(t)]
        return base, [talos.feet[RIGHT], lifted]

    def shares(t: float) -> np.ndarray:
        return np.array([1.0, max(0.0, 1.0 - over_right(t)) if not shift <= t <= shift + swing else 0.0])

    return motion_by(talos, plan, posture, shares)


def smooth(ratio: float) -> float:
    """From 0 to 1 with zero velocity and acceleration at both ends."""
    r = min(max(ratio, 0.0), 1.0)
    return r**3 * (10.0 - 15.0 * r + 6.0 * r**2)


def changed(motion: Motion, **values: object) -> Motion:
    """The motion with other members."""
    return Motion(**{**motion.__getstate__(), **values})
