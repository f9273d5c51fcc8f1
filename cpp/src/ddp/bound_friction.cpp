#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ddp/impossible.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/robot/similarity.hpp"
#include "mcplan/scene/polygon.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// A friction cone: forces within the angle `opening` of `axis`.
struct Cone {
  Vector3d axis;
  double opening;  ///< [rad] atan of the friction coefficient
  int surface;

  /// Whether d . f <= 0 for every force f in the cone: the angle between d and -axis is at most 90 degrees - opening.
  bool opposed_by(const Vector3d& d) const { return -axis.dot(d) >= std::sin(opening) - 1e-12; }
};

/// More normals than this are not looked at: pairs of them are.
constexpr std::size_t kMaxCones = 64;

/// The highest unit vector d that every cone is opposed by, if there is one. Those vectors are the intersection of caps
/// of the sphere about the -axis; its highest point is the highest of one cap, or lies where two of them meet.
std::optional<Vector3d> highest_opposed(const std::vector<Cone>& cones) {
  std::optional<Vector3d> best;
  const auto offer = [&](const Vector3d& d) {
    if (best && d.z() <= best->z()) return;
    if (std::all_of(cones.begin(), cones.end(), [&](const Cone& cone) { return cone.opposed_by(d); })) best = d;
  };
  for (const Cone& cone : cones) {
    // -axis turned towards the vertical by 90 degrees - opening, or as far as it goes.
    const Vector3d center = -cone.axis, level = Vector3d::UnitZ() - center.z() * center;
    const double radius = M_PI / 2.0 - cone.opening, to_top = std::acos(std::clamp(center.z(), -1.0, 1.0));
    if (to_top <= radius)
      offer(Vector3d::UnitZ());
    else if (level.norm() > 1e-9)
      offer(std::cos(radius) * center + std::sin(radius) * level.normalized());
  }
  for (std::size_t i = 0; i < cones.size(); ++i)
    for (std::size_t j = i + 1; j < cones.size(); ++j) {
      // d = a u + b v + c w with u . d = sin(opening_i), v . d = sin(opening_j), |d| = 1 and w normal to both.
      const Vector3d u = -cones[i].axis, v = -cones[j].axis, w = u.cross(v);
      const double along = u.dot(v), alone = 1.0 - along * along;
      if (alone < 1e-9) continue;
      const double s = std::sin(cones[i].opening), t = std::sin(cones[j].opening);
      const Vector3d in_plane = ((s - along * t) * u + (t - along * s) * v) / alone;
      const double rest = 1.0 - in_plane.squaredNorm();
      if (rest < 0.0) continue;
      for (double sign : {-1.0, 1.0}) offer(in_plane + sign * std::sqrt(rest / alone) * w);
    }
  return best;
}

/// Forces in the friction cones of the surfaces that any end-effector may touch; none where one can be held.
std::vector<Cone> cones_of(const Scene& scene, const Robot& robot, double tolerance) {
  std::vector<Cone> cones;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    const auto& ends = robot.end_effectors;
    if (std::none_of(ends.begin(), ends.end(), [&](const EndEffector& e) { return may_touch(surface, e); })) continue;
    const Cone cone{Polygon(surface.vertices_W).normal_W(), std::atan(surface.friction + tolerance),
                    static_cast<int>(i)};
    // Most scenes end here: a force of this surface can point straight up.
    if (surface.grasp || cone.axis.z() >= std::cos(cone.opening)) return {};
    const auto same = [&](const Cone& other) { return (other.axis - cone.axis).norm() < 1e-9; };
    const auto known = std::find_if(cones.begin(), cones.end(), same);
    if (known == cones.end())
      cones.push_back(cone);
    else if (known->opening < cone.opening)
      *known = cone;
    if (cones.size() > kMaxCones) return {};
  }
  return cones;
}

}  // namespace

/// Let d be a unit vector with d_z > 0 and d . f <= 0 for every force in every friction cone, opened by the checker's
/// tolerance (`pull`, `friction`). Below the tolerance of forces, e, they may point anywhere, 2 e for each of n
/// end-effectors. Then, by p'' = sum_l f_l / m - g at every instant,
///
///     d . p'' <= -g_d,     g_d = g d_z - 2 n e / m,
///
/// while the plan starts and ends with |v| <= b_v (`start`, `goal`): -2 b_v <= d . (v(T) - v(0)) <= -g_d T, so it lasts
/// T <= 2 b_v / g_d. In that time the CoM, which accelerates with A = sum_l f_max,l (1 + tolerance) / m + g at most
/// (`force_cap`) and is at rest, within b_v, at both ends, goes no farther than
///
///     b_v T + A T^2 / 4.
///
/// Where the CoM of the goal is farther than that from the start's, with b for each of the two (`start`, `goal`), there
/// is no plan. A hundredth more of b and b_v is for what states may differ by at each of 2000 knots (`dynamics`).
/// Without force caps nothing is said.
std::optional<Impossible> slips_everywhere(const Scene& scene, const Robot& robot) {
  const Tolerances tolerances;
  const std::vector<Cone> cones = cones_of(scene, robot, tolerances.friction);
  if (cones.empty()) return std::nullopt;
  const std::optional<Vector3d> d = highest_opposed(cones);
  if (!d || !(d->z() > 0.0)) return std::nullopt;
  const Similarity size = similarity_of(robot, scene.gravity);
  double force = 0.0;
  for (const EndEffector& end : robot.end_effectors) force += end.max_force * (1.0 + tolerances.force_cap);
  const double leak = 2.0 * static_cast<double>(robot.end_effectors.size()) * tolerances.force * size.force();
  // d is on the edge of some cone's polar, within rounding.
  const double falling = scene.gravity * d->z() - (leak + 1e-9 * force) / robot.mass;
  if (!std::isfinite(force) || !(falling > 0.0)) return std::nullopt;
  const double boundary = 1.01 * tolerances.boundary, rest = boundary * size.velocity(),
               duration = 2.0 * rest / falling;
  const double acceleration = force / robot.mass + scene.gravity;
  const double allowed_m = 2.0 * boundary * size.length + rest * duration + 0.25 * acceleration * duration * duration;
  const double way_m = (scene.goal.position_W - scene.start.position_W).norm();
  if (!(way_m > allowed_m)) return std::nullopt;

  // The surface that comes closest to holding the robot up is the one that is told.
  const auto lacks = [](const Cone& cone) { return std::acos(std::clamp(cone.axis.z(), -1.0, 1.0)) - cone.opening; };
  const Cone& best =
      *std::min_element(cones.begin(), cones.end(), [&](const Cone& a, const Cone& b) { return lacks(a) < lacks(b); });
  const Surface& surface = scene.surfaces[best.surface];
  const double slope = std::acos(std::clamp(best.axis.z(), -1.0, 1.0));
  const bool down = slope >= M_PI / 2.0 - 1e-9;
  const std::string degrees = model::digits(slope * 180.0 / M_PI, "%.3g");
  std::string message = "friction " + model::digits(surface.friction, "%.3g") + " of " + text(surface.name) +
                        " cannot hold on a slope of " + degrees + " degrees";
  if (!down) message += ", which takes " + model::digits(std::tan(slope), "%.3g");
  if (cones.size() > 1) message += ", and no force of all surfaces together holds the robot up";
  return Impossible{message,
                    {"friction", -1, "", 0.0, (down ? M_PI / 2.0 : std::tan(slope)) - surface.friction,
                     tolerances.friction, "", surface.name}};
}

}  // namespace mcplan::ddp
