#include <doctest/doctest.h>

#include <cmath>

#include "planar/sip/constraints.hpp"
#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarPose;
using mcplan::PlanarTask;

namespace {

PlanarPose pose(int body, double fraction) {
  PlanarPose out;
  out.body = body;
  out.fraction = fraction;
  out.min = {0.1, -INFINITY, -0.2};
  out.max = {0.3, INFINITY, INFINITY};
  return out;
}

}  // namespace

TEST_CASE("poses are those of the exact plan at their instant, whichever interval it lies in") {
  PlanarTask task = planar_tasks::climbing();  // whose origin of polynomials is not the world's
  Options options;
  options.order = 12;
  for (double fraction : {0.0, 0.1, 0.25, 0.3, 0.6, 0.75, 0.99, 1.0}) {
    CAPTURE(fraction);
    task.phases[1].poses = {pose(0, fraction), pose(6, fraction)};
    Eigen::VectorXd x = random_parameters(task, options, 9);
    x.head(Layout(task, options).first_duration) *= 0.3;
    int found = 0;
    for (int k = 0; k < task.interval_count(); ++k) {
      IntervalAt interval(task, options, k, x);
      std::vector<Limited> rows;
      pass_poses(interval.motion, rows);
      if (rows.empty()) continue;
      ++found;
      interval.evaluate();
      REQUIRE(rows.size() == 4);  // x and angle of each; y has no limits
      const auto frames =
          planar_kinematics(task.robot, interval.plan.at_phase(1, fraction * interval.plan.durations[1]).configuration);
      for (int i = 0; i < 4; ++i) {
        const auto& frame = frames[i < 2 ? 0 : 6];
        const bool angle = i % 2 == 1;
        const double origin = angle ? 0.0 : interval.motion.origin_W.x();
        CHECK(rows[i].name == "pose of " + task.robot.bodies[i < 2 ? 0 : 6].name);
        CHECK(rows[i].when == Limited::When::instant);
        CHECK(std::abs(interval.at(rows[i].node, rows[i].at) + origin - (angle ? frame.angle : frame.position_W.x())) <
              1e-8);
        CHECK(rows[i].lower + origin == doctest::Approx(angle ? -0.2 : 0.1));
        if (angle)
          CHECK(rows[i].upper == INFINITY);
        else
          CHECK(rows[i].upper + origin == doctest::Approx(0.3));
      }
    }
    CHECK(found == 1);
  }
}
