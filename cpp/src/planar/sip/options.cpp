#include "mcplan/planar/sip/options.hpp"

#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "options_fields.hpp"

namespace mcplan::sip {

void Options::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  if (found.sound("order") && (neq < 0 || neq > order)) found.add("neq", "must lie in [0, order]", text(neq));
  if (solver == nlp::Solver::ipm && hessian == HessianChoice::limited_memory)
    found.add("hessian", "must be automatic, exact or gauss_newton with the solver ipm, which keeps no history",
              "limited_memory");
  found.raise<InvalidOptions>();
}

}  // namespace mcplan::sip
