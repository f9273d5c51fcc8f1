#include "rhp/pieces/momentum_rate.hpp"

#include <Eigen/Geometry>
#include <map>
#include <utility>

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;

constexpr int kMomentumRate = 0, kCom = 3;  // places in x

std::vector<int> gather(int rate, int com, const std::vector<Placement>& placements,
                        const std::vector<ContactPoint>& points) {
  std::vector<int> variables;
  append(variables, rate, 3);
  append(variables, com, 3);
  std::map<int, bool> seen;
  for (const ContactPoint& point : points)
    if (!std::exchange(seen[point.placement], true)) append(variables, placements[point.placement].variable, 2);
  for (const ContactPoint& point : points) append(variables, point.variable, point.count());
  return variables;
}

}  // namespace

MomentumRate::MomentumRate(int rate, int com, const std::vector<Placement>& placements,
                           const std::vector<ContactPoint>& points)
    : Piece("momentum_rate", gather(rate, com, placements, points), 3) {
  std::map<int, int> foothold;
  int next = 6;
  for (const ContactPoint& point : points)
    if (foothold.try_emplace(point.placement, next).second) next += 2;
  for (const ContactPoint& point : points) {
    const Placement& placement = placements[point.placement];
    points_.push_back({placement.origin_W + point.offset_W, placement.axes_W,
                       kForceUnit * point.directions_W(placement), foothold[point.placement], next});
    next += point.count();
  }
}

Vector3d MomentumRate::lever(const nlp::ConstVector& x, const Point& point) const {
  return point.base_W + point.axes_W.leftCols<2>() * x.segment<2>(point.foothold) - x.segment<3>(kCom);
}

void MomentumRate::values(const nlp::ConstVector& x, nlp::Vector f) const {
  Vector3d sum = x.segment<3>(kMomentumRate);
  for (const Point& point : points_)
    sum -= lever(x, point).cross(point.directions_W * x.segment(point.force, point.directions_W.cols()));
  f = sum;
}

void MomentumRate::jacobian(const nlp::ConstVector& x, nlp::Matrix J) const {
  J.middleCols<3>(kMomentumRate).setIdentity();
  for (const Point& point : points_) {
    const Vector3d force = point.directions_W * x.segment(point.force, point.directions_W.cols());
    J.middleCols<3>(kCom) -= skew(force);
    for (int i = 0; i < 2; ++i) J.col(point.foothold + i) -= point.axes_W.col(i).cross(force);
    J.middleCols(point.force, point.directions_W.cols()).noalias() = -skew(lever(x, point)) * point.directions_W;
  }
}

/// With weights y, y . (l x f) = f . (y x l): the only second derivatives are between l = l(c, w) and f.
void MomentumRate::hessian(const nlp::ConstVector&, const nlp::ConstVector& weights, nlp::Matrix H) const {
  const Vector3d y = weights;
  for (const Point& point : points_) {
    const int n = static_cast<int>(point.directions_W.cols());
    H.block(point.force, kCom, n, 3).noalias() = point.directions_W.transpose() * skew(y);
    for (int i = 0; i < 2; ++i)
      H.col(point.foothold + i).segment(point.force, n).noalias() =
          -point.directions_W.transpose() * y.cross(point.axes_W.col(i));
  }
}

}  // namespace mcplan::rhp
