#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace mcplan::nlp {

using ConstVector = Eigen::Ref<const Eigen::VectorXd>;
using Vector = Eigen::Ref<Eigen::VectorXd>;
using Matrix = Eigen::Ref<Eigen::MatrixXd>;

/// One constraint or one cost: a few smooth functions of a few variables, with exact derivatives.
///
/// A piece sees its own variables alone, as a dense vector in the order of variables(). Where the blocks that it writes
/// are always zero is found out by Problem, which keeps the sparse structure.
class Piece {
 public:
  /// variables: indices into the problem's, no index twice.
  Piece(std::string name, std::vector<int> variables, int rows)
      : name_(std::move(name)), variables_(std::move(variables)), rows_(rows) {}
  virtual ~Piece() = default;
  Piece(const Piece&) = delete;
  Piece& operator=(const Piece&) = delete;

  const std::string& name() const { return name_; }
  const std::vector<int>& variables() const { return variables_; }
  int size() const { return static_cast<int>(variables_.size()); }  ///< number of variables
  int rows() const { return rows_; }

  /// f(x), `rows` values.
  virtual void values(const ConstVector& x, Vector f) const = 0;

  /// df/dx, rows x size. On entry J is zero wherever it has structure; other entries are not looked at.
  virtual void jacobian(const ConstVector& x, Matrix J) const = 0;

  /// sum_i weights_i d2f_i/dx2, size x size, likewise; only the lower triangle of H is read.
  virtual void hessian(const ConstVector& x, const ConstVector& weights, Matrix H) const = 0;

  /// The same of a cost, without what may make it indefinite, such as the curvature of residuals whose squares are
  /// summed. Its entries are among those of hessian(), which it is unless a piece says otherwise.
  virtual void gauss_newton_hessian(const ConstVector& x, const ConstVector& weights, Matrix H) const {
    hessian(x, weights, H);
  }

  /// True if the Jacobian is constant and the Hessian zero: both are then evaluated once.
  virtual bool linear() const { return false; }

  /// True if entries of the Jacobian may be zero at one point and not at another: all are kept then.
  virtual bool entries_come_and_go() const { return false; }

  /// What messages call a row: "name[2]", or "name" where there is one.
  virtual std::string row_name(int row) const { return rows_ == 1 ? name_ : name_ + "[" + std::to_string(row) + "]"; }

 private:
  std::string name_;
  std::vector<int> variables_;
  int rows_;
};

/// A x.
class LinearPiece : public Piece {
 public:
  LinearPiece(std::string name, std::vector<int> variables, Eigen::MatrixXd A)
      : Piece(std::move(name), std::move(variables), static_cast<int>(A.rows())), A_(std::move(A)) {}

  void values(const ConstVector& x, Vector f) const override { f.noalias() = A_ * x; }
  void jacobian(const ConstVector&, Matrix J) const override { J = A_; }
  void hessian(const ConstVector&, const ConstVector&, Matrix) const override {}
  bool linear() const override { return true; }

 private:
  Eigen::MatrixXd A_;
};

}  // namespace mcplan::nlp
