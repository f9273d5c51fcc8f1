#include "mcplan/scene/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "mcplan/base/error.hpp"
#include "model/names.hpp"
#include "model/read.hpp"
#include "model/text.hpp"
#include "scene_fields.hpp"

namespace mcplan {
namespace {

using Eigen::Vector3d;

std::string item(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }

/// Bounds go with the polygon below a metre: the ground of a robot of 5 mm has treads of a millimetre.
void validate_polygon(const std::string& field, const std::vector<Vector3d>& vertices) {
  const std::size_t n = vertices.size();
  double size_m = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (vertices[i].cwiseAbs().maxCoeff() > 1e4)
      throw InvalidScene(item(field, i), "must lie within 10 km of the origin", text(vertices[i]));
    size_m = std::max(size_m, (vertices[i] - vertices[0]).norm());
  }
  size_m = std::min(size_m, 1.0);
  for (std::size_t i = 0; i < n; ++i)
    if ((vertices[(i + 1) % n] - vertices[i]).norm() <= 1e-4 * size_m)
      throw InvalidScene(item(field, (i + 1) % n),
                         "must be more than " + text(0.1 * size_m) + " mm from the point before it",
                         text(vertices[(i + 1) % n]));

  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) sum += (vertices[i] - vertices[0]).cross(vertices[(i + 1) % n] - vertices[0]);
  const double area = 0.5 * sum.norm();
  if (area <= 1e-6 * size_m * size_m)
    throw InvalidScene(field, "must span an area of more than " + text(1e-6 * size_m * size_m) + " m^2",
                       text(area) + " m^2");
  const Vector3d normal = sum.normalized();
  double turned = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double height = normal.dot(vertices[i] - vertices[0]);
    if (std::abs(height) > 1e-3 * size_m)
      throw InvalidScene(item(field, i), "must lie in the plane of the others within " + text(size_m) + " mm",
                         text(std::abs(height)) + " m off");
    const Vector3d before = (vertices[i] - vertices[(i + n - 1) % n]).normalized();
    const Vector3d after = (vertices[(i + 1) % n] - vertices[i]).normalized();
    const double turn = std::atan2(normal.dot(before.cross(after)), before.dot(after));
    if (turn < 1e-6)
      throw InvalidScene(item(field, i), "must be a corner of a strictly convex polygon", text(vertices[i]));
    turned += turn;
  }
  if (std::abs(turned - 2.0 * M_PI) > 1e-6)
    throw InvalidScene(field, "must run once around a convex polygon", text(turned / (2.0 * M_PI)) + " turns");
}

/// Says that a surface does not exist, once the names of all are known.
void require_surface(const Scene& scene, const std::string& surface, const std::string& field, model::Findings& found) {
  if (scene.surface_index(surface) >= 0) return;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    if (!found.sound(item("surfaces", i) + ".name")) return;
  if (!scene.surfaces.empty())
    found.check({field}, [&] {
      throw InvalidScene(field, model::name_rule("a surface", surface, model::names_of(scene.surfaces).names),
                         text(surface));
    });
}

void relate_stance(const Scene& scene, const std::string& field, const Stance& stance, model::Findings& found) {
  found.check({field + ".yaw"}, [&] {
    if (std::abs(stance.yaw) > 2.0 * M_PI)
      throw InvalidScene(field + ".yaw", "must lie in [-2 pi, 2 pi] rad", text(stance.yaw));
  });
  found.check({field + ".contacts"}, [&] {
    if (stance.contacts.empty())
      throw InvalidScene(field + ".contacts", "must put at least one end-effector on a surface", "{}");
  });
  for (const auto& [who, surface] : stance.contacts) require_surface(scene, surface, field + ".contacts." + who, found);
}

}  // namespace

int Scene::surface_index(const std::string& surface_name) const {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].name == surface_name) return static_cast<int>(i);
  return -1;
}

void Scene::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  model::relations(*this, found);
  found.raise<InvalidScene>();
}

void model::relations(const Scene& scene, Findings& found) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    const std::string field = item("surfaces", i);
    found.check({field + ".name"}, [&] {
      if (!names.insert(surface.name).second) throw InvalidScene(field + ".name", "must be unique", text(surface.name));
    });
    found.check({field + ".vertices"}, [&] { validate_polygon(field + ".vertices", surface.vertices_W); });
  }
  relate_stance(scene, "start", scene.start, found);
  relate_stance(scene, "goal", scene.goal, found);
  for (std::size_t i = 0; i < scene.steps.size(); ++i)
    require_surface(scene, scene.steps[i].surface, item("steps", i) + ".surface", found);
}

}  // namespace mcplan
