#include "planar/sip/constraints.hpp"

#include <doctest/doctest.h>

#include <set>

#include "planar/sip/interval.hpp"

using namespace mcplan::sip;
using mcplan::PlanarTask;

namespace {

/// First words of the rows' names.
std::set<std::string> kinds(const Options& options) {
  PlanarTask task = planar_tasks::cartwheel();
  mcplan::PlanarPose pose;
  pose.fraction = 0.5;
  pose.min.setConstant(-1.0);
  task.phases[1].poses = {pose};
  std::set<std::string> out;
  for (int k : {0, 5}) {
    IntervalAt interval(task, options, k, random_parameters(task, options, 1));
    for (const Limited& row : constraints_of(interval.motion)) out.insert(row.name.substr(0, row.name.find(' ')));
  }
  return out;
}

using Names = std::set<std::string>;

}  // namespace

TEST_CASE("an interval has the constraints that the options ask for") {
  Options options;
  const Names kinematic{"position", "velocity", "drift", "drift_angle", "clearance", "pose"};
  Names all = kinematic;
  all.insert({"friction", "torque"});
  CHECK(kinds(options) == all);

  options.torque_limits = false;
  Names without_torque = all;
  without_torque.erase("torque");
  CHECK(kinds(options) == without_torque);

  options.torque_limits = true;
  options.clearance = false;
  Names without_clearance = all;
  without_clearance.erase("clearance");
  CHECK(kinds(options) == without_clearance);

  options.clearance = true;
  options.self_collision = true;
  options.min_normal_force = 1.0;
  options.forces = Forces::parameters;
  Names more = all;
  more.insert({"collision", "pull", "balance"});
  CHECK(kinds(options) == more);

  options = Options();
  options.dynamics = false;
  CHECK(kinds(options) == kinematic);
}
