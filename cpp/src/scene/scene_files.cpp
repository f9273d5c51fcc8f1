#include "mcplan/scene/scene_files.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "mcplan/base/error.hpp"
#include "mcplan/scene/polygon.hpp"
#include "model/find.hpp"
#include "model/read.hpp"
#include "model/reading.hpp"
#include "model/text.hpp"
#include "model/toml.hpp"
#include "model/write.hpp"
#include "model/writing.hpp"
#include "scene/ground.hpp"
#include "scene_fields.hpp"

namespace mcplan {
namespace {

using Eigen::Vector3d;

// How far a stance may be off all its surfaces, in lengths of the scene: above or below one of them, and beside.
constexpr double max_above = 0.05, max_beside = 0.25;

/// The ground below the CoM must not be far from every surface that the stance names.
void require_ground_below(const Scene& scene, const Stance& stance, const std::string& field) {
  std::set<std::string> names;
  for (const auto& [who, name] : stance.contacts) names.insert(name);
  double nearest = model::unbounded;
  std::string near_name;
  bool over = false;
  for (const std::string& name : names) {
    const Polygon polygon(scene.surfaces[static_cast<std::size_t>(scene.surface_index(name))].vertices_W);
    const Vector3d away = stance.position_W - polygon.nearest(stance.position_W);
    const double distance = away.stableNorm();
    if (!near_name.empty() && !(distance < nearest)) continue;
    const double along = distance > 0.0 ? std::abs(away.dot(polygon.normal_W())) / distance : 1.0;
    nearest = distance;
    near_name = name;
    over = along > 0.999 && std::abs(polygon.normal_W().z()) > walkable;
  }
  if (nearest <= (over ? max_above : max_beside) * scene_size(scene)) return;
  std::string at;
  for (int i = 0; i < 3; ++i) at += (i ? ", " : "") + digits(stance.position_W[i], "%.4g");
  throw InvalidScene(
      field + ".position", "must be a point of the ground below the robot, near the surfaces that its contacts name",
      "[" + at + "], " + digits(nearest, "%.3g") + " m " + (over ? "off " : "beside ") + model::shown(near_name));
}

}  // namespace

double scene_size(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Surface& surface : scene.surfaces)
    for (const Vector3d& vertex : surface.vertices_W) box.extend(vertex);
  return box.diagonal().norm();
}

namespace model {

Scene scene_from(const Value& data, const std::string& source) {
  Reading reading;
  reading.source = source;
  Scene scene;
  if (require_few_keys(data, reading.found)) {
    read_struct(data, scene, Place(), reading);
    relations(scene, reading.found);
  }
  reading.found.raise<InvalidScene>(source);
  return scene;
}

}  // namespace model

Scene load_scene(const std::string& name_or_path) {
  return read_scene(model::find(name_or_path, "scenes", "scene", &model::throw_unknown<UnknownScene>));
}

Scene read_scene(const std::filesystem::path& file) {
  const std::string source = file.string();
  try {
    model::Value data = model::parse_toml(model::read_file(source, model::max_toml_bytes, "", source));
    if (!data.find("name")) data.set("name", file.stem().string());
    const Scene scene = model::scene_from(data, source);
    require_ground(scene);
    return scene;
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidScene>(found, source);
  }
}

void require_ground(const Scene& scene) {
  scene.validate();
  model::Findings found;
  found.check({"start"}, [&] { require_ground_below(scene, scene.start, "start"); });
  found.check({"goal"}, [&] { require_ground_below(scene, scene.goal, "goal"); });
  found.raise<InvalidScene>();
}

void save_scene(const Scene& scene, const std::filesystem::path& file) {
  scene.validate();
  model::write_whole(model::toml_text(model::written(scene)), file);
}

bool operator==(const Scene& a, const Scene& b) { return model::equal(a, b); }

}  // namespace mcplan
