#include "mcplan/rhp/options.hpp"

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "options_fields.hpp"

namespace mcplan::rhp {

void Options::validate() const { model::require_ranges<InvalidOptions>(*this); }

}  // namespace mcplan::rhp
