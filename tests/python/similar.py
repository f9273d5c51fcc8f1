"""Robots, scenes and plans of another size: dynamic similarity, written down once more and without the product's code."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any

import numpy as np

import mcplan as mp


@dataclass(frozen=True)
class Factors:
    """How many times longer, slower and heavier: everything else follows from the units of what it multiplies."""

    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def velocity(self) -> float:
        return self.length / self.time

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time**2

    @property
    def moment(self) -> float:
        return self.force * self.length

    @property
    def momentum(self) -> float:
        return self.mass * self.length * self.velocity


def similar_limb(limb: Any, by: Factors) -> Any:
    out = copy.deepcopy(limb)
    for name in ("hip_B", "upper", "lower", "ankle", "margin"):
        setattr(out, name, getattr(limb, name) * by.length)
    for name in ("knee_torque", "hip_torque", "ankle_torque"):
        setattr(out, name, getattr(limb, name) * by.moment)
    out.knee_speed = limb.knee_speed / by.time
    return out


def similar_robot(robot: mp.Robot, by: Factors, durations: bool = True) -> mp.Robot:
    """A robot of another size; without `durations` its phases and the height of its swings stay as they were."""
    out = copy.deepcopy(robot)
    out.name = f"{robot.name} x {by.length:g}"
    out.mass = robot.mass * by.mass
    out.inertia = robot.inertia * (by.mass * by.length**2)
    out.com_height = robot.com_height * by.length
    out.max_com_speed = robot.max_com_speed * by.velocity
    if durations:
        out.swing_height = robot.swing_height * by.length
        out.phase_duration = robot.phase_duration * by.time
    ends = []
    for end in robot.end_effectors:
        other = copy.deepcopy(end)
        for name in ("half_size", "nominal_B", "reach_min_B", "reach_max_B", "frame_offset"):
            setattr(other, name, getattr(end, name) * by.length)
        other.max_force = end.max_force * by.force
        other.max_moment = end.max_moment * by.moment
        if end.reach_cut.given:
            other.reach_cut = similar_polytope(end.reach_cut, by)
        if end.com_reach.given:
            other.com_reach = similar_polytope(end.com_reach, by)
        if end.limb.given:
            other.limb = similar_limb(end.limb, by)
        other.partner_reach = {name: similar_polytope(reach, by) for name, reach in end.partner_reach.items()}
        ends.append(other)
    out.end_effectors = ends
    return out


def similar_polytope(polytope: mp.model.Polytope, by: Factors) -> mp.model.Polytope:
    """A x <= b with x of another size."""
    return mp.model.Polytope(A=polytope.A, b=polytope.b * by.length)


def similar_scene(scene: mp.Scene, by: Factors) -> mp.Scene:
    """The scene of that robot, with the gravity in which it moves alike."""
    out = copy.deepcopy(scene)
    out.gravity = scene.gravity * (by.length / by.time**2)
    surfaces = []
    for surface in scene.surfaces:
        other = copy.deepcopy(surface)
        other.vertices_W = surface.vertices_W * by.length
        other.thickness = surface.thickness * by.length
        surfaces.append(other)
    out.surfaces = surfaces
    for name in ("start", "goal"):
        stance = copy.deepcopy(getattr(scene, name))
        stance.position_W = stance.position_W * by.length
        setattr(out, name, stance)
    return out


def similar_plan(plan: mp.Plan, by: Factors) -> mp.Plan:
    """The same motion of that robot."""
    return mp.Plan(
        scene=similar_scene(plan.scene, by),
        robot=similar_robot(plan.robot, by),
        planner=plan.planner,
        knots=[
            mp.model.Knot(
                com_W=knot.com_W * by.length,
                com_velocity_W=knot.com_velocity_W * by.velocity,
                base_rpy=knot.base_rpy,
                base_rpy_rate=knot.base_rpy_rate / by.time,
                end_effectors_W=knot.end_effectors_W * by.length,
                end_effector_velocities_W=knot.end_effector_velocities_W * by.velocity,
                angular_momentum_W=knot.angular_momentum_W * by.momentum,
                end_effector_yaw=knot.end_effector_yaw,
            )
            for knot in plan.knots
        ],
        phases=[
            mp.model.Phase(
                duration=phase.duration * by.time,
                law=phase.law,
                intervals=phase.intervals,
                contacts=[
                    mp.model.Contact(
                        surface=contact.surface,
                        stiffness=contact.stiffness / by.time**2,
                        anchor_W=contact.anchor_W * by.length,
                        moment_W=contact.moment_W * by.moment,
                        center_of_pressure_W=contact.center_of_pressure_W * by.length,
                        points_W=contact.points_W * by.length,
                        point_forces_W=contact.point_forces_W * by.force,
                    )
                    for contact in phase.contacts
                ],
            )
            for phase in plan.phases
        ],
        final_contacts=plan.final_contacts,
        swings=[
            mp.model.Swing(
                end_effector=swing.end_effector,
                first_phase=swing.first_phase,
                end_phase=swing.end_phase,
                height=swing.height * by.length,
                elapsed_s=swing.elapsed_s * by.time,
                lift_normal_W=swing.lift_normal_W,
                land_normal_W=swing.land_normal_W,
            )
            for swing in plan.swings
        ],
        measured_start=plan.measured_start,
        open_end=plan.open_end,
        start_slack_s=plan.start_slack_s * by.time,
        momentum_max=plan.momentum_max * by.momentum,
        momentum_rate_max=plan.momentum_rate_max * by.moment,
    )


def numbers_of(plan: mp.Plan) -> dict[str, np.ndarray]:
    """All numbers of a plan by what they are, to compare two."""
    contacts = [contact for phase in plan.phases for contact in phase.contacts]
    knots = ("com_W", "com_velocity_W", "base_rpy", "base_rpy_rate", "end_effectors_W", "end_effector_velocities_W")
    out = {name: np.array([getattr(knot, name) for knot in plan.knots]) for name in (*knots, "angular_momentum_W")}
    out["end_effector_yaw"] = np.array([list(knot.end_effector_yaw) for knot in plan.knots])
    out["durations"] = np.array([phase.duration for phase in plan.phases])
    for name in ("surface", "stiffness", "anchor_W", "moment_W", "center_of_pressure_W"):
        out[name] = np.array([getattr(contact, name) for contact in contacts])
    for name in ("points_W", "point_forces_W"):
        out[name] = np.vstack([np.reshape(getattr(contact, name), (-1, 3)) for contact in contacts])
    out["swings"] = np.array([[s.end_effector, s.first_phase, s.end_phase, s.height] for s in plan.swings])
    return out
