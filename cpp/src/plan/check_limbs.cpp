#include "check_limbs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/convex_min.hpp"
#include "solid_box.hpp"

namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// Length [m] of the segment inside the prism of a solid, a convex set of half-spaces n . x <= c: each of them cuts the
/// part s_0 <= s <= s_1 of x(s) = from + s (to - from) that is left of it.
double length_inside(const Solid& solid, const Vector3d& from, const Vector3d& to) {
  double first = 0.0, last = 1.0;
  const auto cut = [&](double beyond_from, double beyond_to) {
    if (beyond_from > 0.0 && beyond_to > 0.0) last = first - 1.0;
    if ((beyond_from > 0.0) == (beyond_to > 0.0)) return;
    const double crossing = beyond_from / (beyond_from - beyond_to);
    if (beyond_from > 0.0)
      first = std::max(first, crossing);
    else
      last = std::min(last, crossing);
  };
  const Polygon& polygon = solid.polygon;
  cut(polygon.height(from), polygon.height(to));
  cut(-solid.thickness - polygon.height(from), -solid.thickness - polygon.height(to));
  for (int i = 0; i < polygon.edge_count() && last > first; ++i)
    cut(polygon.overshoot(i, from), polygon.overshoot(i, to));
  return last > first ? (last - first) * (to - from).norm() : 0.0;
}

/// The least way [m] by which a segment that passes through a solid would have to be moved to be outside: of two convex
/// bodies with flat sides the least overlap along the normals of the sides and along what is normal to an edge of each.
double depth_of(const Solid& solid, const Vector3d& from, const Vector3d& to) {
  const std::vector<Vector3d>& top = solid.polygon.vertices_W();
  const Vector3d down = -solid.thickness * solid.polygon.normal_W();
  double least = std::numeric_limits<double>::infinity();
  const auto look_along = [&](const Vector3d& axis) {
    const double length = axis.norm();
    if (!(length > 1e-9 * (to - from).norm())) return;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector3d& vertex : top) {
      low = std::min({low, axis.dot(vertex), axis.dot(vertex + down)});
      high = std::max({high, axis.dot(vertex), axis.dot(vertex + down)});
    }
    const double a = axis.dot(from), b = axis.dot(to);
    least = std::min({least, (high - std::min(a, b)) / length, (std::max(a, b) - low) / length});
  };
  look_along(down);
  look_along((to - from).cross(down));
  for (int i = 0; i < solid.polygon.edge_count(); ++i) {
    look_along(solid.polygon.edge_outward_W(i));
    look_along((to - from).cross(top[(i + 1) % top.size()] - top[i]));
  }
  return std::max(least, 0.0);
}

/// Distance [m] of a point outside the prism of a solid; zero inside.
double distance_outside(const Solid& solid, const Vector3d& point) {
  const double height = solid.polygon.height(point);
  const Vector3d level = point - height * solid.polygon.normal_W();
  const double beside = (solid.polygon.nearest(level) - level).norm();
  return std::hypot(beside, std::max({height, -solid.thickness - height, 0.0}));
}

}  // namespace

/// Surfaces whose solid lies no farther from the CoM than a limb reaches, until the CoM has moved on.
void Limbs::look_around(const Problem& problem, const Vector3d& com_W) {
  if (boxes_.size() != problem.solids.size()) {
    for (const Solid& solid : problem.solids) boxes_.push_back(box_of(solid));
    worst_.resize(boxes_.size());
  } else if ((com_W - looked_at_W_).norm() <= kMove * problem.similarity.length) {
    return;
  }
  double reach = 0.0;
  for (const EndEffector& end : problem.robot.end_effectors)
    reach = std::max(reach, end.reach_min_B.cwiseAbs().cwiseMax(end.reach_max_B.cwiseAbs()).norm());
  for (const TrunkPart& part : problem.robot.trunk)
    reach = std::max(reach, part.radius + std::max(part.from_B.norm(), part.to_B.norm()));
  reach += kMove * problem.similarity.length;
  looked_at_W_ = com_W;
  near_.clear();
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    if (!(boxes_[i].squaredExteriorDistance(com_W) > reach * reach)) near_.push_back(static_cast<int>(i));
}

/// A limb is taken as straight from the CoM to its end-effector. What an end-effector touches is left out: knees and
/// elbows bend around that.
void Limbs::look(const Problem& problem, const Sample& sample, Findings& findings) {
  if (sample.time_s < next_s_) return;
  next_s_ = sample.time_s + kEvery_s * problem.similarity.time;
  const Vector3d& com = sample.replay.com_W;
  look_around(problem, com);
  check_trunk(problem, sample, findings);
  check_legs(problem, sample, findings);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Vector3d& end = sample.at.end_effectors[l].position_W;
    Eigen::AlignedBox3d around(com);
    around.extend(end);
    for (int surface : near_) {
      if (surface == problem.surface(sample.phase, l) || !boxes_[surface].intersects(around)) continue;
      const double length = length_inside(problem.solids[surface], com, end);
      if (length > 0.0)
        findings.offer(StateLimit::limb,
                       std::max(depth_of(problem.solids[surface], com, end) - kBent * problem.similarity.length,
                                length - kInside * problem.similarity.length),
                       {sample.phase, l, sample.time_s});
      if (length > worst_[surface].length) worst_[surface] = {length, {sample.phase, l, sample.time_s}};
    }
  }
}

/// A ball about the CoM, thinner than any trunk (kTrunkBall CoM heights), in no solid, nor the robot's own trunk.
void Limbs::check_trunk(const Problem& problem, const Sample& sample, Findings& findings) const {
  const double radius = kTrunkBall * problem.robot.com_height;
  const Vector3d& com = sample.replay.com_W;
  for (int surface : near_) {
    if (!(boxes_[surface].squaredExteriorDistance(com) < radius * radius)) continue;
    findings.offer(StateLimit::trunk, radius - distance_outside(problem.solids[surface], com),
                   {sample.phase, -1, sample.time_s});
  }
  for (const TrunkPart& part : problem.robot.trunk) {
    const Capsule capsule{com + sample.r_WB * part.from_B, sample.r_WB * (part.to_B - part.from_B), part.radius};
    offer_capsule(problem, capsule, -1, StateLimit::trunk, {sample.phase, -1, sample.time_s}, findings);
  }
}

/// radius - distance of a capsule's line from each of the solids about it but one.
void Limbs::offer_capsule(const Problem& problem, const Capsule& capsule, int but, StateLimit limit, const Place& place,
                          Findings& findings) const {
  const auto& [from, along, radius] = capsule;
  Eigen::AlignedBox3d around(from);
  around.extend(Vector3d(from + along));
  for (int surface : near_) {
    if (surface == but || !(boxes_[surface].squaredExteriorDistance(around) < radius * radius)) continue;
    // The distance from a convex body is convex along a line.
    const auto away = [&](double s) { return distance_outside(problem.solids[surface], from + s * along); };
    findings.offer(limit, radius - std::min({away(0.0), away(1.0), away(convex_min(away))}), place);
  }
}

/// Thigh and upper half of the shank of a leg that bends at its knee, hip_of() above its ankle, in the plane in which
/// the sole heads: with u = hip - ankle and links a above the knee and b below it, the knee is s = (u.u + b^2 - a^2) /
/// (2 |u|) along u and sqrt(b^2 - s^2) ahead of it. What the foot stands on is beside its shank.
void Limbs::check_legs(const Problem& problem, const Sample& sample, Findings& findings) const {
  const Vector3d feet_moved_B = feet_moved(problem, sample);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const EndEffector& end = problem.robot.end_effectors[l];
    const LimbLimits& limb = end.limb;
    if (!limb.given() || !(limb.radius > 0.0)) continue;
    const FreeStretch* swing = sample.view->stretches[l];
    const int surface = problem.surface(sample.phase, l);
    Vector3d normal = Vector3d::UnitZ();
    if (surface >= 0)
      normal = problem.solids[surface].polygon.normal_W();
    else if (swing != nullptr)
      normal = swing->normal(swing->ratio(sample.time_s - swing->start_s));
    // Half way between opposite walls there is none.
    normal = normal.norm() > 0.1 ? normal.normalized() : Vector3d::UnitZ();
    const Eigen::Matrix3d sole = sole_frame(normal, sole_yaw(problem, sample, l));
    const Vector3d ankle = sample.at.end_effectors[l].position_W + sole * limb.ankle;
    const Vector3d u = hip_of(sample, limb, feet_moved_B) - ankle;
    const double length = std::max(u.norm(), std::abs(limb.upper - limb.lower));
    const Vector3d heading = end.half_size.maxCoeff() > 0.0 ? Vector3d(sole.col(0)) : Vector3d(sample.r_WB.col(0));
    const Vector3d left = u.cross(heading).normalized(), ahead = left.cross(u.normalized());
    const double a = limb.upper, b = limb.lower, s = (length * length + b * b - a * a) / (2.0 * length);
    const double lever = std::sqrt(std::max(b * b - s * s, 0.0));
    const Vector3d knee = s * u.normalized() + (limb.bends_backward ? -lever : lever) * ahead;
    const Vector3d beside = ankle + limb.beside * left;
    const Capsule thigh{beside + u, knee - u, limb.radius}, shank{beside + knee, -0.5 * knee, limb.radius};
    const Place place{sample.phase, l, sample.time_s};
    offer_capsule(problem, thigh, -1, StateLimit::limb, place, findings);
    offer_capsule(problem, shank, surface, StateLimit::limb, place, findings);
  }
}

std::vector<Violation> Limbs::warnings(const Problem& problem) const {
  std::vector<Violation> out;
  for (std::size_t i = 0; i < worst_.size(); ++i) {
    const Worst& worst = worst_[i];
    // A negative tolerance asks for a distance to spare, which nothing here measures.
    if (!(worst.length > std::max(problem.tolerances.clearance, 0.0))) continue;
    out.push_back({"limb", worst.place.phase, problem.robot.end_effectors[worst.place.end_effector].name,
                   worst.place.time_s, worst.length, problem.tolerances.clearance, "m",
                   problem.scene.surfaces[i].name});
  }
  std::stable_sort(out.begin(), out.end(), [](const Violation& a, const Violation& b) { return a.value > b.value; });
  return out;
}

}  // namespace mcplan::checks
