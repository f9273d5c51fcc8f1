#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace mcplan::model {

// What may be read how far; also in docs/scenes_and_robots.md, "Limits of files".
constexpr std::size_t kib = 1024, mib = 1024 * kib;
constexpr std::size_t max_toml_bytes = 2 * mib;        ///< of a scene, robot or planar task
constexpr std::size_t max_polytope_bytes = 8 * mib;    ///< of a JSON file with reach polytopes
constexpr std::size_t max_plan_bytes = 64 * mib;       ///< of a plan as it lies on the disk
constexpr std::size_t max_json_plan_bytes = 16 * mib;  ///< of a plan in JSON

/// A limit of bytes in words.
std::string size_text(std::size_t bytes);

/// The content of a regular file. It is opened once, and what is known of it is asked of the open file, so that it
/// cannot be exchanged meanwhile. `field`: where another file names this one, "" where the user does; `source`: the
/// file named in messages. Throws InvalidInput: there is no such file, it cannot be read, is no regular file, or is too
/// large.
std::string read_file(const std::string& path, std::size_t max_bytes, const std::string& field,
                      const std::string& source);

/// The path of a file that another file names: it lies in the folder of that one, or below, after symbolic links are
/// followed; what mcplan brings itself may lie anywhere. Throws InvalidInput.
std::filesystem::path referenced(const std::filesystem::path& folder, const std::string& name, const std::string& field,
                                 const std::string& source);

}  // namespace mcplan::model
