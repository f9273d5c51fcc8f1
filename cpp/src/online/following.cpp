#include "mcplan/online/following.hpp"

#include <algorithm>
#include <utility>

#include "mcplan/plan/checker.hpp"
#include "plan/swing_lift.hpp"

namespace mcplan::online {
namespace {

constexpr double kKeptPeriods = 2.0;  // for which a plan that was cut short has to keep all limits
constexpr double kRise_m_s = 0.5;     // speed at which a foot is raised over its way at most
constexpr double kSwingRatio = 0.1;   // height of a swing over that of the CoM, where the robot says none
constexpr double kUsual_s = 0.45;     // duration of a swing, where the robot says none
constexpr double kHeightRatio = 0.5;  // of the usual height, which a foot keeps half way to its landing

/// Until when [s] a plan keeps all limits, looked at until then.
double kept_until(const Plan& plan, double until_s) {
  return check(plan, plan.scene, plan.robot, {}, {}, until_s).kept_until_s;
}

}  // namespace

bool follows(const Report& report, double period_s) {
  if (report.plan_from == PlanFrom::search || report.plan_from == PlanFrom::previous_plan) return false;
  if (report.status == Status::solved || report.status == Status::acceptable) return true;
  return (report.status == Status::time_limit || report.status == Status::infeasible) &&
         report.kept_until_s >= kKeptPeriods * period_s;
}

Plan with_feet_kept_up(Plan plan) {
  plan.validate();
  const Robot& robot = plan.robot;
  const double usual_m = robot.swing_height > 0.0 ? robot.swing_height : kSwingRatio * robot.com_height;
  const double usual_s = robot.phase_duration[1] > 0.0 ? 0.5 * robot.phase_duration.sum() : kUsual_s;
  const auto height_W = [&](double t, int end) {
    return plan.at(std::min(t, plan.duration())).end_effectors[end].position_W.z();
  };
  for (Swing& swing : plan.swings) {
    const int end = swing.end_effector;
    const bool in_air = swing.first_phase == 0 && plan.phases.front().contacts[end].surface < 0;
    if (!in_air || robot.end_effectors[end].kind != "foot") continue;
    double left_s = 0.0;
    for (int k = 0; k < swing.end_phase; ++k) left_s += plan.phases[k].duration;
    const double half_way = 1.0 - 0.5 * std::min(left_s / usual_s, 1.0);  // s there, of a usual swing
    const auto lacks_m = [&] {
      const double above_m = height_W(0.5 * left_s, end) - height_W(left_s, end);
      return kHeightRatio * SwingLift(half_way).value() * usual_m - above_m;
    };
    const Swing planned = swing;
    if (swing.elapsed_s > 0.0) {
      if (!(lacks_m() > 0.0)) continue;
      swing.height = swing.elapsed_s = 0.0;  // its lift has gone too far to raise it: lifted anew
    }
    swing.height = std::min(swing.height + std::max(lacks_m(), 0.0), kRise_m_s * left_s / SwingLift::kMaxRate);
    const double kept_s = kept_until(plan, left_s);
    if (kept_s >= left_s) continue;
    const Swing changed = std::exchange(swing, planned);
    if (kept_until(plan, left_s) <= kept_s) swing = changed;  // it was no better as it was planned
  }
  return plan;
}

}  // namespace mcplan::online
