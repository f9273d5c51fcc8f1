#pragma once

#include "mcplan/ddp/options.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

template <>
struct Names<ddp::Method> {
  static constexpr const char* name = "Method";
  static constexpr const char* meaning = "Which search runs.";
  static constexpr Choice<ddp::Method> all[] = {
      {"standard", ddp::Method::standard, "Proximal switched DDP, neighbours and whole sequences priced exactly."},
      {"paper", ddp::Method::paper, "Tazaki's Algorithms 1 and 2 as published."}};
};

template <>
struct Names<ddp::Model> {
  static constexpr const char* name = "Model";
  static constexpr const char* meaning = "What a contact can do.";
  static constexpr Choice<ddp::Model> all[] = {
      {"wrench", ddp::Model::wrench,
       "Forces act within the sole and need not point at the CoM: angular momentum, turning, friction as it is."},
      {"lipm", ddp::Model::lipm, "The paper's: forces act at the end-effector and point at the CoM."}};
};

template <>
struct Names<ddp::Polish> {
  static constexpr const char* name = "Polish";
  static constexpr const char* meaning =
      "What finds the motion of a contact sequence that is given; with joint limits always the penalty.";
  static constexpr Choice<ddp::Polish> all[] = {
      {"penalty", ddp::Polish::penalty, "Contacts and limits as weights, steps by a merit function."},
      {"interior_point", ddp::Polish::interior_point,
       "Contacts exact, limits by an elastic barrier, steps by a filter."}};
};

template <>
struct Names<ddp::StiffnessInput> {
  static constexpr const char* name = "StiffnessInput";
  static constexpr const char* meaning = "How the contact stiffness enters the search as an input.";
  static constexpr Choice<ddp::StiffnessInput> all[] = {
      {"mu", ddp::StiffnessInput::mu, "mu itself, in which contact forces are linear."},
      {"lambda_", ddp::StiffnessInput::lambda, "The paper's lambda, with mu = lambda^2."}};
};

template <>
struct Fields<ddp::Weights> {
  using Weights = ddp::Weights;
  static constexpr const char* name = "Weights";
  static constexpr const char* meaning =
      "Weights w of the cost terms 1/2 w^2 e^2 (Tazaki, Table I), for non-dimensional quantities: length in CoM "
      "heights, "
      "time in sqrt(height / gravity), mass 1. Those named _end hold at the first and last knot.";
  static constexpr auto all = std::make_tuple(
      field("com", &Weights::com, "", "On the CoM's distance from its reference.").not_negative(),
      field("com_end", &Weights::com_end, "", "The same at the first and last knot.").not_negative(),
      field("velocity", &Weights::velocity, "", "On the CoM's velocity.").not_negative(),
      field("velocity_end", &Weights::velocity_end, "", "The same at the first and last knot.").not_negative(),
      field("rotation", &Weights::rotation, "", "On the base's angles and rates, inside for Model.lipm alone.")
          .not_negative(),
      field("rotation_end", &Weights::rotation_end, "", "The same at the first and last knot.").not_negative(),
      field("angle", &Weights::angle, "", "On the base's angles inside, of Model.wrench.").not_negative(),
      field("momentum", &Weights::momentum, "", "On the angular momentum inside, of Model.wrench.").not_negative(),
      field("center_of_pressure", &Weights::center_of_pressure, "",
            "On the distance of the acting force from the end-effector, of Model.wrench.")
          .positive(),
      field("force_line", &Weights::force_line, "",
            "On the distance from there to the line that points at the CoM, of Model.wrench; very large: the paper's "
            "forces.")
          .positive(),
      field("end_effector", &Weights::end_effector, "", "On the end-effectors' distance from their reference.")
          .not_negative(),
      field("end_effector_end", &Weights::end_effector_end, "", "The same at the first and last knot.").not_negative(),
      field("stride", &Weights::stride, "", "On the travel of an end-effector within a phase.").not_negative(),
      field("stiffness", &Weights::stiffness, "", "On the contact stiffness.").not_negative(),
      field("moment", &Weights::moment, "", "On contact moments.").not_negative(),
      field("limit", &Weights::limit, "", "On what is beyond reach, stiffness, moment, force, friction, duration.")
          .not_negative(),
      field("duration", &Weights::duration, "", "Towards the middle of the duration box.").not_negative(),
      field("contact_min", &Weights::contact_min, "", "First complementarity weight.").positive(),
      field("contact_max", &Weights::contact_max, "", "Last complementarity weight, at least the first.").positive(),
      field("contact_growth", &Weights::contact_growth, "", "Factor of that weight between iterations, above 1.")
          .above(1.0),
      field("overshoot_factor", &Weights::overshoot_factor, "", "On leaving a polygon sideways, at least 1.")
          .at_least(1.0),
      // Its entries stand beside the other weights: "weights.flight".
      field("own", &Weights::own, "", "Weights of single terms by the term's name, where they are not the usual ones.")
          .in_files("")
          .not_negative());
};

template <>
struct Fields<ddp::Options> {
  using Options = ddp::Options;
  static constexpr const char* name = "Options";
  static constexpr const char* meaning =
      "Options of the contact-sequence search; the defaults serve all built-in scenes.";
  static constexpr auto all = std::make_tuple(
      field("phases", &Options::phases, "",
            "Number of phases N; 0: those of its footsteps, or 18, or more where the way asks for more.")
          .at_least(0)
          .at_most(2000),
      field("method", &Options::method, "", "Which search runs."),
      field("model", &Options::model, "", "What a contact can do; Method.paper always takes Model.lipm."),
      field("stiffness_input", &Options::stiffness_input, "", "How the contact stiffness enters as an input."),
      field("polish", &Options::polish, "", "What finds the motion of a contact sequence that is given."),
      field("weights", &Options::weights, "", "Weights of the cost terms."),
      field("duration_min_s", &Options::duration_min_s, "s", "Shortest phase, as a soft limit; 0: the robot's.")
          .not_negative(),
      field("duration_max_s", &Options::duration_max_s, "s", "Longest phase, as a soft limit; 0: the robot's.")
          .not_negative(),
      field("flight_duration_min_s", &Options::flight_duration_min_s, "s",
            "Shortest phase without any contact. The default goes with the size of the robot.")
          .positive(),
      field("duration_initial_s", &Options::duration_initial_s, "s",
            "First guess of all phases; 0: the middle of their box, 0.45 for Model.lipm.")
          .not_negative(),
      field("proximal_weight", &Options::proximal_weight, "", "First weight on the change of the inputs; it adapts.")
          .positive(),
      field("interior_points", &Options::interior_points, "", "Instants inside a phase where limits are held.")
          .at_least(0)
          .at_most(20),
      field("reach_margin_m", &Options::reach_margin_m, "m",
            "The reach box is planned smaller by this. The default goes with the size of the robot.")
          .not_negative(),
      field("sole_inside", &Options::sole_inside, "-",
            "Share of a sole's half size by which footholds keep from the edges of their surface; 1: the whole sole is "
            "on it, where it is large enough; negative: the robot's sole_support.")
          .at_most(2.0)
          .or_infinite(),
      field("friction", &Options::friction, "", "Hold the friction cones."),
      field(
          "friction_ratio", &Options::friction_ratio, "-",
          "Ratio of each surface's friction that contacts use; at least half of it is left to them. Negative: 0.8 for "
          "tracked robots on point feet, else 1.")
          .at_most(1.0)
          .or_infinite(),
      field("load_ratio", &Options::load_ratio, "-",
            "Least load of a point foot in contact of a tracked robot, over an equal share of the weight: how far the "
            "centre of pressure stays inside the support polygon. Negative: 0.3.")
          .at_most(1.0)
          .or_infinite(),
      field("friction_sides", &Options::friction_sides, "",
            "Sides of the pyramid inside the cone that is held instead of it; 0: the cone itself."),
      field("joint_limits", &Options::joint_limits, "",
            "Hold the joint limits of legs for which the robot has them; False: the plan's robot is one without."),
      field("whole_sequence_moves", &Options::whole_sequence_moves, "",
            "Look for better contact sequences as a whole, by dynamic programming, where it pays."),
      field("stepping_guesses", &Options::stepping_guesses, "",
            "Begin with end-effectors that step in turn, and with footsteps over the ground, beside what the search "
            "finds."),
      field("allow_flight", &Options::allow_flight, "",
            "Allow phases without any contact. Where steps lead to the goal they come last even so."),
      field("min_contacts", &Options::min_contacts, "",
            "Number of contacts at any time; -1: two for robots that stand on four feet, where a plan is found so.")
          .at_least(-1),
      field("detours", &Options::detours, "", "Look for ways round what steps cannot cross, too."),
      field("one_switch_per_step", &Options::one_switch_per_step, "",
            "At most one contact is made or broken between two phases (Tazaki, eq. 32)."),
      field("restarts", &Options::restarts, "", "Further attempts while the checker rejects the plan.").at_least(0),
      field("max_iterations", &Options::max_iterations, "",
            "Most iterations, over all attempts; to mend a near miss a tenth more.")
          .at_least(1),
      field("time_limit_s", &Options::time_limit_s, "s", "Wall clock of the search.").positive().or_infinite(),
      field("threads", &Options::threads, "",
            "Threads that search ways, guesses and changes at once; the result does not depend on it.")
          .at_least(1)
          .at_most(256),
      field("seed", &Options::seed, "", "Seed of the order in which restarts vary the settings."),
      field("initial_sequence", &Options::initial_sequence, "",
            "phases + 1 rows: surface index per end-effector, -1 free. Empty: searched for."),
      field("record_history", &Options::record_history, "", "Keep the sequence of every iteration in the report."),
      field("logger", &Options::logger, "", "Called with (LogLevel, line); None: silent."),
      field("watch", &Options::watch, "",
            "Called with every iterate of the search, a Plan that is not checked; None: never."));
};

}  // namespace mcplan::model
