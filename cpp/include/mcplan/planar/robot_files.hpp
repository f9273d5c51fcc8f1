#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mcplan/base/suspicion.hpp"
#include "mcplan/model/data.hpp"  // which tells where the built-in planar robots lie
#include "mcplan/planar/robot.hpp"

namespace mcplan {

/// The planar robot of a built-in name ("walker9"; built_in("planar_robots") lists them) or of a TOML file; a built-in
/// name means the built-in robot. Throws UnknownRobot, which lists the names that exist, and InvalidRobot with all that
/// is wrong.
PlanarRobot load_planar_robot(const std::string& name_or_path);

/// The planar robot of a TOML file. Throws InvalidRobot.
PlanarRobot read_planar_robot(const std::filesystem::path& file);

/// What of a planar robot can hardly be meant: a gravity that contradicts the lengths. Loading says nothing of it.
/// Throws InvalidRobot.
std::vector<Suspicion> suspicious_geometry(const PlanarRobot& robot);

/// Writes a TOML file, which is complete or not there at all. Throws InvalidRobot, std::filesystem::filesystem_error.
void save_planar_robot(const PlanarRobot& robot, const std::filesystem::path& file);

/// Whether two planar robots are the same, number by number.
bool operator==(const PlanarRobot& a, const PlanarRobot& b);
inline bool operator!=(const PlanarRobot& a, const PlanarRobot& b) { return !(a == b); }

}  // namespace mcplan
