#include "mcplan/base/error.hpp"

#include <sstream>
#include <utility>

namespace mcplan {

InvalidInput::InvalidInput(std::string field, std::string rule, std::string value)
    : std::invalid_argument(field + ": " + rule + ", got " + value),
      field_(std::move(field)),
      rule_(std::move(rule)),
      value_(std::move(value)) {}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string text(int value) { return std::to_string(value); }

std::string text(const std::string& value) { return "'" + value + "'"; }

std::string text(const Eigen::Ref<const Eigen::VectorXd>& value) {
  std::ostringstream out;
  out << '[';
  for (Eigen::Index i = 0; i < value.size(); ++i) out << (i ? ", " : "") << value[i];
  out << ']';
  return out.str();
}

}  // namespace mcplan
