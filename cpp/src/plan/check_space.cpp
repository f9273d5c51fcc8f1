#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "check_internal.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/sole_depth.hpp"
#include "solid_box.hpp"

namespace mcplan::checks {

using Eigen::Vector3d;

namespace {

/// Rz(yaw).
Eigen::Matrix3d level_frame(double yaw) {
  const double c = std::cos(yaw), s = std::sin(yaw);
  Eigen::Matrix3d frame;
  frame << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return frame;
}

/// Largest excess [m] of A x <= b.
double beyond_polytope(const Polytope& polytope, const Vector3d& x) {
  return (polytope.A * x - polytope.b).maxCoeff<Eigen::PropagateNaN>();
}

/// Reach box of an end-effector, in frame B about the CoM. Where polytopes decide on the contacts, a free
/// end-effector's box grows to hold where it lifts off and touches down, which the polytopes have admitted.
Eigen::AlignedBox3d reach_box(const Problem& problem, const FreeStretch* stretch, int l) {
  const EndEffector& limits = problem.robot.end_effectors[l];
  Eigen::AlignedBox3d box(limits.reach_min_B, limits.reach_max_B);
  if (!limits.com_reach.given() || stretch == nullptr) return box;
  for (int k : {stretch->first_phase, stretch->end_phase}) {
    const bool in_contact = k == stretch->first_phase ? k > 0 : problem.surface(k, l) >= 0;
    const Knot& knot = problem.plan.knots[k];
    if (in_contact) box.extend(rotation_from_rpy(knot.base_rpy).transpose() * (knot.end_effectors_W[l] - knot.com_W));
  }
  return box;
}

/// Faces that cut the box: a place relative to the CoM in frame B.
void check_cut(const EndEffector& limits, const Vector3d& relative_B, const Place& place, Findings& findings) {
  if (limits.reach_cut.given()) findings.offer(StateLimit::reach, beyond_polytope(limits.reach_cut, relative_B), place);
}

/// A Rz(yaw)^T (p_m - p_l) <= b for every other end-effector in contact.
void check_partners(const Problem& problem, const Sample& sample, int l, const Eigen::Matrix3d& level,
                    Findings& findings) {
  for (const auto& [name, polytope] : problem.robot.end_effectors[l].partner_reach) {
    const int m = problem.robot.end_effector_index(name);
    if (m < 0 || m == l || !polytope.given() || problem.surface(sample.phase, m) < 0) continue;
    const Vector3d between = sample.at.end_effectors[m].position_W - sample.at.end_effectors[l].position_W;
    findings.offer(StateLimit::reach, beyond_polytope(polytope, level.transpose() * between),
                   {sample.phase, l, sample.time_s});
  }
}

}  // namespace

PhaseView phase_view(const Problem& problem, int phase) {
  PhaseView view{phase_frame(problem.plan, phase), {}, {}};
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const std::vector<FreeStretch>& all = problem.stretches[l];  // in the order of time, none over another
    const auto after = std::upper_bound(all.begin(), all.end(), phase,
                                        [](int k, const FreeStretch& stretch) { return k < stretch.first_phase; });
    const bool free = after != all.begin() && phase < std::prev(after)->end_phase;
    view.stretches.push_back(free ? &*std::prev(after) : nullptr);
    view.reach_boxes.push_back(reach_box(problem, view.stretches.back(), l));
  }
  return view;
}

/// reach_min <= R_WB^T (p_l - p) <= reach_max and what cuts this box, for end-effectors in contact and free ones alike.
/// In contact, and where
/// the robot says it finer, A Rz(yaw)^T (p - p_l) <= b takes the box's place, and the other end-effectors are held to
/// theirs.
void check_reach(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const EndEffector& limits = problem.robot.end_effectors[l];
    const Vector3d offset = sample.at.end_effectors[l].position_W - sample.replay.com_W;
    const bool in_contact = problem.surface(sample.phase, l) >= 0;
    const Place place{sample.phase, l, sample.time_s};
    if (in_contact && (limits.com_reach.given() || !limits.partner_reach.empty())) {
      const Eigen::Matrix3d level = level_frame(sample.yaw);
      check_partners(problem, sample, l, level, findings);
      if (limits.com_reach.given()) {
        findings.offer(StateLimit::reach, beyond_polytope(limits.com_reach, level.transpose() * -offset), place);
        continue;
      }
    }
    const Eigen::AlignedBox3d& box = sample.view->reach_boxes[l];
    const Vector3d relative = sample.r_WB.transpose() * offset;
    check_cut(limits, relative, place, findings);
    const double kept = findings.kept(StateLimit::reach, place);
    if (((box.min() - relative).array() <= kept).all() && ((relative - box.max()).array() <= kept).all()) continue;
    findings.offer(StateLimit::reach, largest((box.min() - relative).cwiseMax(relative - box.max())), place);
  }
}

/// The same of free end-effectors at the knots, whose own positions at_phase() does not give: it bends paths into the
/// reach box.
void check_reach_at_knots(const Problem& problem, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l)
    for (const FreeStretch& stretch : problem.stretches[l]) {
      const Eigen::AlignedBox3d box = reach_box(problem, &stretch, l);
      for (int k = stretch.first_phase; k <= std::min(stretch.end_phase, problem.last_knot); ++k) {
        if (problem.surface(k, l) >= 0) continue;
        const Knot& knot = problem.plan.knots[k];
        const Vector3d relative = rotation_from_rpy(knot.base_rpy).transpose() * (knot.end_effectors_W[l] - knot.com_W);
        findings.offer(StateLimit::reach, largest((box.min() - relative).cwiseMax(relative - box.max())),
                       problem.at_knot(k, l));
        check_cut(problem.robot.end_effectors[l], relative, problem.at_knot(k, l), findings);
      }
    }
}

/// A sole in contact is no deeper than kSoleDepth in a solid but its own, as it is put down: it stays there.
void check_soles(const Problem& problem, Findings& findings) {
  const double length = problem.similarity.length;
  for (int k = 0; k <= problem.last_knot; ++k) {
    const Knot& knot = problem.plan.knots[k];
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      const int surface = problem.surface(k, l);
      if (surface < 0 || (k > 0 && surface == problem.surface(k - 1, l))) continue;
      const double yaw = knot.end_effector_yaw.empty() ? knot.base_rpy.z() : knot.end_effector_yaw[l];
      const Eigen::Matrix3d sole_W = sole_frame(problem.solids[surface].polygon.normal_W(), yaw);
      const double depth = sole_depth(problem.solids, surface, problem.robot.end_effectors[l], kFootHeight * length,
                                      knot.end_effectors_W[l], sole_W);
      findings.offer(StateLimit::clearance, depth - kSoleDepth * length, problem.at_knot(k, l));
    }
  }
}

/// |p'| <= max_com_speed.
void check_com_speed(const Problem& problem, const Sample& sample, Findings& findings) {
  const double max = problem.robot.max_com_speed;
  if (!std::isfinite(max)) return;
  const Vector3d& velocity = sample.replay.com_velocity_W;
  const Place place{sample.phase, -1, sample.time_s};
  const double kept = findings.kept(StateLimit::com_speed, place) + max;
  if (kept > 0.0 && velocity.squaredNorm() < kept * kept * kBelow) return;
  findings.offer(StateLimit::com_speed, velocity.norm() - max, place);
}

/// yaw_range: min <= yaw of the sole - yaw of the base <= max while in contact, modulo a turn.
void check_yaw_range(const Problem& problem, const Sample& sample, Findings& findings) {
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const Eigen::Vector2d& range = problem.robot.end_effectors[l].yaw_range;
    if (problem.surface(sample.phase, l) < 0 || !range.allFinite()) continue;
    const double turned = modulo_turn(sole_yaw(problem, sample, l) - sample.yaw);
    findings.offer(StateLimit::yaw_range, std::max(range[0] - turned, turned - range[1]),
                   {sample.phase, l, sample.time_s}, problem.tolerances.yaw, "rad");
  }
}

/// The end-effector's solids nearby, looked for again once it has left the ball for which they are known.
const std::vector<Solid>& Surroundings::around(const Problem& problem, int l, const Vector3d& position_W) {
  Near& near = near_[l];
  if (near.known && (position_W - near.center_W).squaredNorm() <= kMove * kMove) return near.solids;
  const double reach = kMove + problem.robot.end_effectors[l].half_size.norm() + 1e-6;
  near.center_W = position_W;
  near.known = true;
  near.solids.clear();
  for (std::size_t i = 0; i < boxes_.size(); ++i)
    if (!(boxes_[i].squaredExteriorDistance(position_W) > reach * reach)) near.solids.push_back(problem.solids[i]);
  return near.solids;
}

/// Depth inside the prism below any surface, for end-effectors that are free (clearance.hpp says which points count).
void Surroundings::check_clearance(const Problem& problem, const Sample& sample, Findings& findings) {
  near_.resize(problem.end_effector_count());
  if (boxes_.size() != problem.solids.size())
    for (const Solid& solid : problem.solids) boxes_.push_back(box_of(solid));
  for (int l = 0; l < problem.end_effector_count(); ++l) {
    const FreeStretch* stretch = sample.view->stretches[l];
    if (stretch == nullptr) continue;
    const EndEffectorState& end = sample.at.end_effectors[l];
    const double depth =
        clearance_depth(around(problem, l, end.position_W), problem.robot.end_effectors[l], *stretch,
                        stretch->ratio(sample.time_s - stretch->start_s), end.position_W, sole_yaw(problem, sample, l));
    findings.offer(StateLimit::clearance, depth, {sample.phase, l, sample.time_s});
  }
}

}  // namespace mcplan::checks
