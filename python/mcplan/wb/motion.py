"""Motions: joints, torques and contact forces of a robot with a URDF along a plan of contacts and CoM."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from mcplan._core import Plan, __version__
from mcplan.errors import InvalidInput, InvalidPlan, shown, written
from mcplan.files.archives import archive_bytes, kind_text, read_arrays, read_header, require_kind
from mcplan.files.outputs import ARCHIVE, require_suffix, write_whole
from mcplan.files.plan_files import read_plan_file
from mcplan.files.plans import plan_from_bytes, plan_to_bytes

from . import free_flyer, splines
from .motion_fields import ARRAYS, as_array, number, require_header, require_kinds, require_valid

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .certificate import MotionCheckResult, MotionTolerances
    from .motion_model import MotionModel

#: What a motion's file says that it is, and the version of its format.
KIND, FORMAT = "motion", 1
UNITS = "SI: m, kg, s, N, N m, rad; _W: world frame, z up; _S: frame of a sole, z its normal"


@dataclass(frozen=True, eq=False)
class MotionState:
    """A motion at an instant, of a robot with L end-effectors and J moving joints.

    ``q``, ``v``, ``a`` and ``tau`` are in Pinocchio's order for the free-flyer and the joints ``Motion.joints``; locked
    joints are left out.
    """

    time_s: float
    q: NDArray[
        np.float64
    ]  #: (7 + J) base position_W [m] and quaternion xyzw, joints [rad]; see ``Motion.model`` for nq
    v: NDArray[np.float64]  #: (6 + J) velocity of the base in its own axes [m/s, rad/s], of joints [rad/s]
    a: NDArray[np.float64]  #: (6 + J) derivative of v
    tau: NDArray[np.float64]  #: (J) torques of the joints [N m]
    base_residual_B: NDArray[np.float64]  #: (6) force and moment on the base that no contact gives [N, N m]
    com_W: NDArray[np.float64]  #: (3) [m]
    surfaces: NDArray[np.int32]  #: (L) index into scene.surfaces, -1: free
    end_effectors_W: NDArray[np.float64]  #: (L, 3) [m]
    rotations_W: NDArray[np.float64]  #: (L, 3, 3) of the soles' frames
    wrenches_W: NDArray[np.float64]  #: (L, 6) force [N] and moment [N m] about the end-effector, on the robot


@dataclass(frozen=True, eq=False)
class MotionSamples:
    """A motion at N times; what each array is, ``MotionState`` says of a single time."""

    times: NDArray[np.float64]  #: (N) [s]
    q: NDArray[np.float64]  #: (N, 7 + J)
    v: NDArray[np.float64]  #: (N, 6 + J)
    a: NDArray[np.float64]  #: (N, 6 + J)
    tau: NDArray[np.float64]  #: (N, J)
    base_residual_B: NDArray[np.float64]  #: (N, 6)
    com_W: NDArray[np.float64]  #: (N, 3)
    surfaces: NDArray[np.int32]  #: (N, L)
    end_effectors_W: NDArray[np.float64]  #: (N, L, 3)
    rotations_W: NDArray[np.float64]  #: (N, L, 3, 3)
    wrenches_W: NDArray[np.float64]  #: (N, L, 6)

    def __len__(self) -> int:
        return len(self.times)

    def state(self, i: int) -> MotionState:
        """The state at the i-th time."""
        arrays = {item.name: getattr(self, item.name)[i] for item in fields(self) if item.name != "times"}
        return MotionState(time_s=float(self.times[i]), **arrays)


@dataclass(frozen=True, eq=False)
class Motion:
    """Joints, torques and contact forces of a robot along a plan, defined on the whole of [0, plan.duration()].

    Positions are cubic splines with continuous accelerations; forces act at the corners of soles and are linear between
    nodes. Torques follow from both by inverse dynamics.

        motion = mcplan.wb.Motion.load("motion.npz")
        state = motion.at(0.5)
        motion.check().raise_if_violated()

    Attributes:
        plan: The plan of contacts and CoM that it carries out, with its scene and its robot.
        urdf: Name of a built-in setup such as "talos", or as ``Robot.urdf`` names a URDF.
        joints: (J) names of the joints that move, in Pinocchio's order.
        locked: Positions of all others [rad].
        times_s: (n + 1) the nodes, from 0 to the plan's end [s]; contacts change at nodes only.
        coefficients: (n + 3, 6 + J) of the B-splines whose knots are the nodes and three more at each end, mirrored:
            px, py, pz, rz, ry, rx of the base in the world, R = Rz(rz) Ry(ry) Rx(rx) [m, rad], then the joints [rad].
        corner_points_S: (L, 4, 3) where forces act on each end-effector, in the frame of its sole [m].
        corner_forces_S: (n + 1, L, 4, 3) forces on the robot at the nodes, in the frame of the sole [N].
        contacts: (n, L) surface touched between nodes, -1: none.

    Raises:
        InvalidPlan: A size does not fit, or a value is out of range; the message names both.
    """

    plan: Plan
    urdf: str
    joints: tuple[str, ...]
    locked: Mapping[str, float]
    times_s: NDArray[np.float64]
    coefficients: NDArray[np.float64]
    corner_points_S: NDArray[np.float64]
    corner_forces_S: NDArray[np.float64]
    contacts: NDArray[np.int32]

    def __post_init__(self) -> None:
        require_kinds(self)
        object.__setattr__(self, "joints", tuple(str(name) for name in self.joints))
        object.__setattr__(
            self, "locked", {str(name): number(f"locked.{name}", at) for name, at in self.locked.items()}
        )
        for name in ARRAYS:
            object.__setattr__(self, name, as_array(name, getattr(self, name)))
        require_valid(self)
        self.times_s[-1] = self.plan.duration()  # which sums of durations may miss by a rounding
        for name in ARRAYS:
            getattr(self, name).setflags(write=False)

    def __eq__(self, other: object) -> bool:
        return self.to_bytes() == other.to_bytes() if isinstance(other, Motion) else NotImplemented

    __hash__ = None  # type: ignore[assignment]  # compared by value

    def __repr__(self) -> str:
        return (
            f"<mcplan.wb.Motion of {self.plan.robot.name}: {self.duration():.3f} s, {len(self.joints)} joints, "
            f"{len(self.times_s)} nodes>"
        )

    def __getstate__(self) -> dict[str, Any]:
        return {item.name: getattr(self, item.name) for item in fields(self)}

    def duration(self) -> float:
        """Of the plan and the motion [s]."""
        return float(self.times_s[-1])

    @cached_property
    def model(self) -> MotionModel:
        """The robot's rigid-body model in Pinocchio, locked joints held.

        Raises:
            MissingExtra: Pinocchio is not installed.
            InvalidRobot: The URDF cannot be read.
            InvalidPlan: The joints are not those of the URDF.
        """
        from .motion_model import motion_model

        return motion_model(self.plan, self.urdf, self.joints, self.locked)

    def at(self, t: float) -> MotionState:
        """The state at a time [s] in 0 to duration().

        Raises:
            InvalidInput: The time lies outside.
        """
        if (
            isinstance(t, bool)
            or not isinstance(t, int | float | np.floating | np.integer)
            or not 0.0 <= t <= self.duration()
        ):
            raise InvalidInput("t", f"must lie in [0, {self.duration():.6g}] s", shown(t))
        return self.sample([float(t)]).state(0)

    def sample(self, times: ArrayLike) -> MotionSamples:
        """States at many times, as arrays: what ``at`` says of each.

        Args:
            times: One-dimensional [s], each in 0 to duration(), in any order.

        Raises:
            InvalidInput: A time is no number or lies outside; it is named by its index.
            MissingExtra: Pinocchio is not installed.
        """
        from .motion_samples import states

        asked = self._times(times)
        q, v, a = self.trajectory(asked)
        found = states(self.model, (q, v, a), self.corner_points_S, self.forces(asked))
        return MotionSamples(times=asked, q=q, v=v, a=a, surfaces=self.contacts[self._intervals(asked)], **found)

    def coordinates(self, times: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """The splines (N, 6 + J) in the order of ``coefficients``, and their first and second derivatives."""
        return splines.evaluate(self.times_s, self.coefficients, self._times(times))

    def trajectory(self, times: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """q, v and a as ``MotionState`` has them, at many times."""
        x, dx, ddx = self.coordinates(times)
        base_v, base_a = free_flyer.velocities(x[:, :6], dx[:, :6], ddx[:, :6])
        base_q = np.hstack([x[:, :3], free_flyer.quats_xyzw(x[:, 3:6])])
        q = self.model.configurations(base_q, x[:, 6:])
        return q, np.hstack([base_v, dx[:, 6:]]), np.hstack([base_a, ddx[:, 6:]])

    def forces(self, times: ArrayLike) -> NDArray[np.float64]:
        """(N, L, 4, 3) forces at the corners of soles, in their frames [N], at many times."""
        asked = self._times(times)
        i = self._intervals(asked)
        ratio = (asked - self.times_s[i]) / (self.times_s[i + 1] - self.times_s[i])
        ratio = ratio[:, None, None, None]
        return (1.0 - ratio) * self.corner_forces_S[i] + ratio * self.corner_forces_S[i + 1]

    def check(self, tolerances: MotionTolerances | None = None) -> MotionCheckResult:
        """Check the motion against its plan, its scene and the limits of its robot; see ``mcplan.wb.certificate``.

        Args:
            tolerances: What is accepted; None: the published ones.
        """
        from .certificate import certify

        return certify(self, tolerances)

    def save(self, path: str | Path) -> None:
        """Write the motion to an .npz file, which is complete or not there at all.

        Raises:
            InvalidInput: The name promises another kind of file.
            OSError: The file cannot be written.
        """
        require_suffix("path", path, (*ARCHIVE, ""))
        write_whole(self.to_bytes(), path)

    @staticmethod
    def load(path: str | Path) -> Motion:
        """Read a motion that was written by save().

        Raises:
            InvalidPlan: Not such a file, or its content does not fit together; the message names file, field and rule.
            FileNotFoundError: There is no such file.
        """
        try:
            return Motion.from_bytes(read_plan_file(path))
        except InvalidInput as found:
            raise found.moved(InvalidPlan, str(path)) from None

    def to_bytes(self) -> bytes:
        """The content of the motion's file."""
        header = {
            "kind": KIND,
            "format": FORMAT,
            "units": UNITS,
            "mcplan": __version__,
            "urdf": self.urdf,
            "joints": list(self.joints),
            "locked": self.locked,
        }
        arrays = {name: getattr(self, name) for name in ARRAYS}
        return archive_bytes(header, {**arrays, "plan": np.frombuffer(plan_to_bytes(self.plan), dtype=np.uint8)})

    @staticmethod
    def from_bytes(data: bytes) -> Motion:
        """The motion of the content of a file.

        Raises:
            InvalidPlan: Not such a file, or its content does not fit together.
        """
        if not isinstance(data, bytes | bytearray | memoryview):
            raise InvalidPlan("", "must be the bytes of a motion's file", shown(data))
        arrays = read_arrays(bytes(data))
        header = read_header(arrays)
        if header.get("kind") != KIND:
            raise InvalidPlan("header.kind", f"must be {written(KIND)}", kind_text(header))
        if header.get("format") != FORMAT:
            rule = f"must be {FORMAT} for this version of mcplan"
            raise InvalidPlan("header.format", rule, written(header.get("format")))
        require_header(header)
        for name in ARRAYS:
            require_kind(arrays, name, integers=name == "contacts")
        require_kind(arrays, "plan", integers=True)
        if arrays["plan"].dtype != np.uint8:
            raise InvalidPlan("plan", "must be bytes (uint8)", str(arrays["plan"].dtype))
        try:
            plan = plan_from_bytes(arrays["plan"].tobytes())
        except InvalidInput as found:
            raise found.moved(InvalidPlan, prefix="plan") from None
        named = {key: header[key] for key in ("urdf", "joints", "locked")}
        content: dict[str, Any] = {name: arrays[name] for name in ARRAYS}
        return Motion(plan=plan, **named, **content)

    def _times(self, times: ArrayLike) -> NDArray[np.float64]:
        try:
            asked = np.array(times, dtype=float)
        except (TypeError, ValueError, OverflowError):
            raise InvalidInput("times", "must be an array of numbers", shown(times)) from None
        if asked.ndim != 1:
            raise InvalidInput("times", "must have one dimension", f"{asked.ndim}")
        for i in np.flatnonzero(~((asked >= 0.0) & (asked <= self.duration())))[:1]:
            raise InvalidInput(f"times[{i}]", f"must lie in [0, {self.duration():.6g}] s", shown(float(asked[i])))
        return asked

    def _intervals(self, times: NDArray[np.float64]) -> NDArray[np.int64]:
        return splines.interval_of(self.times_s, times)
