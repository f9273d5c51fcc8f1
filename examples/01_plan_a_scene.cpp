// Plan the jump over a gap, and ask the plan where the robot is and what carries it.

#include <cstdio>
#include <iostream>
#include <mcplan/mcplan.hpp>

int main() {
  const mcplan::Scene scene = mcplan::load_scene("gap");
  const mcplan::Robot robot = mcplan::load_robot("humanoid44");

  const mcplan::PlanResult result = mcplan::ddp::plan(scene, robot);
  std::cout << mcplan::to_string(result.report.status) << ": " << result.report.message << '\n';

  const mcplan::Plan& plan = result.plan;
  const std::vector<double> times = plan.knot_times();
  for (std::size_t k = 0; k < plan.phases.size(); ++k) {
    std::printf("%5.2f s  CoM height %.3f m  ", times[k], plan.at(times[k]).com_W.z());
    for (const mcplan::Contact& contact : plan.phases[k].contacts) {
      std::printf(" %-6s", contact.surface < 0 ? "-" : scene.surfaces[contact.surface].name.c_str());
    }
    std::puts("");
  }

  std::cout << mcplan::check(plan, scene, robot).to_string() << '\n';
  return result.report.status == mcplan::Status::solved ? 0 : 1;
}
