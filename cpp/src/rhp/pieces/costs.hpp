#pragma once

#include <Eigen/Core>
#include <string>

#include "mcplan/nlp/piece.hpp"

namespace mcplan::rhp {

/// weight T |y|^2: a rectangle of the integral of |y|^2, `weight` its share of the duration T. y has three components.
class SquareOverTime : public nlp::Piece {
 public:
  SquareOverTime(const std::string& name, int y, int duration, double weight);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double weight_;
};

/// h/3 (y0.y0 + y0.y1 + y1.y1), h = T / intervals: the integral of |y|^2 where y is linear from y0 to y1.
class LinearSquareOverTime : public nlp::Piece {
 public:
  LinearSquareOverTime(const std::string& name, int y0, int y1, int duration, int intervals);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  double third_;  ///< h / (3 T)
};

/// weight |y - target|^2.
class SquaredDistance : public nlp::Piece {
 public:
  SquaredDistance(const std::string& name, int y, const Eigen::VectorXd& target, double weight);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  Eigen::VectorXd target_;
  double weight_;
};

}  // namespace mcplan::rhp
