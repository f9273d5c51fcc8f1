// Kernels of the contact-sequence search: one linearisation, backward and forward pass, and what a neighbour costs when
// it is priced by its low rank, by the paper's MINCOST (a backward step and a minimisation), and by a full Riccati
// recursion. The three prices are compared, so that a kernel which is fast and wrong is seen.
//
//     ddp_benchmark [repeats, default 200]

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <mcplan/mcplan.hpp>
#include <string>
#include <vector>

#include "ddp/initial_sequence.hpp"
#include "ddp/local_model.hpp"
#include "ddp/pricing.hpp"
#include "ddp/problem.hpp"
#include "ddp/value_functions.hpp"

namespace {

using namespace mcplan::ddp;

/// Median wall clock of `repeats` calls [us].
template <class Call>
double median_us(int repeats, Call&& call) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    call();
    times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + times.size() / 2, times.end());
  return times[times.size() / 2];
}

/// Minimum of a quadratic.
double minimum(double c, const Eigen::VectorXd& g, const Eigen::MatrixXd& h, Eigen::LLT<Eigen::MatrixXd>& factor) {
  factor.compute(h);
  return c - 0.5 * g.dot(factor.solve(g));
}

void measure(const mcplan::Scene& scene, int phases, int repeats) {
  Options options;
  options.phases = phases;
  const Problem problem(scene, mcplan::load_robot("humanoid44"), options);
  const Trajectory guess = problem.initial_guess({});
  Schedule schedule;
  schedule.contact_weight = 1.0;
  LocalModel model(problem);
  model.expand(guess, schedule);
  const ContactSequence sequence = initial_sequence(model);
  if (sequence.empty()) {
    std::fprintf(stderr, "%s: no contact sequence\n", scene.name.c_str());
    std::exit(1);
  }
  ValueFunctions values(model), other(model);
  Pricing pricing(1);
  if (!values.backward(sequence, problem.steps) || !values.forward(sequence, 0)) {
    std::fprintf(stderr, "%s: the value functions are not positive definite\n", scene.name.c_str());
    std::exit(1);
  }
  const std::vector<Neighbour> neighbours = pricing.all(model, values, sequence);
  const double count = static_cast<double>(neighbours.size());

  Quadratic value;
  Eigen::LLT<Eigen::MatrixXd> factor;
  double mincost_error = 0.0, riccati_error = 0.0;
  const auto compare = [](double price, double truth, double& worst) {
    worst = std::max(worst, std::abs(price - truth) / std::abs(truth));
  };
  const double low_rank_us = median_us(repeats, [&] { pricing.all(model, values, sequence); });
  const double mincost_us = median_us(repeats, [&] {
    for (const Neighbour& n : neighbours) {
      values.backward_step(n.step, n.state, values.V(n.step + 1), value);
      const Quadratic& before = values.U(n.step);
      compare(n.cost, minimum(value.c + before.c, value.g + before.g, value.h + before.h, factor), mincost_error);
    }
  });
  ContactSequence changed = sequence;
  const double riccati_us = median_us(std::max(repeats / 20, 3), [&] {
    for (const Neighbour& n : neighbours) {
      changed[n.step] = n.state;
      other.backward(changed, problem.steps);
      changed[n.step] = sequence[n.step];
      compare(n.cost, minimum(other.V(0).c, other.V(0).g, other.V(0).h, factor), riccati_error);
    }
  });
  const double backward_us = median_us(repeats, [&] { values.backward(sequence, problem.steps); });
  const double forward_us = median_us(repeats, [&] { values.forward(sequence, 0); });
  // Blocks of rows are made when first asked for: a linearisation is complete once the neighbours' are there.
  const double expand_us = median_us(repeats, [&] {
    model.expand(guess, schedule);
    for (const Neighbour& n : neighbours)
      for (int l = 0; l < problem.layout.end_effector_count(); ++l) model.block(n.step, l, n.state[l]);
  });

  std::printf("%s: N = %d, nx = %d, nu = %d, %d neighbours\n", scene.name.c_str(), problem.steps, problem.layout.nx(),
              problem.layout.nu(), static_cast<int>(neighbours.size()));
  std::printf("  linearise %.1f us, backward %.1f us, forward %.1f us, pricing all neighbours %.1f us\n", expand_us,
              backward_us, forward_us, low_rank_us);
  std::printf("  a neighbour: low rank %.2f us, MINCOST %.2f us (x %.1f), full Riccati %.1f us (x %.0f)\n",
              low_rank_us / count, mincost_us / count, mincost_us / low_rank_us, riccati_us / count,
              riccati_us / low_rank_us);
  std::printf("  largest relative difference of the price: to MINCOST %.1e, to the full Riccati %.1e\n\n",
              mincost_error, riccati_error);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 200;
  if (repeats < 1) {
    std::fprintf(stderr, "usage: ddp_benchmark [repeats]\n");
    return 2;
  }
  for (const mcplan::Scene& scene : {mcplan::load_scene("gap"), mcplan::load_scene("gap_with_rail")})
    for (const int phases : {18, 72}) measure(scene, phases, repeats);
  return 0;
}
