#include <cmath>

#include "planar/sip/constraints.hpp"

namespace mcplan::sip {

// position_min <= q <= position_max, narrowed by the margin
void limit_positions(IntervalMotion& motion, std::vector<Limited>& out) {
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    const PlanarBody& body = motion.task.robot.bodies[j + 1];
    const double range = body.position_max - body.position_min;
    const double margin = std::isfinite(range) ? motion.options.margin * range : 0.0;
    if (std::isinf(body.position_min) && std::isinf(body.position_max)) continue;
    out.push_back(
        {"position of " + body.name, motion.joints[j], body.position_min + margin, body.position_max - margin});
  }
}

// |2/h dq/ds| <= velocity_max
void limit_velocities(IntervalMotion& motion, std::vector<Limited>& out) {
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    const PlanarBody& body = motion.task.robot.bodies[j + 1];
    if (std::isinf(body.velocity_max)) continue;
    const double limit = (1.0 - motion.options.margin) * body.velocity_max;
    const TaylorGraph::Node velocity = motion.timed(motion.graph.derivative(motion.joints[j]), 1);
    out.push_back({"velocity of " + body.name, velocity, -limit, limit, 1.0 / body.velocity_max});
  }
}

// |torque| <= torque_max
void limit_torques(IntervalMotion& motion, std::vector<Limited>& out) {
  for (std::size_t j = 0; j < motion.torques.size(); ++j) {
    const PlanarBody& body = motion.task.robot.bodies[j + 1];
    if (std::isinf(body.torque_max)) continue;
    const double limit = (1.0 - motion.options.margin) * body.torque_max;
    out.push_back({"torque of " + body.name, motion.torques[j], -limit, limit, 1.0 / body.torque_max});
  }
}

}  // namespace mcplan::sip
