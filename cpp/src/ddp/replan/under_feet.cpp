#include "ddp/replan/under_feet.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {
namespace {

/// A sole may be so deep in the solid of another surface [in distances from the CoM to a nominal end-effector]: tiles
/// that overlap are not even to the millimetre. Chosen.
constexpr double kDeep = 0.005;

/// Whether the solid of another surface is where a sole would stand: the floor that goes on below a block is no ground.
bool in_solid(const Scene& scene, const Found& found, const EndEffector& end) {
  const double room_m = std::max(end.half_size.minCoeff(), 0.0), even_m = kDeep * end.nominal_B.norm();
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (static_cast<int>(i) == found.surface || !(surface.thickness > 0.0)) continue;
    Eigen::AlignedBox3d around;  // most surfaces are elsewhere
    for (const Eigen::Vector3d& vertex_W : surface.vertices_W) around.extend(vertex_W);
    if (around.exteriorDistance(found.place_W) > surface.thickness + even_m + room_m) continue;
    const Polygon polygon(surface.vertices_W);
    const double deep_m = -polygon.height(found.place_W);
    if (deep_m > even_m && deep_m < surface.thickness + even_m && polygon.outside(found.place_W) < room_m) return true;
  }
  return false;
}

}  // namespace

std::vector<Found> grounds_near(const Scene& scene, const EndEffector& end, const Eigen::Vector3d& desired_W) {
  std::vector<Found> out;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (!may_touch(scene.surfaces[i], end)) continue;
    const Eigen::Vector3d place_W = Polygon(scene.surfaces[i].vertices_W).nearest(desired_W);
    out.push_back({static_cast<int>(i), place_W, (place_W - desired_W).norm()});
  }
  std::stable_sort(out.begin(), out.end(), [](const Found& a, const Found& b) { return a.distance < b.distance; });
  return out;
}

Found ground_at(const Scene& scene, const EndEffector& end, const Eigen::Vector3d& desired_W) {
  const std::vector<Found> found = grounds_near(scene, end, desired_W);
  for (const Found& one : found)
    if (!in_solid(scene, one, end)) return one;
  return found.empty() ? Found() : found.front();
}

}  // namespace mcplan::ddp
