#pragma once

#include <array>
#include <variant>

#include "check_internal.hpp"

/// Force laws as the checker sees them: its own formulas, from forces and the places where they act alone. Nothing here
/// calls a function of the law itself.
namespace mcplan::checks {

/// What LawCheck of every force law says, of phases under that law:
///
///     Replay start(problem, phase)                             its first knot
///     Integration(problem, phase, h).advance(sample)           the replay of the sample before, by a step of h [s]
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

/// A step of h [s] of p'' = mu p - f and of the integral P of p, mu and f constant: linear in p, v = p' and f. What RK4
/// makes of each of the three, in as many steps as keep its error far below 1e-9, is found out once.
class PendulumStep {
 public:
  PendulumStep(double stiffness, double h);  // check_pendulum.cpp

  /// Replaces p and v, and returns the integral of p.
  Eigen::Vector3d apply(Eigen::Vector3d& p, Eigen::Vector3d& v, const Eigen::Vector3d& f) const {
    const Eigen::Vector3d from = p, speed = v;
    p = of_[0][0] * from + of_[1][0] * speed + of_[2][0] * f;
    v = of_[0][1] * from + of_[1][1] * speed + of_[2][1] * f;
    return of_[0][2] * from + of_[1][2] * speed + of_[2][2] * f;
  }

 private:
  double of_[3][3];  ///< of p, v and f: what p, v and P are in the end
};

/// Sums over the contacts of a phase, of which all of an instant's forces and moments follow:
///
///     sum_l f_l = m (mu p - s),   sum_l ((a_l - p) x f_l + tau_l) = m ((a - s) x p - c) + tau,
///     mu = sum mu_l,  s = sum mu_l s_l,  a = sum mu_l a_l,  c = sum mu_l a_l x s_l,  tau = sum tau_l
///
/// with places counted from where the CoM is as the phase begins: kilometres from the world's origin the products would
/// lose the digits that their difference is made of.
struct Wrenches {
  Wrenches(const Problem& problem, int phase);  // check_wrench.cpp

  double mass;
  Eigen::Vector3d inverse_inertia, origin_W;
  double stiffness = 0.0;                                                                      ///< mu
  Eigen::Vector3d anchors = Eigen::Vector3d::Zero(), lines = anchors, steady = anchors, fall;  ///< s, a - s, tau/m - c,
                                                                                               ///< s + g
};

/// Contact wrenches step by step. CoM and momentum go by PendulumStep, the quaternion by Adams' and Bashforth's method
/// of order 4, from one look at an instant each; the first steps and those of a base that turns fast by RK4.
class WrenchIntegration {
 public:
  WrenchIntegration(const Problem& problem, int phase, double h);
  void advance(Sample& sample);

 private:
  Eigen::Vector4d turned_by_rk4(const Replay& from, double turning) const;

  Wrenches sum_;
  double h_, min_inertia_;
  PendulumStep step_;
  std::array<Eigen::Vector4d, 4> slopes_;  ///< of the quaternion, at this and the instants before
  int known_ = 0;
};

template <>
struct LawCheck<laws::Pendulum> {  // check_pendulum.cpp
  static Replay start(const Problem& problem, int phase);
  class Integration {
   public:
    Integration(const Problem& problem, int phase, double h);
    void advance(Sample& sample);

   private:
    double h_;
    PendulumStep step_;
    Eigen::Vector3d origin_W_, fall_, spin_up_;
  };
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
  using Integration = WrenchIntegration;
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
  class Integration {
   public:
    Integration(const Problem& problem, int phase, double h) : problem_(problem), phase_(phase), h_(h) {}
    void advance(Sample& sample);

   private:
    const Problem& problem_;
    int phase_;
    double h_;
  };
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

/// f_l = m mu_l (p - s_l) and its moment about the end-effector's own point, of forces that act at the anchor or at the
/// centre of pressure; check_pendulum.cpp.
void set_forces_that_act_at(Eigen::Vector3d Contact::*place_W, const Problem& problem, Sample& sample);

/// |tau_i| <= max_moment_i about each world axis; check_pendulum.cpp.
void check_moment_cap(const Problem& problem, int phase, Findings& findings);

}  // namespace mcplan::checks
