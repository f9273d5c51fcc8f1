#include "ddp/problem_layout.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;

}  // namespace

TEST_CASE("soles that know one plane press within it and twist about its normal") {
  for (double slope : {0.0, 0.3}) {
    mcplan::Scene scene = scenes::gap();
    for (mcplan::Surface& surface : scene.surfaces)
      for (auto& v : surface.vertices_W) v.z() += slope * v.x();
    const Problem problem(scene, scenes::humanoid44(), phases(18));
    const Layout& at = problem.layout;
    const Vector3d normal = Vector3d(-slope, 0, 1).normalized();
    CHECK(at.nu() == 2 * (3 + 1 + 2 + 2 + 1) + 1);
    REQUIRE(at.moment_count() == 2);
    for (int l : {0, 1}) {
      REQUIRE(at.pressure_count(l) == 2);
      CHECK((at.offsets(l).pressure.transpose() * normal).norm() <= 1e-15);
      CHECK((at.offsets(l).pressure.transpose() * at.offsets(l).pressure - Eigen::Matrix2d::Identity()).norm() <=
            1e-15);
      CHECK(at.offsets(l).force_line == Eigen::Matrix3d::Identity().leftCols(2));  // far below the CoM
      CHECK(at.moments()[l].end_effector == l);
      CHECK((at.moments()[l].direction_W - normal).norm() <= 1e-15);
      CHECK(at.moments()[l].max == doctest::Approx(1.0 / (44.0 * 9.8 * 0.7)));
    }
  }
}

TEST_CASE("soles that know several planes have all directions; points neither press aside nor twist") {
  const Problem problem(gap_with_walls(), scenes::humanoid44(), phases(18));
  const Layout& at = problem.layout;
  REQUIRE(at.end_effector_count() == 4);
  for (int l : {0, 1}) CHECK(at.offsets(l).pressure == Eigen::Matrix3d::Identity());
  REQUIRE(at.moment_count() == 6);
  for (int i = 0; i < 6; ++i) {
    CHECK(at.moments()[i].end_effector == i / 3);
    CHECK(at.moments()[i].direction_W == Vector3d::Unit(i % 3));
  }
  for (int l : {2, 3}) CHECK(at.pressure_count(l) == 0);
  CHECK(at.nu() == 2 * (3 + 1 + 3 + 2 + 3) + 2 * (3 + 1) + at.force_line_count(2) + at.force_line_count(3) + 1);
  // Every input has its own place.
  std::vector<int> used(at.nu(), 0);
  const auto use = [&](int first, int count) {
    for (int i = first; i < first + count; ++i) ++used[i];
  };
  for (int l = 0; l < 4; ++l) {
    use(Layout::stride(l), 3), use(at.stiffness(l), 1);
    use(at.pressure(l), at.pressure_count(l)), use(at.force_line(l), at.force_line_count(l));
  }
  use(at.moment(), at.moment_count()), use(at.duration(), 1);
  CHECK(used == std::vector<int>(at.nu(), 1));
}

TEST_CASE("the line of force goes anywhere where surfaces are met at an angle") {
  const Problem rail(scenes::gap_with_rail(), scenes::humanoid44(), phases(18));
  for (int hand : {2, 3}) CHECK(rail.layout.offsets(hand).force_line == Eigen::Matrix3d::Identity());
  mcplan::Scene walls = gap_with_walls();
  for (int i : {2, 3}) walls.surfaces[i].end_effectors = {"foot"};
  const Problem chimney(walls, scenes::humanoid44(), phases(18));
  for (int foot : {0, 1}) CHECK(chimney.layout.offsets(foot).force_line == Eigen::Matrix3d::Identity());
}

TEST_CASE("a robot that cannot twist has no moments") {
  mcplan::Robot robot = scenes::humanoid44();
  for (auto& end : robot.end_effectors) end.max_moment.setZero();
  for (const mcplan::Scene& scene : {scenes::flat(), gap_with_walls()})
    CHECK(Problem(scene, robot, phases(18)).layout.moment_count() == 0);
}
