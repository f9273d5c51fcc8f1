#include "plan/swing_path.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "mcplan/base/rotation.hpp"
#include "plan/fixtures.hpp"

namespace {

using Eigen::Vector3d;
using namespace fixtures;
using mcplan::Plan;
using mcplan::PlanState;

}  // namespace

TEST_CASE("a swing stays below a face that cuts the reach box, and its velocity goes on there") {
  Plan plan = walk();
  plan.swings[0].height = 0.3;
  mcplan::EndEffector& foot = plan.robot.end_effectors[left_foot];
  foot.reach_cut.A = Eigen::RowVector3d(-0.5, 0.1, 1.0).normalized();
  foot.reach_cut.b = foot.reach_cut.A * foot.nominal_B + Eigen::VectorXd::Constant(1, 0.09);
  const Vector3d normal = foot.reach_cut.A.row(0);
  double nearest = 1.0, hardest = 0.0, error = 0.0;
  const double h = 1e-4;
  PlanState last = plan.at_phase(3, 0.0);
  for (int i = 1; i < 4000; ++i) {
    const PlanState state = plan.at_phase(3, i * h);
    const auto &before = last.end_effectors[left_foot], &now = state.end_effectors[left_foot];
    const Vector3d place = mcplan::rotation_from_rpy(state.base_rpy).transpose() * (now.position_W - state.com_W);
    nearest = std::min(nearest, foot.reach_cut.b[0] - normal.dot(place));
    hardest = std::max(hardest, (now.velocity_W - before.velocity_W).norm() / h);
    // The trapezoidal rule errs by h^2 / 12 of the third derivative.
    error =
        std::max(error, ((now.position_W - before.position_W) / h - 0.5 * (now.velocity_W + before.velocity_W)).norm());
    last = state;
  }
  CHECK(std::abs(nearest) < 1e-9);
  CHECK(hardest < 500.0);
  CHECK(error < 1e-4);
}

TEST_CASE("faces of a robot that nobody has validated are used as far as they are there") {
  Plan plan = walk();
  mcplan::EndEffector& foot = plan.robot.end_effectors[left_foot];
  foot.reach_cut.A = Eigen::Matrix<double, 9, 3>::Zero();
  foot.reach_cut.b = Eigen::VectorXd::Constant(2, 1.0);
  CHECK(mcplan::active_swing(plan, plan.swings[0], 3).cut_count == 2);
  foot.reach_cut.b = Eigen::VectorXd::Constant(9, 1.0);
  CHECK(mcplan::active_swing(plan, plan.swings[0], 3).cut_count == mcplan::kReachCuts);
}
