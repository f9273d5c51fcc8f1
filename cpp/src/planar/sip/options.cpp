#include "mcplan/planar/sip/options.hpp"

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "options_fields.hpp"

namespace mcplan::sip {

void Options::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  if (found.sound("order") && (neq < 0 || neq > order)) found.add("neq", "must lie in [0, order]", text(neq));
  found.raise<InvalidOptions>();
}

}  // namespace mcplan::sip
