#pragma once

#include <string>
#include <string_view>

namespace mcplan::model {

/// What a file is that cannot be read as what was expected, with its article: "a PNG picture", "an .npz archive",
/// "JSON", "binary data"; "" for text of which nothing tells what it is.
std::string file_kind(std::string_view content);

/// The same where TOML is possible, too.
std::string file_kind_or_toml(std::string_view content);

}  // namespace mcplan::model
