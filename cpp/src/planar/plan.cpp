#include "mcplan/planar/plan.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "evaluation.hpp"
#include "require.hpp"

namespace mcplan {
namespace {

using Eigen::Vector2d;

struct ExpectedPoint {
  Vector2d position_W, tangent_W, normal_W;
};

/// Contact by contact, point by point.
std::vector<ExpectedPoint> expected_points(const PlanarTask& task, int phase) {
  std::vector<ExpectedPoint> out;
  for (const PlanarContact& contact : task.phases[phase].contacts) {
    const Vector2d tangent_W(std::cos(contact.angle), std::sin(contact.angle));
    const Vector2d normal_W(-tangent_W.y(), tangent_W.x());
    for (double point : task.robot.end_effectors[contact.end_effector].points)
      out.push_back({contact.position_W + point * tangent_W, tangent_W, normal_W});
  }
  return out;
}

Vector2d mean_of(const std::vector<ExpectedPoint>& points) {
  Vector2d sum = Vector2d::Zero();
  for (const ExpectedPoint& point : points) sum += point.position_W;
  return sum / static_cast<double>(points.size());
}

}  // namespace

Vector2d moment_point_W(const PlanarTask& task, int phase) { return mean_of(expected_points(task, phase)); }

/// f = gamma G^T Omega^-1 d with Omega = G gamma G^T; gamma holds the inverse of what each component costs.
Eigen::MatrixXd least_norm_gain(const PlanarTask& task, int phase, const Eigen::VectorXd& weights) {
  constexpr double kTangential = 10.0;  // the paper's alpha
  const std::vector<ExpectedPoint> points = expected_points(task, phase);
  const Eigen::Index count = static_cast<Eigen::Index>(points.size());
  const std::string field = "weights[" + std::to_string(phase) + "]";
  if (weights.size() != count)
    throw InvalidPlan(field, "must be one for each point in contact (" + std::to_string(count) + ")",
                      std::to_string(weights.size()));

  const Vector2d about_W = mean_of(points);
  double spread = 0.0;
  Eigen::Matrix<double, 3, Eigen::Dynamic> g(3, 2 * count);
  Eigen::VectorXd gamma(2 * count);
  for (Eigen::Index v = 0; v < count; ++v) {
    const Vector2d arm_W = points[v].position_W - about_W;
    spread = std::max(spread, arm_W.norm());
    const auto column = [&arm_W](const Vector2d& along_W) {
      return Eigen::Vector3d(along_W.x(), along_W.y(), arm_W.x() * along_W.y() - arm_W.y() * along_W.x());
    };
    g.col(2 * v) = column(points[v].tangent_W);
    g.col(2 * v + 1) = column(points[v].normal_W);
    gamma[2 * v] = 1.0 / (kTangential * weights[v]);
    gamma[2 * v + 1] = 1.0 / weights[v];
  }
  constexpr double kMin = 1e-6;  // [m]
  if (!(spread > kMin))
    throw InvalidPlan("task.phases[" + std::to_string(phase) + "].contacts",
                      "must have two points apart from each other, to balance a moment", std::to_string(spread) + " m");
  const Eigen::MatrixXd weighted = gamma.asDiagonal() * g.transpose();
  const Eigen::Matrix3d omega = g * weighted;
  return weighted * omega.inverse();
}

double PlanarPlan::duration() const {
  double sum = 0.0;
  for (double d : durations) sum += d;
  return sum;
}

std::vector<double> PlanarPlan::knot_times() const {
  std::vector<double> times{0.0};
  for (double d : durations) times.push_back(times.back() + d);
  return times;
}

std::vector<double> PlanarPlan::interval_lengths() const {
  planar::require_intervals(task);
  std::vector<double> lengths;
  const std::size_t phases = std::min(durations.size(), task.phases.size());
  for (std::size_t k = 0; k < phases; ++k)
    for (int i = 0; i < task.phases[k].intervals; ++i) lengths.push_back(durations[k] / task.phases[k].intervals);
  return lengths;
}

PlanarState PlanarPlan::at(double t) const {
  const double end = duration();
  constexpr double kRounding = 1e-9;
  if (!(t >= -kRounding && t <= end + kRounding))
    throw InvalidInput("t", "must lie in [0, " + text(end) + "] s", text(t));
  double start = 0.0;
  int k = 0;
  while (k + 1 < static_cast<int>(durations.size()) && t >= start + durations[k]) start += durations[k++];
  if (durations.empty()) throw InvalidPlan("durations", "must be one for each phase", "none");
  PlanarState state = at_phase(k, std::clamp(t - start, 0.0, std::max(0.0, durations[k])));
  state.time = t;
  return state;
}

PlanarState PlanarPlan::at_phase(int k, double since_start) const {
  planar::require_shape(*this);
  if (k < 0 || k >= static_cast<int>(durations.size()))
    throw InvalidInput("phase", "must lie in [0, " + std::to_string(durations.size() - 1) + "]", text(k));
  if (!(durations[k] > 0.0))
    throw InvalidPlan("durations[" + std::to_string(k) + "]", "must be a positive number", text(durations[k]));
  constexpr double kRounding = 1e-9;
  if (!(since_start >= -kRounding && since_start <= durations[k] + kRounding))
    throw InvalidInput("since_start", "must lie in [0, " + text(durations[k]) + "] s", text(since_start));

  const std::vector<double> lengths = interval_lengths();
  const int intervals = task.phases[k].intervals;
  const double length = durations[k] / intervals;
  const double place = length > 0.0 ? since_start / length : 0.0;  // zero: a duration that has no such part
  const int i = static_cast<int>(std::clamp(place, 0.0, intervals - 1.0));
  planar::Evaluation evaluation(*this);
  evaluation.at(planar::interval_splines(*this, task.first_interval(k) + i, lengths), planar::phase_gain(*this, k),
                std::clamp(2.0 * (place - i) - 1.0, -1.0, 1.0));
  evaluation.state.time = since_start;
  for (int before = 0; before < k; ++before) evaluation.state.time += durations[before];
  return evaluation.state;
}

}  // namespace mcplan
