#include "mcplan/robot/standing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "mcplan/scene/polygon.hpp"
#include "model/text.hpp"

namespace mcplan {
namespace {

/// How far outside of its reach box an end-effector may stand at start and goal, in CoM heights: poses of a real robot,
/// which bends, lie outside of the box by less.
constexpr double max_outside = 0.25;

void require_upward_force(const Scene& scene, const Stance& stance, const std::string& field) {
  std::vector<int> named;
  std::string faces;
  for (const auto& [who, name] : stance.contacts) {
    const int index = scene.surface_index(name);
    if (holds_up(scene.surfaces[index])) return;
    if (std::find(named.begin(), named.end(), index) != named.end()) continue;
    named.push_back(index);
    faces += (faces.empty() ? "" : ", ") + text(name) + " faces down";
  }
  throw InvalidScene(field + ".contacts",
                     "must hold the robot up: corners of ground run counter-clockwise seen from above", faces);
}

void require_within_reach(const Scene& scene, const Robot& robot, const Stance& stance, const std::string& field) {
  const ResolvedStance resolved = resolve_stance(scene, robot, stance, field);
  const Eigen::Matrix3d to_base = rotation_from_rpy(resolved.base_rpy).transpose();
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const EndEffector& end_effector = robot.end_effectors[l];
    const Eigen::Vector3d place_B = to_base * (resolved.end_effectors_W[l] - resolved.com_W);
    const Eigen::Vector3d outside =
        (end_effector.reach_min_B - place_B).cwiseMax(place_B - end_effector.reach_max_B).cwiseMax(0.0);
    if (resolved.contacts[l] < 0 || !(outside.norm() > max_outside * robot.com_height)) continue;
    const std::string off = model::digits((place_B - end_effector.nominal_B).stableNorm(), "%.2g");
    throw InvalidScene(field + ".position",
                       "must be where " + robot.name + " reaches the surfaces that its contacts name",
                       model::digits(stance.position_W, "%.4g") + ": " + end_effector.name + " would stand " + off +
                           " m off " + text(scene.surfaces[resolved.contacts[l]].name));
  }
}

}  // namespace

bool holds_up(const Surface& surface) {
  const double up = Polygon(surface.vertices_W).normal_W().z();
  return surface.grasp || up + surface.friction * std::sqrt(std::max(0.0, 1.0 - up * up)) > 0.0;
}

void require_standing(const Scene& scene, const Robot& robot) {
  scene.validate();
  robot.validate();
  Validation<InvalidScene> validate;
  for (const auto& [field, stance] : {std::pair("start", &scene.start), std::pair("goal", &scene.goal)})
    validate([&, field = std::string(field), stance = stance] {
      require_upward_force(scene, *stance, field);
      require_within_reach(scene, robot, *stance, field);
    });
  validate.raise();
}

}  // namespace mcplan
