#include <doctest/doctest.h>

#include <cmath>

#include "planar/sip/constraints.hpp"
#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

std::vector<Limited> rows_of(IntervalAt& interval) {
  std::vector<Limited> out;
  keep_clear(interval.motion, out);
  interval.evaluate();
  return out;
}

/// Exact height of an end-effector's point over a surface.
double height(const IntervalAt& interval, int end_effector, int point, int surface, double s) {
  const auto& end = interval.task.robot.end_effectors[end_effector];
  const auto& on = interval.task.surfaces[surface];
  const auto sole = planar_point(interval.frames(s)[end.body], end.position_B, end.angle_B);
  return on.normal_W().dot(planar_point(sole, {end.points[point], 0.0}).position_W - on.origin_W);
}

/// The climber with limb B over the slope and over the wall, from the phase's interval 1 to the end of its interval 2.
PlanarTask climbing() {
  PlanarTask task = planar_tasks::climbing();
  task.robot.end_effectors[1].angle_B = 0.2;
  task.phases[1].clearances = {{1, 0, 1, 3, 0.05}, {1, 1, 0, -1, -INFINITY}};
  task.no_clearance = {{0, 0}, {0, 1}, {2, 0}, {2, 1}};  // B alone
  return task;
}

}  // namespace

TEST_CASE("heights of swinging points are those of the exact plan") {
  const PlanarTask task = climbing();
  Options options;
  options.order = 12;
  options.clearance_m = -2e-3;
  Eigen::VectorXd x = random_parameters(task, options, 7);
  x.head(Layout(task, options).first_duration) *= 0.3;
  const int first = task.first_interval(1);
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    IntervalAt interval(task, options, first + i, x);
    std::vector<Limited> always, middle;
    for (const Limited& row : rows_of(interval)) {
      CHECK(row.name == "clearance of B");
      CHECK(row.upper == INFINITY);
      (row.when == Limited::When::always ? always : middle).push_back(row);
    }
    const bool over_slope = i == 1 || i == 2;    // named, so that these come first
    REQUIRE(always.size() == 4);                 // two points each
    REQUIRE(middle.size() == (i == 2 ? 2 : 0));  // at the begin of interval 4 / 2
    for (std::size_t r = 0; r < always.size(); ++r) {
      const int surface = over_slope == (r < 2) ? 0 : 1;
      CHECK(always[r].lower == -2e-3);
      for (double s : kPlaces)
        CHECK(std::abs(interval.at(always[r].node, s) - height(interval, 1, r % 2, surface, s)) < 1e-9);
    }
    for (std::size_t r = 0; r < middle.size(); ++r) {
      CHECK(middle[r].lower == 0.05);
      CHECK(middle[r].at == -1.0);
      CHECK(std::abs(interval.at(middle[r].node, -1.0) - height(interval, 1, r, 0, -1.0)) < 1e-9);
    }
  }
}

TEST_CASE("end-effectors that stand have no rows, swinging ones of which the task says nothing have them") {
  const PlanarTask task = climbing();
  IntervalAt interval(task, {}, 0, random_parameters(task, {}, 7));
  CHECK(rows_of(interval).empty());
  const PlanarTask silent = planar_tasks::climbing();
  IntervalAt swing(silent, {}, silent.first_interval(1), random_parameters(silent, {}, 7));
  CHECK(rows_of(swing).size() == 4);  // two points of B, slope and wall
}
