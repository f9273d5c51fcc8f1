#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace mcplan::ddp {

/// Cost by term, in the order of cost_terms(); there may be this many of them.
constexpr int kCostTermsMax = 32;
using CostTerms = std::array<double, kCostTermsMax>;

/// A sum of squares 1/2 sum_r w_r^2 e_r(z)^2, row by row: value e_r and gradient de_r/dz (z = [x, u]). Every cost and
/// constraint of the planner writes itself into one of these; satisfied inequalities write nothing (active set).
/// Without gradients only the cost is summed up, which is what a line search needs.
class Rows {
 public:
  Rows() = default;
  Rows(int nz, bool with_gradient) : nz_(nz), with_gradient_(with_gradient), gradient_(nz, with_gradient ? 16 : 0) {}

  bool with_gradient() const { return with_gradient_; }
  bool sized() const { return nz_ > 0; }  ///< false: as made without arguments
  void clear();

  /// What is added from now on belongs to this term of cost_terms().
  void begin(int term) { term_ = static_cast<std::size_t>(term); }

  /// A row that depends on one variable: e = value, de/dz_index = 1.
  void add_single(double weight, double value, int index);

  /// A row with a dense gradient, returned as zeros to be filled in (valid until the next add). Only with gradients.
  Eigen::Ref<Eigen::VectorXd> add_dense(double weight, double value);

  /// The gradient of the row added last, to be added to.
  Eigen::Ref<Eigen::VectorXd> last_gradient() { return gradient_.col(count() - 1); }

  /// The same without a gradient.
  void add_value(double weight, double value);

  /// A constant, without a row.
  void add_constant(double cost) {
    cost_ += cost;
    terms_[term_] += cost;
  }

  int count() const { return static_cast<int>(value_.size()); }
  double cost() const { return cost_; }
  const CostTerms& terms() const { return terms_; }
  double precision(int r) const { return precision_[r]; }  ///< w_r^2
  double value(int r) const { return value_[r]; }
  int single(int r) const { return single_[r]; }           ///< its one variable, or -1
  auto gradient(int r) const { return gradient_.col(r); }  ///< zeros but for the one variable of a single row

  /// Add the Gauss-Newton quadratic  c + g'z + 1/2 z'Hz  of these rows, of H the upper triangle.
  void accumulate(double& c, Eigen::VectorXd& g, Eigen::MatrixXd& h) const;

 private:
  void push(double weight, double value, int single);

  int nz_ = 0;
  bool with_gradient_ = true;
  std::size_t term_ = 0;
  double cost_ = 0.0;
  CostTerms terms_{};
  std::vector<double> precision_, value_;
  std::vector<int> single_;
  Eigen::MatrixXd gradient_;  ///< nz x capacity, a column a row
};

}  // namespace mcplan::ddp
