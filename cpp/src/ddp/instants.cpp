#include "ddp/instants.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

void Instants::of(const Problem& problem, const Pendulum& pendulum, const VectorXd& x, const VectorXd& u) {
  problem_ = &problem;
  pendulum_ = &pendulum;
  x_ = &x;
  u_ = &u;
  stale_ = true;
}

void Instants::make() const {
  stale_ = false;
  const Layout& at = problem_->layout;
  const int count = problem_->options.interior_points + 2;
  const Pendulum::Course course(*pendulum_, pendulum_->drive(*x_, *u_));
  made_.resize(count);
  for (int i = 0; i < count; ++i) {
    Instant& instant = made_[i];
    instant.fraction = static_cast<double>(i) / (count - 1);
    const double t = instant.fraction * (*u_)[at.duration()];
    Vector3d angle;
    course.at(t, instant.com, angle);
    instant.rpy = problem_->base_rpy;
    for (int axis : at.axes()) instant.rpy[axis] = angle[axis];
    if (!problem_->jointed.ends.empty()) instant.velocity = course.velocity(t);
    instant.pendulum = pendulum_;
    instant.x = x_;
    instant.u = u_;
    instant.stepped = false;
  }
}

void Instant::make_step() const {
  if (stepped) return;
  pendulum->step(*x, *u, fraction, step);
  stepped = true;
}

void Instant::add_along_velocity(const Vector3d& along, Eigen::Ref<VectorXd> g) const {
  make_step();
  pendulum->add_along_velocity(step, along, g);
}

void Instant::add_along(const Vector3d& along_com, const Vector3d& along_rpy, Eigen::Ref<VectorXd> g) const {
  make_step();
  const std::vector<int>& axes = pendulum->layout().axes();
  Vector3d along_angle = Vector3d::Zero();
  for (std::size_t a = 0; a < axes.size(); ++a) along_angle[a] = along_rpy[axes[a]];
  pendulum->add_along(step, along_com, along_angle, g);
}

}  // namespace mcplan::ddp
