#include <algorithm>

#include "check_internal.hpp"

namespace mcplan::checks {
namespace {

bool any_in_contact(const Problem& problem, int k, const std::vector<std::string>& who, bool* addressed) {
  bool touching = false;
  for (int l = 0; l < problem.end_effector_count(); ++l)
    for (const std::string& name : who)
      if (addresses(name, problem.robot.end_effectors[l])) {
        *addressed = true;
        touching = touching || problem.surface(k, l) >= 0;
      }
  return touching;
}

/// End-effectors named by `who` that touch nothing; a name that this robot does not have counts as one.
int missing(const Problem& problem, int k, const std::vector<std::string>& who) {
  int count = 0;
  for (const std::string& name : who) {
    bool known = false;
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      if (!addresses(name, problem.robot.end_effectors[l])) continue;
      known = true;
      count += problem.surface(k, l) < 0;
    }
    count += !known;
  }
  return count;
}

}  // namespace

/// sum_l |sigma_{k+1,l} - sigma_{k,l}| <= 1 (Tazaki, eq. 32): one end-effector makes or breaks contact in a step, the
/// step to the final contacts included. From surface to surface is a break and a make.
void check_sequence_switch(const Problem& problem, Findings& findings) {
  for (int k = 1; k <= problem.last_knot; ++k) {
    int switches = 0, last = -1;
    for (int l = 0; l < problem.end_effector_count(); ++l) {
      const int before = problem.surface(k - 1, l), after = problem.surface(k, l);
      if (before == after) continue;
      switches += before >= 0 && after >= 0 ? 2 : 1;
      last = l;
    }
    findings.offer(Constraint::sequence_switch, switches - problem.tolerances.switches, problem.at_knot(k, last));
  }
}

/// If none of `when_free` touches anything, all of `require` do. A rule about end-effectors that the robot does not
/// have asks for nothing.
void check_sequence_rule(const Problem& problem, Findings& findings) {
  for (const ContactRule& rule : problem.scene.rules)
    for (int k = 0; k <= problem.last_knot; ++k) {
      bool addressed = false;
      const bool touching = any_in_contact(problem, k, rule.when_free, &addressed);
      const int lacking = addressed && !touching ? missing(problem, k, rule.require) : 0;
      findings.offer(Constraint::sequence_rule, lacking, problem.at_knot(k, -1));
    }
}

}  // namespace mcplan::checks
