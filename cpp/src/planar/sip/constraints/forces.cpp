#include <algorithm>
#include <cmath>

#include "planar/sip/constraints.hpp"

namespace mcplan::sip {
namespace {

std::string place(const IntervalMotion& motion, std::size_t force) {
  const auto& contacts = motion.task.phases[motion.local.phase].contacts;
  const int contact = motion.forces[force].contact;
  int point = static_cast<int>(force);
  for (int i = 0; i < contact; ++i) point -= static_cast<int>(motion.contacts[i].forces.size());
  return motion.task.robot.end_effectors[contacts[contact].end_effector].name + " point " + std::to_string(point);
}

double weight(const IntervalMotion& motion) { return motion.task.robot.mass() * motion.task.robot.gravity; }

}  // namespace

// mu f_n - f_t >= 0 and mu f_n + f_t >= 0: in the plane the cone is these two, which also say f_n >= 0. The paper's
// squared form (eq. 14) has no gradient at zero force and lets pulling forces through.
void keep_in_friction_cone(IntervalMotion& motion, std::vector<Limited>& out) {
  const auto& contacts = motion.task.phases[motion.local.phase].contacts;
  for (std::size_t v = 0; v < motion.forces.size(); ++v) {
    const IntervalMotion::Force& force = motion.forces[v];
    const double mu = motion.task.surfaces[contacts[force.contact].surface].friction;
    constexpr double kSticky = 1e3;  // rows of more friction are scaled, so that none has numbers without use
    const double unit = weight(motion) * std::max(1.0, mu / kSticky);
    for (double side : {1.0, -1.0}) {
      const TaylorGraph::Node spare = motion.graph.linear({{mu, force.normal}, {side, force.tangential}});
      out.push_back(
          {"friction of " + place(motion, v), spare, motion.options.margin * weight(motion), INFINITY, 1.0 / unit});
    }
  }
}

// f_n >= min_normal_force; zero is implied by the cone
void keep_pushing(IntervalMotion& motion, std::vector<Limited>& out) {
  if (motion.options.min_normal_force == 0.0) return;
  for (std::size_t v = 0; v < motion.forces.size(); ++v) {
    out.push_back({"pull of " + place(motion, v), motion.forces[v].normal, motion.options.min_normal_force, INFINITY,
                   1.0 / weight(motion)});
  }
}

// m (a - g) - sum f = 0 and the moments likewise: coefficients 0..neq (eq. 15)
void balance_forces(IntervalMotion& motion, std::vector<Limited>& out) {
  if (motion.options.forces != Forces::parameters) return;
  for (int i = 0; i < 3; ++i) {
    Limited row{i < 2 ? "balance of forces" : "balance of moments", motion.balance[i], 0.0, 0.0, 1.0 / weight(motion)};
    row.when = Limited::When::coefficients;
    row.highest = motion.options.neq;
    out.push_back(row);
  }
}

}  // namespace mcplan::sip
