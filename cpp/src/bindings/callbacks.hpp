#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "mcplan/nlp/piece.hpp"

namespace mcplan::bindings {

/// Functions of a block that are written in Python. Made and destroyed under the GIL, called with or without it.
struct Callbacks {
  std::string where;       ///< "dynamics at stage 3", for messages
  std::vector<int> sizes;  ///< of the arrays that each function is called with: the block's variables in their order
  int rows = 0;
  py::function value, jacobian;
  py::object hessian;  ///< None: there is none

  int size() const;

  /// f(v), df/dv (rows x size) and sum_i weights_i d2f_i/dv2 (size x size). What Python raises comes out unchanged,
  /// with a note that says where; a Ctrl-C is kept for the solve around it, and the numbers are NaN then. InvalidInput
  /// where something else than so many numbers is returned.
  void values(const nlp::ConstVector& v, nlp::Vector f) const;
  void jacobians(const nlp::ConstVector& v, nlp::Matrix J) const;
  void hessians(const nlp::ConstVector& v, const nlp::ConstVector& weights, nlp::Matrix H) const;
};

/// The callbacks as a piece. All entries of its derivatives are kept, since nobody knows which are always zero, and
/// Python is not asked for any before `ready`: Problem::finish() calls pieces where user's functions need not be
/// defined.
class CallbackPiece : public nlp::Piece {
 public:
  CallbackPiece(std::string name, std::vector<int> variables, std::shared_ptr<const Callbacks> callbacks,
                std::shared_ptr<const bool> ready);

  void values(const nlp::ConstVector& v, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& v, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& v, const nlp::ConstVector& weights, nlp::Matrix H) const override;
  bool entries_come_and_go() const override { return true; }

 private:
  std::shared_ptr<const Callbacks> callbacks_;
  std::shared_ptr<const bool> ready_;
};

/// 1/2 sum_i w_i r_i(v)^2 of callbacks r, whose Hessian is Gauss and Newton's J' W J where r has none.
class LeastSquaresPiece : public nlp::Piece {
 public:
  LeastSquaresPiece(std::string name, std::vector<int> variables, std::shared_ptr<const Callbacks> residuals,
                    Eigen::VectorXd weights, std::shared_ptr<const bool> ready);

  void values(const nlp::ConstVector& v, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& v, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& v, const nlp::ConstVector& weights, nlp::Matrix H) const override;
  void gauss_newton_hessian(const nlp::ConstVector& v, const nlp::ConstVector& weights, nlp::Matrix H) const override;
  bool entries_come_and_go() const override { return true; }

 private:
  Eigen::VectorXd residuals(const nlp::ConstVector& v) const;
  Eigen::MatrixXd residual_jacobian(const nlp::ConstVector& v) const;

  std::shared_ptr<const Callbacks> residuals_;
  Eigen::VectorXd weights_;
  std::shared_ptr<const bool> ready_;
};

/// 1/2 v' H v + g' v + c, with a symmetric H.
class QuadraticPiece : public nlp::Piece {
 public:
  QuadraticPiece(std::string name, std::vector<int> variables, Eigen::MatrixXd H, Eigen::VectorXd g, double c);

  void values(const nlp::ConstVector& v, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& v, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& v, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
  double c_;
};

}  // namespace mcplan::bindings
