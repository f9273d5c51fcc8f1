#pragma once

#include <string>
#include <string_view>

#include "value.hpp"

namespace mcplan::model {

/// The value of a JSON text. Throws std::invalid_argument with what there is instead (no JSON, nested too deep, a key
/// twice in a table), std::length_error with the rule where it has too many values.
Value parse_json(std::string_view text);

/// A value as JSON; numbers read back as the same doubles. `indent`: spaces a level, 0: on one line;
/// `open_levels`: what lies deeper stands on one line.
std::string json_text(const Value& value, int indent = 0, int open_levels = 100);

}  // namespace mcplan::model
