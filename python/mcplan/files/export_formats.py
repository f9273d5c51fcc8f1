"""The formats: what each is for, what it needs and contains."""

from __future__ import annotations

from dataclasses import dataclass

from mcplan.errors import InvalidArgument, did_you_mean, shown


@dataclass(frozen=True)
class Format:
    """A file format that another tool reads.

    Attributes:
        name: What it is asked for by.
        module: Module of ``mcplan.export`` that writes it: ``write(source, path)``.
        suffix: What its files end in; more than one where the ending chooses between two.
        tool: Who reads it.
        joints: Whether it contains joint positions: a plan then needs a robot with a URDF, and inverse kinematics.
        rate_hz: Samples per second unless asked otherwise; 0: at the knots of the plan.
        holds: What is in the file.
        planned: Whether it has the plan alone, also where a run of it is given.
    """

    name: str
    module: str
    suffix: tuple[str, ...]
    tool: str
    joints: bool
    rate_hz: float
    holds: str
    planned: bool = False

    @property
    def needs(self) -> str:
        """What it is made of."""
        if self.planned:
            return "plan, or that of a run or motion"
        return "run, motion, or plan and URDF" if self.joints else "run, motion or plan"


_ALL = (
    Format("mjlab", "mjlab", (".npz",), "mjlab", True, 50.0, "joints, poses and velocities of bodies, depth first"),
    Format("isaaclab", "mjlab", (".npz",), "IsaacLab", True, 50.0, "the same, breadth first, velocities of CoMs"),
    Format("unitree", "unitree", (".csv",), "Unitree, LAFAN1", True, 30.0, "root position, quaternion xyzw, joints"),
    Format("contacts", "contacts", (".npz",), "learning", False, 50.0, "contact labels, surfaces, forces, positions"),
    Format("mujoco", "keyframes", (".xml",), "MuJoCo", True, 0.0, "keyframes with qpos and qvel"),
    Format("centroidal", "centroidal", (".csv", ".json"), "any", False, 100.0, "CoM, momentum, contacts, forces", True),
    Format(
        "contact-sequence", "contact_sequence", (".json",), "multicontact-api", False, 50.0, "phases and curves", True
    ),
    Format("crocoddyl", "crocoddyl", (".py",), "Crocoddyl", True, 50.0, "script: shooting problem and warm start"),
    Format("ocs2", "ocs2", (".info",), "OCS2", True, 20.0, "mode schedule and target trajectories"),
    Format("ros2", "ros2", (".py",), "ROS 2", True, 50.0, "node: joint states, odometry, wrenches"),
)
#: By name, in the order in which they are listed.
FORMATS: dict[str, Format] = {entry.name: entry for entry in _ALL}


def format_of(name: str, field: str = "to") -> Format:
    """The format of a name.

    Raises:
        InvalidArgument: There is none; the message lists those that exist.
    """
    if isinstance(name, str) and name in FORMATS:
        return FORMATS[name]
    hint = did_you_mean(name, FORMATS) if isinstance(name, str) else ""
    rule = f"no such format. {hint}Formats: {', '.join(FORMATS)}" if hint else f"must be one of {', '.join(FORMATS)}"
    raise InvalidArgument(field, rule, shown(name))
