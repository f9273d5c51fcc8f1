#include "leg_cases.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("legs in contact keep out of solids: gradients") {
  for (const bool soles : {true, false}) {
    const ddp::Problem problem = with_legs_by_a_post(0.06, soles);
    const int foot = left_foot_of(problem);
    const Writer legs = term(problem, "standing_leg", {2, foot, 0, 100.0, 3.0, 0.2});
    check_leg_rows(problem, legs, 5);
  }
}

TEST_CASE(
    "legs in contact keep out of solids: nothing is written for legs without a radius, at the last knot, in "
    "discovery, or far away") {
  Random random(7);
  const ddp::Problem problem = with_legs_by_a_post();
  const VectorXd near = beside_the_post(problem, random, 0.08);
  const auto price = [&](const ddp::Problem& of, const About& about, const VectorXd& z, bool phase = true) {
    const int nx = of.layout.nx();
    return cost(of, term(of, "standing_leg", about), z.head(nx), phase ? VectorXd(z.tail(of.layout.nu())) : VectorXd());
  };
  const int foot = left_foot_of(problem);
  const About about{2, foot, 0, 100.0, 3.0, 0.2};
  CHECK(price(problem, about, near) > 0.0);
  CHECK(price(problem, about, near, false) == 0.0);
  CHECK(price(problem, {2, foot, 0, 100.0, 0.0, 0.2}, near) == 0.0);
  VectorXd far = near;
  far[problem.layout.com() + 1] -= 1.0;
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) far[problem.layout.end(l) + 1] -= 1.0;
  CHECK(price(problem, about, far) == 0.0);
  CHECK(price(with_legs_by_a_post(0.0), about, near) == 0.0);
}
