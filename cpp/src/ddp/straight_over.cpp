#include "ddp/straight_over.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mcplan/base/rotation.hpp"
#include "mcplan/scene/polygon.hpp"
#include "scene/ground.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Points of the way are so far apart, in CoM heights, and ground that differs less from a straight line is no matter.
constexpr double kApart = 0.2, kFlat = 0.1;
/// Ground that is higher above the straight way than that is none to step on.
constexpr double kHighest = 0.8;

/// Height of the highest ground there that an end-effector may touch; -infinity: there is none.
double ground_at(const Scene& scene, const std::vector<Polygon>& polygons, const EndEffector& end, const Vector3d& at,
                 double highest_m) {
  double out = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const Vector3d &n = polygons[i].normal_W(), &on = polygons[i].vertices_W().front();
    if (n.z() < walkable || !may_touch(scene.surfaces[i], end)) continue;
    const double z = on.z() - n.head<2>().dot((at - on).head<2>()) / n.z();
    if (z < at.z() + highest_m && polygons[i].outside({at.x(), at.y(), z}) <= 0.0) out = std::max(out, z);
  }
  return out;
}

}  // namespace

Route straight_over(const Scene& scene, const Robot& robot) {
  const ResolvedStance from = resolve_stance(scene, robot, scene.start, "start"),
                       to = resolve_stance(scene, robot, scene.goal, "goal");
  const Vector3d begin = scene.start.position_W, end = scene.goal.position_W;
  const int count = static_cast<int>((end - begin).head<2>().norm() / (kApart * robot.com_height));
  if (count < 2 || count > 1000) return {};
  std::vector<Polygon> polygons;
  for (const Surface& surface : scene.surfaces) polygons.emplace_back(surface.vertices_W);
  Route out{begin};
  double most = 0.0;
  for (int i = 1; i < count; ++i) {
    const double share = static_cast<double>(i) / count;
    const double yaw = from.yaw + share * std::remainder(to.yaw - from.yaw, 2.0 * M_PI);
    Vector3d at = begin + share * (end - begin);
    double sum = 0.0;
    int feet = 0;
    for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
      if (from.contacts[l] < 0 || to.contacts[l] < 0) continue;
      Vector3d foot = at + rotation_from_rpy({0.0, 0.0, yaw}) * robot.end_effectors[l].nominal_B;
      foot.z() = at.z();
      const double z = ground_at(scene, polygons, robot.end_effectors[l], foot, kHighest * robot.com_height);
      if (!std::isfinite(z)) continue;
      sum += z;
      ++feet;
    }
    if (feet == 0) return {};
    most = std::max(most, std::abs(sum / feet - at.z()));
    at.z() = sum / feet;
    out.push_back(at);
  }
  out.push_back(end);
  if (!(most > kFlat * robot.com_height)) return {};
  const auto bends = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return ((b - a).normalized() - (c - b).normalized()).norm() > 1e-9;
  };
  Route corners{out.front()};
  for (std::size_t i = 1; i + 1 < out.size(); ++i)
    if (bends(out[i - 1], out[i], out[i + 1])) corners.push_back(out[i]);
  corners.push_back(out.back());
  return corners;
}

}  // namespace mcplan::ddp
