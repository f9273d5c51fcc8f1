#include "ddp/impossible.hpp"

namespace mcplan::ddp {

double farthest_reach(const EndEffector& end) {
  return end.reach_min_B.cwiseAbs().cwiseMax(end.reach_max_B.cwiseAbs()).norm();
}

std::optional<Impossible> why_impossible(const Scene& scene, const Robot& robot, bool measured, bool allow_flight) {
  std::optional<Impossible> found;
  if (!measured) found = stance_out_of_reach(scene, robot, false);
  if (!found) found = stance_out_of_reach(scene, robot, true);
  if (!found && !measured) found = trunk_in_solid(scene, robot, false);
  if (!found) found = trunk_in_solid(scene, robot, true);
  if (!found && !measured) found = sole_in_solid(scene, robot, false);
  if (!found) found = sole_in_solid(scene, robot, true);
  if (!found && !measured) found = slips_everywhere(scene, robot);
  if (!found && !measured) found = gap_too_wide(scene, robot, allow_flight);
  return found;
}

}  // namespace mcplan::ddp
