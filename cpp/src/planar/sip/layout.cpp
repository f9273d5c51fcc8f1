#include "planar/sip/layout.hpp"

#include <algorithm>

namespace mcplan::sip {
namespace {

/// Log weights of a phase: one parameter less than weights, since only their ratios matter.
int weight_count(const PlanarTask& task, const PlanarPhase& phase, Forces forces) {
  int contacts = 0, points = 0;
  for (const PlanarContact& contact : phase.contacts) {
    ++contacts;
    points += static_cast<int>(task.robot.end_effectors[contact.end_effector].points.size());
  }
  if (forces == Forces::per_body) return contacts - 1;
  return forces == Forces::per_point ? points - 1 : 0;
}

int force_count(const PlanarTask& task, const PlanarPhase& phase) {
  constexpr int kCoefficients = 4;
  int points = 0;
  for (const PlanarContact& contact : phase.contacts)
    points += static_cast<int>(task.robot.end_effectors[contact.end_effector].points.size());
  return 2 * points * kCoefficients;
}

}  // namespace

Layout::Layout(const PlanarTask& task, const Options& options) {
  const bool base = options.free_flyer == FreeFlyer::parameterised;
  splines = task.robot.joint_count() + (base ? 3 : 0);
  intervals = task.interval_count();
  const int phases = static_cast<int>(task.phases.size());
  durations = options.free_durations ? phases : 1;
  parameters = first_duration = splines * control_points();
  parameters += durations;
  for (const PlanarPhase& phase : task.phases) {
    first_weight.push_back(parameters);
    weights.push_back(options.dynamics ? weight_count(task, phase, options.forces) : 0);
    parameters += weights.back();
  }
  for (int k = 0; k < intervals; ++k) {
    first_force.push_back(parameters);
    const bool given = options.dynamics && options.forces == Forces::parameters;
    forces.push_back(given ? force_count(task, task.phases[task.phase_of(k)]) : 0);
    parameters += forces.back();
  }
}

int Layout::free_of(int full) const { return std::clamp(full - 2, 0, intervals - 2); }

LocalParameters::LocalParameters(const PlanarTask& task, const Layout& layout, int k)
    : interval(k), phase(task.phase_of(k)), splines(layout.splines) {
  for (int i = 0; i < 4; ++i) {
    const int free = layout.free_of(k + i);
    if (controls.empty() || controls.back() != free) controls.push_back(free);
    control[i] = static_cast<int>(controls.size()) - 1;
  }
  for (int d = -2; d <= 2; ++d) {
    const int at = std::clamp(k + d, 0, layout.intervals - 1), of = task.phase_of(at);
    durations.push_back(layout.duration_of_phase(of));
    knot_ratio[d + 2] = 1.0 / (layout.durations == 1 ? layout.intervals : task.phases[of].intervals);
  }
  const std::vector<int> of_knot = durations;
  std::sort(durations.begin(), durations.end());
  durations.erase(std::unique(durations.begin(), durations.end()), durations.end());
  for (int d = 0; d < 5; ++d)
    knot_duration[d] =
        static_cast<int>(std::lower_bound(durations.begin(), durations.end(), of_knot[d]) - durations.begin());
  own_duration = knot_duration[2];
  weights = layout.weights[phase];
  forces = layout.forces[k];

  for (int j = 0; j < splines; ++j)
    for (int free : controls) variables.push_back(layout.control_point(j, free));
  variables.insert(variables.end(), durations.begin(), durations.end());
  for (int i = 0; i < weights; ++i) variables.push_back(layout.first_weight[phase] + i);
  for (int i = 0; i < forces; ++i) variables.push_back(layout.first_force[k] + i);
}

}  // namespace mcplan::sip
