#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("a phase without any contact lasts as long as drawing up the legs takes") {
  const ddp::Problem problem = workshop();
  const double least = problem.options.flight_duration_min_s / std::sqrt(0.7 / 9.8);
  check_rows(problem, term(problem, "flight_duration"), 61, 2.0, 10);
  const auto price = [&](double h) {
    VectorXd u = VectorXd::Zero(problem.layout.nu());
    u[problem.layout.duration()] = h;
    return cost(problem, term(problem, "flight_duration"), VectorXd(), u) / (0.5 * 100.0 * 100.0);
  };
  CHECK(price(1.001 * least) == 0.0);
  CHECK(price(least - 0.1) == doctest::Approx(0.01));
}

TEST_CASE("a flight that is under way lasts as long as is left of it") {
  ddp::Problem problem = workshop();
  problem.first_duration = 0.1;
  VectorXd u = VectorXd::Zero(problem.layout.nu());
  u[problem.layout.duration()] = 0.1;
  CHECK(cost(problem, term(problem, "flight_duration", {0}), VectorXd(), u) == 0.0);
  CHECK(cost(problem, term(problem, "flight_duration", {1}), VectorXd(), u) > 0.0);
}
