"""A robot that can fold onto itself and onto the ground: a block on its sole, a mast beside it, and a boom on the mast's top."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import mcplan as mp

#: Height of the base above its sole [m].
SOLE_M = 0.1

URDF = """<robot name="folding">
  <link name="base">{inertial}
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="mast">{inertial}
    <collision><origin xyz="0 0 0.15"/><geometry><box size="0.04 0.04 0.3"/></geometry></collision></link>
  <link name="boom">{inertial}
    <collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.02" length="0.4"/></geometry></collision></link>
  <joint name="swivel" type="revolute"><parent link="base"/><child link="mast"/>
    <origin xyz="-0.2 0 0.1"/><axis xyz="0 0 1"/><limit lower="-3.2" upper="3.2" effort="5" velocity="1"/></joint>
  <joint name="hinge" type="revolute"><parent link="mast"/><child link="boom"/>
    <origin xyz="0 0.05 0.1"/><axis xyz="0 1 0"/><limit lower="-3.2" upper="3.2" effort="5" velocity="2"/></joint>
</robot>"""
INERTIAL = (
    """<inertial><mass value="{}"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>"""
)


def robot(folder: Path) -> mp.Robot:
    """The robot, its sole the bottom of the base."""
    (folder / "folding.urdf").write_text(URDF.replace("{inertial}", INERTIAL.format(1.0)).replace('"1.0"', '"5"', 1))
    made = mp.load_robot("anymal")
    made.name, made.urdf, made.posture = "folding", str(folder / "folding.urdf"), {}
    made.end_effectors = [
        mp.model.EndEffector(
            name="sole",
            frame="base",
            frame_offset=[0, 0, -SOLE_M],
            half_size=[0.3, 0.3],
            nominal_B=[0, 0, -SOLE_M],
            reach_min_B=[-1, -1, -1],
            reach_max_B=[1, 1, 1],
        )  # fmt: skip
    ]
    return made


def standing(neutral: np.ndarray) -> np.ndarray:
    """The configuration in which it stands, its boom upright."""
    configuration = neutral.copy()
    configuration[2] = SOLE_M
    return configuration
