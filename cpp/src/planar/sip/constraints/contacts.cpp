#include <algorithm>

#include "planar/sip/constraints.hpp"

namespace mcplan::sip {
namespace {

constexpr double kWidth = 0.02;  // half width of a tube in rows: narrow ones are as easy as wide ones when scaled alike

}  // namespace

// actual - expected pose of each contact (eq. 5) in a tube, or its lowest coefficients in a band or zero.
//
// A contact alone has no error: the base follows from it. Of several the errors add to zero; the strict form leaves the
// last one out, whose rows would depend on the others, and the tube keeps it, whose error would be the others' sum.
void hold_contacts(IntervalMotion& motion, std::vector<Limited>& out) {
  const Options& options = motion.options;
  const auto& contacts = motion.task.phases[motion.local.phase].contacts;
  std::size_t count = motion.contacts.size();
  if (options.contact == ContactMode::strict && options.free_flyer == FreeFlyer::computed) --count;
  for (std::size_t i = 0; i < count; ++i) {
    const IntervalMotion::Contact& contact = motion.contacts[i];
    if (!contact.free) continue;
    const std::string& who = motion.task.robot.end_effectors[contacts[i].end_effector].name;
    const auto hold = [&](const std::string& name, TaylorGraph::Node node, double tube) {
      // The solver's tolerance comes off, so that what it calls kept is inside the tube.
      const double margin = tube * (1.0 - std::min(0.1, options.constraint_tolerance / kWidth));
      Limited row{name + " of " + who, node, -margin, margin, kWidth / tube};
      if (options.contact == ContactMode::strict) {
        row.lower = row.upper = 0.0;
        row.scale = 1.0;
      }
      if (options.contact != ContactMode::tube) {
        row.when = Limited::When::coefficients;
        row.highest = options.neq;
      }
      out.push_back(row);
    };
    hold("drift", contact.error.x, options.tube_m);
    hold("drift", contact.error.y, options.tube_m);
    hold("drift_angle", contact.angle_error, options.tube_rad);
  }
}

}  // namespace mcplan::sip
