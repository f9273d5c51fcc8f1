#include "ddp/polish/motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mcplan::ddp::polish {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

void BodyPose::set(const Vector3d& com_W, const Vector3d& angles) {
  com = com_W;
  rpy = angles;
  const double sr = std::sin(rpy[0]), cr = std::cos(rpy[0]);
  const double sp = std::sin(rpy[1]), cp = std::cos(rpy[1]);
  const double sy = std::sin(rpy[2]), cy = std::cos(rpy[2]);
  rotation << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,          //
      -sp, cp * sr, cp * cr;
  axes_W << cy * cp, -sy, 0.0,  //
      sy * cp, cy, 0.0,         //
      -sp, 0.0, 1.0;
}

Matrix3d BodyPose::turned(const Vector3d& v) const {
  // dR/d(rpy_i) = [axis_i]x R, so d(R' v) = R' (v x axis_i).
  Matrix3d out;
  for (int i = 0; i < 3; ++i) out.col(i) = v.cross(axes_W.col(i));
  return rotation.transpose() * out;
}

Motion::Motion(const FixedSequence& fixed)
    : fixed_(&fixed),
      instants_(fixed.problem().options.interior_points + 2),
      phases_(fixed.steps()),
      knots_(fixed.steps() + 1) {
  for (OfPhase& phase : phases_) {
    phase.inside.resize(instants_ - 2);
    phase.poses.resize(instants_);
    phase.defect.resize(fixed.nx());
  }
}

bool Motion::evaluate(const Pendulum& pendulum) {
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const int axes = at.axis_count();
  defect_sum_ = defect_max_ = 0.0;
  for (int k = 0; k <= fixed_->steps(); ++k)
    knots_[k].set(trajectory.x[k].segment<3>(at.com()), problem.rpy(trajectory.x[k]));
  for (int k = 0; k < fixed_->steps(); ++k) {
    OfPhase& phase = phases_[k];
    const VectorXd &x = trajectory.x[k], &u = trajectory.u[k], &next = trajectory.x[k + 1];
    const auto set_pose = [&](int i, const PendulumStep& step) {
      const Vector3d angle = phase.base.at(step.slope);
      Vector3d rpy = problem.base_rpy;
      for (int axis : at.axes()) rpy[axis] = angle[axis];
      phase.poses[i].set(step.com, rpy);
    };
    pendulum.step(x, u, 1.0, phase.end);
    const Pendulum::Drive drive = pendulum.drive(x, u);
    phase.base.set(pendulum, drive, phase.end);
    phase.poses[0] = knots_[k];
    for (int i = 1; i + 1 < instants_; ++i) {
      pendulum.sway(drive, x, u, static_cast<double>(i) / (instants_ - 1), phase.inside[i - 1]);
      set_pose(i, phase.inside[i - 1]);
    }
    set_pose(instants_ - 1, phase.end);
    VectorXd& d = phase.defect;
    d.segment<3>(at.com()) = phase.end.com;
    d.segment<3>(at.velocity()) = phase.end.velocity;
    d.segment(at.angle(), axes) = phase.end.angle;
    d.segment(at.momentum(), axes) = phase.end.momentum;
    for (int l = 0; l < at.end_effector_count(); ++l)
      d.segment<3>(at.end(l)) = x.segment<3>(at.end(l)) + u.segment<3>(at.stride(l));
    d -= next;
    defect_sum_ += at.distance(d);
    defect_max_ = std::max(defect_max_, d.lpNorm<Eigen::Infinity>());
  }
  return std::isfinite(defect_sum_);
}

}  // namespace mcplan::ddp::polish
