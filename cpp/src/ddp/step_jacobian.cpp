#include "ddp/step_jacobian.hpp"

#include <algorithm>

namespace mcplan::ddp {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// out[0 ... rows) += sum_p by_p column_p
template <int P, class Terms>
inline void add_columns(double* __restrict out, Index rows, const double* __restrict m, Index stride, Terms terms) {
  Index at[P];
  double by[P];
  for (int p = 0; p < P; ++p) {
    at[p] = terms[p].row * stride;
    by[p] = terms[p].by;
  }
  for (Index i = 0; i < rows; ++i) {
    double sum = out[i];
    for (int p = 0; p < P; ++p) sum += by[p] * m[at[p] + i];
    out[i] = sum;
  }
}

}  // namespace

void StepJacobian::end_column(const Layout& at, const PendulumStep& step) {
  const auto column = static_cast<Index>(ends_.size());
  for (int a = 0; a < 2 * at.axis_count(); ++a) add(Layout::angle() + a, step.turn(a, column));
  ends_.push_back(static_cast<int>(terms_.size()));
}

void StepJacobian::make(const Layout& at, const PendulumStep& step) {
  constexpr int com = Layout::com(), velocity = Layout::velocity();
  const int end_effectors = at.end_effector_count();
  nx_ = at.nx();
  terms_.clear();
  ends_.clear();
  for (int i = 0; i < 3; ++i) {
    add(com + i, step.pp);
    add(velocity + i, step.vp);
    end_column(at, step);
  }
  for (int i = 0; i < 3; ++i) {
    add(com + i, step.pv);
    add(velocity + i, step.pp);
    end_column(at, step);
  }
  for (int a = 0; a < 2 * at.axis_count(); ++a) end_column(at, step);
  for (int l = 0; l < end_effectors; ++l)
    for (int i = 0; i < 3; ++i) {
      add(com + i, step.p_end * step.mu[l]);
      add(velocity + i, step.v_end * step.mu[l]);
      add(at.end(l) + i, 1.0);
      end_column(at, step);
    }
  for (int l = 0; l < end_effectors; ++l)
    for (int i = 0; i < 3; ++i) {
      add(at.end(l) + i, 1.0);
      end_column(at, step);
    }
  for (int l = 0; l < end_effectors; ++l) {
    add_point(com, step.p_mu.col(l));
    add_point(velocity, step.v_mu.col(l));
    end_column(at, step);
  }
  for (const auto offset : {&Layout::Offsets::pressure, &Layout::Offsets::force_line})
    for (int l = 0; l < end_effectors; ++l) {
      const Eigen::Matrix3Xd& directions = at.offsets(l).*offset;
      for (Index i = 0; i < directions.cols(); ++i) {
        add_point(com, step.p_end * step.mu[l] * directions.col(i));
        add_point(velocity, step.v_end * step.mu[l] * directions.col(i));
        end_column(at, step);
      }
    }
  for (int i = 0; i < at.moment_count(); ++i) end_column(at, step);
  add_point(com, step.slope * step.velocity);
  add_point(velocity, step.slope * step.acceleration);
  end_column(at, step);
}

void StepJacobian::combine(int column, const double* m, Index stride, Index rows, double* out) const {
  const Term* term = terms_.data() + (column > 0 ? ends_[column - 1] : 0);
  const Term* const end = terms_.data() + ends_[column];
  for (; end - term >= 4; term += 4) add_columns<4>(out, rows, m, stride, term);
  if (end - term >= 2) {
    add_columns<2>(out, rows, m, stride, term);
    term += 2;
  }
  if (term != end) add_columns<1>(out, rows, m, stride, term);
}

void StepJacobian::add_congruent(const MatrixXd& v, MatrixXd& h) {
  const auto nz = static_cast<Index>(ends_.size());
  product_.setZero(nx_, nz);
  for (int j = 0; j < nz; ++j) combine(j, v.data(), v.outerStride(), nx_, product_.col(j).data());
  transposed_ = product_.transpose();
  // Whole chunks of four rows, as in eliminate_last().
  for (int j = 0; j < nz; ++j)
    combine(j, transposed_.data(), nz, std::min<Index>((j + 4) / 4 * 4, nz), h.col(j).data());
}

MatrixXd StepJacobian::dense() const {
  MatrixXd out = MatrixXd::Zero(nx_, static_cast<Index>(ends_.size()));
  for (std::size_t j = 0, k = 0; j < ends_.size(); ++j)
    for (; k < static_cast<std::size_t>(ends_[j]); ++k) out(terms_[k].row, static_cast<Index>(j)) += terms_[k].by;
  return out;
}

}  // namespace mcplan::ddp
