#include "ddp/value_functions.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "ddp/elimination.hpp"

namespace mcplan::ddp {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ValueFunctions::ValueFunctions(LocalModel& model)
    : model_(&model),
      pendulum_(model.pendulum()),
      V_(model.steps() + 1),
      U_(model.steps() + 1),
      feedback_(model.steps()) {
  const int nx = model.problem().layout.nx();
  U_[0] = {0.0, VectorXd::Zero(nx), MatrixXd::Zero(nx, nx)};
}

/// Minimise a quadratic over z = [x, u] in u, of whose H the upper triangle is given: value over x. Undoes z.h.
bool ValueFunctions::solve(Quadratic& z, Quadratic& value, Feedback* feedback) {
  const Layout& at = model_->problem().layout;
  const int nx = at.nx(), nu = at.nu();
  if (!eliminate_last(z.h, nu)) return false;
  const auto factor = z.h.bottomRightCorner(nu, nu).triangularView<Eigen::Upper>();
  o_ = z.g.tail(nu);
  factor.solveInPlace(o_);
  value.c = z.c - 0.5 * o_.squaredNorm();
  value.g = z.g.head(nx);
  value.g.noalias() -= z.h.topRightCorner(nx, nu) * o_;
  value.h = z.h.topLeftCorner(nx, nx).selfadjointView<Eigen::Upper>();
  if (feedback) {
    feedback->factor = z.h.rightCols(nu);
    feedback->offset = o_;
  }
  return std::isfinite(value.c) && value.g.allFinite();
}

bool ValueFunctions::backward_step(int k, const ContactState& state, const Quadratic& next, Quadratic& value,
                                   Feedback* feedback) {
  const PendulumStep& dynamics = model_->dynamics(k);
  const VectorXd& defect = model_->defect(k);
  // V'(A dx + B du + defect), with J = [A B]: H = J'V'J.
  q_ = model_->base(k);
  jacobian_.make(pendulum_.layout(), dynamics);
  jacobian_.add_congruent(next.h, q_.h);
  w_ = next.g;
  w_.noalias() += next.h * defect;
  q_.c += next.c + 0.5 * defect.dot(next.g + w_);
  pendulum_.add_transposed(dynamics, w_, q_.g);
  if (feedback) feedback->without_contacts = q_;
  model_->add_contacts(k, state, q_);
  return solve(q_, value, feedback);
}

bool ValueFunctions::backward(const ContactSequence& sequence, int last) {
  const int n = model_->steps();
  if (last == n) {
    V_[n] = model_->base(n);
    model_->add_contacts(n, sequence[n], V_[n]);
    V_[n].mirror();
    --last;
  }
  for (int k = last; k >= 0; --k)
    if (!backward_step(k, sequence[k], V_[k + 1], V_[k], &feedback_[k])) return false;
  return true;
}

bool ValueFunctions::forward(const ContactSequence& sequence, int first) {
  const Layout& at = model_->problem().layout;
  const int nx = at.nx();
  for (int k = first; k < model_->steps(); ++k) {
    const PendulumStep& dynamics = model_->dynamics(k);
    q_ = model_->base(k);
    model_->add_contacts(k, sequence[k], q_);
    q_.mirror();
    q_.c += U_[k].c;
    q_.g.head(nx) += U_[k].g;
    q_.h.topLeftCorner(nx, nx) += U_[k].h;
    // x = A^-1 (x' - B u - defect): shift by -A^-1 defect, then substitute on both sides.
    pendulum_.apply_inverse(dynamics, model_->defect(k), w_);
    q_.c += -q_.g.head(nx).dot(w_) + 0.5 * w_.dot(q_.h.topLeftCorner(nx, nx) * w_);
    q_.g.noalias() -= q_.h.leftCols(nx) * w_;
    pendulum_.substitute_inverse(dynamics, q_.h);
    mt_ = q_.h.transpose();
    pendulum_.substitute_inverse(dynamics, mt_);
    q_.h = mt_;
    m_ = q_.g.transpose();
    pendulum_.substitute_inverse(dynamics, m_);
    q_.g = m_.row(0).transpose();
    if (!solve(q_, U_[k + 1], nullptr)) return false;
  }
  return true;
}

double ValueFunctions::minimum(int k) const {
  const MatrixXd h = U_[k].h + V_[k].h;
  const VectorXd g = U_[k].g + V_[k].g;
  return U_[k].c + V_[k].c - 0.5 * g.dot(h.llt().solve(g));
}

double ValueFunctions::minimum_with(const ContactSequence& changed, const ContactSequence& sequence) {
  const int n = model_->steps();
  int first = 0, last = n - 1;
  while (first < last && changed[first] == sequence[first]) ++first;
  while (last > first && changed[last] == sequence[last]) --last;
  from_ = V_[last + 1];
  for (int k = last; k >= first; --k) {
    if (!backward_step(k, changed[k], from_, to_)) return std::numeric_limits<double>::infinity();
    std::swap(from_, to_);
  }
  from_.h += U_[first].h;
  from_.g += U_[first].g;
  factor_.compute(from_.h);
  if (factor_.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  factor_.matrixL().solveInPlace(from_.g);
  return U_[first].c + from_.c - 0.5 * from_.g.squaredNorm();
}

void ValueFunctions::state_forward(std::vector<VectorXd>& dx, std::vector<VectorXd>& du) {
  const int n = model_->steps();
  dx.resize(n + 1);
  du.resize(n);
  factor_.compute(V_[0].h);
  dx[0] = -factor_.solve(V_[0].g);
  for (int k = 0; k < n; ++k) {
    const Feedback& feedback = feedback_[k];
    du[k] = -feedback.offset;
    du[k].noalias() -= feedback.factor.topRows(dx[k].size()).transpose() * dx[k];
    feedback.factor.bottomRows(du[k].size()).triangularView<Eigen::Upper>().transpose().solveInPlace(du[k]);
    model_->pendulum().apply(model_->dynamics(k), dx[k], du[k], dx[k + 1]);
    dx[k + 1] += model_->defect(k);
  }
}

}  // namespace mcplan::ddp
