#include "ddp/polish/joint_rows.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "ddp/polish/gradients.hpp"

namespace mcplan::ddp::polish {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::Ref;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr LegJoints::Row kRows[] = {LegJoints::knee,       LegJoints::hip_roll,    LegJoints::hip_pitch,
                                    LegJoints::ankle_roll, LegJoints::ankle_pitch, LegJoints::speed};

}  // namespace

JointRows::JointRows(const FixedSequence& fixed, const Pendulum& pendulum, bool hold)
    : fixed_(&fixed), pendulum_(&pendulum), phases_(fixed.steps()) {
  const int instants = fixed.problem().options.interior_points + 2;
  for (int k = 0; hold && k < fixed.steps(); ++k) {
    const std::vector<Standing>& standing = fixed.phase(k).standing;
    for (std::size_t c = 0; c < standing.size(); ++c) {
      const LimbLimits& limb = fixed.problem().limits[standing[c].l].limb;
      if (!limb.given()) continue;
      for (int i = 0; i < instants; ++i)
        for (const LegJoints::Row row : kRows)
          // How fast the knee turns where the motion begins is given.
          if (std::isfinite(LegJoints::limit_of(limb, row)) && !(row == LegJoints::speed && k == 0 && i == 0))
            phases_[k].pairs.push_back({static_cast<int>(c), i, row});
    }
    phases_[k].by.setZero(fixed.size(k), count(k));
    phases_[k].weighted = phases_[k].by;
  }
}

template <class Visit>
void JointRows::each_leg(const Motion& motion, int k, Visit&& visit) const {
  const Problem& problem = fixed_->problem();
  const Trajectory& t = motion.trajectory;
  const std::vector<Pair>& pairs = phases_[k].pairs;
  std::size_t begin = 0;
  while (begin < pairs.size()) {
    const Pair& first = pairs[begin];
    std::size_t end = begin;
    while (end < pairs.size() && pairs[end].contact == first.contact && pairs[end].instant == first.instant) ++end;
    const int i = first.instant, last = motion.instants() - 1;
    const Standing& s = fixed_->phase(k).standing[first.contact];
    const Vector3d velocity = i == 0      ? Vector3d(t.x[k].segment<3>(Layout::velocity()))
                              : i == last ? motion.end(k).velocity
                                          : motion.inside(k, i).velocity;
    const BodyPose& pose = motion.pose(k, i);
    const BodyAt body{t.x[k], t.u[k], static_cast<double>(i) / last, pose.com, velocity, pose.rotation};
    const StandingLeg leg(problem, *pendulum_, s.l, problem.sole_frame(s.surface, t.sole_yaw[k][s.l]), body);
    LegJoints joints(leg);
    visit(leg, joints, static_cast<int>(begin), static_cast<int>(end));
    begin = end;
  }
}

void JointRows::values(const Motion& motion, int k, int row, ArrayXd& r) const {
  each_leg(motion, k, [&](const StandingLeg&, LegJoints& joints, int begin, int end) {
    for (int j = begin; j < end; ++j) {
      const LegJoints::Row of = phases_[k].pairs[j].limit;
      const double value = joints.value(of), limit = joints.limit(of);
      r[row + 2 * j] = value - limit;
      r[row + 2 * j + 1] = -value - limit;
    }
  });
}

/// g += (dv/dz)' along, v the CoM's velocity at an instant.
void JointRows::add_velocity(const Motion& motion, int k, int instant, const Vector3d& along, Ref<VectorXd> g) const {
  if (instant == 0) {
    g.segment<3>(Layout::velocity()) += along;
    return;
  }
  const Layout& at = fixed_->problem().layout;
  const Phase& phase = fixed_->phase(k);
  const PendulumStep& step = instant + 1 < motion.instants() ? motion.inside(k, instant) : motion.end(k);
  g.segment<3>(Layout::com()) += step.vp * along;
  g.segment<3>(Layout::velocity()) += step.pp * along;
  for (const Standing& s : phase.standing) {
    const Vector3d pushed = step.v_end * step.mu[s.l] * along;
    g.segment<3>(at.end(s.l)) += pushed;
    for (int i = 0; i < s.pressure_count; ++i)
      g[phase.moving[s.pressure + i]] += at.offsets(s.l).pressure.col(i).dot(pushed);
    for (int i = 0; i < s.line_count; ++i) g[phase.moving[s.line + i]] += at.offsets(s.l).force_line.col(i).dot(pushed);
    g[phase.moving[s.stiffness]] += step.v_mu.col(s.l).dot(along);
  }
  g[phase.moving[phase.duration]] += step.slope * step.acceleration.dot(along);
}

/// g += the gradient over z of a row with these slopes.
void JointRows::lift(const Motion& motion, int k, const Pair& pair, const StandingLeg& leg, const LegJoints::Slopes& by,
                     const MatrixXd& lifted, Ref<VectorXd> g) const {
  const Layout& at = fixed_->problem().layout;
  const Phase& phase = fixed_->phase(k);
  const Standing& s = phase.standing[pair.contact];
  const BodyPose& pose = motion.pose(k, pair.instant);
  // By the CoM and the angles of the base at that instant, and these by z.
  Vector3d turns = (pose.rotation * leg.own_B).cross(by.u) + leg.up.cross(by.up);
  if (!leg.has_sole) turns += leg.heading.cross(by.heading);
  Eigen::Matrix<double, 6, 1> by_pose;
  by_pose << leg.by_com * by.u + leg.mu * by.force, pose.axes_W.transpose() * turns;
  add_by_pose({*fixed_, k, pair.instant, lifted}, by_pose, g);
  if (pair.limit == LegJoints::speed) add_velocity(motion, k, pair.instant, leg.by_com * by.velocity, g);
  // By the contact: the ankle moves with the end-effector, and so does a.
  const Vector3d by_line = -leg.mu * by.force, by_acting = by.acting + by_line;
  g.segment<3>(at.end(s.l)) += by_line - by.u;
  for (int i = 0; i < s.pressure_count; ++i)
    g[phase.moving[s.pressure + i]] += at.offsets(s.l).pressure.col(i).dot(by_acting);
  for (int i = 0; i < s.line_count; ++i) g[phase.moving[s.line + i]] += at.offsets(s.l).force_line.col(i).dot(by_line);
  const bool lambda = fixed_->problem().options.stiffness_input == StiffnessInput::lambda;
  const double slope = lambda ? 2.0 * motion.trajectory.u[k][at.stiffness(s.l)] : 1.0;
  g[phase.moving[s.stiffness]] += slope * by.force.dot(leg.lever);
  // By the legs that the hip moves with.
  const double fraction = static_cast<double>(pair.instant) / (motion.instants() - 1);
  add_by_legs(*fixed_, k, fraction, leg.limb.hip_shift * by.u, g);
}

void JointRows::add(const Motion& motion, int k, const MatrixXd& lifted, int row, const ArrayXd& y, const ArrayXd& d,
                    StageModel& model) {
  OfPhase& of = phases_[k];
  if (of.pairs.empty()) return;
  of.by.setZero();
  each_leg(motion, k, [&](const StandingLeg& leg, LegJoints& joints, int begin, int end) {
    for (int j = begin; j < end; ++j) {
      const LegJoints::Row limit = of.pairs[j].limit;
      lift(motion, k, of.pairs[j], leg, joints.slopes(limit, 1.0), lifted, of.by.col(2 * j));
      // The limit of a torque does not depend on the motion, that of a speed does.
      if (limit == LegJoints::speed)
        lift(motion, k, of.pairs[j], leg, joints.slopes(limit, -1.0), lifted, of.by.col(2 * j + 1));
      else
        of.by.col(2 * j + 1) = -of.by.col(2 * j);
    }
  });
  of.weighted.noalias() = of.by * d.segment(row, count(k)).matrix().asDiagonal();
  model.h.noalias() += of.weighted * of.by.transpose();
  model.g.noalias() += of.by * y.segment(row, count(k)).matrix();
}

void JointRows::along(int k, const VectorXd& dz, int row, ArrayXd& out) const {
  const OfPhase& of = phases_[k];
  if (of.pairs.empty()) return;
  out.segment(row, of.by.cols()).matrix().noalias() = of.by.transpose() * dz;
}

}  // namespace mcplan::ddp::polish
