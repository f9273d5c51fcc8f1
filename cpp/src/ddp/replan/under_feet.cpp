#include "ddp/replan/under_feet.hpp"

#include <algorithm>

#include "mcplan/scene/polygon.hpp"

namespace mcplan::ddp {

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
  return found.empty() ? Found() : found.front();
}

}  // namespace mcplan::ddp
