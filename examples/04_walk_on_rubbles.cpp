// Walk over tilted patches, one step a cycle, as a robot would: each cycle starts from a measured state.

#include <cstdio>
#include <mcplan/mcplan.hpp>
#include <random>
#include <string>

int main() {
  const mcplan::Scene scene = mcplan::load_scene("rubbles");
  const mcplan::Robot robot = mcplan::load_robot("talos_wang");
  mcplan::rhp::Options options;
  options.fidelity = mcplan::rhp::Fidelity::point;
  options.lookahead = 3;
  options.time_limit_s = 60.0;  // of each cycle
  auto planner = mcplan::rhp::RecedingHorizon(scene, robot, options);

  std::mt19937 seed(0);
  std::normal_distribution<double> noise;
  for (int i = 0; i < 3; ++i) {
    mcplan::rhp::State measured = planner.state();
    for (int axis = 0; axis < 3; ++axis) {
      measured.com_W[axis] += 0.002 * noise(seed);          // [m]
      measured.com_velocity_W[axis] += 0.01 * noise(seed);  // [m/s]
    }
    const mcplan::rhp::Cycle cycle = planner.step(measured);
    std::printf("cycle %d: %s, %d iterations, %.2f s\n", cycle.index,
                std::string(mcplan::to_string(cycle.status)).c_str(), cycle.iterations, cycle.time_s);
    if (!cycle.executed) {
      std::printf("no step: %s\n", cycle.message.c_str());
      return 1;
    }
    const mcplan::Plan step = planner.executed();  // from time 0: what a controller would follow
    std::printf("  %.2f s long, %.2f m\n", step.duration(), cycle.distance_m);
  }

  // Without measurements the whole walk is one call.
  options.cycles = 2;
  const mcplan::rhp::Walk walk = mcplan::rhp::RecedingHorizon(scene, robot, options).walk();
  std::printf("%s: %.2f m; forces replayed drift %.1g mm at most\n",
              std::string(mcplan::to_string(walk.report.status)).c_str(), walk.distance_m(), 1e3 * walk.drift_com_m());
  return walk.success ? 0 : 1;
}
