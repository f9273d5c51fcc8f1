#include "ddp/polish/limits.hpp"

#include <algorithm>
#include <cmath>

#include "ddp/constants.hpp"
#include "ddp/input_limits.hpp"
#include "ddp/moment_limits.hpp"
#include "ddp/polish/limit_rows.hpp"

namespace mcplan::ddp::polish {

using Eigen::Vector3d;

namespace {

/// Rows of visit_forces() at an instant.
int force_rows(const OfContact& c) {
  return (c.sides > 0 ? c.sides : c.sides == 0 ? 1 : 0) + (c.force_max > 0.0 ? 1 : 0) + 2 * c.moments;
}

/// Where the scene has an end-effector at the goal.
Vector3d goal_of(const Problem& problem, int l) { return problem.reference.x.back().segment<3>(problem.layout.end(l)); }

}  // namespace

Limits::Limits(const FixedSequence& fixed, const Pendulum& pendulum, const Tuning& tuning)
    : fixed_(&fixed),
      pendulum_(&pendulum),
      tuning_(tuning),
      legs_(fixed),
      joints_(fixed, pendulum, tuning.hold_joints),
      phases_(fixed.steps() + 1) {
  const Problem& problem = fixed.problem();
  const int instants = problem.options.interior_points + 2;
  int reaches = 0;
  for (const EndLimits& limit : problem.limits) reaches += reach_rows(limit);
  for (int k = 0; k <= fixed.steps(); ++k) {
    make_linear(k);
    OfPhase& of = phases_[k];
    if (k > 0) of.reach = push(reaches, tuning.limit_weight);
    if (k == fixed.steps()) break;
    const Phase& phase = fixed.phase(k);
    of.lifted.setZero(6 * (instants - 1), static_cast<int>(phase.moving.size()));
    for (const Standing& s : phase.standing) {
      const EndLimits& limit = problem.limits[s.l];
      OfContact c;
      c.friction = problem.friction[s.surface];
      const bool held = problem.options.friction && !std::isinf(c.friction);
      c.sides = held ? problem.options.friction_sides : -1;
      // A cap that large stands for none.
      c.force_max = limit.force_max < kForceCapMax ? limit.force_max : 0.0;
      c.torsion_arm = torsion_arm(problem, s.l, s.surface);
      c.moments = std::isinf(c.torsion_arm) ? 0 : static_cast<int>(s.moments.size());
      c.yaw = std::isfinite(limit.yaw_min) && std::isfinite(limit.yaw_max);
      const int forces = force_rows(c);
      c.first = push(instants * (forces + (c.yaw ? 2 : 0)) + reach_rows(limit) * (instants - 2), tuning.limit_weight);
      of.contacts.push_back(c);
    }
    of.legs = push(static_cast<int>(legs_.rows(k).size()), tuning.limit_weight);
    of.joints = push(joints_.count(k), tuning.limit_weight);
  }
  precision_ = Eigen::Map<RowArray>(weights_.data(), static_cast<int>(weights_.size())).square();
}

int Limits::push(int rows, double weight) {
  const int first = static_cast<int>(weights_.size());
  weights_.insert(weights_.end(), rows, weight);
  return first;
}

Limits::Linear& Limits::linear(int k, double weight, bool two_sided) {
  Linear& row = phases_[k].linear.emplace_back();
  row.row = push(two_sided ? 2 : 1, weight);
  row.two_sided = two_sided;
  return row;
}

/// Rows that are linear in z: boxes of the inputs, soles, edges.
void Limits::make_linear(int k) {
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const double limit = tuning_.limit_weight;
  const double edge_weight = problem.options.weights.contact_max * problem.options.weights.overshoot_factor;
  for (const Touchdown& t : fixed_->touchdowns()) {
    if (t.knot != k) continue;
    const Polygon& polygon = problem.polygons[t.surface];
    for (int i = 0; i < polygon.edge_count(); ++i) {
      Linear& row = linear(k, edge_weight, false);
      double margin = problem.foothold_margin(t.l, t.surface, i, tuning_.extra_margin);
      if (fixed_->last(t)) margin = problem.margin_of_given(t.l, t.surface, i, goal_of(problem, t.l), margin);
      row.offset = polygon.overshoot(i, Vector3d::Zero()) + margin;
      for (int j = 0; j < 3; ++j) row.touch(at.end(t.l) + j, polygon.edge_outward_W(i)[j]);
    }
  }
  make_sole_pairs(k);
  if (k == fixed_->steps()) return;
  const Phase& phase = fixed_->phase(k);
  const auto box = [&](int column, double min, double max) {
    Linear& row = linear(k, limit, true);
    row.min = min;
    row.max = max;
    row.touch(column, 1.0);
  };
  const DurationLimits h = duration_limits(problem, k);
  const double flight = in_flight(fixed_->contacts()[k]) ? min_flight_duration(problem, k) : 0.0;
  box(fixed_->size(k) - 1, std::max(h.min, flight), h.max);
  for (const Standing& s : phase.standing) {
    box(phase.moving[s.stiffness], 0.0, max_stiffness_input(problem, s.l));
    for (std::size_t i = 0; i < s.moments.size(); ++i) {
      const double max = at.moments()[s.moments[i]].max;
      box(phase.moving[s.moment] + static_cast<int>(i), -max, max);
    }
    if (s.pressure_count == 0) continue;
    const Eigen::Matrix3Xd& basis = at.offsets(s.l).pressure;
    for (int i = 0; i < 2; ++i) {
      Linear& row = linear(k, limit, true);
      row.max = problem.limits[s.l].pressure_half[i];
      row.min = -row.max;
      for (int j = 0; j < s.pressure_count; ++j) row.touch(phase.moving[s.pressure] + j, basis(i, j));
    }
    soles_.push_back({k, static_cast<int>(phases_[k].linear.size()) - 2, s.l, s.surface});
    const Polygon& polygon = problem.polygons[s.surface];
    for (int i = 0; i < polygon.edge_count(); ++i) {
      Linear& row = linear(k, edge_weight, false);
      row.offset = polygon.overshoot(i, Vector3d::Zero()) + problem.pressure_margin;
      const Vector3d& outward = polygon.edge_outward_W(i);
      for (int j = 0; j < 3; ++j) row.touch(at.end(s.l) + j, outward[j]);
      for (int j = 0; j < s.pressure_count; ++j) row.touch(phase.moving[s.pressure] + j, outward.dot(basis.col(j)));
    }
  }
}

void Limits::head(const Trajectory& trajectory) {
  const Problem& problem = fixed_->problem();
  for (const Sole& sole : soles_) {
    const Eigen::Matrix3d frame = problem.sole_frame(sole.surface, trajectory.sole_yaw[sole.k][sole.l]);
    const Eigen::Matrix3Xd& basis = problem.layout.offsets(sole.l).pressure;
    for (int i = 0; i < 2; ++i) {
      Linear& row = phases_[sole.k].linear[sole.linear + i];
      for (int j = 0; j < row.count; ++j) row.factor[j] = frame.col(i).dot(basis.col(j));
    }
  }
  part_soles(trajectory);
}

double Limits::variable(const Motion& motion, int k, int column) const {
  const int nx = fixed_->nx();
  return column < nx ? motion.trajectory.x[k][column] : motion.trajectory.u[k][fixed_->phase(k).inputs[column - nx]];
}

void Limits::values(const Motion& motion, RowArray& r) const {
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const Trajectory& t = motion.trajectory;
  r.resize(count());
  const auto box = [&](int row, double value, double min, double max) {
    r[row] = value - max;
    r[row + 1] = min - value;
  };
  for (int k = 0; k <= fixed_->steps(); ++k) {
    const OfPhase& of = phases_[k];
    for (const Linear& row : of.linear) {
      double value = row.offset;
      for (int i = 0; i < row.count; ++i) value += row.factor[i] * variable(motion, k, row.column[i]);
      r[row.row] = value - row.max;
      if (row.two_sided) r[row.row + 1] = row.min - value;
    }
    if (int row = of.reach; row >= 0)
      for (int l = 0; l < at.end_effector_count(); ++l)
        reach_values(motion.knot(k), t.x[k].segment<3>(at.end(l)), problem.limits[l], 0.0, row, r);
    if (k == fixed_->steps()) break;
    for (std::size_t c = 0; c < of.contacts.size(); ++c) {
      const Standing& s = fixed_->phase(k).standing[c];
      const Vector3d end = t.x[k].segment<3>(at.end(s.l));
      const ForceView view(problem, *pendulum_, t.x[k], t.u[k], s, of.contacts[c]);
      int row = of.contacts[c].first;
      for (int i = 0; i < motion.instants(); ++i) {
        const BodyPose& pose = motion.pose(k, i);
        visit_forces(view, pose.com, row, [&](int here, double value, auto&&...) { r[here] = value; });
        if (of.contacts[c].yaw) {
          box(row, t.sole_yaw[k][s.l] - pose.rpy[2], problem.limits[s.l].yaw_min, problem.limits[s.l].yaw_max);
          row += 2;
        }
        if (i > 0 && i + 1 < motion.instants())
          reach_values(pose, end, problem.limits[s.l], problem.reach_room, row, r);
      }
    }
    legs_.values(motion, k, of.legs, r);
    joints_.values(motion, k, of.joints, r);
  }
  if (slack_.size() > 0) r -= slack_;
}

void Limits::relax_from(const Motion& motion) {
  slack_.resize(0);
  start_slack_ = StartSlack(*fixed_, motion, legs_);
  if (!relaxed()) return;
  slack_.setZero(count());
  relax(motion);
}

void Limits::relax(const Motion& motion) {
  StartSlack& slack = start_slack_;
  slack.set_times(*fixed_, motion.trajectory);
  const auto relax_reach = [&](int l, double t, double room, int& row) {
    for (int i = 0; i < reach_rows(fixed_->problem().limits[l]); ++i) slack_[row++] = slack.reach(l, i, t, room);
  };
  for (int k = 0; k <= fixed_->steps(); ++k) {
    const OfPhase& of = phases_[k];
    if (int row = of.reach; row >= 0)
      for (int l = 0; l < fixed_->problem().layout.end_effector_count(); ++l)
        relax_reach(l, slack.knot_time(k), 0.0, row);
    if (k == fixed_->steps()) break;
    const double h = slack.knot_time(k + 1) - slack.knot_time(k);
    for (std::size_t c = 0; c < of.contacts.size(); ++c) {
      const int l = fixed_->phase(k).standing[c].l;
      int row = of.contacts[c].first;
      for (int i = 0; i < motion.instants(); ++i) {
        const double t = slack.knot_time(k) + h * i / (motion.instants() - 1);
        row += force_rows(of.contacts[c]);
        if (of.contacts[c].yaw) {
          slack_[row] = slack.yaw(l, true, t);
          slack_[row + 1] = slack.yaw(l, false, t);
          row += 2;
        }
        if (i > 0 && i + 1 < motion.instants()) relax_reach(l, t, fixed_->problem().reach_room, row);
      }
    }
    int row = of.legs;
    for (const LegLengths::Row& leg : legs_.rows(k)) {
      const double t = slack.knot_time(k) + h * leg.instant / (motion.instants() - 1);
      slack_[row++] = slack.leg(fixed_->phase(k).standing[leg.contact].l, t, legs_.room(leg));
    }
  }
}

}  // namespace mcplan::ddp::polish
