#include "ddp/polish/leg_lengths.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "ddp/hip.hpp"
#include "ddp/polish/gradients.hpp"

namespace mcplan::ddp::polish {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A leg at an instant.
struct LegLengths::Leg {
  Leg(const Problem& problem, const BodyPose& pose, int l, const Eigen::Matrix3d& sole, const VectorXd& x,
      const VectorXd* u, double fraction)
      : limit(problem.limits[l]) {
    const Hip hip(problem, limit.limb, pose.com, pose.rotation, x, u, fraction);
    by_com = hip.by_com;
    from_com_W = pose.rotation * hip.own_B;
    const Vector3d between = hip.place_W - x.segment<3>(problem.layout.end(l)) - sole * limit.limb.ankle;
    length = between.norm();
    direction = between / std::max(length, 1e-9);
  }

  double beyond() const { return length - limit.leg_max; }

  const EndLimits& limit;
  double by_com, length;
  Vector3d from_com_W, direction;
};

LegLengths::LegLengths(const FixedSequence& fixed) : fixed_(&fixed), phases_(fixed.steps()) {
  const int last = fixed.problem().options.interior_points + 1;
  for (int k = 0; k < fixed.steps(); ++k) {
    const std::vector<Standing>& standing = fixed.phase(k).standing;
    for (std::size_t c = 0; c < standing.size(); ++c) {
      const int l = standing[c].l;
      if (!fixed.problem().limits[l].limb.given()) continue;
      // The end of a phase is the begin of the next one; where the motion begins nothing can be chosen.
      const bool stays = k + 1 < fixed.steps() && fixed.contacts()[k + 1][l] == standing[c].surface;
      for (int i = k == 0 ? 1 : 0; i <= (stays ? last - 1 : last); ++i)
        phases_[k].rows.push_back({static_cast<int>(c), i});
    }
    phases_[k].by.setZero(fixed.size(k), static_cast<int>(phases_[k].rows.size()));
    phases_[k].weighted = phases_[k].by;
  }
}

LegLengths::Leg LegLengths::leg(const Motion& motion, int k, const Row& row) const {
  const Problem& problem = fixed_->problem();
  const Standing& s = fixed_->phase(k).standing[row.contact];
  const Trajectory& t = motion.trajectory;
  return Leg(problem, motion.pose(k, row.instant), s.l, problem.sole_frame(s.surface, t.sole_yaw[k][s.l]), t.x[k],
             &t.u[k], static_cast<double>(row.instant) / (motion.instants() - 1));
}

double LegLengths::room(const Row& row) const {
  const Problem& problem = fixed_->problem();
  return row.instant > 0 && row.instant <= problem.options.interior_points ? problem.reach_room : 0.0;
}

void LegLengths::values(const Motion& motion, int k, int row, ArrayXd& r) const {
  for (const Row& of : phases_[k].rows) r[row++] = leg(motion, k, of).beyond() + room(of);
}

void LegLengths::add(const Motion& motion, int k, const MatrixXd& lifted, int row, const ArrayXd& y, const ArrayXd& d,
                     StageModel& model) {
  OfPhase& of = phases_[k];
  const int count = static_cast<int>(of.rows.size());
  if (count == 0) return;
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const Phase& phase = fixed_->phase(k);
  of.by.setZero();
  for (int j = 0; j < count; ++j) {
    const Row& which = of.rows[j];
    const Leg stands = leg(motion, k, which);
    const BodyPose& pose = motion.pose(k, which.instant);
    auto by = of.by.col(j);
    // By the CoM and the angles of the base at that instant, and these by z.
    Eigen::Matrix<double, 6, 1> by_pose;
    by_pose << stands.by_com * stands.direction, pose.axes_W.transpose() * stands.from_com_W.cross(stands.direction);
    add_by_pose({*fixed_, k, which.instant, lifted}, by_pose, by);
    // By the end-effectors themselves.
    by.segment<3>(at.end(phase.standing[which.contact].l)) -= stands.direction;
    const double fraction = static_cast<double>(which.instant) / (motion.instants() - 1);
    add_by_legs(*fixed_, k, fraction, stands.limit.limb.hip_shift * stands.direction, by);
  }
  of.weighted.noalias() = of.by * d.segment(row, count).matrix().asDiagonal();
  model.h.noalias() += of.weighted.lazyProduct(of.by.transpose());
  model.g.noalias() += of.by.lazyProduct(y.segment(row, count).matrix());
}

void LegLengths::along(int k, const VectorXd& dz, int row, ArrayXd& out) const {
  const OfPhase& of = phases_[k];
  out.segment(row, of.by.cols()).matrix().noalias() = of.by.transpose() * dz;
}

LegLengths::AtStart LegLengths::at_start(const Motion& motion, int l, const Vector3d& spin) const {
  const Problem& problem = fixed_->problem();
  const VectorXd& x = motion.trajectory.x.front();
  const Eigen::Matrix3d sole = problem.sole_frame(fixed_->contacts().front()[l], motion.trajectory.sole_yaw.front()[l]);
  const Leg stands(problem, motion.pose(0, 0), l, sole, x, nullptr, 0.0);
  const Vector3d velocity = stands.by_com * x.segment<3>(problem.layout.velocity()) + spin.cross(stands.from_com_W);
  return {stands.beyond(), stands.direction.dot(velocity)};
}

}  // namespace mcplan::ddp::polish
