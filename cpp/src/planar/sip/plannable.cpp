#include "planar/sip/plannable.hpp"

#include <string>
#include <vector>

#include "planar/sip/contact_gain.hpp"
#include "planar/sip/program.hpp"

namespace mcplan::sip {

void require_plannable(const PlanarTask& task, const Options& options) {
  if (task.robot.joint_count() < 1) throw InvalidRobot("bodies", "needs at least one joint to plan", "the base alone");
  if (task.interval_count() < 2)
    throw InvalidPlanarTask("phases[0].intervals",
                            "must be at least 2 in a task of one phase, to be at rest at both ends",
                            text(task.interval_count()));
  if (options.dynamics && options.forces == Forces::parameters) return;
  for (std::size_t k = 0; k < task.phases.size(); ++k) {
    Eigen::Index points = 0;
    for (const PlanarContact& contact : task.phases[k].contacts)
      points += static_cast<Eigen::Index>(task.robot.end_effectors[contact.end_effector].points.size());
    try {
      least_norm_gain(task, static_cast<int>(k), Eigen::VectorXd::Ones(points));
    } catch (const InvalidPlan& error) {
      throw InvalidPlanarTask("phases[" + std::to_string(k) + "].contacts", error.rule(), error.value());
    }
  }
}

void require_durations(const PlanarTask& task, const Options& options) {
  const std::vector<Range> ranges = duration_ranges(task, options);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double lower = ranges[i].min, upper = ranges[i].max;
    if (lower > upper)
      throw InvalidOptions(options.free_durations ? "phase_duration_s" : "total_duration_s",
                           "must overlap with what the task allows" +
                               (options.free_durations ? " phase " + std::to_string(i) : std::string()),
                           "at least " + text(lower) + " and at most " + text(upper) + " s");
  }
}

}  // namespace mcplan::sip
