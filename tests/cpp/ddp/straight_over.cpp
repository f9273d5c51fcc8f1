#include "ddp/straight_over.hpp"

#include <doctest/doctest.h>

#include "scenes.hpp"

namespace {

using mcplan::ddp::Route;

mcplan::Scene block(double height) {
  mcplan::Scene scene =
      scenes::made_of("block", {scenes::rectangle("ground", -1, 6, -2, 2, 0)}, "ground", "ground", {4, 0, 0});
  scene.surfaces.push_back(scenes::rectangle("block", 1.5, 2.5, -2, 2, height));
  scene.surfaces.back().thickness = height;
  return scene;
}

}  // namespace

TEST_CASE("the straight way goes as high as the ground is below the feet, and down again") {
  const Route route = mcplan::ddp::straight_over(block(0.2), scenes::humanoid44());
  REQUIRE(route.size() >= 4);
  CHECK((route.front() - Eigen::Vector3d::Zero()).norm() == 0.0);
  CHECK((route.back() - Eigen::Vector3d(4, 0, 0)).norm() == 0.0);
  double highest = 0.0;
  for (std::size_t i = 0; i < route.size(); ++i) {
    CHECK(route[i].y() == 0.0);
    if (i > 0) CHECK(route[i].x() > route[i - 1].x());
    if (route[i].x() < 1.2 || route[i].x() > 2.8) CHECK(route[i].z() == 0.0);
    highest = std::max(highest, route[i].z());
  }
  CHECK(std::abs(highest - 0.2) < 1e-12);
}

TEST_CASE("there is none over level ground, over what is low, and where nothing is below the feet") {
  const mcplan::Robot robot = scenes::humanoid44();
  CHECK(mcplan::ddp::straight_over(scenes::flat(), robot).empty());
  CHECK(mcplan::ddp::straight_over(block(0.02), robot).empty());
  CHECK(mcplan::ddp::straight_over(scenes::gap(), robot).empty());
}
