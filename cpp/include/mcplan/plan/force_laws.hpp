#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <type_traits>
#include <variant>

/// How contact forces depend on time within a phase. A law is a type that says which numbers of Phase and Contact it
/// reads, and that gives motion and forces at any instant in closed form. It has no numbers of its own: they stand in
/// Phase and Contact, under the names that files and Python have for them whatever the law.
///
/// A law to be added is such a type and an entry in ForceLaw. Its functions get a file beside cpp/src/plan/law_*.cpp,
/// and LawCheck of it (cpp/src/plan/check_laws.hpp) the checker's own formulas; the compiler names what is missing.
namespace mcplan {

struct Contact;
struct Phase;
struct PhaseInstant;  // what a law is given of an instant: the plan, the phase, its knots
struct PlanState;
struct RpyTrig;  // sines and cosines of the base's angles

namespace laws {

/// What laws share under which a contact has one force, f_l(t) = m mu_l (p(t) - s_l), and no points.
struct OneForce {
  static constexpr bool has_points = false;
  static int node_count(int /*intervals*/) { return 0; }

  /// tau_l + (a_l - p_l) x f_l about each end-effector, whose position, force and centre of pressure a_l are known.
  static void set_moments(const Phase& phase, PlanState& state);

  /// Rates of the base's angles, where they follow from the angular momentum: set_motion() has set them.
  static void set_base_rate(const RpyTrig& /*trig*/, const Eigen::Vector3d& /*inertia*/, PlanState& /*state*/) {}

  /// Throws InvalidPlan where what set_motion() reads does not fit together: there is nothing to fit.
  static void require_queryable(const Phase& /*phase*/, int /*k*/) {}

  /// Throw InvalidPlan where numbers are given that the law does not have. `field`: of the phase, of the contact.
  static void validate(const Phase& phase, const std::string& field);
  static void validate_contact(const Phase& phase, const Contact& contact, const std::string& field);
};

/// f_l acts at s_l: the multi-contact pendulum (Tazaki, sec. II, eq. 5, mu = lambda^2). The base turns as a rigid body,
/// by small angles, I theta'' = sum_l tau_l, and carries the angular momentum.
struct Pendulum : OneForce {
  static constexpr const char* name = "pendulum";
  static constexpr const char* meaning = "f(t) = mass stiffness (com(t) - anchor): the multi-contact pendulum.";
  static constexpr bool has_momentum = false, has_wrenches = false;

  static void set_motion(const PhaseInstant& at, PlanState& state);
};

/// f_l acts at a_l, with a moment about the normal: a pendulum with contacts as they are, whose forces need not point
/// at the CoM (docs/theory/ddp.md, "Contact wrenches"). The angular momentum is a state and turns the base:
///
///     L' = sum_l ((a_l - p) x f_l + tau_l),   theta' = E(theta) R I^-1 R^T L.
struct Wrench : OneForce {
  static constexpr const char* name = "wrench";
  static constexpr const char* meaning =
      "f(t) = mass stiffness (com(t) - anchor), acting at center_of_pressure, with a moment about the normal.";
  static constexpr bool has_momentum = true, has_wrenches = true;

  static void set_motion(const PhaseInstant& at, PlanState& state);
  static void set_base_rate(const RpyTrig& trig, const Eigen::Vector3d& inertia, PlanState& state);
};

/// What laws share whose forces act at points, constant or linear over each of `intervals` equal intervals: the CoM is
/// cubic, L of degree 4 (plan/point_forces.hpp). The base follows the quintic through its knots, since the limbs carry
/// what it does not of L' = sum_i (p_i - p) x f_i.
struct PointForces {
  static constexpr bool has_points = true, has_momentum = true, has_wrenches = false;

  /// sum_i (p_i - p_l) x f_i
  static void set_moments(const Phase& phase, PlanState& state);

  static void set_motion(const PhaseInstant& at, PlanState& state);
  static void set_base_rate(const RpyTrig& /*trig*/, const Eigen::Vector3d& /*inertia*/, PlanState& /*state*/) {}
  static void require_queryable(const Phase& phase, int k);
  static void validate(const Phase& phase, const std::string& field);
  static void validate_contact(const Phase& phase, const Contact& contact, const std::string& field);
};

/// f_j over interval j.
struct Held : PointForces {
  static constexpr const char* name = "held";
  static constexpr const char* meaning = "Forces at points, constant over each of `intervals` equal intervals.";

  static int node_count(int intervals) { return intervals; }

  /// Force [N] of a point, `fraction` of the way through an interval. `node`: what Contact::point_forces_W has for it
  /// where the interval begins; a node has as many forces as there are `points`.
  static const Eigen::Vector3d& point_force_W(const Eigen::Vector3d* node, std::size_t /*points*/,
                                              double /*fraction*/) {
    return *node;
  }
};

/// From f_j to f_{j+1} over interval j.
struct Linear : PointForces {
  static constexpr const char* name = "linear";
  static constexpr const char* meaning = "Forces at points, linear over each of `intervals` equal intervals.";

  static int node_count(int intervals) { return intervals + 1; }

  static Eigen::Vector3d point_force_W(const Eigen::Vector3d* node, std::size_t points, double fraction) {
    return *node + fraction * (node[points] - *node);
  }
};

/// Two laws of one type are the same: they have no numbers.
template <class Law>
constexpr std::enable_if_t<std::is_empty_v<Law>, bool> operator==(const Law& /*a*/, const Law& /*b*/) {
  return true;
}
template <class Law>
constexpr std::enable_if_t<std::is_empty_v<Law>, bool> operator!=(const Law& /*a*/, const Law& /*b*/) {
  return false;
}

}  // namespace laws

/// The laws that there are. Their order is that of the numbers of .npz files and of Python's enum.
using ForceLaw = std::variant<laws::Pendulum, laws::Held, laws::Linear, laws::Wrench>;

}  // namespace mcplan
