#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "mcplan/planar/checker.hpp"
#include "mcplan/planar/sip/certificate.hpp"
#include "planar/robots.hpp"

using namespace mcplan;
using planar::hand;
using sip::certify;
using sip::Proof;
using sip::ProvedConstraint;

namespace {

ProvedConstraint clearance(const PlanarPlan& plan, const sip::CertifyOptions& options = {}) {
  for (const ProvedConstraint& c : certify(plan, options).constraints)
    if (c.name == "clearance") return c;
  throw std::out_of_range("clearance");
}

/// The robot stands; what is above 0.9 m, where the hand is, is solid.
PlanarPlan under_a_ceiling() {
  PlanarPlan plan = planar::standing_plan();
  for (auto& phase : plan.task.phases) phase.clearances.clear();
  PlanarSurface ceiling;
  ceiling.name = "ceiling";
  ceiling.origin_W = {0.0, 0.9};
  ceiling.angle = std::acos(-1.0);
  plan.task.surfaces.push_back(ceiling);
  return plan;
}

/// A hand with a sole that swings about among surfaces with and without ends.
PlanarPlan swinging(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  PlanarPlan plan = planar::standing_plan();
  for (auto& phase : plan.task.phases) phase.clearances.clear();
  plan.task.robot.end_effectors[hand].points = {-0.06, 0.09};
  for (Eigen::Index i = 3; i + 3 < plan.control_points.cols(); ++i)
    plan.control_points(planar::arm - 1, i) = 1.4 * unit(random);
  PlanarSurface block;
  block.name = "block";
  block.origin_W = {0.2 * unit(random), planar::hip_height() + 0.2 + 0.1 * unit(random)};
  block.angle = M_PI * unit(random);
  const int ends = static_cast<int>(seed % 4);
  if (ends & 1) block.from = -0.1 + 0.1 * unit(random);
  if (ends & 2) block.to = 0.1 + 0.1 * unit(random);
  plan.task.surfaces.push_back(block);
  return plan;
}

}  // namespace

TEST_CASE("a hand in a solid of which the task says nothing is refused, beyond the end of the surface it is proved") {
  PlanarPlan plan = under_a_ceiling();
  const ProvedConstraint inside = clearance(plan);
  CHECK(inside.proof == Proof::violated);
  CHECK(inside.where == "hand and ceiling");
  CHECK(inside.reached == doctest::Approx(planar::hip_height() + 0.2 - 0.9));
  plan.task.surfaces.back().from = 0.3;
  CHECK(clearance(plan).proof == Proof::proved);
}

TEST_CASE("a pair in no_clearance is not proved, and does not stand in the way") {
  PlanarPlan plan = under_a_ceiling();
  plan.task.no_clearance = {{hand, 1}};
  CHECK(certify(plan).proved());
  CHECK(clearance(plan).where == "hand and ground");
}

TEST_CASE("the certificate decides as dense samples do, a little above and below the deepest of them") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const PlanarPlan plan = swinging(seed);
    double deepest = -INFINITY;
    for (const SolidDepth& depth : solid_depths(plan, 1e-4)) deepest = std::max(deepest, depth.depth_m);
    sip::CertifyOptions options;
    options.max_depth = 16;
    CAPTURE(seed);
    CAPTURE(deepest);
    options.tolerances.clearance = deepest + 1e-4;
    CHECK(clearance(plan, options).proof == Proof::proved);
    options.tolerances.clearance = deepest - 1e-4;
    CHECK(clearance(plan, options).proof == Proof::violated);
  }
}
