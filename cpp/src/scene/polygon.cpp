#include "mcplan/scene/polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "mcplan/base/error.hpp"

namespace mcplan {

using Eigen::Vector3d;

Polygon::Polygon(std::vector<Vector3d> vertices_W) : vertices_(std::move(vertices_W)) {
  const int n = edge_count();
  if (n < 3) throw InvalidInput("vertices", "needs at least 3 points", text(n));
  // Newell's sum: robust for slightly non-planar input and independent of the first vertex.
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < n; ++i) sum += (vertices_[i] - vertices_[0]).cross(vertices_[(i + 1) % n] - vertices_[0]);
  normal_ = sum.normalized();
  for (int i = 0; i < n; ++i) outward_.push_back((vertices_[(i + 1) % n] - vertices_[i]).cross(normal_).normalized());
  const Vector3d along = std::abs(normal_.x()) < 0.9 ? Vector3d::UnitX() : Vector3d::UnitY();
  tangents_[0] = (along - normal_ * normal_.dot(along)).normalized();
  tangents_[1] = normal_.cross(tangents_[0]);
}

Vector3d Polygon::centroid_W() const {
  Vector3d weighted = Vector3d::Zero();
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < vertices_.size(); ++i) {
    const double triangle = normal_.dot((vertices_[i] - vertices_[0]).cross(vertices_[i + 1] - vertices_[0]));
    weighted += triangle / 3.0 * (vertices_[0] + vertices_[i] + vertices_[i + 1]);
    area += triangle;
  }
  return weighted / area;
}

double Polygon::outside(const Vector3d& point_W) const {
  double worst = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < edge_count(); ++i) worst = std::max(worst, overshoot(i, point_W));
  return worst;
}

Vector3d Polygon::nearest(const Vector3d& point_W) const {
  const Vector3d projected = point_W - normal_ * height(point_W);
  if (outside(projected) <= 0.0) return projected;
  Vector3d best = vertices_[0];
  double best_distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < edge_count(); ++i) {
    const Vector3d& a = vertices_[i];
    const Vector3d ab = vertices_[(i + 1) % edge_count()] - a;
    const Vector3d candidate = a + ab * std::clamp((projected - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
    const double distance = (projected - candidate).squaredNorm();
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace mcplan
