#include <algorithm>
#include <cmath>

#include "check_internal.hpp"

namespace mcplan::checks {
namespace {

using Eigen::Vector3d;

/// contact_distance: |n . (p - v)|.  contact_polygon: distance of p's projection beyond the boundary (negative inside)
/// of the surface and what goes on in its plane.
/// Each of them a Constraint or a StateLimit, for which the slack of a measured start counts.
template <class Limit>
void offer_place(const Problem& problem, Limit distance, Limit beyond, int surface, const Vector3d& position,
                 const Place& place, Findings& findings) {
  findings.offer(distance, std::abs(problem.solids[surface].polygon.height(position)), place);
  findings.offer(beyond, beyond_ground(problem, surface, place.end_effector, position, beside_named_m), place);
}

bool has_own_yaw(const Problem& problem, int phase) { return !problem.plan.knots[phase].end_effector_yaw.empty(); }

Seen seen(const PlanState& at, double since_start_s, int l) {
  const EndEffectorState& end = at.end_effectors[l];
  return {since_start_s, end.position_W, end.velocity_W, end.yaw};
}

}  // namespace

double beyond_sole(const Eigen::Vector2d& half, const Vector3d& normal, double yaw, const Vector3d& offset) {
  if (half.maxCoeff() <= 0.0 || offset.norm() == 0.0) return offset.norm();
  Vector3d d = sole_frame(normal, yaw).transpose() * offset;
  for (int i = 0; i < 2; ++i) d[i] = std::max(std::abs(d[i]) - half[i], 0.0);
  return d.norm();
}

double beyond_polygon(const Polygon& polygon, const Vector3d& position) {
  const double beyond = polygon.outside(position);
  if (!(beyond > 0.0)) return beyond;
  const Vector3d projected = position - polygon.normal_W() * polygon.height(position);
  return (projected - polygon.nearest(projected)).norm();
}

double beyond_ground(const Problem& problem, int surface, int l, const Vector3d& position, double within) {
  constexpr double kLevel_m = 0.002, kTilted = 0.01;
  const Polygon& own = problem.solids[surface].polygon;
  double beyond = beyond_polygon(own, position);
  if (beyond > within) return beyond;
  for (std::size_t i = 0; i < problem.solids.size() && beyond > 0.0; ++i) {
    const Surface& other = problem.scene.surfaces[i];
    const Polygon& polygon = problem.solids[i].polygon;
    if (other.friction < problem.scene.surfaces[surface].friction || other.grasp) continue;
    if (!may_touch(other, problem.robot.end_effectors[l]) || std::abs(polygon.height(position)) > kLevel_m) continue;
    if (polygon.normal_W().dot(own.normal_W()) < 0.0 || polygon.normal_W().cross(own.normal_W()).norm() > kTilted)
      continue;
    if (polygon.outside(own.centroid_W()) <= 0.0 || own.outside(polygon.centroid_W()) <= 0.0) continue;
    beyond = std::min(beyond, beyond_polygon(polygon, position));
  }
  return beyond;
}

double sole_yaw(const Problem& problem, const Sample& sample, int l) {
  return has_own_yaw(problem, sample.phase) ? sample.at.end_effectors[l].yaw : sample.yaw;
}

void check_contact_place(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(sample.phase, l);
    if (surface < 0 || sample.still[l]) continue;
    offer_place(problem, StateLimit::contact_distance, StateLimit::contact_polygon, surface,
                sample.at.end_effectors[l].position_W, {sample.phase, l, sample.time_s}, findings);
  }
}

/// What touches down at the very end has no phase of its own that is looked at.
void check_contact_place_at_end(const Problem& problem, const Sample& last, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const int surface = problem.surface(last.phase + 1, l);
    if (surface < 0) continue;
    const Vector3d& position = last.at.end_effectors[l].position_W;
    const Place place{last.phase, l, last.time_s};
    if (surface == problem.surface(last.phase, l))
      offer_place(problem, StateLimit::contact_distance, StateLimit::contact_polygon, surface, position, place,
                  findings);
    else
      offer_place(problem, Constraint::contact_distance, Constraint::contact_polygon, surface, position, place,
                  findings);
  }
}

/// The surface admits the end-effector.
void check_contact_permission(const Problem& problem, Findings& findings) {
  for (int k = 0; k <= problem.last_knot; ++k)
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      const int surface = problem.surface(k, l);
      if (surface < 0) continue;
      const bool allowed = may_touch(problem.scene.surfaces[surface], problem.robot.end_effectors[l]);
      findings.offer(Constraint::contact_permission, allowed ? 0.0 : 1.0, problem.at_knot(k, l));
    }
}

void Travel::find_still(const Problem& problem, Sample& sample) const {
  sample.still.assign(problem.end_effector_count(), 0);
  if (sample.phase != phase_) return;
  const bool own_yaw = has_own_yaw(problem, sample.phase);
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const EndEffectorState& end = sample.at.end_effectors[l];
    const Seen& last = last_[l];
    const Vector3d &v = end.velocity_W, &before = last.velocity_W;
    sample.still[l] = problem.surface(sample.phase, l) >= 0 && end.position_W == last.position_W && v.x() == 0.0 &&
                      v.y() == 0.0 && v.z() == 0.0 && before == v && (!own_yaw || end.yaw == last.yaw);
  }
}

/// path_continuity: |p(knot, from the left) - p(knot, from the right)|; within a phase jump().
void Travel::check_continuity(const Problem& problem, const Sample& sample, int l, Findings& findings) {
  const Seen now = seen(sample.at, sample.since_start_s, l);
  findings.offer(
      Constraint::path_continuity,
      sample.phase == phase_ ? jump(problem, sample, l, last_[l], now) : (now.position_W - last_[l].position_W).norm(),
      {sample.phase, l, sample.time_s});
}

/// Whether it is told at a glance that check_continuity() would find nothing new within the phase.
bool Travel::smooth(const Problem& problem, const Sample& sample, int l, const Findings& findings) const {
  const double kept = std::min(findings.kept(Constraint::path_continuity), problem.tolerances.slip);
  const EndEffectorState& end = sample.at.end_effectors[l];
  const Seen& last = last_[l];
  const double half = 0.5 * (sample.since_start_s - last.since_start_s);
  return sample.phase == phase_ && kept > 0.0 &&
         (end.position_W - last.position_W - half * (last.velocity_W + end.velocity_W)).squaredNorm() <
             kept * kept * kBelow;
}

/// |p(b) - p(a) - (b - a) (v(a) + v(b)) / 2|: how far the path goes beyond its velocities, of the third order in b - a
/// where it is smooth. Where that is much, the halves say whether the path bends or jumps, down to a quarter of a
/// millisecond, or to what instants can be told apart in phases that last for ages. What is no number is no jump of any
/// length: halves say no more.
double Travel::jump(const Problem& problem, const Sample& sample, int l, const Seen& a, const Seen& b) {
  constexpr int kMaxInstants = 20000;
  const double duration = b.since_start_s - a.since_start_s;
  const double found = (b.position_W - a.position_W - 0.5 * duration * (a.velocity_W + b.velocity_W)).norm();
  const double tolerance = problem.tolerances.slip;
  const double middle = a.since_start_s + 0.5 * duration;
  const bool divisible = a.since_start_s < middle && middle < b.since_start_s && std::isfinite(found);
  if (found <= tolerance || !divisible || duration <= 2.5e-4 * problem.similarity.time ||
      ++looked_closer_ > kMaxInstants)
    return found;
  const Seen between = seen(state_in_phase(problem.plan, sample.view->frame, middle), middle, l);
  const double before = jump(problem, sample, l, a, between);
  return before > tolerance ? before : std::max(before, jump(problem, sample, l, between, b));
}

/// slip: |p(t) - p(touchdown)| while the end-effector stays on one surface, over as many phases as that lasts. A sole's
/// own heading must not change either: half its diagonal times the change is how far a corner slides. Without headings
/// of their own soles turn with the base, which contact wrenches hold to the same, and the paper's model does not.
void Travel::check(const Problem& problem, const Sample& sample, Findings& findings) {
  const int n = problem.end_effector_count();
  const bool first = phase_ < 0;
  if (first) {
    surface_.assign(n, -1);
    touched_W_.resize(n);
    touched_yaw_.assign(n, 0.0);
    last_.resize(n);
  }
  for (int l = 0; l < n; ++l) {
    const Vector3d& position = sample.at.end_effectors[l].position_W;
    const Place place{sample.phase, l, sample.time_s};
    const bool turns = !has_own_yaw(problem, sample.phase) && problem.has_wrenches(sample.phase);
    if (sample.still[l] && !turns) {
      last_[l].since_start_s = sample.since_start_s;
      continue;
    }
    if (!first && !smooth(problem, sample, l, findings)) check_continuity(problem, sample, l, findings);
    const int surface = problem.surface(sample.phase, l);
    if (surface >= 0) {
      const double yaw = sole_yaw(problem, sample, l);
      if (surface != surface_[l]) {
        touched_W_[l] = position;
        touched_yaw_[l] = yaw;
      }
      findings.offer(Constraint::slip, (position - touched_W_[l]).norm(), place);
      const double half_diagonal = problem.robot.end_effectors[l].half_size.norm();
      if (has_own_yaw(problem, sample.phase) || problem.has_wrenches(sample.phase))
        findings.offer(Constraint::slip, std::abs(modulo_turn(yaw - touched_yaw_[l])) * half_diagonal, place);
    }
    surface_[l] = surface;
    last_[l] = seen(sample.at, sample.since_start_s, l);
  }
  phase_ = sample.phase;
}

}  // namespace mcplan::checks
