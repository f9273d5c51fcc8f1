#pragma once

#include <Eigen/Core>
#include <vector>

namespace mcplan {

/// Convex planar polygon in the world, prepared for distance queries. Lengths in the unit of its vertices.
class Polygon {
 public:
  Polygon() = default;

  /// vertices_W: at least 3, coplanar, convex, counter-clockwise about the outward normal (validated by Scene).
  explicit Polygon(std::vector<Eigen::Vector3d> vertices_W);

  const std::vector<Eigen::Vector3d>& vertices_W() const { return vertices_; }
  const Eigen::Vector3d& normal_W() const { return normal_; }
  Eigen::Vector3d centroid_W() const;

  /// Height of a point above the plane [length].
  double height(const Eigen::Vector3d& point_W) const { return normal_.dot(point_W - vertices_.front()); }

  /// Edge i as a half-plane inside the plane: unit outward direction e_i and overshoot e_i . (p - v_i),
  /// positive outside.
  int edge_count() const { return static_cast<int>(vertices_.size()); }
  const Eigen::Vector3d& edge_outward_W(int i) const { return outward_[i]; }
  double overshoot(int i, const Eigen::Vector3d& point_W) const { return outward_[i].dot(point_W - vertices_[i]); }

  /// Largest overshoot over the edges: negative inside, the distance to the boundary near an edge.
  double outside(const Eigen::Vector3d& point_W) const;

  /// Nearest point of the polygon (interior and boundary).
  Eigen::Vector3d nearest(const Eigen::Vector3d& point_W) const;

  /// Two unit tangents t_1, t_2 with t_1 x t_2 = normal; t_1 is the world's x axis projected onto the plane where that
  /// is well defined.
  const Eigen::Vector3d& tangent_W(int i) const { return tangents_[i]; }

 private:
  std::vector<Eigen::Vector3d> vertices_, outward_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d tangents_[2] = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
};

}  // namespace mcplan
