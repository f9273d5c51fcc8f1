#include "ddp/walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace mcplan::ddp {

using Eigen::Vector3d;

namespace {

/// A wall is higher than an edge by this [m], within so much [m] of it; below its surface it is as thick as its solid
/// is, or as far as this [m]: what is no higher than that catches shanks, however thin it is. Chosen.
constexpr double kLeast_m = 0.03, kBeside_m = 0.08, kHigh_m = 0.3;

}  // namespace

Walls::Walls(const std::vector<Polygon>& polygons, const std::vector<double>& thickness, double unit)
    : polygons_(&polygons), thickness_(&thickness), unit_(unit), higher_beside_(polygons.size()) {
  const int count = static_cast<int>(polygons.size());
  std::vector<Eigen::AlignedBox<double, 3>> boxes(count);
  for (int i = 0; i < count; ++i)
    for (const Vector3d& vertex : polygons[i].vertices_W()) boxes[i].extend(vertex);
  std::vector<int> along_x(count);
  std::iota(along_x.begin(), along_x.end(), 0);
  std::stable_sort(along_x.begin(), along_x.end(),
                   [&](int one, int other) { return boxes[one].min().x() < boxes[other].min().x(); });
  const double beside = kBeside_m * unit;
  const auto rises = [&](int here, int there) {
    if (boxes[there].max().z() > boxes[here].min().z() + kLeast_m * unit) higher_beside_[here].push_back(there);
  };
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      const auto &one = boxes[along_x[i]], &other = boxes[along_x[j]];
      if (other.min().x() > one.max().x() + beside) break;
      if (other.min().y() > one.max().y() + beside || other.max().y() < one.min().y() - beside) continue;
      rises(along_x[i], along_x[j]);
      rises(along_x[j], along_x[i]);
    }
}

double Walls::beyond(int surface, int edge) const {
  const Polygon& polygon = (*polygons_)[surface];
  const Vector3d& from = polygon.vertices_W()[edge];
  const Vector3d& to = polygon.vertices_W()[(edge + 1) % polygon.edge_count()];
  double highest = 0.0;
  for (int other : higher_beside_[surface]) {
    const Polygon& beside = (*polygons_)[other];
    const double thick = std::max((*thickness_)[other], kHigh_m * unit_);
    for (const double along : {0.02, 0.15, 0.3, 0.5, 0.7, 0.85, 0.98})
      for (const double ratio : {0.1, 0.5, 1.0}) {
        const Vector3d place = from + along * (to - from) + ratio * kBeside_m * unit_ * polygon.edge_outward_W(edge) +
                               kLeast_m * unit_ * Vector3d::UnitZ();
        const double depth = -beside.height(place);
        if (depth > 0.0 && depth < thick && beside.outside(place) < 0.0)
          highest = std::max(highest, depth + kLeast_m * unit_);
      }
  }
  return highest;
}

}  // namespace mcplan::ddp
