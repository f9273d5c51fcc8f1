#include "ddp/pendulum.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/base_rotation.hpp"
#include "ddp/step_jacobian.hpp"

namespace mcplan::ddp {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// The matrix of  x -> x cross w.
Matrix3d cross_with(const Vector3d& w) {
  Matrix3d m;
  m << 0.0, w[2], -w[1], -w[2], 0.0, w[0], w[1], -w[0], 0.0;
  return m;
}

}  // namespace

Pendulum::Pendulum(const Layout& layout, const Vector3d& inertia, StiffnessInput input, Model model)
    : layout_(layout), inertia_(inertia), input_(input), model_(model) {}

double Pendulum::mu(const VectorXd& u, int l) const {
  const double value = u[layout_.stiffness(l)];
  return input_ == StiffnessInput::lambda ? value * value : value;
}

Pendulum::Drive Pendulum::drive(const VectorXd& x, const VectorXd& u) const {
  Drive d;
  d.p = x.segment<3>(layout_.com());
  d.v = x.segment<3>(layout_.velocity());
  d.pull = Vector3d::UnitZ();
  d.angle.setZero();
  d.momentum.setZero();
  d.rho.setZero();
  d.kappa.setZero();
  for (int a = 0; a < layout_.axis_count(); ++a) {
    d.angle[layout_.axes()[a]] = x[layout_.angle(a)];
    d.momentum[layout_.axes()[a]] = x[layout_.momentum(a)];
  }
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    const double m = mu(u, l);
    const Vector3d acting = layout_.acting_point(x, u, l), line = layout_.line_offset(u, l);
    d.total += m;
    d.pull += m * (acting + line);
    d.rho += m * line;
    d.kappa -= m * acting.cross(line);
  }
  for (int i = 0; i < layout_.moment_count(); ++i) d.kappa += u[layout_.moment(i)] * layout_.moments()[i].direction_W;
  d.acceleration = d.total * d.p - d.pull;
  return d;
}

Vector3d Pendulum::momentum_at(const Drive& d, const EntireFunctions& f, double t) const {
  if (model_ == Model::lipm) return d.momentum + t * d.kappa;
  const Vector3d travelled = t * d.p + t * t * (f(2) * d.v + t * f(3) * d.acceleration);
  return d.momentum + travelled.cross(d.rho) + t * d.kappa;
}

void Pendulum::Course::at(double t, Vector3d& com, Vector3d& angle) const {
  const Drive& d = drive_;
  const EntireFunctions f(d.total * t * t);
  com = d.p + t * f(1) * d.v + t * t * f(2) * d.acceleration;
  if (pendulum_->model_ == Model::lipm) {
    angle = d.angle + (t * d.momentum + 0.5 * t * t * d.kappa).cwiseQuotient(pendulum_->inertia_);
    return;
  }
  const EntireFunctions half(0.25 * d.total * t * t);
  angle = turning_.rpy(pendulum_->momentum_at(d, half, 0.5 * t), pendulum_->momentum_at(d, f, t), t);
}

Vector3d Pendulum::Course::velocity(double t) const {
  const EntireFunctions f(drive_.total * t * t);
  return f(0) * drive_.v + t * f(1) * drive_.acceleration;
}

/// dL(t)/dz.
void Pendulum::momentum_jacobian(const Drive& d, const VectorXd& x, const VectorXd& u, const Time& time,
                                 Eigen::Ref<Eigen::Matrix3Xd> out) const {
  const EntireFunctions& f = time.f;
  const double t = time.t, slope = time.slope;
  const int nx = layout_.nx();
  const double t2 = t * t, t3 = t2 * t;
  const double end = -t3 * f(3);  // dP/ds_l = end * mu_l
  const Vector3d travelled = t * d.p + t2 * f(2) * d.v + t3 * f(3) * d.acceleration;
  const Vector3d stiffer = t2 * (t2 * f.derivative(2) * d.v + t3 * f.derivative(3) * d.acceleration);
  out.middleCols<3>(layout_.com()) = cross_with(t * f(1) * d.rho);
  out.middleCols<3>(layout_.velocity()) = cross_with(t2 * f(2) * d.rho);
  for (int a = 0; a < layout_.axis_count(); ++a) out(layout_.axes()[a], layout_.momentum(a)) = 1.0;
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    const double m = mu(u, l);
    const Vector3d acting = layout_.acting_point(x, u, l), line = layout_.line_offset(u, l);
    const Matrix3d shift = cross_with(m * (end * d.rho - t * line));
    out.middleCols<3>(layout_.end(l)) = shift;
    if (const int n = layout_.pressure_count(l); n > 0)
      out.middleCols(nx + layout_.pressure(l), n).noalias() = shift * layout_.offsets(l).pressure;
    if (const int n = layout_.force_line_count(l); n > 0)
      out.middleCols(nx + layout_.force_line(l), n).noalias() =
          cross_with(m * (end * d.rho - travelled + t * acting)) * layout_.offsets(l).force_line;
    const double chain = input_ == StiffnessInput::lambda ? 2.0 * u[layout_.stiffness(l)] : 1.0;
    const Vector3d by_mu = stiffer - end * (d.p - acting - line);
    out.col(nx + layout_.stiffness(l)) = chain * (by_mu.cross(d.rho) + (travelled - t * acting).cross(line));
  }
  for (int i = 0; i < layout_.moment_count(); ++i)
    out.col(nx + layout_.moment(i)) = t * layout_.moments()[i].direction_W;
  const Vector3d there = d.p + t * f(1) * d.v + t2 * f(2) * d.acceleration;
  out.col(nx + layout_.duration()) = slope * (there.cross(d.rho) + d.kappa);
}

/// theta+, L+ and their derivatives.
void Pendulum::turn_rows(const Drive& d, const VectorXd& x, const VectorXd& u, const EntireFunctions& f,
                         PendulumStep& s) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  const double t = s.duration;
  if (s.turn.rows() != 2 * axes || s.turn.cols() != layout_.nz()) s.turn.setZero(2 * axes, layout_.nz());
  s.angle.resize(axes);
  s.momentum.resize(axes);
  if (model_ == Model::lipm) {
    s.angle_inverse.setIdentity(axes, axes);
    for (int a = 0; a < axes; ++a) {
      const int axis = layout_.axes()[a];
      const double inverse = 1.0 / inertia_[axis];
      s.momentum[a] = d.momentum[axis] + t * d.kappa[axis];
      s.angle[a] = d.angle[axis] + inverse * t * (d.momentum[axis] + 0.5 * t * d.kappa[axis]);
      s.turn(a, layout_.angle(a)) = s.turn(axes + a, layout_.momentum(a)) = 1.0;
      s.turn(a, layout_.momentum(a)) = inverse * t;
      s.turn(a, nx + layout_.duration()) = s.slope * inverse * s.momentum[a];
      s.turn(axes + a, nx + layout_.duration()) = s.slope * d.kappa[axis];
      for (int i = 0; i < layout_.moment_count(); ++i) {
        const double along = layout_.moments()[i].direction_W[axis];
        s.turn(a, nx + layout_.moment(i)) = inverse * 0.5 * t * t * along;
        s.turn(axes + a, nx + layout_.moment(i)) = t * along;
      }
    }
    return;
  }
  const EntireFunctions half(0.25 * d.total * t * t);
  s.momentum = momentum_at(d, f, t);
  BaseRotation::Derivatives turned;
  BaseRotation(d.angle, d.momentum, inertia_).differentiate(momentum_at(d, half, 0.5 * t), s.momentum, t, turned);
  s.angle = turned.rpy;
  s.angle_inverse = turned.d_rpy.inverse();
  auto angle = s.turn.topRows<3>();
  auto momentum = s.turn.bottomRows<3>();
  if (by_middle_.cols() != layout_.nz()) by_middle_.setZero(3, layout_.nz());
  if (by_end_.cols() != layout_.nz()) by_end_.setZero(3, layout_.nz());
  momentum_jacobian(d, x, u, {half, 0.5 * t, 0.5 * s.slope}, by_middle_);
  momentum_jacobian(d, x, u, {f, t, s.slope}, by_end_);
  momentum = by_end_;
  angle.noalias() = turned.d_middle * by_middle_;
  angle.noalias() += turned.d_end * by_end_;
  angle.middleCols<3>(layout_.angle()) += turned.d_rpy;
  angle.middleCols<3>(layout_.momentum()) += turned.d_begin;
  angle.col(nx + layout_.duration()) += s.slope * turned.d_duration;
}

RpyRate Pendulum::base_rate(const Vector3d& angle, const Vector3d& momentum) const {
  if (model_ == Model::wrench) return rpy_rate_derivatives(angle, momentum, inertia_);
  return {momentum.cwiseQuotient(inertia_), Matrix3d::Zero(), inertia_.cwiseInverse().asDiagonal()};
}

void Pendulum::step(const VectorXd& x, const VectorXd& u, double fraction, PendulumStep& s) const {
  const Drive d = drive(x, u);
  turn_rows(d, x, u, sway(d, x, u, fraction, s), s);
}

EntireFunctions Pendulum::sway(const Drive& d, const VectorXd& x, const VectorXd& u, double fraction,
                               PendulumStep& s) const {
  const int end_effectors = layout_.end_effector_count();
  s.mu.resize(end_effectors);
  s.p_mu.resize(3, end_effectors);
  s.v_mu.resize(3, end_effectors);
  s.slope = fraction;
  s.duration = fraction * u[layout_.duration()];
  const double t = s.duration, t2 = t * t;
  const EntireFunctions f(d.total * t2);

  s.pp = f(0);
  s.pv = t * f(1);
  s.vp = d.total * t * f(1);
  s.p_end = -t2 * f(2);
  s.v_end = -t * f(1);
  s.com = d.p + t * f(1) * d.v + t2 * f(2) * d.acceleration;
  s.velocity = f(0) * d.v + t * f(1) * d.acceleration;
  s.acceleration = d.total * s.com - d.pull;
  const double d0 = f.derivative(0) * t2, d1 = f.derivative(1) * t2, d2 = f.derivative(2) * t2;
  for (int l = 0; l < end_effectors; ++l) {
    s.mu[l] = mu(u, l);
    const Vector3d lever = d.p - layout_.line_point(x, u, l);
    const double chain = input_ == StiffnessInput::lambda ? 2.0 * u[layout_.stiffness(l)] : 1.0;
    s.p_mu.col(l) = chain * (t * d1 * d.v + t2 * d2 * d.acceleration + t2 * f(2) * lever);
    s.v_mu.col(l) = chain * (d0 * d.v + t * d1 * d.acceleration + t * f(1) * lever);
  }
  return f;
}

void Pendulum::next(const VectorXd& x, const VectorXd& u, VectorXd& x_next) const {
  const double h = u[layout_.duration()];
  const Drive d = drive(x, u);
  const EntireFunctions f(d.total * h * h);
  x_next.resize(layout_.nx());
  x_next.segment<3>(layout_.velocity()) = f(0) * d.v + h * f(1) * d.acceleration;
  Vector3d com, angle;
  Course(*this, d).at(h, com, angle);
  const Vector3d momentum = momentum_at(d, f, h);
  x_next.segment<3>(layout_.com()) = com;
  for (int a = 0; a < layout_.axis_count(); ++a) {
    x_next[layout_.angle(a)] = angle[layout_.axes()[a]];
    x_next[layout_.momentum(a)] = momentum[layout_.axes()[a]];
  }
  for (int l = 0; l < layout_.end_effector_count(); ++l)
    x_next.segment<3>(layout_.end(l)) = x.segment<3>(layout_.end(l)) + u.segment<3>(layout_.stride(l));
}

void Pendulum::previous(const VectorXd& x_next, const VectorXd& u, VectorXd& x) const {
  // The end-effectors first: the pendulum swings about where they were at the start of the phase.
  const double h = u[layout_.duration()];
  VectorXd from = x_next, back = u;
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    from.segment<3>(layout_.end(l)) -= u.segment<3>(layout_.stride(l));
    back.segment<3>(layout_.stride(l)).setZero();
  }
  back[layout_.duration()] = -h;
  next(from, back, x);
  if (model_ == Model::lipm) return;
  // A Runge-Kutta step backwards nearly undoes one forwards; Newton's method does the rest.
  const Drive d = drive(x, u);
  const EntireFunctions f(d.total * h * h), half(0.25 * d.total * h * h);
  const Vector3d middle = momentum_at(d, half, 0.5 * h), end = momentum_at(d, f, h);
  BaseRotation::Derivatives turned;
  for (int i = 0; i < 4; ++i) {
    BaseRotation(x.segment<3>(layout_.angle()), d.momentum, inertia_).differentiate(middle, end, h, turned);
    x.segment<3>(layout_.angle()) -= turned.d_rpy.inverse() * (turned.rpy - x_next.segment<3>(layout_.angle()));
  }
}

void Pendulum::apply(const PendulumStep& s, const VectorXd& dx, const VectorXd& du, VectorXd& out) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  out.resize(nx);
  const double dt = s.slope * du[layout_.duration()];
  const Vector3d dp = dx.segment<3>(layout_.com()), dv = dx.segment<3>(layout_.velocity());
  Vector3d p = s.pp * dp + s.pv * dv + dt * s.velocity;
  Vector3d v = s.vp * dp + s.pp * dv + dt * s.acceleration;
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    const Vector3d end = dx.segment<3>(layout_.end(l));
    const Vector3d line = end + layout_.pressure_offset(du, l) + layout_.line_offset(du, l);
    const double dm = du[layout_.stiffness(l)];
    p += s.p_end * s.mu[l] * line + dm * s.p_mu.col(l);
    v += s.v_end * s.mu[l] * line + dm * s.v_mu.col(l);
    out.segment<3>(layout_.end(l)) = end + du.segment<3>(layout_.stride(l));
  }
  out.segment<3>(layout_.com()) = p;
  out.segment<3>(layout_.velocity()) = v;
  if (axes == 0) return;
  out.segment(layout_.angle(), 2 * axes).noalias() = s.turn.leftCols(nx) * dx;
  out.segment(layout_.angle(), 2 * axes).noalias() += s.turn.rightCols(layout_.nu()) * du;
}

void Pendulum::add_transposed(const PendulumStep& s, const VectorXd& w, Eigen::Ref<VectorXd> g) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  const Vector3d p = w.segment<3>(layout_.com()), v = w.segment<3>(layout_.velocity());
  g.segment<3>(layout_.com()) += s.pp * p + s.vp * v;
  g.segment<3>(layout_.velocity()) += s.pv * p + s.pp * v;
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    const Vector3d end = w.segment<3>(layout_.end(l));
    layout_.add_along_line_point(l, s.mu[l] * (s.p_end * p + s.v_end * v), g);
    g.segment<3>(layout_.end(l)) += end;
    g.segment<3>(nx + layout_.stride(l)) += end;
    g[nx + layout_.stiffness(l)] += s.p_mu.col(l).dot(p) + s.v_mu.col(l).dot(v);
  }
  g[nx + layout_.duration()] += s.slope * (s.velocity.dot(p) + s.acceleration.dot(v));
  if (axes > 0) g.noalias() += s.turn.transpose() * w.segment(layout_.angle(), 2 * axes);
}

void Pendulum::add_along(const PendulumStep& s, const Vector3d& along_com, const Vector3d& along_angle,
                         Eigen::Ref<VectorXd> g) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  g.segment<3>(layout_.com()) += s.pp * along_com;
  g.segment<3>(layout_.velocity()) += s.pv * along_com;
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    layout_.add_along_line_point(l, s.mu[l] * s.p_end * along_com, g);
    g[nx + layout_.stiffness(l)] += s.p_mu.col(l).dot(along_com);
  }
  g[nx + layout_.duration()] += s.slope * s.velocity.dot(along_com);
  if (axes > 0 && !along_angle.isZero(0.0)) g.noalias() += s.turn.topRows(axes).transpose() * along_angle.head(axes);
}

void Pendulum::add_along_velocity(const PendulumStep& s, const Vector3d& along, Eigen::Ref<VectorXd> g) const {
  const int nx = layout_.nx();
  g.segment<3>(layout_.com()) += s.vp * along;
  g.segment<3>(layout_.velocity()) += s.pp * along;
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    layout_.add_along_line_point(l, s.mu[l] * s.v_end * along, g);
    g[nx + layout_.stiffness(l)] += s.v_mu.col(l).dot(along);
  }
  g[nx + layout_.duration()] += s.slope * s.acceleration.dot(along);
}

void Pendulum::substitute_inverse(const PendulumStep& s, MatrixXd& m) const {
  const int nx = layout_.nx(), axes = layout_.axis_count();
  // theta and L depend on everything, nothing else on them: their columns first.
  if (axes > 0) {
    auto angles = m.middleCols(layout_.angle(), axes);
    auto momenta = m.middleCols(layout_.momentum(), axes);
    turned_ = m.middleCols(layout_.angle(), 2 * axes);
    turned_.leftCols(axes).noalias() = angles * s.angle_inverse;
    turned_.rightCols(axes).noalias() -= turned_.leftCols(axes) * s.turn.block(0, layout_.momentum(), axes, axes);
    m.noalias() -= turned_.lazyProduct(s.turn);
    angles = turned_.leftCols(axes);
    momenta = turned_.rightCols(axes);
  }
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
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    pushed_ = (s.p_end * s.mu[l]) * yp + (s.v_end * s.mu[l]) * yv;
    m.middleCols<3>(layout_.end(l)) -= pushed_;
    m.middleCols<3>(nx + layout_.stride(l)) -= m.middleCols<3>(layout_.end(l));
    if (const int n = layout_.pressure_count(l); n > 0)
      m.middleCols(nx + layout_.pressure(l), n).noalias() -= pushed_.lazyProduct(layout_.offsets(l).pressure);
    if (const int n = layout_.force_line_count(l); n > 0)
      m.middleCols(nx + layout_.force_line(l), n).noalias() -= pushed_.lazyProduct(layout_.offsets(l).force_line);
    m.col(nx + layout_.stiffness(l)) -= yp * s.p_mu.col(l) + yv * s.v_mu.col(l);
  }
  m.col(nx + layout_.duration()) -= s.slope * (yp * s.velocity + yv * s.acceleration);
}

void Pendulum::apply_inverse(const PendulumStep& s, const VectorXd& w, VectorXd& out) const {
  const int axes = layout_.axis_count();
  out = w;
  Vector3d p = w.segment<3>(layout_.com()), v = w.segment<3>(layout_.velocity());
  for (int l = 0; l < layout_.end_effector_count(); ++l) {
    const Vector3d end = w.segment<3>(layout_.end(l));
    p -= s.p_end * s.mu[l] * end;
    v -= s.v_end * s.mu[l] * end;
  }
  out.segment<3>(layout_.com()) = s.pp * p - s.pv * v;
  out.segment<3>(layout_.velocity()) = -s.vp * p + s.pp * v;
  if (axes == 0) return;
  auto angle = out.segment(layout_.angle(), axes);
  auto momentum = out.segment(layout_.momentum(), axes);
  angle.setZero();
  momentum.setZero();
  const VectorXd rest = w.segment(layout_.angle(), 2 * axes) - s.turn.leftCols(layout_.nx()) * out;
  momentum = rest.tail(axes);
  angle = s.angle_inverse * (rest.head(axes) - s.turn.block(0, layout_.momentum(), axes, axes) * momentum);
}

MatrixXd Pendulum::dense_jacobian(const PendulumStep& s) const {
  StepJacobian jacobian;
  jacobian.make(layout_, s);
  return jacobian.dense();
}

}  // namespace mcplan::ddp
