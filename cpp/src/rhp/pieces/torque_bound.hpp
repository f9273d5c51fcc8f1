#pragma once

#include <array>

#include "mcplan/nlp/piece.hpp"
#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {

/// The convex relaxation of a contact point's torque about the CoM (Wang et al., eq. 3; Ponton et al.). With lever
/// l = (p - c) / kLeverUnit and force d = f / force_unit, each component of l x d is a dot product of two 2-vectors
/// alpha (of the lever) and delta (of the force),
///
///     alpha . delta = (|alpha + delta|^2 - |alpha - delta|^2) / 4,
///
/// so six convex quadratics |e_j|^2, e_j = alpha +- delta affine in (c, w, f), stand for the torque. Order: x+, x-, y+,
/// y-, z+, z-.
class TorqueForms {
 public:
  static constexpr double kLeverUnit = 1.5;  ///< [m]
  static constexpr int kCount = 6;           ///< forms
  static constexpr int kSize = 8;            ///< c, w and f / kForceUnit in world axes
  using Point = Eigen::Matrix<double, kSize, 1>;
  using Square = Eigen::Matrix<double, kSize, kSize>;

  /// force_unit [N]: the largest component of the point's force.
  TorqueForms(const Placement& placement, const ContactPoint& point, double force_unit);

  static std::vector<int> variables(int com, const Placement& placement, const ContactPoint& point);

  int size() const { return 5 + static_cast<int>(directions_.cols()); }  ///< variables: c, w, those of the force

  Point point(const nlp::ConstVector& x) const;  ///< (c, w, f) of the variables
  Eigen::Vector2d form(int j, const Point& z) const { return E_[j] * z + e_[j]; }
  const Eigen::Matrix<double, 2, kSize>& slope(int j) const { return E_[j]; }
  const Square& squared_slope(int j) const { return EE_[j]; }  ///< E_j^T E_j

  /// From derivatives with respect to (c, w, f) to those with respect to the variables.
  void expand_row(const Eigen::Matrix<double, 1, kSize>& row, int at, nlp::Matrix J) const;
  void expand(const Square& square, nlp::Matrix H) const;

 private:
  Eigen::Matrix3Xd directions_;  ///< of the force
  std::array<Eigen::Matrix<double, 2, kSize>, kCount> E_;
  std::array<Square, kCount> EE_;
  std::array<Eigen::Vector2d, kCount> e_;
};

/// |e_j|^2 [-], six rows; with `psi` (first of six variables) |e_j|^2 - psi_j.
class TorqueBound : public nlp::Piece {
 public:
  TorqueBound(int com, const Placement& placement, const ContactPoint& point, double force_unit, int psi = -1);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  TorqueForms forms_;
  bool lifted_;
};

/// weight sum_j |e_j|^4: the cost of psi^2 with psi eliminated.
class TorqueCost : public nlp::Piece {
 public:
  TorqueCost(int com, const Placement& placement, const ContactPoint& point, double force_unit, double weight);
  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  TorqueForms forms_;
  double weight_;
};

}  // namespace mcplan::rhp
