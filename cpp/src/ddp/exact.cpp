#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/ddp/search.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Held = std::vector<std::vector<char>>;

/// Put every end-effector in contact onto its surface and keep it there.
void snap_positions(const Problem& problem, const ContactSequence& sequence, Trajectory& t) {
  const Layout& at = problem.layout;
  const int n = problem.steps;
  const int fixed = at.nx() - at.angle();
  t.x[0].tail(fixed) = problem.start.tail(fixed);
  for (int l = 0; l < at.ends(); ++l) {
    for (int k = 0; k <= n; ++k) {
      if (sequence[k][l] == kFree) continue;
      // Phases first..k are one contact; it holds the knots first..last_knot.
      const int first = k, surface = sequence[k][l];
      while (k < n && sequence[k + 1][l] == surface) ++k;
      const int last_knot = std::min(k + 1, n);
      Vector3d foothold = t.x[first].segment<3>(at.end(l));
      if (first > 0) {
        foothold.setZero();
        for (int j = first; j <= last_knot; ++j) foothold += t.x[j].segment<3>(at.end(l));
        foothold = problem.polygons[surface].nearest(foothold / (last_knot - first + 1));
      }
      for (int j = first; j <= last_knot; ++j) t.x[j].segment<3>(at.end(l)) = foothold;
    }
    for (int k = 0; k < n; ++k)
      t.u[k].segment<3>(at.stride(l)) = t.x[k + 1].segment<3>(at.end(l)) - t.x[k].segment<3>(at.end(l));
  }
}

/// Bring forces and moments into their bounds and hold those that were outside; free end-effectors have none.
void snap_forces(const Problem& problem, const Pendulum& pendulum, const ContactSequence& sequence, Trajectory& t,
                 Held& held) {
  const Layout& at = problem.layout;
  const auto mu = [&](int k, int l) { return pendulum.mu(t.u[k], l); };
  const auto bound = [&](int k, int i, double low, double high) {
    double& value = t.u[k][i];
    if (value > low && value < high) return;
    value = std::clamp(value, low, high);
    held[k][i] = 1;
  };
  for (int k = 0; k < problem.steps; ++k) {
    for (int l = 0; l < at.ends(); ++l)
      bound(k, at.stiffness(l), 0.0, sequence[k][l] == kFree ? 0.0 : std::numeric_limits<double>::infinity());
    for (int i = 0; i < at.moment_count(); ++i) {
      const int l = at.moments()[i].end_effector;
      double most = 0.0;
      if (sequence[k][l] != kFree)
        most = std::min(problem.limits[l].moment_max[at.axes()[at.moments()[i].axis]],
                        moment_per_stiffness(problem, l, sequence[k][l]) * mu(k, l));
      bound(k, at.moment(i), -most, most);
    }
  }
}

}  // namespace

bool Search::make_exact(Incumbent& now) {
  const Stopwatch watch(report_->timing_s, "make_exact");
  const Layout& at = problem_->layout;
  Held held(problem_->steps, std::vector<char>(at.nu(), 0));
  for (auto& inputs : held) std::fill_n(inputs.begin(), 3 * at.ends(), 1);
  Schedule schedule;
  schedule.contact_weight = problem_->options.weights.contact_max;
  schedule.interior_weight = problem_->options.weights.limit;
  schedule.proximal_weight = 0.0;
  schedule.held_inputs = &held;
  Trajectory trajectory = now.trajectory;
  snap_positions(*problem_, now.sequence, trajectory);
  // Newton on the defects: quadratic from 1e-3 on, but every input that meets its bound costs a step.
  constexpr double kRounding = 1e-13;
  for (int i = 0; i < 30; ++i) {
    snap_forces(*problem_, model_.pendulum(), now.sequence, trajectory, held);
    model_.expand(trajectory, schedule);
    double defect = 0.0;
    for (int k = 0; k < problem_->steps; ++k) defect = std::max(defect, model_.defect(k).lpNorm<Eigen::Infinity>());
    if (!std::isfinite(defect)) return false;
    if (defect < kRounding) {
      now.trajectory = trajectory;
      schedule.held_inputs = nullptr;
      now.evaluation = evaluate_(trajectory, now.sequence, schedule);
      return true;
    }
    if (!values_.backward(now.sequence, problem_->steps)) return false;
    values_.state_forward(dx_, du_);
    for (int k = 0; k <= problem_->steps; ++k) trajectory.x[k] += dx_[k];
    for (int k = 0; k < problem_->steps; ++k) trajectory.u[k] += du_[k];
    snap_positions(*problem_, now.sequence, trajectory);
  }
  return false;
}

}  // namespace mcplan::ddp
