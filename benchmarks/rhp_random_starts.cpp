// The first cycle's program from uniformly random starts, as in the experiments of Wang et al.:
//
//     rhp_random_starts [seeds, 10] [most iterations, 400]
//
// A row for each terrain and model: how many are solved, iterations and CPU time, mean and most.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "mcplan/ipm/solver.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "mcplan/scene/scene_files.hpp"
#include "rhp/guess.hpp"
#include "rhp/horizon.hpp"
#include "rhp/random_start.hpp"
#include "rhp/walker.hpp"

using namespace mcplan;
using namespace mcplan::rhp;

namespace {

void run(const char* terrain, Fidelity fidelity, int lookahead, int seeds, int max_iterations) {
  Options options;
  options.fidelity = fidelity;
  options.lookahead = lookahead;
  const Walker walker(load_scene(terrain), load_robot("talos_wang"), options);
  const Footsteps footsteps = footsteps_of(walker);
  HorizonRequest request;
  request.state = walker.start();
  request.steps = lookahead;
  request.footholds_W = nominal_footholds(walker, request.state, footsteps, 0, lookahead);
  request.guess = [&](const Horizon& horizon) { return nominal_guess(walker, request.state, horizon); };
  const Horizon horizon = build_horizon(walker, footsteps, request);
  nlp::SolverOptions how;
  how.adaptive_barrier = true;
  how.gradient_scaling = false;
  how.initial_barrier = fidelity == Fidelity::single ? 0.03 : 0.1;
  how.max_iterations = max_iterations;
  int solved = 0, iterations = 0, most_iterations = 0;
  double total_s = 0.0, most_s = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const std::clock_t begin = std::clock();
    const nlp::Solution s = ipm::solve(horizon.problem, random_start(horizon, static_cast<unsigned>(seed)), how);
    const double took_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    solved += s.outcome == nlp::Outcome::converged;
    iterations += s.iterations;
    most_iterations = std::max(most_iterations, s.iterations);
    total_s += took_s;
    most_s = std::max(most_s, took_s);
  }
  std::printf("%-12s %-7s %d  solved %2d of %d  iterations %5.0f (%d)  ms %5.0f (%.0f)\n", terrain,
              fidelity == Fidelity::single ? "single" : "point", lookahead, solved, seeds,
              static_cast<double>(iterations) / seeds, most_iterations, 1e3 * total_s / seeds, 1e3 * most_s);
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 10;
  const int max_iterations = argc > 2 ? std::max(1, std::atoi(argv[2])) : 400;
  for (const char* terrain : {"rubbles", "v_shape", "up_and_down"}) {
    run(terrain, Fidelity::point, 3, seeds, max_iterations);
    run(terrain, Fidelity::single, 2, seeds, max_iterations);
  }
}
