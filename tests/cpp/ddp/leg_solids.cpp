#include <doctest/doctest.h>

#include "ddp/leg_lines.hpp"
#include "ddp/support.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

mcplan::Robot with_legs(double radius) {
  mcplan::Robot robot = scenes::humanoid44();
  for (auto& end : robot.end_effectors) {
    if (end.kind != "foot") continue;
    end.limb.hip_B = Vector3d(0.0, end.nominal_B.y(), -0.05);
    end.limb.upper = end.limb.lower = 0.36;
    end.limb.ankle = Vector3d(0.0, 0.0, 0.06);
    end.limb.radius = radius;
  }
  return robot;
}

mcplan::Scene with_solid(double x0, double x1, double y0, double y1, double top, double thickness) {
  mcplan::Scene scene = scenes::flat();
  scene.surfaces.push_back(scenes::rectangle("solid", x0, x1, y0, y1, top, "hand"));
  scene.surfaces.back().thickness = thickness;
  return scene;
}

std::vector<std::string> solids_near(const mcplan::Scene& scene, double radius) {
  const ddp::Problem problem(scene, with_legs(radius), phases(6));
  std::vector<std::string> names;
  for (int i : problem.leg_solids) names.push_back(problem.scene.surfaces[i].name);
  return names;
}

}  // namespace

TEST_CASE("solids near legs: posts beside the way, not the ground, curbs, what hangs above or stands far away") {
  const std::vector<std::string> near = {"solid"};
  CHECK(solids_near(with_solid(0.9, 1.0, 0.2, 0.3, 1.2, 1.2), 0.06) == near);
  CHECK(solids_near(with_solid(0.9, 1.0, 0.2, 0.3, 0.4, 0.4), 0.06) == near);
  CHECK(solids_near(with_solid(0.9, 1.0, 0.2, 0.3, 1.2, 1.2), 0.0).empty());
  CHECK(solids_near(with_solid(0.9, 1.0, 0.2, 0.3, 0.08, 0.08), 0.06).empty());
  CHECK(solids_near(with_solid(0.9, 1.0, -0.3, 0.3, 1.6, 0.2), 0.06).empty());
  CHECK(solids_near(with_solid(0.9, 1.0, 0.9, 1.0, 1.2, 1.2), 0.06).empty());
}

TEST_CASE("solids near legs: no more room than there is at the start, and never less than the radius") {
  const double radius = 0.06, unit = scenes::humanoid44().com_height;
  const auto rooms = [&](double wall_y) {
    const ddp::Problem problem(with_solid(-0.5, 0.5, wall_y, wall_y + 0.1, 1.2, 1.2), with_legs(radius), phases(6));
    REQUIRE(problem.leg_solids.size() == 1);
    double least = 1.0;
    for (int l : problem.jointed.ends) least = std::min(least, problem.leg_rooms[l][0]);
    return least * unit;
  };
  const double hip = std::abs(scenes::humanoid44().end_effectors[0].nominal_B.y());
  CHECK(rooms(hip + 0.2) == doctest::Approx(ddp::kLegRoom * radius));
  CHECK(rooms(hip + 0.07) == doctest::Approx(0.07));
  CHECK(rooms(hip + 0.03) == doctest::Approx(radius));
}
