#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace mcplan::model {

/// Throws a class of UnknownName with a message, the name, and the legal names.
using Unknown = void (*)(const std::string& message, const std::string& name, const std::vector<std::string>& legal);

template <class Error>
void throw_unknown(const std::string& message, const std::string& name, const std::vector<std::string>& legal) {
  throw Error(message, name, legal);
}

/// Whether there is a file of that name.
bool is_there(const std::string& path);

/// Path of a built-in file of a kind ("scenes"), or `source` itself if there is such a file; a built-in name means the
/// built-in file. `word`: what messages call it ("scene").
std::filesystem::path find(const std::string& source, const std::string& kind, const std::string& word,
                           Unknown unknown);

}  // namespace mcplan::model
