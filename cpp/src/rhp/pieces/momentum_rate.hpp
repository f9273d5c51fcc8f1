#pragma once

#include <vector>

#include "mcplan/nlp/piece.hpp"
#include "rhp/pieces/contact_point.hpp"

namespace mcplan::rhp {

/// R - sum_i (p_i - c) x f_i = 0: the rate of the angular momentum about the CoM (Wang et al., eq. 2c), sum over the
/// points in contact. Bilinear in (c, footholds) and forces.
class MomentumRate : public nlp::Piece {
 public:
  /// rate, com: first variables of R [N m] and c [m].
  MomentumRate(int rate, int com, const std::vector<Placement>& placements, const std::vector<ContactPoint>& points);

  void values(const nlp::ConstVector& x, nlp::Vector f) const override;
  void jacobian(const nlp::ConstVector& x, nlp::Matrix J) const override;
  void hessian(const nlp::ConstVector& x, const nlp::ConstVector& weights, nlp::Matrix H) const override;

 private:
  struct Point {
    Eigen::Vector3d base_W;         ///< of the point at w = 0
    Eigen::Matrix3d axes_W;         ///< of the surface
    Eigen::Matrix3Xd directions_W;  ///< of the force, times kForceUnit
    int foothold = 0, force = 0;    ///< places in x
  };
  Eigen::Vector3d lever(const nlp::ConstVector& x, const Point& point) const;

  std::vector<Point> points_;
};

}  // namespace mcplan::rhp
