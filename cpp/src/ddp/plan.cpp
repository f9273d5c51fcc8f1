#include "mcplan/ddp/plan.hpp"

#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/robot/standing.hpp"

namespace mcplan::ddp {

PlanResult plan(const Scene& scene, const Robot& robot, const Options& options) {
  require_standing(scene, robot);
  return SwitchedDdp(scene, robot, options).solve();
}

}  // namespace mcplan::ddp
