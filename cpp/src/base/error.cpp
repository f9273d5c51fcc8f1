#include "mcplan/base/error.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

namespace mcplan {

namespace {

constexpr std::size_t max_listed = 20;

/// "<source>: <field>: <rule>, got <value>" without the parts that are missing.
std::string line(const InvalidInput& found) {
  std::string out;
  for (const std::string& part : {found.source(), found.field(), found.rule()})
    if (!part.empty()) out += (out.empty() ? "" : ": ") + part;
  return out + (found.value().empty() ? "" : ", got " + found.value());
}

}  // namespace

InvalidInput::InvalidInput(std::string field, std::string rule, std::string value, std::string source)
    : std::invalid_argument(rule),
      field_(std::move(field)),
      rule_(std::move(rule)),
      value_(std::move(value)),
      source_(std::move(source)) {
  text_ = line(*this);
}

void InvalidInput::add(const InvalidInput& other) {
  others_.push_back(other);
  if (others_.size() < max_listed) {
    text_ += "\n" + line(other);
  } else {
    if (others_.size() > max_listed) text_.erase(text_.rfind('\n'));
    text_ += "\nand " + std::to_string(others_.size() + 1 - max_listed) + " more";
  }
}

std::string text(double value) {
  std::ostringstream out;
  constexpr double kDigits = 1e15;  // whole numbers below are written in full: 1234567, not 1.23457e+06
  if (value == std::floor(value) && std::abs(value) < kDigits) out << std::setprecision(15);
  out << value;
  return out.str();
}

std::string text(int value) { return std::to_string(value); }

std::string text(const std::string& value) {
  std::string out = "\"";
  for (const char c : value) out.append(c == '"' || c == '\\' ? 1 : 0, '\\') += c;
  return out + "\"";
}

std::string text(const Eigen::Ref<const Eigen::VectorXd>& value) {
  std::ostringstream out;
  out << '[';
  for (Eigen::Index i = 0; i < value.size(); ++i) out << (i ? ", " : "") << text(value[i]);
  out << ']';
  return out.str();
}

}  // namespace mcplan
