#pragma once

#include "mcplan/planar/plan.hpp"
#include "model/fields.hpp"
#include "planar/task_fields.hpp"

namespace mcplan::model {

/// Of a planar plan in a file, in all phases together.
constexpr int max_planar_intervals = 20'000;

template <>
struct Names<PlanarForceLaw> : NamesOfTypes<PlanarForceLaw> {
  static constexpr const char* name = "PlanarForceLaw";
  static constexpr const char* meaning = "Where the contact forces of a planar plan come from.";
};

template <>
struct Fields<PlanarPlan> {
  static constexpr const char* name = "PlanarPlan";
  static constexpr const char* meaning =
      "A motion of a planar robot: joint splines, durations of the phases, and what fixes the contact forces. Carries "
      "the planar task it was made for.";
  static constexpr auto all = std::make_tuple(
      field("task", &PlanarPlan::task, "", "PlanarTask that it was made for.").formerly("motion").required(),
      field("planner", &PlanarPlan::planner, "", "Which planner made it, e.g. sip."),
      field("durations", &PlanarPlan::durations, "s", "Of the phases. Assign a list to change them.")
          .required()
          .positive()
          .entries(1, 1000),
      field("control_points", &PlanarPlan::control_points, "rad", "Of the joints' splines: joints x (intervals + 3).")
          .required()
          .entries(0, 100),
      field("base_control_points", &PlanarPlan::base_control_points, "",
            "3 x (intervals + 3): x, y [m], angle [rad]; empty: computed from the joints.")
          .entries(0, 3),
      field("force_law", &PlanarPlan::force_law, "", "Where the contact forces come from.").required(),
      field("weights", &PlanarPlan::weights, "-",
            "least_norm: an array for each phase, contact by contact, point by point.")
          .positive(),
      field("force_polynomials", &PlanarPlan::force_polynomials, "N",
            "polynomial: for each interval 4 x (2 points), coefficients of s^0..s^3, s = -1..1, of tangential and "
            "normal force, contact by contact, point by point."));
};

/// The plan of the fields of a JSON file. Throws InvalidPlan with all that is wrong.
PlanarPlan planar_plan_from(const Value& fields);

}  // namespace mcplan::model
