#include "mcplan/base/suspicion.hpp"

#include "mcplan/base/error.hpp"

namespace mcplan {

std::string Suspicion::to_string() const { return InvalidInput(field, rule, value).what(); }

}  // namespace mcplan
