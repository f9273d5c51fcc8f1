#include "ddp/instants.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

void make_instants(const Problem& problem, const Pendulum& pendulum, const VectorXd& x, const VectorXd& u,
                   std::vector<Instant>& out) {
  const Layout& at = problem.layout;
  const int count = problem.options.interior_points + 2;
  const Pendulum::Course course(pendulum, pendulum.drive(x, u));
  out.resize(count);
  for (int i = 0; i < count; ++i) {
    Instant& instant = out[i];
    instant.fraction = static_cast<double>(i) / (count - 1);
    Vector3d angle;
    course.at(instant.fraction * u[at.duration()], instant.com, angle);
    instant.rpy = problem.base_rpy;
    for (int axis : at.axes()) instant.rpy[axis] = angle[axis];
    if (!problem.jointed.ends.empty()) instant.velocity = course.velocity(instant.fraction * u[at.duration()]);
    instant.pendulum = &pendulum;
    instant.x = &x;
    instant.u = &u;
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
