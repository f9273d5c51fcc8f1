#include "check_rows.hpp"

namespace {

using namespace support;

Writer yaw_range_of(const ddp::Problem& problem, double sole_yaw) {
  return term(problem, "yaw_range", {2, 1, 0, 3.0, 7.0, sole_yaw});
}

}  // namespace

TEST_CASE("heading of the sole: gradients; the paper's model knows no headings of soles") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    for (double yaw : {-0.4, 1.2}) {
      const Writer yaw_range = yaw_range_of(problem, yaw);
      if (model == ddp::Model::wrench)
        check_rows(problem, yaw_range, 60, 0.1, 40);
      else
        CHECK(values(problem, yaw_range, VectorXd::Zero(problem.layout.nz())).size() == 0);
    }
  }
}

TEST_CASE("the sole may be turned against the base by its range, at every instant") {
  ddp::Options options = phases(6);
  options.interior_points = 1;
  const ddp::Problem problem = workshop(options);  // a range of [-0.3, 0.5] rad
  const ddp::Layout& at = problem.layout;
  VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
  u[at.duration()] = 0.4;
  x[at.angle(2)] = 0.2;
  const auto price = [&](double yaw) { return cost(problem, yaw_range_of(problem, yaw), x, u) / (0.5 * 49.0); };
  CHECK(price(-0.09) == 0.0);
  CHECK(price(0.69) == 0.0);
  CHECK(price(-0.2) == doctest::Approx(3 * 0.01));  // three instants
  CHECK(price(0.8) == doctest::Approx(3 * 0.01));
  // Turning under the standing sole, by 0.4 rad: 0, 0.2 and 0.4 rad beyond.
  x[at.momentum(2)] = problem.inertia[2];
  CHECK(price(-0.1) == doctest::Approx(0.04 + 0.16).epsilon(1e-6));
}
