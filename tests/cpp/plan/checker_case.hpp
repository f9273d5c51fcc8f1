#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <set>
#include <stdexcept>
#include <string>

#include "mcplan/plan/checker.hpp"
#include "plan/fixtures.hpp"
#include "plan/name_sets.hpp"

/// Valid plans made by hand, and what the checker says of a change to one of them.
namespace checker_case {

using namespace fixtures;
using Eigen::Vector3d;
using mcplan::CheckResult;
using mcplan::Plan;
using mcplan::Robot;
using mcplan::Scene;

struct Case {
  Plan plan = walk();
  Scene scene = plan.scene;
  Robot robot = plan.robot;

  CheckResult check() const { return mcplan::check(plan, scene, robot); }
};

using Names = std::set<std::string>;

inline Names names(const CheckResult& result) {
  Names out;
  for (const auto& violation : result.violations()) out.insert(violation.name);
  return out;
}

/// Names of what a change to the valid walk (or another case) violates.
inline Names broken(const std::function<void(Case&)>& mutate, Case walk_case = {}) {
  mutate(walk_case);
  const CheckResult result = walk_case.check();
  REQUIRE_FALSE(result.ok());
  CHECK(result.worst().name == result.violations().front().name);
  return names(result);
}

inline const mcplan::Violation& find(const CheckResult& result, const std::string& name) {
  for (const auto& violation : result.constraints)
    if (violation.name == name) return violation;
  throw std::out_of_range(name);
}

inline void shift_foothold(Plan& plan, int foot, int first_knot, int last_knot, const Vector3d& by) {
  for (int k = first_knot; k <= last_knot; ++k) plan.knots[k].end_effectors_W[foot] += by;
}

inline Case at_rails(double height, double hold) {
  Case c;
  c.plan = stand_at_rails(height, hold);
  c.scene = c.plan.scene;
  return c;
}

}  // namespace checker_case
