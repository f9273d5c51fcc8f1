#include "mcplan/planar/robot_files.hpp"

#include <algorithm>

#include "mcplan/base/error.hpp"
#include "model/find.hpp"
#include "model/read.hpp"
#include "model/reading.hpp"
#include "model/toml.hpp"
#include "model/write.hpp"
#include "model/writing.hpp"
#include "robot_fields.hpp"

namespace mcplan {
namespace {

using model::InFile;
using model::Value;

/// The index of the body that a body names as its parent.
int parent_of(const InFile<PlanarBody>& body, int index, const model::NameList& bodies, const model::Place& at,
              model::Reading& reading) {
  const std::optional<std::string>& name = body.keys.parent;
  const auto wrong = [&](const std::string& rule) {
    reading.found.add(at, rule, name ? model::shown(*name) : "");
    return -1;
  };
  if (!name) return index > 0 ? wrong("is required of every body but the first, the base") : -1;
  if (index == 0) return wrong("must be left out for the first body, the base");
  model::NameList above = bodies;
  above.names.resize(std::min<std::size_t>(above.names.size(), static_cast<std::size_t>(index)));
  if (std::find(above.names.begin(), above.names.end(), *name) == above.names.end() &&
      std::find(bodies.names.begin(), bodies.names.end(), *name) != bodies.names.end())
    return wrong("must come before its children, and no body may be its own ancestor");
  int parent = -1;
  model::find_name(*name, above, "a body above this one", parent, at, reading);
  return parent;
}

void take_bodies(const std::vector<InFile<PlanarBody>>& bodies, PlanarRobot& robot, model::Reading& reading) {
  const model::Place root, list(root, "bodies");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    robot.bodies.push_back(bodies[i].value);
    const model::Place at(list, i), parent(at, "parent");
    if (reading.found.sound(parent.text()))
      robot.bodies.back().parent = parent_of(bodies[i], static_cast<int>(i), reading.lists["bodies"], parent, reading);
  }
}

}  // namespace

namespace model {

PlanarRobot planar_robot_from(const Value& data, const std::string& source) {
  Reading reading;
  reading.source = source;
  InFile<PlanarRobot> file;
  if (require_few_keys(data, reading.found)) {
    reading.lists["bodies"] = names_in(data.find("bodies"));
    read_struct(data, file, Place(), reading);
    take_bodies(file.keys.bodies, file.value, reading);
    relations(file.value, reading.found);
  }
  reading.found.raise<InvalidRobot>(source);
  return file.value;
}

Value planar_robot_data(const PlanarRobot& robot) {
  InFile<PlanarRobot> file{robot, {}};
  for (const PlanarBody& body : robot.bodies) {
    file.keys.bodies.push_back({body, {}});
    if (body.parent >= 0)
      file.keys.bodies.back().keys.parent = robot.bodies[static_cast<std::size_t>(body.parent)].name;
  }
  Writing writing;
  writing.lists["bodies"] = names_of(robot.bodies);
  return written(file, writing);
}

}  // namespace model

PlanarRobot load_planar_robot(const std::string& name_or_path) {
  return read_planar_robot(model::find(name_or_path, "planar_robots", "robot", &model::throw_unknown<UnknownRobot>));
}

PlanarRobot model::planar_robot_in(const std::string& content, const std::filesystem::path& file) {
  const std::string source = file.string();
  try {
    Value data = parse_toml(content);
    if (!data.find("name")) data.set("name", file.stem().string());
    return planar_robot_from(data, source);
  } catch (const InvalidInput& found) {
    throw_as<InvalidRobot>(found, source);
  }
}

PlanarRobot read_planar_robot(const std::filesystem::path& file) {
  const std::string source = file.string();
  try {
    return model::planar_robot_in(model::read_file(source, model::max_toml_bytes, "", source), file);
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidRobot>(found, source);
  }
}

void save_planar_robot(const PlanarRobot& robot, const std::filesystem::path& file) {
  robot.validate();
  model::write_whole(model::toml_text(model::planar_robot_data(robot)), file);
}

bool operator==(const PlanarRobot& a, const PlanarRobot& b) { return model::equal(a, b); }

}  // namespace mcplan
