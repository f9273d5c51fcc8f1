#pragma once

#include <variant>

#include "check_internal.hpp"

/// Force laws as the checker sees them: its own formulas, from forces and the places where they act alone. Nothing here
/// calls a function of the law itself.
namespace mcplan::checks {

/// What LawCheck of every force law says, of phases under that law:
///
///     Replay start(problem, phase)                             its first knot
///     Replay advance(problem, phase, from, since_start, h)     a step of h [s]
///     void set_forces(problem, sample)                         and moments, from the replay
///     double min_normal(problem)                             [N] by which friction of a smaller force is measured
///     void check_numbers(problem, phase, findings)             what is constant over the phase
///     void check_state(problem, sample, findings)              what the plan says of the base and of pressure
///     void check_bounds(problem, sample, findings)             where forces act, and what soles can give
///     void check_end(problem, phase_end, findings)             the next knot, beyond what all laws are held to
///
/// A law without one does not compile.
template <class Law>
struct LawCheck;

template <>
struct LawCheck<laws::Pendulum> {  // check_pendulum.cpp
  static Replay start(const Problem& problem, int phase);
  static Replay advance(const Problem& problem, int phase, const Replay& from, double since_start, double h);
  static void set_forces(const Problem& problem, Sample& sample);
  static double min_normal(const Problem& problem) { return problem.tolerances.force; }
  static void check_numbers(const Problem& problem, int phase, Findings& findings);
  static void check_state(const Problem& /*problem*/, const Sample& /*sample*/, Findings& /*findings*/) {}
  static void check_bounds(const Problem& problem, const Sample& sample, Findings& findings);
  static void check_end(const Problem& /*problem*/, const Sample& /*phase_end*/, Findings& /*findings*/) {}
};

template <>
struct LawCheck<laws::Wrench> {  // check_wrench.cpp
  static Replay start(const Problem& problem, int phase);
  static Replay advance(const Problem& problem, int phase, const Replay& from, double since_start, double h);
  static void set_forces(const Problem& problem, Sample& sample);
  static double min_normal(const Problem& problem) { return problem.tolerances.force; }
  static void check_numbers(const Problem& problem, int phase, Findings& findings);
  static void check_state(const Problem& problem, const Sample& sample, Findings& findings);
  static void check_bounds(const Problem& problem, const Sample& sample, Findings& findings);
  static void check_end(const Problem& problem, const Sample& phase_end, Findings& findings);
};

/// Forces at points; `Law` has the force of one of them. check_point_forces.cpp.
template <class Law>
struct PointForceCheck {
  static Replay start(const Problem& problem, int phase);
  static Replay advance(const Problem& problem, int phase, const Replay& from, double since_start, double h);
  static void set_forces(const Problem& problem, Sample& sample);
  static double min_normal(const Problem& problem);
  static void check_numbers(const Problem& problem, int phase, Findings& findings);
  static void check_state(const Problem& /*problem*/, const Sample& /*sample*/, Findings& /*findings*/) {}
  static void check_bounds(const Problem& problem, const Sample& sample, Findings& findings);
  static void check_end(const Problem& /*problem*/, const Sample& /*phase_end*/, Findings& /*findings*/) {}
};
extern template struct PointForceCheck<laws::Held>;
extern template struct PointForceCheck<laws::Linear>;
template <>
struct LawCheck<laws::Held> : PointForceCheck<laws::Held> {};
template <>
struct LawCheck<laws::Linear> : PointForceCheck<laws::Linear> {};

/// use(law) with LawCheck of a phase's law.
template <class Use>
auto with_law(const Problem& problem, int phase, Use use) {
  return std::visit([&](auto law) { return use(LawCheck<decltype(law)>()); }, problem.plan.phases[phase].law);
}

inline Replay add(const Replay& state, double h, const Replay& slope) {
  return {state.com_W + h * slope.com_W,
          state.com_velocity_W + h * slope.com_velocity_W,
          state.rpy + h * slope.rpy,
          state.rpy_rate + h * slope.rpy_rate,
          state.momentum_W + h * slope.momentum_W,
          state.quat_wxyz + h * slope.quat_wxyz};
}

/// A step of Runge-Kutta's method of order 4; slope(t, state), t = 0..h.
template <class Slope>
Replay rk4(const Replay& from, double h, const Slope& slope) {
  const Replay a = slope(0.0, from);
  const Replay b = slope(0.5 * h, add(from, 0.5 * h, a));
  const Replay c = slope(0.5 * h, add(from, 0.5 * h, b));
  const Replay d = slope(h, add(from, h, c));
  return add(add(add(add(from, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d);
}

/// Into how many steps h [s] has to be cut under f_l = m mu_l (p - s_l); check_pendulum.cpp.
double stiffness_steps(const Problem& problem, int phase, double h);

/// f_l = m mu_l (p - s_l) and its moment about the end-effector's own point, of forces that act at the anchor or at the
/// centre of pressure; check_pendulum.cpp.
void set_forces_that_act_at(Eigen::Vector3d Contact::*place_W, const Problem& problem, Sample& sample);

/// |tau_i| <= max_moment_i about each world axis; check_pendulum.cpp.
void check_moment_cap(const Problem& problem, int phase, Findings& findings);

}  // namespace mcplan::checks
