#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

namespace mcplan {

/// Bad input from the user. what() reads "<field>: <rule>, got <value>", e.g.
/// "surfaces[3].vertices: needs at least 3 points, got 2".
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(std::string field, std::string rule, std::string value);

  const std::string& field() const { return field_; }
  const std::string& rule() const { return rule_; }
  const std::string& value() const { return value_; }

 private:
  std::string field_, rule_, value_;
};

class InvalidScene : public InvalidInput {
  using InvalidInput::InvalidInput;
};
class InvalidRobot : public InvalidInput {
  using InvalidInput::InvalidInput;
};
class InvalidOptions : public InvalidInput {
  using InvalidInput::InvalidInput;
};
class InvalidPlan : public InvalidInput {
  using InvalidInput::InvalidInput;
};

/// Short texts for the `value` of an error.
std::string text(double value);
std::string text(int value);
std::string text(const std::string& value);  ///< quoted
std::string text(const Eigen::Ref<const Eigen::VectorXd>& value);

}  // namespace mcplan
