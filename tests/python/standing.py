"""A plan that is right by hand: a robot stands still on two feet below its CoM."""

from __future__ import annotations

import numpy as np

import mcplan as mp


def standing_scene() -> mp.Scene:
    """Level ground with the goal where the start is."""
    scene = mp.load_scene("flat")
    scene.goal = scene.start
    return scene


def standing_plan(phases: int = 3, duration_s: float = 0.4, robot: mp.Robot | None = None) -> mp.Plan:
    """The CoM rests where the two feet's stiffness balances gravity: sum mu_l (p - s_l) = g."""
    scene, robot = standing_scene(), robot or mp.load_robot("humanoid44")
    feet = [end.kind == "foot" for end in robot.end_effectors]
    com_W = np.array([0.0, 0.0, robot.com_height])
    ends_W = [com_W + end.nominal_B for end in robot.end_effectors]
    stiffness = scene.gravity / robot.com_height / sum(feet)
    contacts = [
        mp.model.Contact(surface=0, stiffness=stiffness, anchor_W=position) if foot else mp.model.Contact()
        for foot, position in zip(feet, ends_W, strict=True)
    ]
    knot = mp.model.Knot(com_W=com_W, end_effectors_W=ends_W, end_effector_velocities_W=np.zeros((len(ends_W), 3)))
    return mp.Plan(
        scene=scene,
        robot=robot,
        planner="by hand",
        knots=[knot] * (phases + 1),
        phases=[mp.model.Phase(duration=duration_s, contacts=contacts)] * phases,
        final_contacts=[0 if foot else -1 for foot in feet],
        swings=[
            mp.model.Swing(end_effector=i, first_phase=0, end_phase=phases) for i, foot in enumerate(feet) if not foot
        ],
    )
