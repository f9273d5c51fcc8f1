#include "model/suspicious.hpp"

#include <cstddef>
#include <utility>

#include "mcplan/scene/polygon.hpp"
#include "mcplan/scene/scene_files.hpp"
#include "model/text.hpp"
#include "scene/ground.hpp"

namespace mcplan {
namespace {

constexpr double long_scene_m = 1000.0;  // longer, lengths are taken to be millimetres

void suspect_ground(const Scene& scene, const Stance& stance, const std::string& field, std::vector<Suspicion>& out) {
  for (const auto& [who, name] : stance.contacts) {
    const int index = scene.surface_index(name);
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    const Polygon polygon(surface.vertices_W);
    const bool above = stance.position_W.z() >= polygon.nearest(stance.position_W).z() - 1e-3;
    if (!above || surface.grasp || polygon.normal_W().z() >= -walkable) continue;
    out.push_back(
        {"surfaces[" + std::to_string(index) + "].vertices",
         "faces down, and " + who + " stands on it at the " + field + ": corners run counter-clockwise seen from above",
         "normal " + model::digits(polygon.normal_W(), "%.4g")});
  }
}

}  // namespace

std::vector<Suspicion> suspicious_geometry(const Scene& scene) {
  scene.validate();
  std::vector<Suspicion> out;
  suspect_ground(scene, scene.start, "start", out);
  suspect_ground(scene, scene.goal, "goal", out);
  const double size = scene_size(scene);
  const std::string length = model::digits(size, "%.4g") + " m";
  const bool is_long = size > long_scene_m, is_strong = scene.gravity > model::strong_gravity;
  if (is_long && !is_strong)
    out.push_back({"surfaces", "lengths are in metres, and these look like millimetres", "a scene of " + length});
  if (!is_long && is_strong)
    out.push_back(
        {"gravity", model::gravity_rule, model::digits(scene.gravity, "%g") + " m/s^2 in a scene of " + length});
  return out;
}

}  // namespace mcplan
