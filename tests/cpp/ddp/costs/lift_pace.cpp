#include "check_rows.hpp"

namespace {

using namespace support;

ddp::Problem tracked(bool is) {
  const ddp::Problem with = workshop();
  mcplan::Robot robot = with.robot;
  robot.tracked = is;
  return ddp::Problem(with.scene, robot, phases(6));
}

/// The price of a swing of one end-effector that rises by so much [m] in a phase of h, over the interior weight.
double price(const ddp::Problem& problem, const std::string& end, double rise_m, double h) {
  int l = 0;
  while (problem.robot.end_effectors[problem.active[l]].name != end) ++l;
  Random random(1);
  const VectorXd z = random_z(problem, random, 0.0);
  VectorXd u = z.tail(problem.layout.nu());
  u[problem.layout.stride(l) + 2] = rise_m / problem.units.length;
  u[problem.layout.duration()] = h;
  const Writer pace = term(problem, "lift_pace", {2, l, ddp::kFree, 100.0, 3.0});
  return std::sqrt(2.0 * cost(problem, pace, z.head(problem.layout.nx()), u)) / 3.0;
}

}  // namespace

TEST_CASE("a swing to a higher foothold takes its time, up to the longest phase") {
  const ddp::Problem problem = tracked(true);
  const double h = 0.5 * (problem.duration_min + problem.duration_max);
  const double rise_m = 0.17 * h * problem.units.length;  // just so much in that time
  CHECK(price(problem, "left_foot", rise_m, h) == doctest::Approx(0.0).epsilon(1e-12));
  CHECK(price(problem, "left_foot", rise_m, 0.8 * h) == doctest::Approx(0.2 * h));
  CHECK(price(problem, "left_foot", 100.0, 0.8 * h) == doctest::Approx(problem.duration_max - 0.8 * h));
  CHECK(price(problem, "left_foot", -rise_m, 0.1 * h) == 0.0);  // down it may be put at once
  CHECK(price(problem, "left_hand", rise_m, 0.1 * h) == 0.0);
  CHECK(price(tracked(false), "left_foot", rise_m, 0.1 * h) == 0.0);
}

TEST_CASE("a swing to a higher foothold: gradients") {
  const ddp::Problem problem = tracked(true);
  const Writer pace = term(problem, "lift_pace", {2, 0, ddp::kFree, 100.0, 3.0});
  const Writer high = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
    VectorXd up = u;
    up[problem.layout.stride(0) + 2] += 0.35;
    pace(x, up, rows);
  };
  check_rows(problem, high, 3, 0.1, 20);
}
