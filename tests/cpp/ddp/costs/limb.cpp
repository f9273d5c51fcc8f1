#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

/// A post beside the way at x = 1 m, and a pad for hands.
ddp::Problem with_post() {
  mcplan::Scene scene = scenes::flat();
  mcplan::Surface post = scenes::rectangle("post", 0.95, 1.05, -0.05, 0.05, 1.4, "foot");
  post.thickness = 1.4;
  scene.surfaces.push_back(post);
  scene.surfaces.push_back(scenes::rectangle("pad", -1.0, -0.8, -1.0, 1.0, 0.5, "right_hand"));
  return ddp::Problem(scene, scenes::humanoid44(), phases(6));
}

}  // namespace

TEST_CASE("an arm stays on the side of a post on which the robot passes it") {
  const ddp::Problem problem = with_post();
  const ddp::Layout& at = problem.layout;
  const Writer limb = term(problem, "limb", {2, 2, ddp::kFree, 100.0, 3.0});
  const auto price = [&](double com_y, double hand_y) {
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.com()) = Vector3d(1.0, com_y, 0.7) / 0.7;
    x.segment<3>(at.end(2)) = Vector3d(1.0, hand_y, 0.7) / 0.7;
    u[at.duration()] = 1.0;
    return cost(problem, limb, x, u);
  };
  CHECK(price(0.30, 0.08) == 0.0);
  CHECK(price(0.30, 0.02) > 0.0);
  CHECK(price(0.30, -0.10) > price(0.30, 0.02));  // through the post, not merely in it
  CHECK(price(-0.20, -0.40) == 0.0);
  check_rows(problem, limb, 7, 0.5, 5);
}

TEST_CASE("the CoM gives way for a hand that may touch nothing and is carried along") {
  const ddp::Problem problem = with_post();  // the left hand, 0.225 m to the left
  REQUIRE(problem.idle_hands.size() == 1);
  const ddp::Layout& at = problem.layout;
  const Writer limb = term(problem, "idle_limb", {2, -1, ddp::kFree, 100.0, 3.0});
  const auto price = [&](double com_y) {
    VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
    x.segment<3>(at.com()) = Vector3d(1.0, com_y, 0.7) / 0.7;
    u[at.duration()] = 1.0;
    return cost(problem, limb, x, u);
  };
  CHECK(price(-0.30) == 0.0);
  CHECK(price(-0.26) > 0.0);
  CHECK(price(-0.15) > price(-0.26));
  CHECK(price(0.20) == 0.0);
  check_rows(problem, limb, 11, 0.5, 5);
}

TEST_CASE("feet have no rows of arms") {
  const ddp::Problem problem = with_post();
  const ddp::Layout& at = problem.layout;
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  x.segment<3>(at.com()) = Vector3d(1.0, 0.1, 0.7) / 0.7;
  x.segment<3>(at.end(1)) = Vector3d(1.0, -0.1, 0.0) / 0.7;
  u[at.duration()] = 1.0;
  CHECK(cost(problem, term(problem, "limb", {2, 1, ddp::kFree, 100.0, 3.0}), x, u) == 0.0);
}
