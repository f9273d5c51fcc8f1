#include "check_rows.hpp"
#include "mcplan/base/error.hpp"

namespace {

using namespace support;

double price(const ddp::Problem& problem, int k, double h) {
  VectorXd u = VectorXd::Zero(problem.layout.nu());
  u[problem.layout.duration()] = h;
  return cost(problem, term(problem, "duration", {k}), VectorXd(), u);
}

}  // namespace

TEST_CASE("duration cost: gradients") {
  const ddp::Problem problem = workshop();
  check_rows(problem, term(problem, "duration", {2}), 42, 2.0, 20);
}

TEST_CASE("durations tend to the middle of their box and are held inside it") {
  const ddp::Problem problem = workshop();
  const ddp::Weights& w = problem.options.weights;
  const double low = problem.duration_min, high = problem.duration_max, middle = 0.5 * (low + high);
  CHECK(low == doctest::Approx(problem.robot.phase_duration[0] / std::sqrt(0.7 / 9.8)));
  CHECK(high == doctest::Approx(problem.robot.phase_duration[1] / std::sqrt(0.7 / 9.8)));
  const auto soft = [&](double h) { return 0.5 * w.duration * w.duration * (h - middle) * (h - middle); };
  const double hard = 0.5 * w.limit * w.limit * 0.01 * 0.01;
  CHECK(price(problem, 2, middle) == 0.0);
  CHECK(price(problem, 2, low) == doctest::Approx(soft(low)));
  CHECK(price(problem, 2, high) == doctest::Approx(soft(high)));
  CHECK(price(problem, 2, low - 0.01) == doctest::Approx(soft(low - 0.01) + hard));
  CHECK(price(problem, 2, high + 0.01) == doctest::Approx(soft(high + 0.01) + hard));
}

TEST_CASE("durations asked for come before the robot's") {
  ddp::Options options = phases(6);
  options.duration_min_s = 0.21, options.duration_max_s = 0.83;
  const ddp::Problem problem = workshop(options);
  CHECK(problem.duration_min == doctest::Approx(0.21 / std::sqrt(0.7 / 9.8)));
  CHECK(problem.duration_max == doctest::Approx(0.83 / std::sqrt(0.7 / 9.8)));
  options.duration_max_s = 0.0, options.duration_min_s = 0.51;  // above the robot's longest
  CHECK_THROWS_AS(workshop(options), mcplan::InvalidOptions);
}

TEST_CASE("a phase under way when replanning keeps what is left of it, short as it may be") {
  ddp::Problem problem = workshop();
  problem.first_duration = 0.1 * problem.duration_min;
  CHECK(price(problem, 0, problem.first_duration) == 0.0);
  CHECK(price(problem, 1, problem.first_duration) > 1.0);
}
