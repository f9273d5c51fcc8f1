#include <algorithm>
#include <cmath>
#include <limits>

#include "checks.hpp"
#include "plane.hpp"

namespace mcplan::planar {
namespace {

using Eigen::Vector2d;

/// What lies between the outermost points of an end-effector; one point is a segment without length.
struct Sole {
  Vector2d from_W, to_W;
};

Sole sole_of(const Sample& sample, const PlanarEndEffector& end_effector) {
  const PlanarMotionOfFrame frame =
      planar_point(sample.at.frames[end_effector.body], end_effector.position_B, end_effector.angle_B);
  const auto [first, last] = std::minmax_element(end_effector.points.begin(), end_effector.points.end());
  return {planar_point(frame, {*first, 0.0}).position_W, planar_point(frame, {*last, 0.0}).position_W};
}

/// How far a solid reaches along a unit vector, from its surface's origin; infinity where it has no end that way.
double reach(const PlanarSurface& surface, const Vector2d& direction_W) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double slope = direction_W.dot(surface.tangent_W());
  if (direction_W.dot(surface.normal_W()) < 0.0) return infinity;
  if (slope == 0.0) return 0.0;
  return slope * (slope > 0.0 ? surface.to : surface.from);
}

/// The shortest way by which a sole gets out of the solid behind a surface, a strip that ends where the surface does;
/// negative: how far it is out. Two convex shapes are apart if and only if a line along a side of one of them parts
/// them: the surface, the ends of the strip, the sole.
double depth(const PlanarSurface& surface, const Sole& sole) {
  const Vector2d a = sole.from_W - surface.origin_W, b = sole.to_W - surface.origin_W;
  const auto way_out = [&](const Vector2d& direction_W) {
    return reach(surface, direction_W) - std::min(direction_W.dot(a), direction_W.dot(b));
  };
  const Vector2d tangent_W = surface.tangent_W();
  double out = -std::min(a.dot(surface.normal_W()), b.dot(surface.normal_W()));
  out = std::min({out, surface.to - std::min(a.dot(tangent_W), b.dot(tangent_W)),
                  std::max(a.dot(tangent_W), b.dot(tangent_W)) - surface.from});
  const double length = (b - a).norm();
  if (length == 0.0) return out;
  const Vector2d across_W = left_of(b - a) / length;
  return std::min({out, way_out(across_W), way_out(-across_W)});
}

bool swings(const PlanarPhase& phase, int end_effector) {
  return std::none_of(phase.contacts.begin(), phase.contacts.end(),
                      [&](const PlanarContact& contact) { return contact.end_effector == end_effector; });
}

}  // namespace

void SolidDepths::look(const Sample& sample) {
  const PlanarTask& task = sample.plan.task;
  const std::size_t surfaces = task.surfaces.size();
  if (worst_.empty()) {
    worst_.resize(task.robot.end_effectors.size() * surfaces);
    beyond_since_s_.assign(worst_.size(), std::numeric_limits<double>::infinity());
  }
  for (std::size_t e = 0; e < task.robot.end_effectors.size(); ++e) {
    if (!swings(task.phases[sample.phase], static_cast<int>(e))) continue;
    const Sole sole = sole_of(sample, task.robot.end_effectors[e]);
    for (std::size_t s = 0; s < surfaces; ++s) {
      SolidDepth& worst = worst_[e * surfaces + s];
      double value = depth(task.surfaces[s], sole);
      if (std::isnan(value)) value = std::numeric_limits<double>::max();
      double& since_s = beyond_since_s_[e * surfaces + s];
      if (value > tolerance_) since_s = std::min(since_s, sample.time_s);
      if (worst.phase >= 0 && value <= worst.depth_m) continue;
      worst = {static_cast<int>(e), static_cast<int>(s), value, sample.phase, sample.time_s, true};
    }
  }
}

std::vector<SolidDepth> SolidDepths::all(const PlanarTask& task) const {
  std::vector<SolidDepth> out;
  for (SolidDepth depth : worst_) {
    if (depth.phase < 0) continue;  // it never swings
    depth.asked = task.keeps_clear(depth.end_effector, depth.surface);
    out.push_back(depth);
  }
  return out;
}

double SolidDepths::beyond_since_s(const PlanarTask& task) const {
  double out = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < worst_.size(); ++i)
    if (worst_[i].phase >= 0 && task.keeps_clear(worst_[i].end_effector, worst_[i].surface))
      out = std::min(out, beyond_since_s_[i]);
  return out;
}

void check_solids(const PlanarTask& task, const SolidDepths& depths, Findings& findings) {
  for (const SolidDepth& depth : depths.all(task))
    if (depth.asked)
      findings.offer(Constraint::clearance, depth.depth_m,
                     {depth.phase, &task.robot.end_effectors[depth.end_effector].name,
                      &task.surfaces[depth.surface].name, depth.time_s});
  findings.note_beyond(depths.beyond_since_s(task));
}

/// Heights of the points of swinging end-effectors at the begin of interval n / 2, wherever they are along the surface.
void check_middle_heights(const Sample& sample, Findings& findings) {
  const PlanarTask& task = sample.plan.task;
  const PlanarPhase& phase = task.phases[sample.phase];
  if (!sample.begin || sample.interval_of_phase != phase.intervals / 2) return;
  for (const PlanarClearance& clearance : phase.clearances) {
    if (std::isinf(clearance.middle_height)) continue;
    const PlanarSurface& surface = task.surfaces[clearance.surface];
    const PlanarEndEffector& end_effector = task.robot.end_effectors[clearance.end_effector];
    const Sole sole = sole_of(sample, end_effector);
    const double height = std::min((sole.from_W - surface.origin_W).dot(surface.normal_W()),
                                   (sole.to_W - surface.origin_W).dot(surface.normal_W()));
    findings.offer(Constraint::clearance, clearance.middle_height - height,
                   {sample.phase, &end_effector.name, &surface.name, sample.time_s});
  }
}

}  // namespace mcplan::planar
