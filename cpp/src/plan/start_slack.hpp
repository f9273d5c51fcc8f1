#pragma once

#include <array>
#include <vector>

#include "check_internal.hpp"

namespace mcplan::checks {

/// What a measured start violates by itself, which no plan can change at once, and how much of it is forgiven:
///
///     beyond(t) = value(t) - v(t) max(0, 1 - (t / start_slack_s)^2)
///
/// of each limit and end-effector. v(t) is the most that the state would violate until t if nothing intervened: CoM and
/// base move on straight, at their velocities, what stands stands, and what is free moves with the base. Of clearance,
/// limb, trunk and the speeds v is that at t = 0. A sole does not move: of a contact that has been held since the
/// start, v of contact_distance and contact_polygon is forgiven in full as long as it stands, and not afterwards.
class StartSlack {
 public:
  /// Measures v from the first knot and the contacts of the first phase. The plan must have start_slack_s > 0.
  StartSlack(const Problem& problem, const Findings& empty);

  /// The value less what is left of v; while v is measured, the value as it is, which is noted.
  double beyond(StateLimit limit, double value, const Place& place, double tolerance, const char* unit);

  /// What is left of v.
  double left(StateLimit limit, const Place& place) const;

  bool measured() const { return measured_; }

  /// v at t = 0 beyond the tolerance, the largest ratio to it first.
  std::vector<Violation> violations(const Robot& robot) const;

 private:
  static constexpr int kTimes = 9;  ///< over start_slack_s, at which v is measured; between them it is linear
  struct Excess {
    std::array<double, kTimes> value{};
    double tolerance = 0.0;
    const char* unit = "";
  };
  void measure(const Problem& problem, Findings findings);

  double start_slack_s_;
  bool measured_ = false;
  int now_ = 0;                                           ///< which of the times is measured
  std::array<std::vector<Excess>, kStateLimits> excess_;  ///< per end-effector, then of the CoM
  std::vector<int> held_phases_;  ///< per end-effector, as long as the contact of the start stands; 0: it is free
};

}  // namespace mcplan::checks
