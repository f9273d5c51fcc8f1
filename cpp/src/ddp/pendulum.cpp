#include "mcplan/ddp/pendulum.hpp"

#include "mcplan/base/entire_functions.hpp"

namespace mcplan::ddp {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Pendulum::Pendulum(const Layout& layout, const Vector3d& inertia, StiffnessInput input)
    : layout_(layout), axis_inertia_(layout.axis_count()), input_(input) {
  for (int a = 0; a < layout.axis_count(); ++a) axis_inertia_[a] = inertia[layout.axes()[a]];
}

double Pendulum::mu(const VectorXd& u, int l) const {
  const double value = u[layout_.stiffness(l)];
  return input_ == StiffnessInput::lambda ? value * value : value;
}

Vector3d Pendulum::com_at(const VectorXd& x, const VectorXd& u, double fraction) const {
  const double tau = fraction * u[layout_.duration()];
  double total = 0.0;
  Vector3d pull = Vector3d::UnitZ();
  for (int l = 0; l < layout_.ends(); ++l) {
    const double m = mu(u, l);
    total += m;
    pull += m * x.segment<3>(layout_.end(l));
  }
  const auto p = x.segment<3>(layout_.com());
  const EntireFunctions f(total * tau * tau);
  return p + tau * f(1) * x.segment<3>(layout_.velocity()) + tau * tau * f(2) * (total * p - pull);
}

double Pendulum::angle_at(const VectorXd& x, const VectorXd& u, double fraction, int axis) const {
  const double tau = fraction * u[layout_.duration()];
  double moment = 0.0;
  for (int i = 0; i < layout_.moment_count(); ++i)
    if (layout_.moments()[i].axis == axis) moment += u[layout_.moment(i)];
  return x[layout_.angle(axis)] + tau * x[layout_.rate(axis)] + 0.5 * tau * tau * moment / axis_inertia_[axis];
}

void Pendulum::step(const VectorXd& x, const VectorXd& u, double fraction, PendulumStep& s) const {
  const int ends = layout_.ends(), axes = layout_.axis_count(), moments = layout_.moment_count();
  s.mu.resize(ends);
  s.p_mu.resize(3, ends);
  s.v_mu.resize(3, ends);
  s.slope = fraction;
  s.duration = fraction * u[layout_.duration()];
  const double t = s.duration, t2 = t * t;
  double total = 0.0;
  Vector3d pull = Vector3d::UnitZ();
  for (int l = 0; l < ends; ++l) {
    s.mu[l] = mu(u, l);
    total += s.mu[l];
    pull += s.mu[l] * x.segment<3>(layout_.end(l));
  }
  const Vector3d p = x.segment<3>(layout_.com()), v = x.segment<3>(layout_.velocity());
  const Vector3d a = total * p - pull;
  const EntireFunctions f(total * t2);

  s.pp = f(0);
  s.pv = t * f(1);
  s.vp = total * t * f(1);
  s.p_end = -t2 * f(2);
  s.v_end = -t * f(1);
  s.com = p + t * f(1) * v + t2 * f(2) * a;
  s.velocity = f(0) * v + t * f(1) * a;
  s.acceleration = total * s.com - pull;
  const double d0 = f.derivative(0) * t2, d1 = f.derivative(1) * t2, d2 = f.derivative(2) * t2;
  for (int l = 0; l < ends; ++l) {
    const Vector3d lever = p - x.segment<3>(layout_.end(l));
    const double chain = input_ == StiffnessInput::lambda ? 2.0 * u[layout_.stiffness(l)] : 1.0;
    s.p_mu.col(l) = chain * (t * d1 * v + t2 * d2 * a + t2 * f(2) * lever);
    s.v_mu.col(l) = chain * (d0 * v + t * d1 * a + t * f(1) * lever);
  }

  s.spin_up.setZero(axes);
  s.per_moment.resize(moments);
  for (int i = 0; i < moments; ++i) {
    const int axis = layout_.moments()[i].axis;
    s.per_moment[i] = 1.0 / axis_inertia_[axis];
    s.spin_up[axis] += s.per_moment[i] * u[layout_.moment(i)];
  }
  s.angle = x.segment(layout_.angle(), axes) + t * x.segment(layout_.rate(), axes) + 0.5 * t2 * s.spin_up;
  s.rate = x.segment(layout_.rate(), axes) + t * s.spin_up;
}

void Pendulum::next(const VectorXd& x, const VectorXd& u, VectorXd& x_next) const {
  const double h = u[layout_.duration()];
  double total = 0.0;
  Vector3d pull = Vector3d::UnitZ();
  for (int l = 0; l < layout_.ends(); ++l) {
    const double m = mu(u, l);
    total += m;
    pull += m * x.segment<3>(layout_.end(l));
  }
  const Vector3d p = x.segment<3>(layout_.com()), v = x.segment<3>(layout_.velocity());
  const Vector3d a = total * p - pull;
  const EntireFunctions f(total * h * h);
  x_next.resize(layout_.nx());
  x_next.segment<3>(layout_.com()) = p + h * f(1) * v + h * h * f(2) * a;
  x_next.segment<3>(layout_.velocity()) = f(0) * v + h * f(1) * a;
  const int axes = layout_.axis_count();
  x_next.segment(layout_.angle(), axes) = x.segment(layout_.angle(), axes) + h * x.segment(layout_.rate(), axes);
  x_next.segment(layout_.rate(), axes) = x.segment(layout_.rate(), axes);
  for (int i = 0; i < layout_.moment_count(); ++i) {
    const int axis = layout_.moments()[i].axis;
    const double spin_up = u[layout_.moment(i)] / axis_inertia_[axis];
    x_next[layout_.angle(axis)] += 0.5 * h * h * spin_up;
    x_next[layout_.rate(axis)] += h * spin_up;
  }
  for (int l = 0; l < layout_.ends(); ++l)
    x_next.segment<3>(layout_.end(l)) = x.segment<3>(layout_.end(l)) + u.segment<3>(layout_.stride(l));
}

void Pendulum::previous(const VectorXd& x_next, const VectorXd& u, VectorXd& x) const {
  // The end-effectors first: the pendulum swings about where they were at the start of the phase.
  VectorXd from = x_next, back = u;
  for (int l = 0; l < layout_.ends(); ++l) {
    from.segment<3>(layout_.end(l)) -= u.segment<3>(layout_.stride(l));
    back.segment<3>(layout_.stride(l)).setZero();
  }
  back[layout_.duration()] = -u[layout_.duration()];
  next(from, back, x);
}

void Pendulum::times_jacobian(const PendulumStep& s, const MatrixXd& m, MatrixXd& out) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  out.resize(m.rows(), layout_.nz());
  const auto mp = m.middleCols<3>(layout_.com());
  const auto mv = m.middleCols<3>(layout_.velocity());
  out.middleCols<3>(layout_.com()) = s.pp * mp + s.vp * mv;
  out.middleCols<3>(layout_.velocity()) = s.pv * mp + s.pp * mv;
  const auto angles = m.middleCols(layout_.angle(), axes);
  const auto rates = m.middleCols(layout_.rate(), axes);
  out.middleCols(layout_.angle(), axes) = angles;
  out.middleCols(layout_.rate(), axes) = rates + s.duration * angles;
  for (int l = 0; l < layout_.ends(); ++l) {
    const auto end = m.middleCols<3>(layout_.end(l));
    out.middleCols<3>(layout_.end(l)) = end + (s.p_end * s.mu[l]) * mp + (s.v_end * s.mu[l]) * mv;
    out.middleCols<3>(nx + layout_.stride(l)) = end;
    out.col(nx + layout_.stiffness(l)) = m.leftCols<3>() * s.p_mu.col(l) + mv * s.v_mu.col(l);
  }
  for (int i = 0; i < layout_.moment_count(); ++i) {
    const int axis = layout_.moments()[i].axis;
    out.col(nx + layout_.moment(i)) =
        s.per_moment[i] * s.duration * (0.5 * s.duration * m.col(layout_.angle(axis)) + m.col(layout_.rate(axis)));
  }
  out.col(nx + layout_.duration()) = s.slope * (mp * s.velocity + mv * s.acceleration);
  for (int a = 0; a < axes; ++a)
    out.col(nx + layout_.duration()) +=
        s.slope * (s.rate[a] * m.col(layout_.angle(a)) + s.spin_up[a] * m.col(layout_.rate(a)));
}

void Pendulum::apply(const PendulumStep& s, const VectorXd& dx, const VectorXd& du, VectorXd& out) const {
  const int axes = layout_.axis_count();
  out.resize(layout_.nx());
  const double dt = s.slope * du[layout_.duration()];
  const Vector3d dp = dx.segment<3>(layout_.com()), dv = dx.segment<3>(layout_.velocity());
  Vector3d p = s.pp * dp + s.pv * dv + dt * s.velocity;
  Vector3d v = s.vp * dp + s.pp * dv + dt * s.acceleration;
  for (int l = 0; l < layout_.ends(); ++l) {
    const Vector3d end = dx.segment<3>(layout_.end(l));
    const double dm = du[layout_.stiffness(l)];
    p += s.p_end * s.mu[l] * end + dm * s.p_mu.col(l);
    v += s.v_end * s.mu[l] * end + dm * s.v_mu.col(l);
    out.segment<3>(layout_.end(l)) = end + du.segment<3>(layout_.stride(l));
  }
  out.segment<3>(layout_.com()) = p;
  out.segment<3>(layout_.velocity()) = v;
  for (int a = 0; a < axes; ++a) {
    out[layout_.angle(a)] = dx[layout_.angle(a)] + s.duration * dx[layout_.rate(a)] + dt * s.rate[a];
    out[layout_.rate(a)] = dx[layout_.rate(a)] + dt * s.spin_up[a];
  }
  for (int i = 0; i < layout_.moment_count(); ++i) {
    const int axis = layout_.moments()[i].axis;
    const double change = s.per_moment[i] * s.duration * du[layout_.moment(i)];
    out[layout_.angle(axis)] += 0.5 * s.duration * change;
    out[layout_.rate(axis)] += change;
  }
}

void Pendulum::add_transposed(const PendulumStep& s, const VectorXd& w, VectorXd& g) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  const Vector3d p = w.segment<3>(layout_.com()), v = w.segment<3>(layout_.velocity());
  g.segment<3>(layout_.com()) += s.pp * p + s.vp * v;
  g.segment<3>(layout_.velocity()) += s.pv * p + s.pp * v;
  double along_time = s.velocity.dot(p) + s.acceleration.dot(v);
  for (int a = 0; a < axes; ++a) {
    g[layout_.angle(a)] += w[layout_.angle(a)];
    g[layout_.rate(a)] += w[layout_.rate(a)] + s.duration * w[layout_.angle(a)];
    along_time += s.rate[a] * w[layout_.angle(a)] + s.spin_up[a] * w[layout_.rate(a)];
  }
  for (int l = 0; l < layout_.ends(); ++l) {
    const Vector3d end = w.segment<3>(layout_.end(l));
    g.segment<3>(layout_.end(l)) += end + s.mu[l] * (s.p_end * p + s.v_end * v);
    g.segment<3>(nx + layout_.stride(l)) += end;
    g[nx + layout_.stiffness(l)] += s.p_mu.col(l).dot(p) + s.v_mu.col(l).dot(v);
  }
  for (int i = 0; i < layout_.moment_count(); ++i) {
    const int axis = layout_.moments()[i].axis;
    g[nx + layout_.moment(i)] +=
        s.per_moment[i] * s.duration * (0.5 * s.duration * w[layout_.angle(axis)] + w[layout_.rate(axis)]);
  }
  g[nx + layout_.duration()] += s.slope * along_time;
}

void Pendulum::substitute_inverse(const PendulumStep& s, MatrixXd& m) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  // The 2x2 block of p and v has determinant 1 (it is a flow of a linear Hamiltonian system), so its inverse swaps
  // signs.
  for (int i = 0; i < 3; ++i) {
    auto p = m.col(layout_.com() + i);
    auto v = m.col(layout_.velocity() + i);
    for (Eigen::Index r = 0; r < m.rows(); ++r) {
      const double mp = p[r], mv = v[r];
      p[r] = s.pp * mp - s.vp * mv;
      v[r] = -s.pv * mp + s.pp * mv;
    }
  }
  const auto yp = m.middleCols<3>(layout_.com());
  const auto yv = m.middleCols<3>(layout_.velocity());
  for (int a = 0; a < axes; ++a) m.col(layout_.rate(a)) -= s.duration * m.col(layout_.angle(a));
  for (int l = 0; l < layout_.ends(); ++l) {
    m.middleCols<3>(layout_.end(l)) -= (s.p_end * s.mu[l]) * yp + (s.v_end * s.mu[l]) * yv;
    m.middleCols<3>(nx + layout_.stride(l)) -= m.middleCols<3>(layout_.end(l));
    m.col(nx + layout_.stiffness(l)) -= yp * s.p_mu.col(l) + yv * s.v_mu.col(l);
  }
  for (int i = 0; i < layout_.moment_count(); ++i) {
    const int axis = layout_.moments()[i].axis;
    m.col(nx + layout_.moment(i)) -=
        s.per_moment[i] * s.duration * (0.5 * s.duration * m.col(layout_.angle(axis)) + m.col(layout_.rate(axis)));
  }
  m.col(nx + layout_.duration()) -= s.slope * (yp * s.velocity + yv * s.acceleration);
  for (int a = 0; a < axes; ++a)
    m.col(nx + layout_.duration()) -=
        s.slope * (s.rate[a] * m.col(layout_.angle(a)) + s.spin_up[a] * m.col(layout_.rate(a)));
}

void Pendulum::apply_inverse(const PendulumStep& s, const VectorXd& w, VectorXd& out) const {
  const int axes = layout_.axis_count();
  out = w;
  Vector3d p = w.segment<3>(layout_.com()), v = w.segment<3>(layout_.velocity());
  for (int l = 0; l < layout_.ends(); ++l) {
    const Vector3d end = w.segment<3>(layout_.end(l));
    p -= s.p_end * s.mu[l] * end;
    v -= s.v_end * s.mu[l] * end;
  }
  out.segment<3>(layout_.com()) = s.pp * p - s.pv * v;
  out.segment<3>(layout_.velocity()) = -s.vp * p + s.pp * v;
  for (int a = 0; a < axes; ++a) out[layout_.angle(a)] -= s.duration * w[layout_.rate(a)];
}

MatrixXd Pendulum::dense_jacobian(const PendulumStep& s) const {
  MatrixXd out;
  times_jacobian(s, MatrixXd::Identity(layout_.nx(), layout_.nx()), out);
  return out;
}

}  // namespace mcplan::ddp
