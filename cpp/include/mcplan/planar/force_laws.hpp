#pragma once

#include <Eigen/Core>
#include <type_traits>
#include <variant>

/// Where the contact forces of a planar plan come from. A law is a type that says which numbers of the plan it reads
/// and gives the forces at any instant; it has no numbers of its own. A law to be added is such a type and an entry in
/// PlanarForceLaw; the compiler names which functions are missing, here, in the checker and in `sip`.
namespace mcplan {

class PlanarPlan;

namespace planar_laws {

struct Gain;     // what is constant over a phase
struct Instant;  // what a law is given of an instant: the plan, the interval, the motion of all bodies

/// Weighted least norm that balances the motion (Lengagne et al., sec. IV): PlanarPlan::weights.
struct LeastNorm {
  static constexpr const char* name = "least_norm";
  static constexpr const char* meaning = "Weighted least norm that balances the motion.";

  /// From what has to be given to the forces that give it.
  static Gain gain(const PlanarPlan& plan, int phase);

  /// Tangential and normal force [N] at an instant, contact by contact, point by point.
  static void set_components(const Instant& at, Eigen::VectorXd& components);

  /// Throw InvalidPlan where the numbers of the law do not fit together, or are out of their range.
  static void require_shape(const PlanarPlan& plan);
  static void validate(const PlanarPlan& plan);

  /// Takes away what the law does not read: files do without.
  static void clear_others(PlanarPlan& plan);
};

/// Cubic in time over each interval, given (sec. III-C): PlanarPlan::force_polynomials.
struct Polynomial {
  static constexpr const char* name = "polynomial";
  static constexpr const char* meaning = "Cubic in time over each interval, given.";

  static Gain gain(const PlanarPlan& plan, int phase);
  static void set_components(const Instant& at, Eigen::VectorXd& components);
  static void require_shape(const PlanarPlan& plan);
  static void validate(const PlanarPlan& plan);
  static void clear_others(PlanarPlan& plan);
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

}  // namespace planar_laws

/// The laws that there are, in the order of Python's enum.
using PlanarForceLaw = std::variant<planar_laws::LeastNorm, planar_laws::Polynomial>;

}  // namespace mcplan
