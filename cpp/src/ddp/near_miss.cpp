#include "ddp/near_miss.hpp"

#include <algorithm>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Ratio of a phase's duration from which on an instant lies between its knots, and of what is missed there by which
/// the instants that are looked at are kept further inside. Chosen.
constexpr double kBetweenKnots = 0.02, kRoomRatio = 1.5;
/// Depth in a solid [m] from which a sole is taken to have caught the solid's side, for a robot of a person's size.
/// Chosen.
constexpr double kBeside_m = 0.02;

/// A box that is smaller on all sides; one that is thinner than that keeps its middle.
void shrink(EndLimits& limit, double by) {
  const Vector3d middle = 0.5 * (limit.reach_min + limit.reach_max);
  limit.reach_min = (limit.reach_min.array() + by).matrix().cwiseMin(middle);
  limit.reach_max = (limit.reach_max.array() - by).matrix().cwiseMax(middle);
  for (int i = 0; i < limit.cuts; ++i)
    limit.cut_b[i] = std::max(limit.cut_b[i] - by, std::min(limit.cut_b[i], limit.cut_A.row(i).dot(limit.nominal)));
  if (limit.limb.given()) limit.shorten_leg(by);
}

/// Joints of legs are held, and planned as if they were weaker by a ratio, or slower, than they are.
void hold_joints(Problem& problem, Tuning& tuning, double torques_by, double speeds_by) {
  tuning.hold_joints = true;
  for (EndLimits& limit : problem.limits) {
    LimbLimits& limb = limit.limb;
    limb.knee_torque *= 1.0 - std::min(torques_by, kJointSpareMax);
    limb.hip_torque *= 1.0 - std::min(torques_by, kJointSpareMax);
    limb.ankle_torque *= 1.0 - std::min(torques_by, kJointSpareMax);
    limb.knee_speed *= 1.0 - std::min(speeds_by, kJointSpareMax);
  }
}

/// Swings keep out of solids by so much more. Depths are measured from above: what is deep has come a little past a
/// solid's side, which footholds further inside of their own surface mend, and no higher swing.
void keep_out_further(Problem& problem, Tuning& tuning, double by) {
  const double unit = problem.similarity.length / problem.units.length;
  tuning.clear_swings = true;
  if (by < kBeside_m * unit)
    problem.swing_room += by;
  else
    tuning.extra_margin += kExtraMargin_m * unit;
}

/// The state at the goal weighs more. Making contacts exact cuts moments about the normal, and a base that lacks them
/// may go on turning there: fewer of these are asked for.
void aim_firmer(Problem& problem) {
  Weights& weights = problem.options.weights;
  problem.torsion_ratio *= kTorsionSpare;
  for (double* weight : {&weights.com_end, &weights.velocity_end, &weights.rotation_end, &weights.end_effector_end})
    *weight *= kEndFirmer;
}

void use_less_friction(Problem& problem, double by) {
  for (double& friction : problem.friction) friction = std::max(friction - by, kFrictionRatioMin * friction);
}

void press_further_inside(Problem& problem, double by) {
  problem.pressure_margin += by;
  for (EndLimits& limit : problem.limits)
    limit.pressure_half = (limit.pressure_half.array() - by).max(0.5 * limit.pressure_half.array()).matrix();
}

}  // namespace

double dearest_mended(double cost, int phases) {
  return phases > kFarPhases ? std::max(kMendDearer * cost, kFairPhase * phases) : kMendDearer * cost;
}

void tighten(Problem& problem, Tuning& tuning, const std::vector<Violation>& violations) {
  for (const Violation& v : violations) {
    const double length = v.value / problem.units.length;
    if (v.name == "reach") {
      for (EndLimits& limit : problem.limits) shrink(limit, length);
    } else if (v.name == "clearance") {
      keep_out_further(problem, tuning, length);
    } else if (v.name == "goal") {
      aim_firmer(problem);
    } else if (v.name == "friction") {
      use_less_friction(problem, v.value);
    } else if (v.name == "center_of_pressure") {
      press_further_inside(problem, length);
    } else if (v.name == "joint_torque") {
      hold_joints(problem, tuning, v.value, 0.0);
    } else if (v.name == "joint_speed") {
      hold_joints(problem, tuning, 0.0, v.value);
    }
  }
}

void tighten_between_knots(Problem& problem, Tuning& tuning, std::vector<Violation> violations, const Plan& plan) {
  const std::vector<double> times = plan.knot_times();
  const auto between = [&](const Violation& v) {
    if (v.name != "reach" || v.phase < 0 || v.phase >= static_cast<int>(plan.phases.size())) return false;
    const int e = plan.robot.end_effector_index(v.end_effector);
    const double nearest_s = std::min(v.time_s - times[v.phase], times[v.phase + 1] - v.time_s);
    return e >= 0 && plan.phases[v.phase].contacts[e].surface != kFree &&
           nearest_s > kBetweenKnots * plan.phases[v.phase].duration;
  };
  for (const Violation& v : violations)
    if (between(v)) problem.reach_room += kRoomRatio * v.value / problem.units.length;
  violations.erase(std::remove_if(violations.begin(), violations.end(), between), violations.end());
  tighten(problem, tuning, violations);
}

}  // namespace mcplan::ddp
