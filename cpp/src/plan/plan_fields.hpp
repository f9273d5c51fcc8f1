#pragma once

#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "model/fields.hpp"
#include "robot/robot_fields.hpp"
#include "scene/scene_fields.hpp"

namespace mcplan::model {

// Of a plan in a file: each takes a hundred times the memory of its numbers once it is read.
constexpr std::size_t max_phases = 10'000, max_swings = 40'000, max_points = 100'000;

template <>
struct Names<ForceLaw> : NamesOfTypes<ForceLaw> {
  static constexpr const char* name = "ForceLaw";
  static constexpr const char* meaning = "How contact forces depend on time within a phase.";
};

template <>
struct Fields<Contact> {
  static constexpr const char* name = "Contact";
  static constexpr const char* meaning =
      "What one end-effector does during one phase: f(t) = mass stiffness (com(t) - anchor), acting at the anchor or, "
      "under ForceLaw.wrench, at center_of_pressure, or forces at points where the phase's law says so.";
  static constexpr auto all =
      std::make_tuple(field("surface", &Contact::surface, "", "Index into scene.surfaces, -1: free.").always_written(),
                      field("stiffness", &Contact::stiffness, "1/s^2", "mu, 0 when free."),
                      field("anchor_W", &Contact::anchor_W, "m", "Point through which the line of force passes."),
                      field("moment_W", &Contact::moment_W, "N m", "Contact moment, constant over the phase."),
                      field("points_W", &Contact::points_W, "m", "Where forces act, e.g. the corners of the sole.")
                          .entries(0, max_points),
                      field("point_forces_W", &Contact::point_forces_W, "N",
                            "Node by node, a row for each point: (Phase.node_count() N) x 3.")
                          .entries(0, any_number),
                      field("center_of_pressure_W", &Contact::center_of_pressure_W, "m",
                            "Where the force acts under ForceLaw.wrench."));
};

template <>
struct Fields<Phase> {
  static constexpr const char* name = "Phase";
  static constexpr const char* meaning = "A stretch of time with constant contacts.";
  static constexpr auto all = std::make_tuple(
      field("duration", &Phase::duration, "s", "How long it lasts.").required().positive(),
      field("contacts", &Phase::contacts, "", "One Contact per end-effector.").required().entries(0, 8),
      field("law", &Phase::law, "", "How forces depend on time."),
      field("intervals", &Phase::intervals, "", "Of the forces at points, equally long; 0 where there are none.")
          .at_least(0.0)
          .at_most(Phase::max_intervals));
};

template <>
struct Fields<Knot> {
  static constexpr const char* name = "Knot";
  static constexpr const char* meaning = "State at the instant between two phases.";
  static constexpr auto all = std::make_tuple(
      field("com_W", &Knot::com_W, "m", "Position of the CoM.").required(),
      field("com_velocity_W", &Knot::com_velocity_W, "m/s", "Velocity of the CoM.").required(),
      field("base_rpy", &Knot::base_rpy, "rad", "Roll, pitch, yaw of the base.").required(),
      field("base_rpy_rate", &Knot::base_rpy_rate, "rad/s", "Their rates.").required(),
      field("end_effectors_W", &Knot::end_effectors_W, "m", "Positions, one row per end-effector.").required(),
      field("end_effector_velocities_W", &Knot::end_effector_velocities_W, "m/s", "Velocities, zero at contacts.")
          .required(),
      field("angular_momentum_W", &Knot::angular_momentum_W, "kg m^2/s",
            "About the CoM; not looked at under ForceLaw.pendulum, whose base carries it."),
      field("end_effector_yaw", &Knot::end_effector_yaw, "rad",
            "Heading of each sole; empty: all head where the base does."));
};

template <>
struct Names<PlanFrom> {
  static constexpr const char* name = "PlanFrom";
  static constexpr const char* meaning = "Where the plan of a replan comes from.";
  static constexpr Choice<PlanFrom> all[] = {
      {"search", PlanFrom::search, "It is no replan."},
      {"same_sequence", PlanFrom::same_sequence, "The contacts of the plan under way, with what was added at its end."},
      {"other_sequence", PlanFrom::other_sequence, "Another step was put in."},
      {"recovery", PlanFrom::recovery, "Steps that catch a push, and a stand wherever that is."},
      {"stop", PlanFrom::stop, "A stand as soon as may be: nothing that leads on can be followed."},
      {"previous_plan", PlanFrom::previous_plan,
       "What is left of the plan under way, as it was planned: nothing better was found in time."}};
};

template <>
struct Fields<Swing> {
  static constexpr const char* name = "Swing";
  static constexpr const char* meaning =
      "A stretch of phases, first_phase to end_phase - 1, in which an end-effector is free.";
  static constexpr auto all = std::make_tuple(
      field("end_effector", &Swing::end_effector, "", "Index of the end-effector.").required(),
      field("first_phase", &Swing::first_phase, "", "Index of the first of the phases.").required(),
      field("end_phase", &Swing::end_phase, "", "Index of the phase after the last of them.").required(),
      field("height", &Swing::height, "m", "How far it is lifted off the straight path.").required(),
      field("lift_normal_W", &Swing::lift_normal_W, "-",
            "Unit normal of the surface it leaves; of a sole in the air at the plan's start the sole's.")
          .required(),
      field("land_normal_W", &Swing::land_normal_W, "-", "Unit normal of the surface it reaches.").required(),
      field("elapsed_s", &Swing::elapsed_s, "s",
            "Time since lift-off at the plan's start, of a swing that is under way there; 0: it begins in the plan.")
          .not_negative());
};

template <>
struct Fields<Plan> {
  static constexpr const char* name = "Plan";
  static constexpr const char* meaning =
      "A motion: phases with constant contacts between knots. Carries its scene and robot.";
  static constexpr auto all = std::make_tuple(
      field("planner", &Plan::planner, "", "Which planner made it, e.g. ddp.").always_written(),
      field("measured_start", &Plan::measured_start, "", "Starts from a measured state, not from the scene's start."),
      field("open_end", &Plan::open_end, "", "Ends on the way, not at the scene's goal."),
      field("start_slack_s", &Plan::start_slack_s, "s",
            "Time within which what the measured start violates by itself has to be made good; above zero with "
            "measured_start alone.")
          .not_negative(),
      field(
          "momentum_max", &Plan::momentum_max, "kg m^2/s",
          "Largest component of the angular momentum about the CoM that it claims to keep, in the axes of the start's "
          "heading; left out: no claim.")
          .positive()
          .or_infinite(),
      field("momentum_rate_max", &Plan::momentum_rate_max, "N m", "The same of its rate.").positive().or_infinite(),
      field("scene", &Plan::scene, "", "The scene it was made for.").required(),
      field("robot", &Plan::robot, "", "The robot it was made for.").required(),
      field("knots", &Plan::knots, "", "Knots, one more than phases.").required().entries(0, max_phases + 1),
      field("phases", &Plan::phases, "", "Phases.").required().entries(0, max_phases),
      field("final_contacts", &Plan::final_contacts, "", "Surface index per end-effector after the last phase.")
          .required()
          .entries(0, 8),
      field("swings", &Plan::swings, "", "Swings.").required().entries(0, max_swings));
};

/// The plan of the fields of a JSON file. Throws InvalidPlan with all that is wrong.
Plan plan_from(const Value& fields);

}  // namespace mcplan::model
