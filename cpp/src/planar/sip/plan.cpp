#include "mcplan/planar/sip/plan.hpp"

namespace mcplan::sip {

Result plan(const PlanarTask& task, const Options& options) { return Planner(task, options).solve(); }

}  // namespace mcplan::sip
