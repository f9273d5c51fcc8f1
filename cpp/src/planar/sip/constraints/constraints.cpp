#include "planar/sip/constraints.hpp"

namespace mcplan::sip {

std::vector<Limited> constraints_of(IntervalMotion& motion, const CloseDiscs* close) {
  const Options& options = motion.options;
  std::vector<Limited> out;
  limit_positions(motion, out);
  limit_velocities(motion, out);
  hold_contacts(motion, out);
  if (options.dynamics) {
    keep_in_friction_cone(motion, out);
    keep_pushing(motion, out);
    balance_forces(motion, out);
    if (options.torque_limits) limit_torques(motion, out);
  }
  if (options.clearance) keep_clear(motion, out);
  if (options.self_collision) keep_apart(motion, close, out);
  pass_poses(motion, out);
  return out;
}

}  // namespace mcplan::sip
