#pragma once

#include <filesystem>
#include <string>

namespace mcplan::model {

/// Writes a file, which is complete or not there at all: it is made beside its target under a name of its own and then
/// renamed. A link goes on pointing where it points; devices and pipes are written through. Throws
/// std::filesystem::filesystem_error naming the file.
void write_whole(const std::string& content, const std::filesystem::path& file);

}  // namespace mcplan::model
