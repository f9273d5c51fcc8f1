#pragma once

#include <string>
#include <string_view>

#include "value.hpp"

namespace mcplan::model {

/// The tables of a TOML file. Throws InvalidInput without field and source: no UTF-8, empty, no TOML, nested too deep.
Value parse_toml(std::string_view text);

/// A table as TOML: plain values first, then tables and lists of tables. `header`: a comment to put on top.
std::string toml_text(const Value& table, const std::string& header = "");

}  // namespace mcplan::model
