#include <cmath>

#include "check_rows.hpp"
#include "ddp/constants.hpp"
#include "ddp/sole_gap.hpp"

namespace {

using namespace support;

constexpr double kWeight = 7.0;

Writer soles_of(const ddp::Problem& problem, double yaw, double other_yaw, int k = 2) {
  About about{k, 1, 0, 3.0, kWeight, yaw};
  about.sole_yaws = {other_yaw, yaw, 0.0, 0.0};
  return term(problem, "soles", about);
}

/// The second foot at this place beside the first, which stands at the origin.
VectorXd beside(const ddp::Problem& problem, double x, double y) {
  VectorXd out = VectorXd::Zero(problem.layout.nx());
  out.segment<2>(problem.layout.end(1)) << x, y;
  return out;
}

double price(const ddp::Problem& problem, const Writer& write, const VectorXd& x) {
  return cost(problem, write, x, VectorXd::Zero(problem.layout.nu())) / (0.5 * kWeight * kWeight);
}

}  // namespace

TEST_CASE("soles beside each other: gradients, at headings of their own") {
  const ddp::Problem problem = workshop();
  Random random(67);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const VectorXd yaws = noise(random, 2, 0.6);
    VectorXd z = random_z(problem, random, 0.05);
    z.segment<2>(problem.layout.end(1)) = z.segment<2>(problem.layout.end(0)) + noise(random, 2, 0.1);
    checked += check_rows(problem, soles_of(problem, yaws[0], yaws[1]), z);
  }
  CHECK(checked >= 30);
}

TEST_CASE("soles that point ahead keep their room beside each other, and one before the other") {
  const ddp::Problem problem = workshop();
  const ddp::EndLimits& foot = problem.limits[1];
  const double room = ddp::sole_room(foot, problem.limits[0]);
  CHECK(room > 0.0);
  CHECK(room <= ddp::kSoleRoom);
  const Writer soles = soles_of(problem, 0.0, 0.0);
  const double width = 2.0 * foot.half_size.y(), length = 2.0 * foot.half_size.x();
  CHECK(price(problem, soles, beside(problem, 0.0, width + room + 1e-6)) == 0.0);
  CHECK(price(problem, soles, beside(problem, 0.0, width)) == doctest::Approx(room * room));
  CHECK(price(problem, soles, beside(problem, length + room + 1e-6, 0.0)) == 0.0);
  CHECK(price(problem, soles, beside(problem, -length, 0.0)) == doctest::Approx(room * room));
  // The robot starts as it is.
  CHECK(price(problem, soles_of(problem, 0.0, 0.0, 0), beside(problem, 0.0, width)) == 0.0);
}

TEST_CASE("a sole across another one reaches as far as it is long") {
  const ddp::Problem problem = workshop();
  const ddp::EndLimits& foot = problem.limits[1];
  const double room = ddp::sole_room(foot, problem.limits[0]);
  const double reach = foot.half_size.x() + foot.half_size.y();
  const Writer soles = soles_of(problem, M_PI / 2, 0.0);
  CHECK(price(problem, soles, beside(problem, 0.0, reach + room + 1e-6)) == 0.0);
  CHECK(price(problem, soles, beside(problem, 0.0, reach - 0.01)) == doctest::Approx((room + 0.01) * (room + 0.01)));
}

TEST_CASE("soles are apart along one of their axes exactly when no point of the one is in the other") {
  const ddp::Problem problem = workshop();
  ddp::EndLimits one = problem.limits[0], other = problem.limits[1];
  one.half_size << 0.12, 0.05;
  other.half_size << 0.09, 0.06;
  const auto inside = [](const Eigen::Vector2d& point, const ddp::EndLimits& sole, const Eigen::Vector2d& at,
                         double yaw) {
    const Eigen::Vector2d local = Eigen::Rotation2Dd(-yaw) * (point - at);
    return (local.cwiseAbs() - sole.half_size).maxCoeff() < 0.0;
  };
  const auto overlap = [&](const ddp::EndLimits& a, const Eigen::Vector2d& at, double yaw, const ddp::EndLimits& b,
                           const Eigen::Vector2d& b_at, double b_yaw) {
    for (int i = 0; i <= 60; ++i)
      for (int j = 0; j <= 60; ++j) {
        const Eigen::Vector2d share(i / 30.0 - 1.0, j / 30.0 - 1.0);
        const Eigen::Vector2d point = at + Eigen::Rotation2Dd(yaw) * a.half_size.cwiseProduct(share);
        if (inside(point, b, b_at, b_yaw)) return true;
      }
    return false;
  };
  Random random(3);
  int apart = 0, over = 0;
  for (int i = 0; i < 300; ++i) {
    const VectorXd yaws = noise(random, 2, 1.0), at = noise(random, 2, 0.25);
    const Eigen::Vector2d place = at.head<2>();
    const ddp::SoleGap gap = ddp::sole_gap(one, yaws[0], other, yaws[1], place);
    const double clear = gap.axis.dot(place) - gap.reach;
    if (std::abs(clear) < 0.006) continue;  // finer than the points
    const bool overlaps = overlap(one, place, yaws[0], other, Eigen::Vector2d::Zero(), yaws[1]);
    CHECK(overlaps == (clear < 0.0));
    (overlaps ? over : apart) += 1;
  }
  CHECK(apart > 20);
  CHECK(over > 20);
}
