#pragma once

#include "ipm/names.hpp"
#include "mcplan/rhp/options.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

template <>
struct Names<rhp::Fidelity> {
  static constexpr const char* name = "Fidelity";
  static constexpr const char* meaning =
      "Model of the steps that are predicted but not executed (Wang et al., sec. IV).";
  static constexpr Choice<rhp::Fidelity> all[] = {
      {"single", rhp::Fidelity::single, "Centroidal dynamics, free timing: the baseline."},
      {"com", rhp::Fidelity::com, "Candidate 1: linear CoM dynamics."},
      {"rectangle", rhp::Fidelity::rectangle, "Candidate 2: relaxed torque, four corner forces per foot."},
      {"point", rhp::Fidelity::point, "Candidate 3: relaxed torque, one force per foot."}};
};

template <>
struct Names<rhp::Transcription> {
  static constexpr const char* name = "Transcription";
  static constexpr const char* meaning = "How the continuous motion becomes algebraic equations.";
  static constexpr Choice<rhp::Transcription> all[] = {
      {"trapezoidal", rhp::Transcription::trapezoidal, "Forces linear between nodes, motion integrated exactly."},
      {"euler", rhp::Transcription::euler, "The paper's forward Euler."}};
};

template <>
struct Names<rhp::StepFrom> {
  static constexpr const char* name = "StepFrom";
  static constexpr const char* meaning = "Where the step that a cycle executes comes from.";
  static constexpr Choice<rhp::StepFrom> all[] = {
      {"none", rhp::StepFrom::none, "Nothing is executed."},
      {"converged", rhp::StepFrom::converged, "The solver converged."},
      {"iterate", rhp::StepFrom::iterate, "The best point of a solve that was cut short, usable as it is."},
      {"previous_plan", rhp::StepFrom::previous_plan,
       "The solve was cut short: what the last cycle with a plan of its own predicted for now, usable."}};
};

template <>
struct Fields<rhp::Options> {
  using Options = rhp::Options;
  static constexpr const char* name = "Options";
  static constexpr const char* meaning = "Options of the receding-horizon planner.";
  static constexpr auto all = std::make_tuple(
      field("fidelity", &Options::fidelity, "", "Model of the steps after the first."),
      field("lookahead", &Options::lookahead, "", "Steps in the horizon, 1 to 10, the executed one included.")
          .within(1, 10),
      field("cycles", &Options::cycles, "", "Steps to execute; fewer if the sequence ends before.").within(1, 10'000),
      field("transcription", &Options::transcription, "", "How the continuous motion becomes algebraic equations."),
      field("paper", &Options::paper, "", "Absolute CoM box and outer friction pyramid, as published."),
      field("lifted_psi", &Options::lifted_psi, "", "Keep the relaxation's bounds psi as variables."),
      field("friction_rows", &Options::friction_rows, "", "Pyramids with faces across t1 and t2, not edges."),
      field("all_faces", &Options::all_faces, "", "Keep faces of the reach polytopes that others imply."),
      field("intervals", &Options::intervals, "", "Intervals of a phase, 2 to 100.").within(2, 100),
      field("double_support_s", &Options::double_support_s, "s", "Duration of a phase on two feet: min, max.")
          .positive()
          .growing(),
      field("single_support_s", &Options::single_support_s, "s", "Duration of a phase on one foot: min, max.")
          .positive()
          .growing(),
      field("landing_s", &Options::landing_s, "s",
            "Time by which the first phase of a horizon may last longer, for starts at a touch-down.")
          .not_negative(),
      field("predicted_double_support_s", &Options::predicted_double_support_s, "s",
            "Fixed duration of a phase on two feet in predicted steps of the reduced models.")
          .positive(),
      field("predicted_single_support_s", &Options::predicted_single_support_s, "s", "The same on one foot.")
          .positive(),
      field("com_velocity_max", &Options::com_velocity_max, "m/s", "Largest value of each component.").positive(),
      field("momentum_max", &Options::momentum_max, "kg m^2/s", "Largest value of each component of L.").positive(),
      field("momentum_rate_max", &Options::momentum_rate_max, "N m", "Largest value of each component of L'.")
          .positive(),
      field("com_height", &Options::com_height, "-",
            "Height of the CoM over every foot in contact, over robot.com_height: min, max.")
          .positive()
          .growing(),
      field("sole_ratio", &Options::sole_ratio, "-", "Ratio of the sole that forces make use of; paper: all.")
          .within(0.0, 1.0)
          .above(0.0),
      field("friction_ratio", &Options::friction_ratio, "-",
            "Ratio of the friction coefficient that forces make use of; paper: all.")
          .within(0.0, 1.0)
          .above(0.0),
      field("foothold_margin_m", &Options::foothold_margin_m, "m",
            "Distance of the sole from the edges of a surface where it has room.")
          .not_negative(),
      field("psi_max", &Options::psi_max, "-", "Bound of the relaxation.").positive(),
      field("goal_weight", &Options::goal_weight, "1/m^2", "On the squared distance of the end to the goal.")
          .not_negative(),
      field("friction_sides", &Options::friction_sides, "", "Sides of the pyramid inside the friction cone, 3 to 64.")
          .within(3, 64),
      field("tolerance", &Options::tolerance, "", "Optimality tolerance of the solver.").positive(),
      field("constraint_tolerance", &Options::constraint_tolerance, "", "Tolerance of the solver on constraints.")
          .positive(),
      field("max_iterations", &Options::max_iterations, "", "Most iterations of a cycle.").at_least(1),
      field("time_limit_s", &Options::time_limit_s, "s", "Wall clock of a cycle.").positive().or_infinite(),
      field("solver", &Options::solver, "", "Solver of the nonlinear programs."),
      field("automatic_ordering", &Options::automatic_ordering, "", "Pivot order of Ipopt's linear solver is its own."),
      field("logger", &Options::logger, "", "Called with (LogLevel, line), a line a cycle; None: silent."));
};

}  // namespace mcplan::model
