#pragma once

#include "ddp/replan/rest.hpp"

namespace mcplan::ddp {

/// What comes after the phases that are planned anew: phases and swings of the plan under way as they were planned,
/// with surfaces by index in the scene that is planned on. The first knot is where the new phases have to lead.
struct Tail {
  std::vector<Knot> knots;
  std::vector<Phase> phases;
  std::vector<Swing> swings;  ///< by phases of the tail
  std::vector<int> final_contacts;
  int unseen_from = 0;  ///< phase from which the checker has accepted it before; how many there are, if it has not
};

/// Keep the end of a rest as it was planned: `phases` phases at least are left to be planned anew, up to a knot at
/// which all feet stand and have stepped since the begin. Nothing changes where there is no such knot with so much
/// beyond it that this is worth it, where the scene has changed there, or where the plan is not such as this model
/// makes.
void keep_tail(Rest& rest, const Plan& previous, const Scene& scene, const Robot& robot, const ReplanOptions& options,
               int phases);

/// Put the tail after the phases that lead to its first knot.
void append(Plan& plan, const Tail& tail);

}  // namespace mcplan::ddp
