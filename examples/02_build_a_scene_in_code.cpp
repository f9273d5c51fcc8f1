// Build a scene in code: up a platform, with a turn of 30 degrees on the way. Then see what a mistake looks like.

#include <cstdio>
#include <iostream>
#include <mcplan/mcplan.hpp>

/// Rectangle at height z [m] with sides along x and y.
mcplan::Surface rectangle(const std::string& name, double x_min, double x_max, double y_min, double y_max, double z) {
  mcplan::Surface surface;
  surface.name = name;
  surface.vertices_W = {{x_min, y_min, z}, {x_max, y_min, z}, {x_max, y_max, z}, {x_min, y_max, z}};
  return surface;
}

int main() {
  constexpr double kPi = 3.14159265358979323846;

  mcplan::Scene scene;
  scene.name = "platform";
  scene.surfaces = {rectangle("ground", -1.0, 0.5, -1.0, 1.0, 0.0), rectangle("platform", 0.5, 2.0, -1.0, 1.0, 0.10)};
  scene.start.contacts = {{"foot", "ground"}};
  scene.goal.position_W = {1.2, 0.0, 0.10};
  scene.goal.yaw = kPi / 6.0;
  scene.goal.contacts = {{"foot", "platform"}};
  const mcplan::Robot robot = mcplan::load_robot("humanoid44");

  const mcplan::PlanResult result = mcplan::ddp::plan(scene, robot);
  const mcplan::PlanState end = result.plan.at(result.plan.duration());
  std::printf("%s after %.3f s; heading at the end %.1f degrees\n",
              std::string(mcplan::to_string(result.report.status)).c_str(), result.report.time_s,
              end.base_rpy.z() * 180.0 / kPi);

  scene.surfaces[1].vertices_W.resize(2);
  try {
    scene.validate();
    return 1;
  } catch (const mcplan::InvalidScene& error) {
    std::cout << "as expected: " << error.what() << '\n';
  }
  return result.report.status == mcplan::Status::solved ? 0 : 1;
}
