#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "value.hpp"

namespace mcplan::model {

/// Shortest decimal number that reads back as the same double: 0.1, 1e-05, 2.0, nan, inf.
std::string number_text(double value);

/// A number, or numbers in brackets, by a format of printf, such as "%.4g".
std::string digits(double value, const char* format);
std::string digits(const Eigen::Ref<const Eigen::VectorXd>& values, const char* format);

/// In quotes, with control characters and those that no terminal shows written out.
std::string quote(std::string_view text);

/// Control characters, and those that no terminal shows, written out.
std::string printable(std::string_view text);

/// Whether a key may stand in TOML without quotes.
bool is_bare_key(const std::string& key);

/// A value as text for a message, in the words of TOML: true, "x", { a = 1 }. 60 characters at most.
std::string shown(const Value& value);

/// Characters of UTF-8 text.
std::size_t length(std::string_view text);

/// The first characters of UTF-8 text.
std::string_view prefix(std::string_view text, std::size_t characters);

/// Offset of the first byte that is no UTF-8, or npos.
std::size_t first_not_utf8(std::string_view text);

/// The legal name that is most like a name, or "" if none is like it.
std::string nearest(std::string_view name, const std::vector<std::string>& legal);

/// "Did you mean 'stairs'? " if one of the legal names is near, else "".
std::string did_you_mean(std::string_view name, const std::vector<std::string>& legal);

/// "must name a body. Did you mean 'hip'? There are: hip, left, right": what a name breaks that is none of the legal
/// ones.
std::string name_rule(const std::string& what, std::string_view name, const std::vector<std::string>& legal);

std::string joined(const std::vector<std::string>& names, const char* separator = ", ");

}  // namespace mcplan::model
