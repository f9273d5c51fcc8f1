#pragma once

#include "ipm/names.hpp"
#include "mcplan/planar/sip/options.hpp"
#include "model/fields.hpp"

namespace mcplan::model {

template <>
struct Names<sip::Forces> {
  static constexpr const char* name = "Forces";
  static constexpr const char* meaning = "Where contact forces come from (Lengagne et al., secs. III-C and IV-D).";
  static constexpr Choice<sip::Forces> all[] = {
      {"uniform", sip::Forces::uniform, "Weighted least norm, all weights 1: case 1."},
      {"per_body", sip::Forces::per_body, "One weight for each contact of a phase: case 2."},
      {"per_point", sip::Forces::per_point, "One weight for each point of a contact: case 3."},
      {"parameters", sip::Forces::parameters, "Cubic polynomials of time over each interval, balance as constraints."}};
};

template <>
struct Names<sip::ContactMode> {
  static constexpr const char* name = "ContactMode";
  static constexpr const char* meaning = "How an end-effector in contact is held where it should be.";
  static constexpr Choice<sip::ContactMode> all[] = {
      {"tube", sip::ContactMode::tube, "Position and angle stay within a tube at every instant."},
      {"band", sip::ContactMode::band, "Polynomial coefficients 0..neq of position and angle within a band."},
      {"strict", sip::ContactMode::strict, "The same coefficients zero; one contact of a phase is left out."}};
};

template <>
struct Names<sip::Continuous> {
  static constexpr const char* name = "Continuous";
  static constexpr const char* meaning = "How an inequality is kept at every instant of an interval.";
  static constexpr Choice<sip::Continuous> all[] = {
      {"hull", sip::Continuous::hull, "Every Bernstein coefficient within the limits."},
      {"extremum", sip::Continuous::extremum, "The polynomial's extrema within the limits: exact, not smooth."},
      {"grid", sip::Continuous::grid, "At grid_points instants: nothing is said about the time between."}};
};

template <>
struct Names<sip::FreeFlyer> {
  static constexpr const char* name = "FreeFlyer";
  static constexpr const char* meaning = "The trajectory of the base.";
  static constexpr Choice<sip::FreeFlyer> all[] = {
      {"computed", sip::FreeFlyer::computed, "From the joints (eqs. 9-12)."},
      {"parameterised", sip::FreeFlyer::parameterised, "Three more splines (Table I)."}};
};

template <>
struct Names<sip::HessianChoice> {
  static constexpr const char* name = "HessianChoice";
  static constexpr const char* meaning = "Where second derivatives come from.";
  static constexpr Choice<sip::HessianChoice> all[] = {
      {"automatic", sip::HessianChoice::automatic, "As suits the problem, and another one where that fails."},
      {"exact", sip::HessianChoice::exact, "Of cost and constraints."},
      {"gauss_newton", sip::HessianChoice::gauss_newton, "Of the cost alone, without its curvature."},
      {"limited_memory", sip::HessianChoice::limited_memory, "L-BFGS."}};
};

template <>
struct Fields<sip::Options> {
  using Options = sip::Options;
  static constexpr const char* name = "Options";
  static constexpr const char* meaning = "Options of the semi-infinite planner.";
  static constexpr auto all = std::make_tuple(
      field("forces", &Options::forces, "", "Where contact forces come from."),
      field("torque_weight", &Options::torque_weight, "1/(N m)^2 s", "Cost: integral of the squared torques.")
          .not_negative(),
      field("duration_weight", &Options::duration_weight, "1/s", "Cost: duration.").not_negative(),
      field("jerk_weight", &Options::jerk_weight, "s^5", "Cost: integral of the squared joint jerks.").not_negative(),
      field("free_durations", &Options::free_durations, "",
            "A duration for each phase; else one for the motion, shared by intervals."),
      field("total_duration_s", &Options::total_duration_s, "s", "Where free_durations is off: min, max.").positive(),
      field("phase_duration_s", &Options::phase_duration_s, "s",
            "Where free_durations is on: min, max; the task's own limits hold as well.")
          .positive(),
      field("contact", &Options::contact, "", "How an end-effector in contact is held where it should be."),
      field("tube_m", &Options::tube_m, "m", "Half width of the tube or of the band.").positive(),
      field("tube_rad", &Options::tube_rad, "rad", "The same of the angle.").positive(),
      field("neq", &Options::neq, "", "Highest coefficient of band and strict, 0 to order."),
      field("continuous", &Options::continuous, "", "How an inequality is kept at every instant of an interval."),
      field("grid_points", &Options::grid_points, "",
            "Instants of an interval under Continuous.grid, both ends included.")
          .within(2, 1000),
      field("order", &Options::order, "", "Order of the Taylor polynomials, 3 to 12.").within(3, 12),
      field("free_flyer", &Options::free_flyer, "", "The trajectory of the base."),
      field("dynamics", &Options::dynamics, "", "Contact forces in their cones; off: kinematics alone."),
      field("torque_limits", &Options::torque_limits, "", "Joint torques within their limits."),
      field("clearance", &Options::clearance, "", "Swinging end-effectors outside of all solids."),
      field("self_collision", &Options::self_collision, "", "The robot's collision pairs keep clear of each other."),
      field("clearance_m", &Options::clearance_m, "m",
            "Least height of swinging points: at lift-off they are at zero to the tube."),
      field("min_normal_force", &Options::min_normal_force, "N", "Least normal force at every point.").not_negative(),
      field("margin", &Options::margin, "-", "Kept to joint, torque and force limits, relative.")
          .within(0.0, 0.5)
          .below(0.5),
      field("log_weight_max", &Options::log_weight_max, "", "Bound of the logarithms of weights.").positive(),
      field("kinematics_first", &Options::kinematics_first, "",
            "With dynamics: find contacts and joints within limits first, forces from there."),
      field("feasible_first", &Options::feasible_first, "",
            "With a cost: solve without it first, and start from that."),
      field("solver", &Options::solver, "", "Solver of the nonlinear programs."),
      field("hessian", &Options::hessian, "", "Where second derivatives come from."),
      field("tolerance", &Options::tolerance, "", "Optimality tolerance of the solver.").positive(),
      field("constraint_tolerance", &Options::constraint_tolerance, "", "Tolerance of the solver on constraints.")
          .positive(),
      field("max_iterations", &Options::max_iterations, "", "Most iterations of each run of the solver.")
          .within(1, 1'000'000),
      field("time_limit_s", &Options::time_limit_s, "s", "Wall clock of the whole solve.").positive().or_infinite(),
      field("logger", &Options::logger, "", "Called with (LogLevel, line), a line an iteration; None: silent."));
};

}  // namespace mcplan::model
