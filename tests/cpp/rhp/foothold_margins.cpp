#include "rhp/foothold_margins.hpp"

#include <doctest/doctest.h>

#include "mcplan/plan/checker.hpp"
#include "rhp/walkers.hpp"

namespace mcplan::rhp::tests {
namespace {

using namespace walkers;

/// Two level platforms with a gap between them. Steps of 0.32 m and soles of 0.22 m leave 0.10 m.
Scene gap(double width) {
  Scene scene = plain();
  scene.name = "gap";
  scene.surfaces = {patch("near", -1.0, 0.2, -0.5, 0.5), patch("far", 0.2 + width, 30.0, -0.5, 0.5)};
  scene.start.contacts = {{"foot", "near"}};
  scene.goal.contacts = {{"foot", "far"}};
  scene.steps = {{"left_foot", "near"}, {"right_foot", "far"}, {"left_foot", "far"}};
  return scene;
}

FootholdMargins margins(const Scene& scene) {
  const Walker walker(scene, robot(), {});
  return FootholdMargins(walker, walker.start(), footsteps_of(walker));
}

}  // namespace

TEST_CASE("margins yield as far as a gap asks, and no further") {
  // By hand: a step of 0.32 m spans the gap, the soles and both margins.
  const std::pair<double, double> cases[] = {{0.03, 1.0}, {0.06, 0.5}, {0.08, 0.25}, {0.099, 0.0}};
  for (const auto& entry : cases) {  // by names that CAPTURE may capture in C++17, which those of a binding are not
    const double width = entry.first, ratio = entry.second;
    CAPTURE(width);
    const FootholdMargins found = margins(gap(width));
    CHECK(found.out_of_reach.empty());
    CHECK(found.yielded.empty() == (ratio == 1.0));
    if (ratio == 1.0) continue;
    for (const auto& [where, kept] : found.ratios) CHECK(kept == ratio);
    CHECK(found.ratios.size() == 2);
    CHECK(found.ratios.count({0, 0}) == 1);
    CHECK(found.ratios.count({1, 1}) == 1);
  }
}

TEST_CASE("a gap that no step spans is named, with the foot and both surfaces") {
  const FootholdMargins found = margins(gap(0.15));
  CHECK(found.out_of_reach ==
        "no foothold of right_foot on \"far\" is in reach of the other foot on \"near\", with no margin either");
}

TEST_CASE("a gap of nine centimetres is crossed, and the checker accepts it") {
  Options options;
  options.cycles = 4;
  RecedingHorizon planner(gap(0.09), robot(), options);
  const Walk walk = planner.walk();
  CHECK_MESSAGE(walk.success, walk.report.message);
  CHECK(walk.report.status == Status::solved);
  CHECK(walk.report.message.find("foothold_margin_m yields") == 0);
  CHECK(walk.plan.final_contacts == std::vector<int>{1, 1});
}

}  // namespace mcplan::rhp::tests
