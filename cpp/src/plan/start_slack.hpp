#pragma once

#include <array>
#include <vector>

#include "check_internal.hpp"

namespace mcplan::checks {

/// What a measured start violates by itself, which no plan can change at once, and how much of it is forgiven:
///
///     beyond(t) = value(t) - v_0 max(0, 1 - t / start_slack_s),    v_0 = max(0, value(0))
///
/// of each limit and end-effector. A sole does not move: of a contact that has been held since the start, v_0 of
/// contact_distance and contact_polygon stays as long as it stands, and is gone with it.
class StartSlack {
 public:
  /// Measures v_0 from the first knot and the contacts of the first phase. The plan must have start_slack_s > 0.
  StartSlack(const Problem& problem, const Findings& empty);

  /// The value less what is left of v_0; while v_0 is measured, the value as it is, which is noted.
  double beyond(StateLimit limit, double value, const Place& place, double tolerance, const char* unit);

  /// What is left of v_0.
  double left(StateLimit limit, const Place& place) const;

  bool measured() const { return measured_; }

  /// v_0 beyond the tolerance, the largest ratio to it first.
  std::vector<Violation> violations(const Robot& robot) const;

 private:
  struct Excess {
    double value = 0.0, tolerance = 0.0;
    const char* unit = "";
  };
  void measure(const Problem& problem, Findings findings);

  double start_slack_s_;
  bool measured_ = false;
  std::array<std::vector<Excess>, kStateLimits> excess_;  ///< per end-effector, then of the CoM
  std::vector<int> held_phases_;  ///< per end-effector, as long as the contact of the start stands; 0: it is free
};

}  // namespace mcplan::checks
