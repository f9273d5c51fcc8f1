#pragma once

#include <string>

namespace mcplan {

/// What is legal and can hardly be meant, such as lengths in millimetres; nothing is refused for it.
struct Suspicion {
  std::string field, rule, value;

  std::string to_string() const;  ///< as InvalidInput::what() reads
};

}  // namespace mcplan
