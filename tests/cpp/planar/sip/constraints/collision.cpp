#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "planar/robots.hpp"
#include "planar/sip/constraints.hpp"
#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::Capsule;
using mcplan::PlanarTask;

namespace {

constexpr int kAlong = 60;

/// Points along a capsule's middle line in the world.
std::vector<Eigen::Vector2d> spine(const mcplan::PlanarMotionOfFrame& frame, const Capsule& capsule) {
  std::vector<Eigen::Vector2d> out;
  for (int i = 0; i <= kAlong; ++i)
    out.push_back(planar_point(frame, capsule.from_B + (capsule.to_B - capsule.from_B) * i / kAlong).position_W);
  return out;
}

/// Gap between two capsules, by brute force; below zero where they overlap.
double gap(const mcplan::PlanarMotionOfFrame& a, const Capsule& first, const mcplan::PlanarMotionOfFrame& b,
           const Capsule& second) {
  double least = INFINITY;
  for (const auto& p : spine(a, first))
    for (const auto& q : spine(b, second)) least = std::min(least, (p - q).norm());
  return least - first.radius - second.radius;
}

/// Least room of all rows at s, in units of their limits: at least zero where they hold.
double room(const IntervalAt& interval, const std::vector<Limited>& rows, double s) {
  double least = INFINITY;
  for (const Limited& row : rows) least = std::min(least, row.scale * (interval.at(row.node, s) - row.lower));
  return least;
}

}  // namespace

TEST_CASE("where the rows hold, the capsules are apart") {
  const PlanarTask task = planar_tasks::cartwheel();
  Options options;
  options.order = 12;
  int holding = 0, touching = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Eigen::VectorXd x = random_parameters(task, options, seed);
    x.head(Layout(task, options).first_duration) *= 6.0;  // limbs get into each other's way
    IntervalAt interval(task, options, 5, x);
    std::vector<Limited> rows;
    keep_apart(interval.motion, nullptr, rows);
    interval.evaluate();
    const double s = 0.0;  // there the polynomials are exact
    const auto frames = interval.frames(s);
    double least = INFINITY;
    for (const auto& [a, b] : task.robot.collision_pairs)
      least = std::min(least,
                       gap(frames[a], task.robot.bodies[a].capsules[0], frames[b], task.robot.bodies[b].capsules[0]));
    CAPTURE(seed);
    if (room(interval, rows, s) >= 0.0) {
      CHECK(least >= -1e-4);  // the gap is that of points a hundredth of a metre apart
      ++holding;
    }
    if (least < 0.0) {
      CHECK(room(interval, rows, s) < 1e-3);
      ++touching;
    }
    // Not too cautious: capsules further apart than the discs' excess, 0.42 of both radii, are let through.
    if (least > 0.42 * 0.08) CHECK(room(interval, rows, s) >= 0.0);
  }
  CHECK(holding > 5);
  CHECK(touching > 5);
}

TEST_CASE("rows are squared distances of the exact plan's discs") {
  // Two capsules of no length: one disc each, and the distance is theirs.
  PlanarTask task = planar::standing();
  task.robot.bodies[planar::left_leg].capsules = {{{0.0, -0.5}, {0.0, -0.5}, 0.05}};
  task.robot.bodies[planar::arm].capsules = {{{0.0, -0.2}, {0.0, -0.2}, 0.03}};
  Options options;
  options.order = 12;
  Eigen::VectorXd x = random_parameters(task, options, 3);
  x.head(Layout(task, options).first_duration) *= 0.3;
  IntervalAt interval(task, options, 6, x);
  std::vector<Limited> rows;
  keep_apart(interval.motion, nullptr, rows);
  interval.evaluate();
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].lower == doctest::Approx(0.08 * 0.08));
  CHECK(rows[0].upper == INFINITY);
  CHECK(rows[0].name == "collision of left_leg and arm");
  for (double s : kPlaces) {
    const auto frames = interval.frames(s);
    const Eigen::Vector2d p_W = planar_point(frames[planar::left_leg], {0.0, -0.5}).position_W;
    const Eigen::Vector2d q_W = planar_point(frames[planar::arm], {0.0, -0.2}).position_W;
    CHECK(interval.at(rows[0].node, s) == doctest::Approx((p_W - q_W).squaredNorm()).epsilon(1e-8));
  }
}

TEST_CASE("discs that come close are found, and rows are made for them alone") {
  const PlanarTask task = planar_tasks::cartwheel();
  const Options options;
  const Layout layout(task, options);
  int with_some = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Eigen::VectorXd x = random_parameters(task, options, seed);
    x.head(layout.first_duration) *= 6.0;
    CloseDiscs close;
    add_close_discs(plan_of(task, options, layout, x), close);
    constexpr int kInterval = 5;
    IntervalAt interval(task, options, kInterval, x);
    std::vector<Limited> all, some;
    keep_apart(interval.motion, nullptr, all);
    keep_apart(interval.motion, &close, some);
    int expected = 0;
    for (const auto& pair : close) expected += pair[0] == kInterval;
    CAPTURE(seed);
    CHECK(static_cast<int>(some.size()) == expected);
    CHECK(some.size() < all.size());
    interval.evaluate();
    // At the interval's middle, one of the instants looked at, whatever was left out is apart.
    if (room(interval, all, 0.0) < 0.0) {
      REQUIRE(!some.empty());
      CHECK(room(interval, some, 0.0) == room(interval, all, 0.0));
      ++with_some;
    }
  }
  CHECK(with_some > 0);
}
