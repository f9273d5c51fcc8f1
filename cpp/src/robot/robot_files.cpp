#include "mcplan/robot/robot_files.hpp"

#include "mcplan/base/error.hpp"
#include "model/find.hpp"
#include "model/json.hpp"
#include "model/read.hpp"
#include "model/reading.hpp"
#include "model/toml.hpp"
#include "model/write.hpp"
#include "model/writing.hpp"
#include "robot_fields.hpp"

namespace mcplan {
namespace {

using model::PolytopeTable;
using model::Reading;
using model::Value;

/// How a robot names a URDF of the package example-robot-data.
constexpr const char* urdf_package = "example-robot-data:";

/// The polytopes of a JSON file, by name.
Value polytope_entries(const std::string& path, const std::string& field, const std::string& source) {
  const std::string name = std::filesystem::path(path).filename().string();
  const std::string content = model::read_file(path, model::max_polytope_bytes, field, source);
  Value data;
  try {
    data = model::parse_json(content);
  } catch (const std::invalid_argument& bad) {
    throw InvalidInput(field, "must be a JSON file", model::printable(name + ": " + bad.what()));
  } catch (const std::length_error& bad) {
    throw InvalidInput(field, bad.what(), model::printable(name + ": more"));
  }
  const Value* const entries = data.find("polytopes");
  if (!entries || !entries->get<Value::Table>())
    throw InvalidInput(field, "must hold an object `polytopes`", model::shown(name));
  return *entries;
}

/// Takes A and b from the file that a table names.
void read_named(PolytopeTable& table, const model::Place& at, Reading& reading) {
  const std::string field = at.text() + ".file";
  if (table.A.rows() > 0 || table.b.size() > 0)
    throw InvalidInput(field, "must stand alone, without A and b", model::shown(table.file));
  if (!reading.in_file) throw InvalidInput(field, "may be used in files alone; here A and b", model::shown(table.file));
  const auto path = model::referenced(reading.folder, table.file, field, reading.source);
  const Value entries = polytope_entries(path.string(), field, reading.source);
  const Value* const found = entries.find(table.name);
  if (!found) {
    std::vector<std::string> names;
    for (const model::Entry& entry : *entries.get<Value::Table>()) names.push_back(entry.key);
    std::string near = model::did_you_mean(table.name, names);
    if (names.size() > 20) names.resize(20);
    for (std::string& name : names) name = model::printable(model::prefix(name, 60));
    if (!near.empty()) near = " " + near.substr(0, near.size() - 1);
    throw InvalidInput(at.text() + ".name",
                       "must be in " + path.filename().string() + " (" + model::joined(names) + ")." + near,
                       model::shown(table.name));
  }
  Reading inner;
  PolytopeTable numbers;
  if (model::require_few_keys(*found, inner.found)) model::read_struct(*found, numbers, model::Place(), inner);
  inner.found.raise<InvalidInput>(path.string() + ": " + table.name);
  table.A = numbers.A;
  table.b = numbers.b;
}

/// The URDF that a file names, as the working directory sees it: relative paths count from the folder of the file;
/// where there is none, from the working directory, as older files do.
std::string urdf_of(const std::string& urdf, const Reading& reading) {
  if (urdf.empty() || urdf.rfind(urdf_package, 0) == 0) return urdf;
  const std::string beside = (reading.folder / urdf).string();
  const bool elsewhere = model::is_there(urdf) && !model::is_there(beside);
  std::error_code failed;  // where the working directory is gone
  const std::string named = elsewhere ? std::filesystem::absolute(urdf, failed).string() : urdf;
  model::referenced(reading.folder, failed ? urdf : named, "urdf", reading.source);
  return model::is_there(beside) ? beside : urdf;
}

}  // namespace

bool model::read_value(const Value& value, Polytope& out, const Rules&, const Place& at, Reading& reading) {
  PolytopeTable table;
  if (!read_struct(value, table, at, reading)) return false;
  if (!reading.found.sound(at.text())) return false;
  try {
    if (!table.file.empty())
      read_named(table, at, reading);
    else if (table.A.rows() == 0)
      throw InvalidInput(at.text() + ".A", "is required, or file and name", "");
  } catch (const InvalidInput& found) {
    reading.found.add(found);
    reading.found.lacks(at.text());
    return false;
  }
  out.A = table.A;
  out.b = table.b;
  return true;
}

Robot model::robot_from(const Value& data, const std::string& source, const std::filesystem::path* folder) {
  Reading reading;
  reading.source = source;
  reading.in_file = folder != nullptr;
  if (folder) reading.folder = *folder;
  Robot robot;
  if (require_few_keys(data, reading.found)) {
    read_struct(data, robot, Place(), reading);
    if (folder) reading.found.check({"urdf"}, [&] { robot.urdf = urdf_of(robot.urdf, reading); });
    relations(robot, reading.found);
  }
  reading.found.raise<InvalidRobot>(source);
  return robot;
}

Robot load_robot(const std::string& name_or_path) {
  return read_robot(model::find(name_or_path, "robots", "robot", &model::throw_unknown<UnknownRobot>));
}

Robot read_robot(const std::filesystem::path& file) {
  const std::string source = file.string();
  try {
    Value data = model::parse_toml(model::read_file(source, model::max_toml_bytes, "", source));
    if (!data.find("name")) data.set("name", file.stem().string());
    const std::filesystem::path folder = file.parent_path();
    return model::robot_from(data, source, &folder);
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidRobot>(found, source);
  }
}

void save_robot(const Robot& robot, const std::filesystem::path& file) {
  robot.validate();
  model::write_whole(model::toml_text(model::written(robot)), file);
}

bool operator==(const Robot& a, const Robot& b) { return model::equal(a, b); }

}  // namespace mcplan
