#include "ddp/reachable_surfaces.hpp"

#include <doctest/doctest.h>

#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/plan/checker.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;
using mcplan::Plan;
using mcplan::PlanResult;
using mcplan::Scene;
using mcplan::Surface;

Surface patch(const std::string& name, const Vector3d& middle, double half = 0.1) {
  Surface out;
  out.name = name;
  out.vertices_W = {middle + Vector3d(-half, -half, 0), middle + Vector3d(half, -half, 0),
                    middle + Vector3d(half, half, 0), middle + Vector3d(-half, half, 0)};
  return out;
}

/// flat with patches far to both sides of the way, before and after the floor in the list.
Scene flat_with_idle_patches(int count, std::uint64_t seed) {
  Random random(seed);
  Scene scene = scenes::flat();
  const Surface floor = scene.surfaces[0];
  scene.surfaces.clear();
  for (int i = 0; i < count; ++i) {
    if (i == count / 2) scene.surfaces.push_back(floor);
    const double y = (i % 2 ? 1.0 : -1.0) * uniform(random, 2.5, 4.5);
    scene.surfaces.push_back(patch("idle" + std::to_string(i), {uniform(random, -0.8, 4.8), y, 0.3}));
  }
  return scene;
}

const std::vector<Vector3d> kFrom{{0, 0.1, 0}}, kTo{{2, 0.1, 0}};

}  // namespace

TEST_CASE("what is set aside lies beyond the distance from the way, solids included") {
  Scene scene;
  scene.surfaces = {patch("under", {1, 0, 0}), patch("beside", {1, 1.0, 0}), patch("far", {1, 3.0, 0}),
                    patch("ahead", {3.0, 0, 0}), patch("high", {1, 0, 2.5})};
  CHECK(surfaces_near_way(scene, kFrom, kTo, 1.0, {}) == std::vector<int>{0, 1, 3});
  CHECK(surfaces_near_way(scene, kFrom, kTo, 1.0, {2}) == std::vector<int>{0, 1, 2, 3});
  CHECK(surfaces_near_way(scene, kFrom, kTo, 5.0, {}).size() == 5);
  scene.surfaces[4].thickness = 2.5;  // a wall that stands on the ground
  CHECK(surfaces_near_way(scene, kFrom, kTo, 1.0, {}) == std::vector<int>{0, 1, 3, 4});
}

TEST_CASE("the last outlook leaves nothing out, and each one sees more than the one before") {
  for (int level = 1; level < kOutlooks - 1; ++level) {
    CHECK(outlook(level).reach > outlook(level - 1).reach);
    CHECK(outlook(level).nearest > outlook(level - 1).nearest);
  }
  CHECK(outlook(kOutlooks - 1).reach == 0.0);
  CHECK(outlook(kOutlooks - 1).nearest == 0);
}

TEST_CASE("surfaces out of reach change neither the motion nor the work, and the plan is one on the whole scene") {
  const PlanResult alone = SwitchedDdp(scenes::flat(), scenes::humanoid44()).solve();
  for (int count : {20, 200}) {
    CAPTURE(count);
    const Scene scene = flat_with_idle_patches(count, 7);
    Options options;
    options.record_history = true;
    const PlanResult among = SwitchedDdp(scene, scenes::humanoid44(), options).solve();
    CHECK(among.report.status == mcplan::Status::solved);
    CHECK(among.report.iterations == alone.report.iterations);
    CHECK(among.report.cost == alone.report.cost);
    REQUIRE(among.plan.scene.surfaces.size() == scene.surfaces.size());
    const auto here = among.plan.contact_sequence(), there = alone.plan.contact_sequence();
    const int floor = scene.surface_index("ground");
    for (std::size_t k = 0; k < here.size(); ++k)
      for (std::size_t e = 0; e < here[k].size(); ++e) CHECK(here[k][e] == (there[k][e] < 0 ? -1 : floor));
    for (const auto& state : among.report.history.back().sequence)
      for (int surface : state) CHECK((surface == kFree || surface == floor));
    CHECK(mcplan::check(among.plan, scene, scenes::humanoid44()).ok());
    // A warm start on it finds its contacts again.
    CHECK(SwitchedDdp(scene, scenes::humanoid44()).solve(among.plan).report.status == mcplan::Status::solved);
  }
}

TEST_CASE("a sequence that is given may use what would be set aside") {
  const Scene scene = flat_with_idle_patches(20, 7);
  Options options;
  const Problem problem(scene, scenes::humanoid44(), options);
  ContactSequence sequence(19, ContactState{10, 10, -1, -1});
  sequence[5][0] = sequence[7][0] = -1;
  sequence[6][0] = 0;  // an idle patch: no plan comes of it, and no exception either
  options.initial_sequence = sequence;
  options.max_iterations = 3;
  const PlanResult result = SwitchedDdp(scene, scenes::humanoid44(), options).solve();
  CHECK(result.report.status == mcplan::Status::iteration_limit);
  CHECK(result.plan.phases.size() == 18);
}

TEST_CASE("contacts are looked for among the nearest surfaces of each step") {
  Random random(3);
  Scene scene = scenes::flat();
  for (int i = 0; i < 60; ++i)
    scene.surfaces.push_back(
        patch("patch" + std::to_string(i), {uniform(random, -0.5, 2.5), uniform(random, -0.4, 0.4), 0.02}, 0.03));
  Problem problem(scene, scenes::humanoid44(), Options());
  problem.look_near(0);
  CHECK(problem.rules.looks_everywhere());
  problem.look_near(61);
  CHECK(problem.rules.looks_everywhere());
  problem.look_near(8);
  CHECK_FALSE(problem.rules.looks_everywhere());
  const ContactState stands{0, kFree, kFree, kFree};
  for (int k = 0; k <= problem.steps; ++k) {
    std::vector<int> made;
    for (const ContactState& next : problem.rules.successors(stands, k))
      if (next[1] != kFree) made.push_back(next[1]);
    CHECK(made.size() == 8);
    const Vector3d due = problem.reference.x[k].segment<3>(problem.layout.end(1));
    double farthest = 0.0, nearest_left_out = 1e9;
    for (int i = 0; i < 61; ++i) {
      const double distance = (problem.polygons[i].nearest(due) - due).norm();
      const bool taken = std::find(made.begin(), made.end(), i) != made.end();
      (taken ? farthest : nearest_left_out) =
          taken ? std::max(farthest, distance) : std::min(nearest_left_out, distance);
    }
    CHECK(farthest <= nearest_left_out);
    // What the next step touches may always be touched earlier.
    int far = 0;
    while (std::find(made.begin(), made.end(), far) != made.end()) ++far;
    ContactState then = stands;
    then[1] = far;
    const auto with = problem.rules.successors(stands, k, then);
    CHECK(std::find(with.begin(), with.end(), then) != with.end());
  }
  CHECK(problem.rules.successors(stands).size() > 60);
  // And no further than so many diagonals of the reach, with however many.
  const double diagonal = (problem.limits[1].reach_max - problem.limits[1].reach_min).norm();
  for (double within : {0.1, 0.3}) {
    problem.look_near(32, within);
    for (int k = 0; k <= problem.steps; ++k) {
      const Vector3d due = problem.reference.x[k].segment<3>(problem.layout.end(1));
      std::size_t near = 0, made = 0;
      for (const mcplan::Polygon& polygon : problem.polygons)
        near += (polygon.nearest(due) - due).norm() <= within * diagonal;
      for (const ContactState& next : problem.rules.successors(stands, k)) {
        if (next[1] == kFree) continue;
        ++made;
        CHECK((problem.polygons[next[1]].nearest(due) - due).norm() <= within * diagonal + 1e-12);
      }
      CHECK(made == std::min<std::size_t>(near, 32));
    }
  }
}
