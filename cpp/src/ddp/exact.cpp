#include <algorithm>
#include <cmath>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/footholds.hpp"
#include "ddp/moment_limits.hpp"
#include "ddp/search.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Fixed = std::vector<std::vector<char>>;

/// Bring a centre of pressure onto its sole, held there if it was outside; forces of free end-effectors act nowhere.
void snap_pressure(const Problem& problem, int l, int surface, double sole_yaw, VectorXd& u, std::vector<char>& fixed) {
  const Layout& at = problem.layout;
  const int count = at.pressure_count(l), lines = at.force_line_count(l);
  if (surface == kFree) {
    u.segment(at.pressure(l), count).setZero();
    u.segment(at.force_line(l), lines).setZero();
    std::fill_n(fixed.begin() + at.pressure(l), count, 1);
    std::fill_n(fixed.begin() + at.force_line(l), lines, 1);
    return;
  }
  if (count == 0) return;
  const Eigen::Matrix3d sole = problem.sole_frame(surface, sole_yaw);
  const Eigen::Vector2d offset = sole.leftCols<2>().transpose() * at.pressure_offset(u, l);
  const Eigen::Vector2d& half = problem.limits[l].pressure_half;
  const Eigen::Vector2d on_sole = offset.cwiseMax(-half).cwiseMin(half);
  if (count == 2 && on_sole == offset) return;
  u.segment(at.pressure(l), count) = at.offsets(l).pressure.transpose() * (sole.leftCols<2>() * on_sole);
  std::fill_n(fixed.begin() + at.pressure(l), count, 1);
}

/// What torsion an end-effector can have all through phase k, with a little to spare for what the steps still change.
double min_torsion(const Problem& problem, const Pendulum& pendulum, const Trajectory& t, int k, int l, int surface) {
  const Vector3d& n = problem.polygons[surface].normal_W();
  const Vector3d s = problem.layout.line_point(t.x[k], t.u[k], l);
  Instants instants;
  instants.of(problem, pendulum, t.x[k], t.u[k]);
  double normal = std::numeric_limits<double>::infinity();
  for (const Instant& instant : instants) normal = std::min(normal, n.dot(instant.com - s));
  const double arm = torsion_arm(problem, l, surface);
  return std::isinf(arm) ? arm : kTorsionSpare * arm * pendulum.mu(t.u[k], l) * std::max(normal, 0.0);
}

/// Bring forces and moments into their bounds and hold those that were outside; free end-effectors have none.
void snap_forces(const Problem& problem, const Pendulum& pendulum, const ContactSequence& sequence, Trajectory& t,
                 Fixed& fixed) {
  const Layout& at = problem.layout;
  const auto bound = [&](int k, int i, double low, double high) {
    double& value = t.u[k][i];
    if (value > low && value < high) return;
    value = std::clamp(value, low, high);
    fixed[k][i] = 1;
  };
  for (int k = 0; k < problem.steps; ++k) {
    for (int l = 0; l < at.end_effector_count(); ++l)
      bound(k, at.stiffness(l), 0.0, sequence[k][l] == kFree ? 0.0 : std::numeric_limits<double>::infinity());
    for (int l = 0; l < at.end_effector_count(); ++l)
      snap_pressure(problem, l, sequence[k][l], t.sole_yaw[k][l], t.u[k], fixed[k]);
    for (int i = 0; i < at.moment_count(); ++i) {
      const Layout::Moment& m = at.moments()[i];
      const int l = m.end_effector, surface = sequence[k][l];
      const bool possible = surface != kFree && about_normal(problem, m, surface);
      const double max_moment = possible ? std::min(m.max, min_torsion(problem, pendulum, t, k, l, surface)) : 0.0;
      bound(k, at.moment(i), -max_moment, max_moment);
    }
  }
}

}  // namespace

bool Search::make_exact(Incumbent& now, const Tuning& tuning, const StopRequest& give_up) {
  const Stopwatch watch(report_->timing_s, "make_exact");
  const Layout& at = problem_->layout;
  Fixed fixed(problem_->steps, std::vector<char>(at.nu(), 0));
  for (auto& inputs : fixed) std::fill_n(inputs.begin(), 3 * at.end_effector_count(), 1);
  Schedule schedule = full_schedule(tuning);
  schedule.proximal_weight = 0.0;
  schedule.fixed_inputs = &fixed;
  Trajectory trajectory = now.trajectory;
  problem_->set_sole_yaw(now.sequence, trajectory);
  snap_positions(*problem_, now.sequence, trajectory);
  // Newton on the defects.
  for (int i = 0; i < kExactSteps; ++i) {
    if (give_up && give_up()) return false;
    snap_forces(*problem_, model_.pendulum(), now.sequence, trajectory, fixed);
    model_.expand(trajectory, schedule);
    double defect = 0.0;
    for (int k = 0; k < problem_->steps; ++k) defect = std::max(defect, model_.defect(k).lpNorm<Eigen::Infinity>());
    if (!std::isfinite(defect)) return false;
    if (defect < kExactDefect) {
      now.trajectory = trajectory;
      schedule.fixed_inputs = nullptr;
      now.evaluation = evaluate_(trajectory, now.sequence, schedule);
      return true;
    }
    if (!values_.backward(now.sequence, problem_->steps)) return false;
    values_.state_forward(dx_, du_);
    for (int k = 0; k <= problem_->steps; ++k) trajectory.x[k] += dx_[k];
    for (int k = 0; k < problem_->steps; ++k) trajectory.u[k] += du_[k];
    snap_positions(*problem_, now.sequence, trajectory);
    if (problem_->pinned_end) trajectory.x.back() = problem_->reference.x.back();
  }
  return false;
}

}  // namespace mcplan::ddp
