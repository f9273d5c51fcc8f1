#include "ddp/polish/start_slack.hpp"

#include <algorithm>
#include <limits>

#include "mcplan/base/rotation.hpp"

namespace mcplan::ddp::polish {

using Eigen::Vector3d;

StartSlack::StartSlack(const FixedSequence& fixed, const Motion& motion, const LegLengths& legs) {
  const Problem& problem = fixed.problem();
  horizon_ = problem.start_slack;
  if (!(horizon_ > 0.0)) return;
  const Layout& at = problem.layout;
  const Eigen::VectorXd& x = motion.trajectory.x.front();
  times_.assign(fixed.steps() + 1, 0.0);
  const Vector3d com = x.segment<3>(at.com()), velocity = x.segment<3>(at.velocity());
  Vector3d momentum = Vector3d::Zero();
  for (int a = 0; a < at.axis_count(); ++a) momentum[at.axes()[a]] = x[at.momentum(a)];
  const Eigen::Matrix3d rotation = rotation_from_rpy(problem.rpy(x));
  const Vector3d spin = rotation * (rotation.transpose() * momentum).cwiseQuotient(problem.inertia);
  for (int l = 0; l < at.end_effector_count(); ++l) {
    const EndLimits& limit = problem.limits[l];
    const Vector3d offset = x.segment<3>(at.end(l)) - com;
    const Vector3d place = rotation.transpose() * offset;
    // What is free is moved by the robot, not by its inertia.
    const bool stands = fixed.contacts().front()[l] != kFree;
    const Vector3d rate =
        stands ? Vector3d(rotation.transpose() * (-velocity - spin.cross(offset))) : Vector3d(0.0, 0.0, 0.0);
    std::vector<Row>& rows = reach_.emplace_back();
    for (int i = 0; i < 3; ++i) {
      rows.push_back({place[i] - limit.reach_max[i], std::max(rate[i], 0.0)});
      rows.push_back({limit.reach_min[i] - place[i], std::max(-rate[i], 0.0)});
    }
    for (int i = 0; i < limit.cuts; ++i)
      rows.push_back({limit.cut_A.row(i).dot(place) - limit.cut_b[i], std::max(limit.cut_A.row(i).dot(rate), 0.0)});
    Row& leg = leg_.emplace_back(Row{-std::numeric_limits<double>::infinity(), 0.0});  // no limit, no excess
    if (stands && limit.limb.given()) {
      const LegLengths::AtStart now = legs.at_start(motion, l, spin);
      leg = {now.value, std::max(now.rate, 0.0)};
    }
    // In the air a sole may head anywhere: only contacts have a range.
    const double yaw = stands ? motion.trajectory.sole_yaw.front()[l] - problem.rpy(x).z() : 0.0;
    yaw_.push_back(
        {Row{yaw - limit.yaw_max, std::max(-spin.z(), 0.0)}, Row{limit.yaw_min - yaw, std::max(spin.z(), 0.0)}});
  }
  // Any row that may be beyond its bound before the slack is used up.
  const auto beyond = [&](const Row& row) { return row.value + row.rate * horizon_ > -problem.reach_room; };
  for (const auto& rows : reach_) any_ = any_ || std::any_of(rows.begin(), rows.end(), beyond);
  any_ = any_ || std::any_of(leg_.begin(), leg_.end(), beyond);
  for (const auto& rows : yaw_) any_ = any_ || std::any_of(rows.begin(), rows.end(), beyond);
}

void StartSlack::set_times(const FixedSequence& fixed, const Trajectory& trajectory) {
  const int duration = fixed.problem().layout.duration();
  for (int k = 0; k < fixed.steps(); ++k) times_[k + 1] = times_[k] + trajectory.u[k][duration];
}

double StartSlack::amount(const Row& row, double t) const {
  if (!(t < horizon_)) return 0.0;
  return std::max(row.value + row.rate * t, 0.0) * (1.0 - t * t / (horizon_ * horizon_));
}

}  // namespace mcplan::ddp::polish
