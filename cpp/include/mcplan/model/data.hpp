#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace mcplan {

/// The folder of the built-in scenes, robots and planar tasks: the environment's MCPLAN_DATA if it is set; else what
/// lies beside the compiled code, as in a wheel, or in ../share/mcplan of it; else what CMake told the program when it
/// was linked, for an installed tree or a build tree. An empty path where none of these exists.
std::filesystem::path data_folder();

/// Sorted names of the built-in files of a kind: "scenes", "robots", "planar_robots" or "planar_tasks".
std::vector<std::string> built_in(const std::string& kind);

/// Called before main() by whoever includes this header, with the folder that CMake hands on to those who link mcplan.
bool tell_data_folder(const char* folder);

#ifdef MCPLAN_DATA_FOLDER
namespace detail {
inline const bool data_folder_told = tell_data_folder(MCPLAN_DATA_FOLDER);
}
#endif

}  // namespace mcplan
