#include "mcplan/planar/task_files.hpp"

#include <algorithm>
#include <regex>

#include "mcplan/planar/robot_files.hpp"
#include "model/find.hpp"
#include "model/read.hpp"
#include "model/reading.hpp"
#include "model/toml.hpp"
#include "model/write.hpp"
#include "model/writing.hpp"
#include "stances.hpp"
#include "task_fields.hpp"

namespace mcplan {
namespace {

using model::InFile;
using model::Place;
using model::Reading;
using model::Value;

constexpr int end_intervals = 3, middle_intervals = 4;  // of the first and last phase, and of those between

/// The robot of a task: its table, a built-in one, or a file, which lies beside that of the task or below.
class RobotOfTask {
 public:
  RobotOfTask(const Value* entry, const std::filesystem::path* folder, Reading& reading)
      : folder_(folder), reading_(reading) {
    const auto* const name = entry ? entry->get<std::string>() : nullptr;
    try {
      if (name && !name->empty())
        by_name(*name);
      else if (entry && entry->get<Value::Table>())
        inline_robot(*entry);
    } catch (const InvalidRobot& found) {
      is_wrong = true;
      reading_.found.add(found);
    } catch (const InvalidInput& found) {
      reading_.found.add(found);
    } catch (const UnknownRobot& found) {
      unknown = found;
    }
    if (!is_read) reading_.found.lacks("robot");
    set_lists(is_read ? nullptr : entry);
  }

  PlanarRobot robot;
  bool is_read = false, is_wrong = false;
  std::optional<UnknownRobot> unknown;

 private:
  void inline_robot(Value table) {
    if (!table.find("name")) table.set("name", "robot");
    try {
      robot = model::planar_robot_from(table);
    } catch (const InvalidRobot& found) {
      throw moved<InvalidRobot>(found, reading_.source, "robot");
    }
    is_read = true;
  }

  void by_name(const std::string& name) {
    const std::vector<std::string> legal = built_in("planar_robots");
    const bool is_built_in = std::find(legal.begin(), legal.end(), name) != legal.end();
    std::filesystem::path path = folder_ ? *folder_ / name : std::filesystem::path(name);
    if (folder_ && !model::is_there(path.string()) && model::is_there(name)) path = name;
    if (is_built_in || !folder_ || !model::is_there(path.string())) {
      robot = load_planar_robot(name);
    } else {
      std::error_code failed;  // where the working directory is gone
      const std::filesystem::path absolute = std::filesystem::absolute(path, failed);
      path = model::referenced(*folder_, failed ? name : absolute.string(), "robot", reading_.source);
      robot = model::planar_robot_in(model::read_file(path.string(), model::max_toml_bytes, "robot", reading_.source),
                                     path);
    }
    is_read = true;
  }

  /// The names by which the task speaks of the robot's parts.
  void set_lists(const Value* entry) {
    reading_.lists["bodies"] =
        is_read ? model::names_of(robot.bodies) : model::names_in(entry ? entry->find("bodies") : nullptr);
    reading_.lists["end_effectors"] = is_read ? model::names_of(robot.end_effectors)
                                              : model::names_in(entry ? entry->find("end_effectors") : nullptr);
  }

  const std::filesystem::path* folder_;
  Reading& reading_;
};

std::vector<PlanarPose> poses_of(const std::vector<InFile<PlanarPose>>& entries, const Place& phase, Reading& reading) {
  std::vector<PlanarPose> out;
  const Place list(phase, "poses");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Place at(list, i);
    PlanarPose pose = entries[i].value;
    int axis = 0;
    model::for_each_key(entries[i].keys, [&](const auto& f, const Eigen::Vector2d& range) {
      if (!(range[0] <= range[1]))
        reading.found.add(Place(at, f.key), "must read [from, to], with from not above to",
                          model::shown(model::written_value(range)));
      pose.min[axis] = range[0];
      pose.max[axis] = range[1];
      ++axis;
    });
    out.push_back(pose);
  }
  return out;
}

void take_surfaces(const std::vector<InFile<PlanarSurface>>& entries, PlanarTask& task) {
  for (const InFile<PlanarSurface>& entry : entries) {
    task.surfaces.push_back(entry.value);
    task.surfaces.back().from = entry.keys.extent[0];
    task.surfaces.back().to = entry.keys.extent[1];
  }
}

void take_phases(const std::vector<InFile<PlanarPhase>>& entries, bool robot_is_read, planar::Stances& stances,
                 PlanarTask& task, Reading& reading) {
  const Place root, list(root, "phases");
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const model::PlanarPhaseKeys& keys = entries[k].keys;
    const bool at_an_end = k == 0 || k + 1 == entries.size();
    PlanarPhase phase = entries[k].value;
    phase.intervals = keys.intervals.value_or(at_an_end ? end_intervals : middle_intervals);
    phase.poses = poses_of(keys.poses, Place(list, k), reading);
    if (robot_is_read) phase.contacts = stances.next(keys);
    task.phases.push_back(std::move(phase));
  }
}

/// The field of a surface as the file calls it.
InvalidPlanarTask with_extent(const InvalidPlanarTask& found) {
  static const std::regex ends("^(surfaces\\[\\d+\\])\\.(from|to)$");
  return {std::regex_replace(found.field(), ends, "$1.extent"), found.rule(), found.value()};
}

}  // namespace

namespace model {

PlanarTask planar_task_from(const Value& data, const std::string& source, const std::filesystem::path* folder) {
  Reading reading;
  reading.source = source;
  if (!require_few_keys(data, reading.found)) reading.found.raise<InvalidPlanarTask>(source);
  RobotOfTask robot(data.find("robot"), folder, reading);
  reading.lists["surfaces"] = names_in(data.find("surfaces"));
  InFile<PlanarTask> file;
  read_struct(data, file, Place(), reading);
  PlanarTask& task = file.value;
  task.robot = robot.robot;
  take_surfaces(file.keys.surfaces, task);
  planar::Stances stances(task, reading.found);
  take_phases(file.keys.phases, robot.is_read, stances, task, reading);
  relations(task, reading.found, [&](const InvalidPlanarTask& found) { return with_extent(stances.located(found)); });
  if (robot.unknown && reading.found.empty()) {
    const std::string where = reading.source.empty() ? "" : model::printable(reading.source) + ": ";
    throw UnknownRobot(where + "robot: " + robot.unknown->what(), robot.unknown->name(), robot.unknown->legal());
  }
  if (robot.is_wrong) reading.found.raise<InvalidRobot>(source);
  reading.found.raise<InvalidPlanarTask>(source);
  return task;
}

Value planar_task_data(const PlanarTask& task) {
  InFile<PlanarTask> file{task, {}};
  file.keys.robot.table = planar_robot_data(task.robot);
  for (const PlanarSurface& surface : task.surfaces)
    file.keys.surfaces.push_back({surface, {{surface.from, surface.to}}});
  for (const PlanarPhase& phase : task.phases) {
    InFile<PlanarPhase> entry{phase, {}};
    entry.keys.intervals = phase.intervals;
    for (const PlanarContact& contact : phase.contacts)
      entry.keys.contacts.push_back(
          {contact, planar::contact_keys(contact, task.surfaces[static_cast<std::size_t>(contact.surface)])});
    for (const PlanarPose& pose : phase.poses)
      entry.keys.poses.push_back(
          {pose, {{pose.min[0], pose.max[0]}, {pose.min[1], pose.max[1]}, {pose.min[2], pose.max[2]}}});
    file.keys.phases.push_back(std::move(entry));
  }
  Writing writing;
  writing.lists["bodies"] = names_of(task.robot.bodies);
  writing.lists["end_effectors"] = names_of(task.robot.end_effectors);
  writing.lists["surfaces"] = names_of(task.surfaces);
  return written(file, writing);
}

PlanarTask planar_task_from_exact(const Value& data) {
  Reading reading;
  reading.exact = true;
  PlanarTask task;
  if (require_few_keys(data, reading.found)) read_struct(data, task, Place(), reading);
  reading.found.raise<InvalidPlanarTask>();
  return task;
}

}  // namespace model

PlanarTask load_planar_task(const std::string& name_or_path) {
  return read_planar_task(
      model::find(name_or_path, "planar_tasks", "planar task", &model::throw_unknown<UnknownPlanarTask>));
}

PlanarTask read_planar_task(const std::filesystem::path& file) {
  const std::string source = file.string();
  try {
    Value data = model::parse_toml(model::read_file(source, model::max_toml_bytes, "", source));
    if (!data.find("name")) data.set("name", file.stem().string());
    const std::filesystem::path folder = file.parent_path();
    return model::planar_task_from(data, source, &folder);
  } catch (const InvalidRobot&) {
    throw;
  } catch (const InvalidInput& found) {
    model::throw_as<InvalidPlanarTask>(found, source);
  }
}

void save_planar_task(const PlanarTask& task, const std::filesystem::path& file) {
  task.validate();
  model::write_whole(model::toml_text(model::planar_task_data(task)), file);
}

bool operator==(const PlanarTask& a, const PlanarTask& b) { return model::equal(a, b); }

}  // namespace mcplan
