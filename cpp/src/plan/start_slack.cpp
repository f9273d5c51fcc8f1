#include "start_slack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/base_rotation.hpp"
#include "check_laws.hpp"
#include "check_limbs.hpp"

namespace mcplan::checks {
namespace {

bool is_of_contact(StateLimit limit) {
  return limit == StateLimit::contact_distance || limit == StateLimit::contact_polygon;
}

/// Phases from the start in which an end-effector is on the surface on which it is at the start.
int held_phases(const Problem& problem, int l) {
  const int surface = problem.surface(0, l);
  int k = 0;
  while (surface >= 0 && k < problem.phase_count() && problem.surface(k, l) == surface) ++k;
  return k;
}

std::size_t index_of(const Place& place, std::size_t end_effectors) {
  return place.end_effector < 0 ? end_effectors : static_cast<std::size_t>(place.end_effector);
}

}  // namespace

StartSlack::StartSlack(const Problem& problem, const Findings& empty) : start_slack_s_(problem.plan.start_slack_s) {
  for (int l = 0; l < problem.end_effector_count(); ++l) held_phases_.push_back(held_phases(problem, l));
  for (std::vector<Excess>& of_limit : excess_) of_limit.resize(problem.end_effector_count() + 1);
  measure(problem, empty);
  measured_ = true;
}

namespace {

/// The state after it has moved on straight for a while.
Sample moved_on(const Problem& problem, const Sample& start, double by_s) {
  Sample out = start;
  out.since_start_s = out.time_s = by_s;
  out.replay.com_W += by_s * out.replay.com_velocity_W;
  const Eigen::Vector3d turn = by_s * RpyTrig(start.at.base_rpy).angular_velocity_W(start.at.base_rpy_rate);
  if (const double angle = turn.norm(); angle > 0.0)
    out.r_WB = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * start.r_WB;
  out.yaw = std::atan2(out.r_WB(1, 0), out.r_WB(0, 0));
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    if (problem.surface(0, l) >= 0) continue;
    Eigen::Vector3d& place = out.at.end_effectors[l].position_W;
    place = out.replay.com_W + out.r_WB * (start.r_WB.transpose() * (place - start.replay.com_W));
  }
  return out;
}

}  // namespace

/// The checks of limits of the state into findings that nobody asks for.
void StartSlack::measure(const Problem& problem, Findings findings) {
  findings.set_slack(this);
  const PhaseView view = phase_view(problem, 0);
  Sample start;
  start.view = &view;
  start.replay = with_law(problem, 0, [&](auto law) { return law.start(problem, 0); });
  set_orientation(start);
  set_state(problem.plan, view.frame, 0.0, start.at, start.r_at_WB);
  contact_forces(problem, start);
  start.still.assign(problem.end_effector_count(), 0);
  check_contact_place(problem, start, findings);
  check_com_speed(problem, start, findings);
  Surroundings().check_clearance(problem, start, findings);
  Limbs().look(problem, start, findings);
  for (auto& of_limit : excess_)
    for (Excess& excess : of_limit) excess.value.fill(excess.value.front());
  for (now_ = 0; now_ < kTimes; ++now_) {
    const double t = start_slack_s_ * now_ / (kTimes - 1);
    const Sample then = moved_on(problem, start, t);
    // The speed of a knee is what two instants tell.
    Joints joints;
    joints.check(problem, then, findings);
    joints.check(problem, moved_on(problem, start, t + problem.tolerances.sample_s), findings);
    check_reach(problem, then, findings);
    check_yaw_range(problem, then, findings);
  }
  // What moves back inside by itself need not: forces may be wanted elsewhere.
  for (auto& of_limit : excess_)
    for (Excess& excess : of_limit)
      for (int i = 1; i < kTimes; ++i) excess.value[i] = std::max(excess.value[i], excess.value[i - 1]);
}

double StartSlack::beyond(StateLimit limit, double value, const Place& place, double tolerance, const char* unit) {
  if (measured_) return value - left(limit, place);
  std::vector<Excess>& of_limit = excess_[static_cast<int>(limit)];
  Excess& excess = of_limit[index_of(place, of_limit.size() - 1)];
  if (std::isfinite(value) && value > excess.value[now_]) {
    excess.value[now_] = value;
    excess.tolerance = tolerance;
    excess.unit = unit;
  }
  return value;
}

double StartSlack::left(StateLimit limit, const Place& place) const {
  const std::vector<Excess>& of_limit = excess_[static_cast<int>(limit)];
  const std::array<double, kTimes>& value = of_limit[index_of(place, of_limit.size() - 1)].value;
  if (is_of_contact(limit)) return place.phase < held_phases_[place.end_effector] ? value.front() : 0.0;
  const double gone = place.time_s / start_slack_s_;
  if (!(gone < 1.0)) return 0.0;
  const double at = gone * (kTimes - 1);
  const int before = std::min(static_cast<int>(at), kTimes - 2);
  return (value[before] + (at - before) * (value[before + 1] - value[before])) * (1.0 - gone * gone);
}

std::vector<Violation> StartSlack::violations(const Robot& robot) const {
  std::vector<Violation> out;
  for (int i = 0; i < kStateLimits; ++i)
    for (std::size_t l = 0; l < excess_[i].size(); ++l) {
      const Excess& excess = excess_[i][l];
      // A negative tolerance asks for as much to spare, which is no excess: nothing is forgiven of it.
      const double value = excess.value.front();
      if (!(value > std::max(excess.tolerance, 0.0))) continue;
      out.push_back({name_of(constraint_of(static_cast<StateLimit>(i))), 0,
                     l < robot.end_effectors.size() ? robot.end_effectors[l].name : "", 0.0, value, excess.tolerance,
                     excess.unit});
    }
  std::stable_sort(out.begin(), out.end(), [](const Violation& a, const Violation& b) {
    return severity(a.value, a.tolerance) > severity(b.value, b.tolerance);
  });
  return out;
}

}  // namespace mcplan::checks
