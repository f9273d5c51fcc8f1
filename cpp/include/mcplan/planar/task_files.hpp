#pragma once

#include <filesystem>
#include <string>

#include "mcplan/model/data.hpp"  // which tells where the built-in tasks lie
#include "mcplan/planar/task.hpp"

namespace mcplan {

/// The planar task of a built-in name ("cartwheel"; built_in("planar_tasks") lists them) or of a TOML file; a
/// built-in name means the built-in one. Throws UnknownPlanarTask and UnknownRobot, which list the names that exist,
/// InvalidPlanarTask with all that is wrong, and InvalidRobot where its robot is.
PlanarTask load_planar_task(const std::string& name_or_path);

/// The planar task of a TOML file. The file of its robot, if it names one, lies beside it or below. Throws
/// InvalidPlanarTask, InvalidRobot, UnknownRobot.
PlanarTask read_planar_task(const std::filesystem::path& file);

/// Writes a TOML file, which is complete or not there at all; the robot is inline, and each phase has all its contacts.
/// Throws InvalidPlanarTask, InvalidRobot, std::filesystem::filesystem_error.
void save_planar_task(const PlanarTask& task, const std::filesystem::path& file);

/// Whether two planar tasks are the same, number by number, their robots too.
bool operator==(const PlanarTask& a, const PlanarTask& b);
inline bool operator!=(const PlanarTask& a, const PlanarTask& b) { return !(a == b); }

}  // namespace mcplan
