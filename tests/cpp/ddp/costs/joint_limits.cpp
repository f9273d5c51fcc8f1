#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;
constexpr double kInf = std::numeric_limits<double>::infinity();

/// The workshop's robot with legs of which only one kind of limit is low.
enum class Low { knee, hip_roll, hip_pitch, ankle_roll, ankle_pitch, speed, length, nothing };

mcplan::LimbLimits limb_of(const mcplan::EndEffector& foot, Low low) {
  mcplan::LimbLimits limb;
  limb.hip_B = Vector3d(0.02, 0.8 * foot.nominal_B.y(), -0.05);
  limb.hip_shift = -0.1;
  limb.upper = 0.36;
  limb.lower = 0.34;
  limb.ankle = Vector3d(-0.01, 0.005, 0.06);
  limb.margin = 0.01;
  const auto cap = [&](Low which) { return which == low ? 0.01 : kInf; };
  limb.knee_torque = cap(Low::knee);
  limb.knee_speed = cap(Low::speed);
  limb.hip_torque = {cap(Low::hip_roll), cap(Low::hip_pitch)};
  limb.ankle_torque = {cap(Low::ankle_roll), cap(Low::ankle_pitch)};
  if (low == Low::length) limb.upper = limb.lower = 0.31;
  return limb;
}

ddp::Problem jointed(Low low, ddp::Options options, bool soles = true) {
  const ddp::Problem with = workshop(options, true);
  mcplan::Robot robot = with.robot;
  for (auto& end : robot.end_effectors) {
    if (end.kind != "foot") continue;
    if (!soles) end.half_size.setZero();
    end.limb = limb_of(end, low);
    if (soles) continue;
    end.limb.ankle.setZero();
    if (low == Low::length) end.limb.upper = end.limb.lower = 0.34;
  }
  return ddp::Problem(with.scene, robot, options);
}

Writer rows_of(const ddp::Problem& problem, int surface) {
  return term(problem, "joint_limits", {2, 1, surface, 100.0, 3.0, 0.2});
}

}  // namespace

TEST_CASE("joint limits: gradients") {
  for (ddp::Model model : kModels)
    for (bool soles : {true, false})
      for (Low low :
           {Low::knee, Low::hip_roll, Low::hip_pitch, Low::ankle_roll, Low::ankle_pitch, Low::speed, Low::length}) {
        // Forces act at a point foot itself, which is its ankle.
        if (!soles && (low == Low::ankle_roll || low == Low::ankle_pitch)) continue;
        CAPTURE(static_cast<int>(low));
        const ddp::Problem problem = jointed(low, phases(6, model), soles);
        REQUIRE(problem.jointed.ends.size() == 2);
        const Writer at_place = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
          VectorXd stiff = u;
          stiff[problem.layout.stiffness(1)] += 1.0;
          rows_of(problem, 0)(x, stiff, rows);
        };
        check_rows(problem, at_place, 50, 0.06, 20);
      }
}

TEST_CASE(
    "joint limits: nothing is written for limits that are infinite, at the knots, in discovery, before one is "
    "exceeded or without the option") {
  ddp::Options options = phases(6);
  const ddp::Problem free = jointed(Low::nothing, options);
  const ddp::Problem low = jointed(Low::knee, options);
  options.joint_limits = false;
  const ddp::Problem without = jointed(Low::knee, options);
  CHECK(without.jointed.ends.empty());
  CHECK_FALSE(without.robot.end_effectors[1].limb.given());
  const auto price = [](const ddp::Problem& problem, double interior, bool asked = true) {
    const ddp::Trajectory t = problem.initial_guess({});
    About about{2, 1, 0, 100.0, interior};
    about.hold_joints = asked;
    return cost(problem, term(problem, "joint_limits", about), t.x[2], t.u[2]);
  };
  CHECK(price(free, 3.0) == 0.0);
  CHECK(price(low, 3.0) > 0.0);
  CHECK(price(low, 0.0) == 0.0);
  CHECK(price(low, 3.0, false) == 0.0);  // before a plan has exceeded a limit
  CHECK(price(without, 3.0) == 0.0);
}
