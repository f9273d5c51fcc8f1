#include "check_rows.hpp"

namespace {

using namespace support;

ddp::Problem with_foothold() {
  ddp::Problem problem = workshop();
  problem.kept.push_back({2, 1, Eigen::Vector3d(0.1, -0.2, 0.3), 3.0});
  return problem;
}

}  // namespace

TEST_CASE("kept footholds: gradients") {
  const ddp::Problem problem = with_foothold();
  check_rows(problem, term(problem, "kept", {2}), 42, 2.0, 20);
}

TEST_CASE("kept footholds cost the square of their distance at their knot, and nothing elsewhere") {
  const ddp::Problem problem = with_foothold();
  VectorXd x = VectorXd::Zero(problem.layout.nx());
  const VectorXd u = VectorXd::Zero(problem.layout.nu());
  x.segment<3>(problem.layout.end(1)) = Eigen::Vector3d(0.1, -0.2, 0.5);
  CHECK(cost(problem, term(problem, "kept", {2}), x, u) == doctest::Approx(0.5 * 9.0 * 0.04));
  CHECK(cost(problem, term(problem, "kept", {3}), x, u) == 0.0);
}
