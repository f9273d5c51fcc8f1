#include "mcplan/ddp/plan.hpp"

#include "mcplan/ddp/switched_ddp.hpp"

namespace mcplan::ddp {

PlanResult plan(const Scene& scene, const Robot& robot, const Options& options) {
  return SwitchedDdp(scene, robot, options).solve();
}

}  // namespace mcplan::ddp
