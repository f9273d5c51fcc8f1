#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <vector>

namespace mcplan {

/// Bad input from the user. what() reads "<field>: <rule>, got <value>", e.g.
/// "surfaces[3].vertices: needs at least 3 points, got 2".
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(std::string field, std::string rule, std::string value);

  const std::string& field() const { return field_; }
  const std::string& rule() const { return rule_; }
  const std::string& value() const { return value_; }

  /// What else is wrong with the same input.
  const std::vector<InvalidInput>& others() const { return others_; }
  void add(const InvalidInput& other) { others_.push_back(other); }

 private:
  std::string field_, rule_, value_;
  std::vector<InvalidInput> others_;
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

/// Makes checks one after the other and throws what they have found together: the first error with the others.
template <class Error>
class Validation {
 public:
  /// Make a check that throws an Error; false: it did.
  template <class Check>
  bool operator()(const Check& check) {
    try {
      check();
      return true;
    } catch (const Error& found) {
      found_.push_back(found);
      return false;
    }
  }

  void raise() const {
    if (found_.empty()) return;
    Error all = found_.front();
    for (std::size_t i = 1; i < found_.size(); ++i) all.add(found_[i]);
    throw all;
  }

 private:
  std::vector<Error> found_;
};

/// Short texts for the `value` of an error.
std::string text(double value);
std::string text(int value);
std::string text(const std::string& value);  ///< quoted
std::string text(const Eigen::Ref<const Eigen::VectorXd>& value);

}  // namespace mcplan
