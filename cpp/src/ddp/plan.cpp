#include "mcplan/ddp/plan.hpp"

#include "ddp/joined_ground.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/robot/standing.hpp"

namespace mcplan::ddp {

PlanResult plan(const Scene& scene, const Robot& robot, const Options& options) {
  require_standing(scene, robot);
  return SwitchedDdp(scene, robot, options).solve();
}

Plan on_joined_ground(const Plan& plan) {
  plan.validate();
  plan.scene.validate();
  const JoinedGround ground(plan.scene);
  return ground.any() ? ground.join(plan) : plan;
}

}  // namespace mcplan::ddp
