// Sequences taken from plans: RecedingHorizon walks them to their end, near the goal or far from it.

#include <doctest/doctest.h>

#include <cmath>

#include "mcplan/base/error.hpp"
#include "mcplan/rhp/receding_horizon.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using Eigen::Vector3d;
using walkers::field_of;

RecedingHorizon planner(const Scene& scene, const Options& options) { return {scene, walkers::robot(), options}; }

}  // namespace

TEST_CASE("a sequence taken from a plan is walked to its end, where the robot rests") {
  Options options = walkers::quick(Fidelity::single, 3);
  const Plan sequence = planner(walkers::uneven(), options).walk().plan;
  REQUIRE(sequence.phases.size() == 6);
  options.cycles = 14;
  options.constraint_tolerance = 1e-9;  // the state at the end is that of the forces, integrated
  RecedingHorizon refined(walkers::uneven(), walkers::robot(), sequence, options);
  const Walk walk = refined.walk();
  CAPTURE(walk.report.message);
  CHECK(walk.success);
  REQUIRE(walk.cycles.size() == 2);
  CHECK(walk.plan.knots.back().com_velocity_W.norm() < 1e-9);
  CHECK(walk.plan.knots.back().angular_momentum_W.norm() < 1e-6);
  CHECK(walk.plan.final_contacts == sequence.final_contacts);
  CHECK(field_of<InvalidInput>([&] { refined.step(); }) == "cycles");
}

TEST_CASE("a sequence that ends far from the goal comes to rest above its last footholds") {
  const Options options = walkers::quick(Fidelity::single, 3);
  const Scene far = walkers::uneven();
  const Plan sequence = planner(far, options).walk().plan;
  REQUIRE(far.goal.position_W.x() - sequence.knots.back().com_W.x() > 5.0);
  const Walk walk = RecedingHorizon(far, walkers::robot(), sequence, options).walk();
  CAPTURE(walk.report.message);
  REQUIRE(walk.success);
  CHECK(walk.plan.open_end);
  const Knot& end = walk.plan.knots.back();
  const Vector3d middle_W = 0.5 * (end.end_effectors_W[walkers::left] + end.end_effectors_W[walkers::right]);
  CHECK((end.com_W - middle_W).head<2>().norm() < 0.05);  // at the end of its reach where the goal pulls
  for (const Knot& knot : walk.plan.knots) CHECK(std::abs(knot.com_velocity_W.z()) < 0.3);
}

}  // namespace mcplan::rhp::tests
