#include <cmath>

#include "check_rows.hpp"
#include "ddp/constants.hpp"

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

TEST_CASE("kept footholds cost the square of a small distance and a multiple of a great one, at their knot alone") {
  const ddp::Problem problem = with_foothold();
  const VectorXd u = VectorXd::Zero(problem.layout.nu());
  const auto price = [&](const Eigen::Vector3d& off, int knot) {
    VectorXd x = VectorXd::Zero(problem.layout.nx());
    x.segment<3>(problem.layout.end(1)) = Eigen::Vector3d(0.1, -0.2, 0.3) + off;
    return cost(problem, term(problem, "kept", {knot}), x, u);
  };
  const double s = ddp::kKeptBend, d = 0.001 * s;
  CHECK(price({d, 0.0, 0.0}, 2) == doctest::Approx(0.5 * 9.0 * d * d).epsilon(1e-6));
  CHECK(price({0.0, 0.3, 0.4}, 2) == doctest::Approx(9.0 * (s * std::hypot(0.5, s) - s * s)));
  CHECK(price({0.3, 0.0, -0.4}, 2) == doctest::Approx(price({0.0, 0.5, 0.0}, 2)));
  CHECK(price({0.0, 0.0, 0.2}, 3) == 0.0);
}
