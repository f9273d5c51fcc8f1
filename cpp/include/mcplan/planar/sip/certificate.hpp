#pragma once

#include <string>
#include <vector>

#include "mcplan/base/logging.hpp"
#include "mcplan/planar/checker.hpp"
#include "mcplan/planar/plan.hpp"

namespace mcplan::sip {

enum class Proof { proved, not_proved, violated };

/// What certify() found out about one kind of constraint.
struct ProvedConstraint {
  std::string name;  ///< as in planar/checker.hpp
  Proof proof = Proof::not_proved;
  double bound = 0.0;      ///< proved upper bound of the amount beyond the limit, over the whole motion, in `unit`
  double reached = 0.0;    ///< proved lower bound of its maximum; above the tolerance: violated
  double tolerance = 0.0;  ///< what was to be proved: bound <= tolerance
  std::string unit;
  int phase = -1;     ///< where the bound is largest; where `reached` is, if violated; -1: nothing to prove
  std::string where;  ///< joint, end-effector or point
  double time_s = 0.0;
};

struct Certificate {
  std::vector<ProvedConstraint> constraints;
  int subdivisions = 0;   ///< pieces of time looked at
  double rounding = 0.0;  ///< largest allowance for floating-point arithmetic in a bound, as a ratio to its tolerance
  double time_s = 0.0;    ///< wall clock

  bool proved() const;  ///< every constraint
  std::string to_string() const;
};

struct CertifyOptions {
  PlanarTolerances tolerances;  ///< what is to be proved
  int order = 8;                ///< of the Taylor models
  int max_depth = 12;           ///< halvings of an interval
  bool self_collision = false;  ///< prove that capsules of the robot's collision pairs stay apart
  StopRequest stop = {};        ///< polled for every piece of time; null: never. Nothing is proved then
};

/// Prove every inequality of a planar plan at every instant, not only at samples: sines, cosines, forces and
/// torques are Taylor models (polynomial and bound of what is left out), Bernstein coefficients bound the polynomials,
/// and an interval is halved until its bound is below the tolerance, a point of it is above it, or max_depth is
/// reached. Amounts are measured as the checker measures them, and named as there; `finite` is missing, because plans
/// with other numbers are malformed. Theory: docs/theory/sip_certificate.md.
///
/// Throws InvalidPlan, InvalidPlanarTask or InvalidRobot where the plan is malformed, InvalidOptions for an order out
/// of 2..12 or a max_depth out of 0..40.
Certificate certify(const PlanarPlan& plan, const CertifyOptions& options = {});

}  // namespace mcplan::sip
