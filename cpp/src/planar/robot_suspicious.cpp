#include <utility>

#include "mcplan/planar/robot_files.hpp"
#include "model/suspicious.hpp"
#include "model/text.hpp"

namespace mcplan {

std::vector<Suspicion> suspicious_geometry(const PlanarRobot& robot) {
  robot.validate();
  double length = 0.0;
  for (const PlanarBody& body : robot.bodies) length += body.joint_P.norm();
  if (robot.gravity <= model::strong_gravity || length > model::high_com_m) return {};
  return {
      {"gravity", model::gravity_rule,
       model::digits(robot.gravity, "%g") + " m/s^2 beside limbs of " + model::digits(length, "%.3g") + " m together"}};
}

}  // namespace mcplan
