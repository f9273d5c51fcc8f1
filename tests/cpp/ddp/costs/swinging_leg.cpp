#include "leg_cases.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("legs that swing keep out of solids: gradients") {
  for (const bool soles : {true, false}) {
    const ddp::Problem problem = with_legs_by_a_post(0.06, soles);
    const Writer legs = term(problem, "swinging_leg", {2, left_foot_of(problem), ddp::kFree, 100.0, 3.0});
    check_leg_rows(problem, legs, 5);
  }
}

TEST_CASE("legs that swing keep out of solids by a quarter more than their radius") {
  Random random(9);
  const double radius = 0.06;
  const ddp::Problem thin = with_legs_by_a_post(radius), thick = with_legs_by_a_post(1.25 * radius);
  const int foot = left_foot_of(thin);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const VectorXd z = beside_the_post(thin, random, 0.08);
    const auto values_of = [&](const ddp::Problem& problem) {
      return values(problem, term(problem, "swinging_leg", {2, foot, ddp::kFree, 100.0, 3.0}), z);
    };
    const VectorXd few = values_of(thin), more = values_of(thick);
    CHECK(more.size() >= few.size());
    if (few.size() == 0 || more.size() != few.size()) continue;
    ++compared;
    // Each row is the distance less 1.25 radii.
    CHECK((few - more).minCoeff() == doctest::Approx(0.25 * 1.25 * radius / 0.7));
    CHECK((few - more).maxCoeff() == doctest::Approx(0.25 * 1.25 * radius / 0.7));
  }
  CHECK(compared >= 10);
}
