#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mcplan {

/// Bad input from the user. what() reads "<source>: <field>: <rule>, got <value>", e.g.
/// "my.toml: surfaces[3].vertices: needs at least 3 points, got 2"; source (a file), field and value may be missing.
/// Where more than one thing is wrong, what() lists up to 20 of them, a line each.
class InvalidInput : public std::invalid_argument {
 public:
  InvalidInput(std::string field, std::string rule, std::string value, std::string source = "");

  const char* what() const noexcept override { return text_.c_str(); }
  const std::string& field() const { return field_; }
  const std::string& rule() const { return rule_; }
  const std::string& value() const { return value_; }
  const std::string& source() const { return source_; }

  /// What else is wrong with the same input.
  const std::vector<InvalidInput>& others() const { return others_; }
  void add(const InvalidInput& other);

 private:
  std::string field_, rule_, value_, source_, text_;
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

/// No built-in of that name and no file of that name; what() lists the names that exist.
class UnknownName : public std::invalid_argument {
 public:
  UnknownName(const std::string& message, std::string name, std::vector<std::string> legal)
      : std::invalid_argument(message), name_(std::move(name)), legal_(std::move(legal)) {}

  const std::string& name() const { return name_; }
  const std::vector<std::string>& legal() const { return legal_; }

 private:
  std::string name_;
  std::vector<std::string> legal_;
};

class UnknownScene : public UnknownName {
  using UnknownName::UnknownName;
};
class UnknownRobot : public UnknownName {
  using UnknownName::UnknownName;
};
class UnknownPlanarTask : public UnknownName {
  using UnknownName::UnknownName;
};

/// An error as one of another kind, of another file ("": as it was), and of a field within another one.
template <class Error>
Error moved(const InvalidInput& found, const std::string& source = "", const std::string& prefix = "") {
  const auto one = [&](const InvalidInput& each) {
    const std::string dot = prefix.empty() || each.field().empty() ? "" : ".";
    return Error(prefix + dot + each.field(), each.rule(), each.value(), source.empty() ? each.source() : source);
  };
  Error out = one(found);
  for (const InvalidInput& other : found.others()) out.add(one(other));
  return out;
}

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
std::string text(const std::string& value);  ///< in quotes, as files write it
std::string text(const Eigen::Ref<const Eigen::VectorXd>& value);

}  // namespace mcplan
