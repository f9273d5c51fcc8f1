"""A robot of a heavy base and one arm of two links in the x-z plane, written as a URDF: everything in closed form."""

from __future__ import annotations

from pathlib import Path

import mcplan as mp

#: Lengths [m], masses at the end of each link [kg], torque limits [N m].
LENGTHS, MASSES, LIMITS = (0.4, 0.3), (2.0, 1.0), (40.0, 10.0)


def arm_robot(folder: Path, kind: str = "hand") -> mp.Robot:
    """Both joints turn about y: at angle 0 a link points along x, at +pi/2 down."""
    links = [_link("base", 50.0, 0.0), _link("upper", MASSES[0], LENGTHS[0]), _link("lower", MASSES[1], LENGTHS[1])]
    joints = [
        _joint("shoulder", "base", "upper", 0.0, LIMITS[0]),
        _joint("elbow", "upper", "lower", LENGTHS[0], LIMITS[1]),
        f'<joint name="tip_joint" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="{LENGTHS[1]} 0 0"/></joint>',
    ]
    file = folder / "arm.urdf"
    file.write_text('<robot name="arm">' + "".join(links) + '<link name="tip"/>' + "".join(joints) + "</robot>")
    end = mp.model.EndEffector(
        name="hand",
        kind=kind,
        frame="tip",
        nominal_B=[0.5, 0.0, 0.0],
        reach_min_B=[-1.0, -1.0, -1.0],
        reach_max_B=[1.0, 1.0, 1.0],
        max_force=100.0,
    )
    return mp.Robot(name="arm", mass=53.0, inertia=[1.0, 1.0, 1.0], com_height=0.5, end_effectors=[end], urdf=str(file))


def _link(name: str, mass: float, x: float) -> str:
    inertia = '<inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/>'
    return f'<link name="{name}"><inertial><origin xyz="{x} 0 0"/><mass value="{mass}"/>{inertia}</inertial></link>'


def _joint(name: str, parent: str, child: str, x: float, limit: float) -> str:
    return (
        f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/><origin xyz="{x} 0 0"/>'
        f'<axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="{limit}" velocity="5"/></joint>'
    )
