#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mcplan/base/suspicion.hpp"
#include "mcplan/model/data.hpp"  // which tells where the built-in robots lie
#include "mcplan/robot/robot.hpp"

namespace mcplan {

/// The robot of a built-in name ("talos"; built_in("robots") lists them) or of a TOML file; a built-in name means the
/// built-in robot. Throws UnknownRobot, which lists the names that exist, and InvalidRobot with all that is wrong.
Robot load_robot(const std::string& name_or_path);

/// The robot of a TOML file. What it names (its URDF, files of reach polytopes) lies beside it or below. Throws
/// InvalidRobot.
Robot read_robot(const std::filesystem::path& file);

/// What of a robot can hardly be meant: numbers that look like millimetres, degrees, milliseconds or grams, and an
/// inertia that no body has. Loading says nothing of it. Throws InvalidRobot.
std::vector<Suspicion> suspicious_geometry(const Robot& robot);

/// Writes a TOML file, which is complete or not there at all; reach polytopes are inline. Throws InvalidRobot,
/// std::filesystem::filesystem_error.
void save_robot(const Robot& robot, const std::filesystem::path& file);

/// Whether two robots are the same, number by number.
bool operator==(const Robot& a, const Robot& b);
inline bool operator!=(const Robot& a, const Robot& b) { return !(a == b); }

}  // namespace mcplan
