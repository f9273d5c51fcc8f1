#include "mcplan/ddp/costs/costs.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;
using Eigen::VectorXd;

void make_instants(const Problem& problem, const Pendulum& pendulum, const VectorXd& x, const VectorXd& u,
                   bool with_gradient, PendulumStep& s, std::vector<Instant>& out) {
  const Layout& at = problem.layout;
  const int nx = at.nx(), axes = at.axis_count();
  const int count = problem.options.interior_points + 2;
  out.resize(count);
  for (int i = 0; i < count; ++i) {
    Instant& instant = out[i];
    instant.fraction = static_cast<double>(i) / (count - 1);
    instant.rpy = problem.base_rpy;
    if (!with_gradient) {
      // A line search evaluates many of these; the derivatives are most of the work.
      instant.com = pendulum.com_at(x, u, instant.fraction);
      for (int a = 0; a < axes; ++a) instant.rpy[at.axes()[a]] = pendulum.angle_at(x, u, instant.fraction, a);
      continue;
    }
    pendulum.step(x, u, instant.fraction, s);
    instant.com = s.com;
    for (int a = 0; a < axes; ++a) instant.rpy[at.axes()[a]] = s.angle[a];
    auto& jc = instant.com_jacobian;
    jc.setZero(3, at.nz());
    jc.middleCols<3>(at.com()).diagonal().setConstant(s.pp);
    jc.middleCols<3>(at.velocity()).diagonal().setConstant(s.pv);
    for (int l = 0; l < at.ends(); ++l) {
      jc.middleCols<3>(at.end(l)).diagonal().setConstant(s.p_end * s.mu[l]);
      jc.col(nx + at.stiffness(l)) = s.p_mu.col(l);
    }
    jc.col(nx + at.duration()) = s.slope * s.velocity;
    auto& ja = instant.angle_jacobian;
    ja.setZero(axes, at.nz());
    for (int a = 0; a < axes; ++a) {
      ja(a, at.angle(a)) = 1.0;
      ja(a, at.rate(a)) = s.duration;
      ja(a, nx + at.duration()) = s.slope * s.rate[a];
    }
    for (int m = 0; m < at.moment_count(); ++m)
      ja(at.moments()[m].axis, nx + at.moment(m)) = 0.5 * s.duration * s.duration * s.per_moment[m];
  }
}

}  // namespace mcplan::ddp
