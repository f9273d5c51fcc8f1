// The robot was pushed: plan on from the state that was measured instead of the one that was planned.

#include <cstdio>
#include <mcplan/mcplan.hpp>
#include <string>

int main() {
  const mcplan::Scene scene = mcplan::load_scene("gap");
  const mcplan::Robot robot = mcplan::load_robot("humanoid44");
  auto planner = mcplan::ddp::SwitchedDdp(scene, robot);
  const mcplan::PlanResult first = planner.solve();

  const double t = 1.0;  // [s]
  const mcplan::PlanState planned = first.plan.at(t);
  mcplan::Knot measured;
  measured.com_W = planned.com_W;
  measured.com_velocity_W = planned.com_velocity_W + Eigen::Vector3d(0.0, 0.03, 0.0);  // a push to the left [m/s]
  measured.base_rpy = planned.base_rpy;
  measured.base_rpy_rate = planned.base_rpy_rate;
  for (const mcplan::EndEffectorState& end_effector : planned.end_effectors) {
    measured.end_effectors_W.push_back(end_effector.position_W);
    measured.end_effector_velocities_W.push_back(end_effector.velocity_W);
  }

  const mcplan::PlanResult second = planner.replan(first.plan, t, measured);
  std::printf("first: %s in %.3f s; from the measured state: %s in %.3f s\n",
              std::string(mcplan::to_string(first.report.status)).c_str(), first.report.time_s,
              std::string(mcplan::to_string(second.report.status)).c_str(), second.report.time_s);

  const double jump = (second.plan.at(0.0).com_velocity_W - measured.com_velocity_W).norm();
  std::printf("the new plan starts %.1e m/s from the measured velocity\n", jump);
  return second.report.status == mcplan::Status::solved ? 0 : 1;
}
