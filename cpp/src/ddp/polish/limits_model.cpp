#include <array>

#include "ddp/polish/limits.hpp"

/// The rows to second order, as a part of a knot's quadratic, and along a step.
namespace mcplan::ddp::polish {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Columns of the line point s_l = p_l + c_l + r_l in Phase::moving, and how it moves with them.
struct LineColumns {
  int count = 0;
  std::array<int, 9> column{};
  Eigen::Matrix<double, 3, 9> by;

  LineColumns(const Standing& s, const Layout::Offsets& offsets) {
    for (int i = 0; i < 3; ++i) push(s.end + i, Vector3d::Unit(i));
    for (int i = 0; i < s.pressure_count; ++i) push(s.pressure + i, offsets.pressure.col(i));
    for (int i = 0; i < s.line_count; ++i) push(s.line + i, offsets.force_line.col(i));
  }
  void push(int c, const Vector3d& direction) {
    column[count] = c;
    by.col(count++) = direction;
  }
};

/// Sums over the force rows of a contact, at one instant or several: weights D times products of gradients, multipliers
/// times gradients, by d, the stiffness input and the moments.
struct ForceSums {
  Matrix3d dd = Matrix3d::Zero();
  Vector3d d_mu = Vector3d::Zero(), d = Vector3d::Zero();
  double mu_mu = 0.0, mu = 0.0;
  Matrix3d d_tau = Matrix3d::Zero();
  Vector3d mu_tau = Vector3d::Zero(), tau_tau = Vector3d::Zero(), tau = Vector3d::Zero();

  void add(double y, double w, const Vector3d& by_d, double by_mu, int moment, double by_tau) {
    const Vector3d scaled = w * by_d;
    dd.noalias() += scaled * by_d.transpose();
    d += y * by_d;
    if (by_mu != 0.0) {
      d_mu += by_mu * scaled;
      mu_mu += w * by_mu * by_mu;
      mu += y * by_mu;
    }
    if (moment < 0) return;
    d_tau.col(moment) += by_tau * scaled;
    mu_tau[moment] += w * by_mu * by_tau;
    tau_tau[moment] += w * by_tau * by_tau;
    tau[moment] += y * by_tau;
  }
  void add(const ForceSums& o) {
    dd += o.dd;
    d_mu += o.d_mu;
    d += o.d;
    mu_mu += o.mu_mu;
    mu += o.mu;
    d_tau += o.d_tau;
    mu_tau += o.mu_tau;
    tau_tau += o.tau_tau;
    tau += o.tau;
  }
  /// What does not go through the body's pose: half of the Hessian, and the gradient.
  void add_to(const Standing& s, const OfContact& of, const LineColumns& line, MatrixXd& half, VectorXd& g) const {
    for (int a = 0; a < line.count; ++a) {
      const Vector3d by = line.by.col(a), acted = dd * by;
      const int column = line.column[a];
      g[column] -= by.dot(d);
      for (int b = 0; b < line.count; ++b) half(column, line.column[b]) += 0.5 * acted.dot(line.by.col(b));
      half(column, s.stiffness) -= by.dot(d_mu);
      for (int j = 0; j < of.moments; ++j) half(column, s.moment + j) -= by.dot(d_tau.col(j));
    }
    half(s.stiffness, s.stiffness) += 0.5 * mu_mu;
    g[s.stiffness] += mu;
    for (int j = 0; j < of.moments; ++j) {
      half(s.stiffness, s.moment + j) += mu_tau[j];
      half(s.moment + j, s.moment + j) += 0.5 * tau_tau[j];
      g[s.moment + j] += tau[j];
    }
  }
};

/// The same over the reach rows of an end-effector, by e = p_l - p and the angles of the base.
struct ReachSums {
  Matrix3d ee = Matrix3d::Zero(), er = Matrix3d::Zero(), rr = Matrix3d::Zero();
  Vector3d e = Vector3d::Zero(), r = Vector3d::Zero();

  void add(const BodyPose& pose, const Vector3d& end, const EndLimits& limit, int& row, const RowArray& y,
           const RowArray& w) {
    Matrix3d weight = Matrix3d::Zero();
    Vector3d multiplier;
    for (int i = 0; i < 3; ++i, row += 2) {
      weight(i, i) = w[row] + w[row + 1];
      multiplier[i] = y[row] - y[row + 1];
    }
    for (int i = 0; i < limit.cuts; ++i, ++row) {
      const Vector3d n = limit.cut_A.row(i).transpose();
      weight += w[row] * n * n.transpose();
      multiplier += y[row] * n;
    }
    const Matrix3d turned = pose.turned(end - pose.com);
    const Matrix3d scaled = pose.rotation * weight;
    ee += scaled * pose.rotation.transpose();
    er += scaled * turned;
    rr += turned.transpose() * weight * turned;
    e += pose.rotation * multiplier;
    r += turned.transpose() * multiplier;
  }
  /// By the body's pose alone.
  void add_to(Matrix6d& pose) const {
    pose.topLeftCorner<3, 3>() += ee;
    pose.topRightCorner<3, 3>() -= er;
    pose.bottomLeftCorner<3, 3>() -= er.transpose();
    pose.bottomRightCorner<3, 3>() += rr;
  }
};

}  // namespace

/// d(com, angles)/d(moving) at the instants after the first, six rows each.
void Limits::lift(const Motion& motion, int k) {
  const Layout& at = fixed_->problem().layout;
  const Phase& phase = fixed_->phase(k);
  MatrixXd& out = phases_[k].lifted;
  // Angles and momenta at the end of the phase, by axis.
  end_turn_.setZero(6, static_cast<int>(phase.moving.size()));
  for (std::size_t j = 0; j < phase.full.size(); ++j)
    for (int a = 0; a < at.axis_count(); ++a) {
      end_turn_(at.axes()[a], static_cast<int>(j)) = motion.end(k).turn(a, phase.full[j]);
      end_turn_(3 + at.axes()[a], static_cast<int>(j)) = motion.end(k).turn(at.axis_count() + a, phase.full[j]);
    }
  for (int i = 1; i < motion.instants(); ++i) {
    const PendulumStep& step = i + 1 < motion.instants() ? motion.inside(k, i) : motion.end(k);
    auto block = out.middleRows<6>(6 * (i - 1));
    for (int j = 0; j < 3; ++j) {
      block(j, Layout::com() + j) = step.pp;
      block(j, Layout::velocity() + j) = step.pv;
    }
    for (const Standing& s : phase.standing) {
      const double pushed = step.p_end * step.mu[s.l];
      for (int j = 0; j < 3; ++j) block(j, s.end + j) = pushed;
      if (s.pressure_count > 0) block.block(0, s.pressure, 3, s.pressure_count) = pushed * at.offsets(s.l).pressure;
      if (s.line_count > 0) block.block(0, s.line, 3, s.line_count) = pushed * at.offsets(s.l).force_line;
      block.col(s.stiffness).head<3>() = step.p_mu.col(s.l);
    }
    block.col(phase.duration).head<3>() = step.slope * step.velocity;
    auto turn = block.bottomRows<3>();
    if (i + 1 == motion.instants()) {
      turn = end_turn_.topRows<3>();
      continue;
    }
    const BaseCourse::Derivatives by = motion.base(k).derivatives(step.slope);
    turn.noalias() = by.end.lazyProduct(end_turn_);
    for (int a = 0; a < at.axis_count(); ++a) {
      turn.col(at.angle(a)) += by.begin_angle.col(at.axes()[a]);
      turn.col(at.momentum(a)) += by.begin_momentum.col(at.axes()[a]);
    }
    turn.col(phase.duration) += by.duration;
  }
}

void Limits::add_knot_reach(const Motion& motion, int k, const RowArray& y, const RowArray& d,
                            StageModel& model) const {
  const Layout& at = fixed_->problem().layout;
  int row = phases_[k].reach;
  if (row < 0) return;
  const BodyPose& pose = motion.knot(k);
  ReachSums all;
  for (int l = 0; l < at.end_effector_count(); ++l) {
    ReachSums of;
    const int end = at.end(l);
    of.add(pose, motion.trajectory.x[k].segment<3>(end), fixed_->problem().limits[l], row, y, d);
    model.g.segment<3>(end) += of.e;
    model.h.block<3, 3>(end, end) += of.ee;
    model.h.block<3, 3>(end, Layout::com()) -= of.ee;
    model.h.block<3, 3>(Layout::com(), end) -= of.ee;
    for (int a = 0; a < at.axis_count(); ++a) {
      model.h.block<3, 1>(end, at.angle(a)) += of.er.col(at.axes()[a]);
      model.h.block<1, 3>(at.angle(a), end) += of.er.col(at.axes()[a]).transpose();
    }
    all.ee += of.ee;
    all.er += of.er;
    all.rr += of.rr;
    all.e += of.e;
    all.r += of.r;
  }
  model.g.segment<3>(Layout::com()) -= all.e;
  model.h.block<3, 3>(Layout::com(), Layout::com()) += all.ee;
  for (int a = 0; a < at.axis_count(); ++a) {
    const int axis = at.axes()[a];
    model.g[at.angle(a)] += all.r[axis];
    model.h.block<3, 1>(Layout::com(), at.angle(a)) -= all.er.col(axis);
    model.h.block<1, 3>(at.angle(a), Layout::com()) -= all.er.col(axis).transpose();
    for (int b = 0; b < at.axis_count(); ++b) model.h(at.angle(a), at.angle(b)) += all.rr(axis, at.axes()[b]);
  }
}

void Limits::add_linear(int k, const RowArray& y, const RowArray& d, StageModel& model) const {
  for (const Linear& row : phases_[k].linear) {
    const double weight = d[row.row] + (row.two_sided ? d[row.row + 1] : 0.0);
    const double multiplier = y[row.row] - (row.two_sided ? y[row.row + 1] : 0.0);
    for (int i = 0; i < row.count; ++i) {
      model.g[row.column[i]] += multiplier * row.factor[i];
      for (int j = 0; j < row.count; ++j)
        model.h(row.column[i], row.column[j]) += weight * row.factor[i] * row.factor[j];
    }
  }
}

/// The rows of a contact. With E_i = d(com, angles)/dz at instant i they add E'ME + E'X + X'E + what does not go
/// through the body's pose: M, X and half of the rest are collected, the Hessian gets the half and its transpose.
void Limits::add_contact(const Motion& motion, int k, std::size_t c, const RowArray& y, const RowArray& d) {
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const Standing& s = fixed_->phase(k).standing[c];
  const OfContact& of = phases_[k].contacts[c];
  const VectorXd &x = motion.trajectory.x[k], &u = motion.trajectory.u[k];
  const ForceView view(problem, *pendulum_, x, u, s, of);
  const LineColumns line(s, at.offsets(s.l));
  ForceSums all;
  int row = of.first;
  for (int i = 0; i < motion.instants(); ++i) {
    ForceSums f;
    visit_forces(view, motion.pose(k, i).com, row,
                 [&](int here, double, const Vector3d& by_d, double by_mu, int moment, double by_tau) {
                   f.add(y[here], d[here], by_d, by_mu, moment, by_tau);
                 });
    all.add(f);
    auto g = gradient_.segment<6>(6 * i);
    auto acting = acting_.middleRows<6>(6 * i);
    poses_[i].topLeftCorner<3, 3>() += f.dd;
    g.head<3>() += f.d;
    for (int j = 0; j < line.count; ++j) acting.col(line.column[j]).head<3>() -= f.dd * line.by.col(j);
    acting.col(s.stiffness).head<3>() += f.d_mu;
    for (int j = 0; j < of.moments; ++j) acting.col(s.moment + j).head<3>() += f.d_tau.col(j);
    if (of.yaw) {
      poses_[i](5, 5) += d[row] + d[row + 1];
      g[5] += y[row + 1] - y[row];
      row += 2;
    }
    if (i == 0 || i + 1 == motion.instants()) continue;
    ReachSums r;
    r.add(motion.pose(k, i), x.segment<3>(at.end(s.l)), problem.limits[s.l], row, y, d);
    r.add_to(poses_[i]);
    g.head<3>() -= r.e;
    g.tail<3>() += r.r;
    acting.block<3, 3>(0, s.end) -= r.ee;
    acting.block<3, 3>(3, s.end) += r.er.transpose();
    half_.block<3, 3>(s.end, s.end) += 0.5 * r.ee;
    beside_.segment<3>(s.end) += r.e;
  }
  all.add_to(s, of, line, half_, beside_);
}

void Limits::add(const Motion& motion, int k, const RowArray& y, const RowArray& d, StageModel& model) {
  add_linear(k, y, d, model);
  add_knot_reach(motion, k, y, d, model);
  if (k == fixed_->steps() || fixed_->phase(k).standing.empty()) return;
  const Layout& at = fixed_->problem().layout;
  const Phase& phase = fixed_->phase(k);
  const int instants = motion.instants(), columns = static_cast<int>(phase.moving.size());
  lift(motion, k);
  const MatrixXd& lifted = phases_[k].lifted;
  acting_.setZero(6 * instants, columns);  // M E / 2 + X, by instant; of the first one X alone
  gradient_.setZero(6 * instants);
  half_.setZero(columns, columns);
  beside_.setZero(columns);
  poses_.assign(instants, Matrix6d::Zero());  // M, by instant
  for (std::size_t c = 0; c < phase.standing.size(); ++c) add_contact(motion, k, c, y, d);
  for (int i = 1; i < instants; ++i)
    acting_.middleRows<6>(6 * i).noalias() += (0.5 * poses_[i]) * lifted.middleRows<6>(6 * (i - 1));
  half_.noalias() += lifted.transpose() * acting_.bottomRows(6 * (instants - 1));
  beside_.noalias() += lifted.transpose() * gradient_.tail(6 * (instants - 1));
  // At the first instant the pose is the state's own.
  std::array<int, 6> own{0, 1, 2, -1, -1, -1};
  for (int a = 0; a < at.axis_count(); ++a) own[3 + at.axes()[a]] = at.angle(a);
  for (int a = 0; a < 6; ++a) {
    if (own[a] < 0) continue;
    beside_[own[a]] += gradient_[a];
    half_.row(own[a]) += acting_.row(a);
    for (int b = 0; b < 6; ++b)
      if (own[b] >= 0) half_(own[a], own[b]) += 0.5 * poses_[0](a, b);
  }
  for (int a = 0; a < columns; ++a) {
    model.g[phase.moving[a]] += beside_[a];
    for (int b = 0; b < columns; ++b) model.h(phase.moving[b], phase.moving[a]) += half_(b, a) + half_(a, b);
  }
  legs_.add(motion, k, lifted, phases_[k].legs, y, d, model);
  joints_.add(motion, k, lifted, phases_[k].joints, y, d, model);
}

/// The rows of an end-effector's reach, where CoM and angles move so.
void Limits::reach_along(const BodyPose& pose, int l, const Vector3d& end, const Vector3d& d_end,
                         const Vector6d& d_pose, int& row, RowArray& out) const {
  const EndLimits& limit = fixed_->problem().limits[l];
  const Vector3d change =
      pose.rotation.transpose() * (d_end - d_pose.head<3>()) + pose.turned(end - pose.com) * d_pose.tail<3>();
  for (int i = 0; i < 3; ++i) {
    out[row++] = change[i];
    out[row++] = -change[i];
  }
  for (int i = 0; i < limit.cuts; ++i) out[row++] = limit.cut_A.row(i).dot(change);
}

void Limits::contact_along(const Motion& motion, int k, std::size_t c, const VectorXd& dz, RowArray& out) const {
  const Problem& problem = fixed_->problem();
  const VectorXd &x = motion.trajectory.x[k], &u = motion.trajectory.u[k];
  const Standing& s = fixed_->phase(k).standing[c];
  const OfContact& of = phases_[k].contacts[c];
  const ForceView view(problem, *pendulum_, x, u, s, of);
  const LineColumns line(s, problem.layout.offsets(s.l));
  const int end = problem.layout.end(s.l);
  Vector3d line_moved = Vector3d::Zero();
  for (int j = 0; j < line.count; ++j) line_moved += step_[line.column[j]] * line.by.col(j);
  const double stiffer = step_[s.stiffness];
  int row = of.first;
  for (int i = 0; i < motion.instants(); ++i) {
    const BodyPose& pose = motion.pose(k, i);
    const Vector6d moved = carried_.segment<6>(6 * i);
    const Vector3d turned = moved.head<3>() - line_moved;
    visit_forces(
        view, pose.com, row, [&](int here, double, const Vector3d& by_d, double by_mu, int moment, double by_tau) {
          out[here] = by_d.dot(turned) + by_mu * stiffer + (moment >= 0 ? by_tau * step_[s.moment + moment] : 0.0);
        });
    if (of.yaw) {
      out[row] = -moved[5];
      out[row + 1] = moved[5];
      row += 2;
    }
    if (i > 0 && i + 1 < motion.instants())
      reach_along(pose, s.l, x.segment<3>(end), dz.segment<3>(end), moved, row, out);
  }
}

void Limits::along(const Motion& motion, const std::vector<VectorXd>& dz, RowArray& out) {
  const Layout& at = fixed_->problem().layout;
  out.resize(count());
  carried_.resize(6 * motion.instants());
  for (int k = 0; k <= fixed_->steps(); ++k) {
    const OfPhase& of = phases_[k];
    for (const Linear& row : of.linear) {
      double change = 0.0;
      for (int i = 0; i < row.count; ++i) change += row.factor[i] * dz[k][row.column[i]];
      out[row.row] = change;
      if (row.two_sided) out[row.row + 1] = -change;
    }
    Vector6d moved = Vector6d::Zero();
    moved.head<3>() = dz[k].segment<3>(Layout::com());
    for (int a = 0; a < at.axis_count(); ++a) moved[3 + at.axes()[a]] = dz[k][at.angle(a)];
    if (int row = of.reach; row >= 0)
      for (int l = 0; l < at.end_effector_count(); ++l)
        reach_along(motion.knot(k), l, motion.trajectory.x[k].segment<3>(at.end(l)), dz[k].segment<3>(at.end(l)), moved,
                    row, out);
    if (k == fixed_->steps() || of.contacts.empty()) continue;
    const Phase& phase = fixed_->phase(k);
    step_.resize(static_cast<int>(phase.moving.size()));
    for (std::size_t j = 0; j < phase.moving.size(); ++j) step_[static_cast<int>(j)] = dz[k][phase.moving[j]];
    carried_.head<6>() = moved;
    carried_.tail(6 * (motion.instants() - 1)).noalias() = of.lifted * step_;
    for (std::size_t c = 0; c < phase.standing.size(); ++c) contact_along(motion, k, c, dz[k], out);
    legs_.along(k, dz[k], of.legs, out);
    joints_.along(k, dz[k], of.joints, out);
  }
}

}  // namespace mcplan::ddp::polish
