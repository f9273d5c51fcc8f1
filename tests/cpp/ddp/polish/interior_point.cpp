#include "ddp/polish/interior_point.hpp"

#include <doctest/doctest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "ddp/initial_sequence.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/search.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/support.hpp"
#include "mcplan/plan/checker.hpp"

namespace {

using mcplan::Deadline;
using namespace support;
using namespace mcplan::ddp;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// A search with everything it points to.
struct Bench {
  explicit Bench(const mcplan::Scene& scene, const Options& options = {})
      : problem(scene, scenes::humanoid44(), options), deadline(kForever), search(problem, deadline, report) {}
  Problem problem;
  Deadline deadline;
  mcplan::Report report;
  Search search;

  Incumbent stepping() const {
    Incumbent out;
    out.sequence = stepping_sequence(problem, 0);
    out.trajectory = problem.initial_guess(out.sequence);
    return out;
  }
  Incumbent discovered() {
    Incumbent now;
    now.trajectory = problem.initial_guess({});
    Schedule weights;
    weights.contact_weight = problem.options.weights.contact_min;
    search.model().expand(now.trajectory, weights);
    now.sequence = initial_sequence(search.model());
    REQUIRE(search.discover(now, problem.options.proximal_weight, problem.tuning()) == Ending::done);
    return now;
  }
  void penalty(Incumbent& now) {
    Tuning hard = problem.tuning();
    hard.limit_weight *= kHardening;
    search.polish(now, kPolishIterations, kRoughTolerance, kForever, problem.tuning());
    search.polish(now, kFinalIterations, kFinalTolerance, kForever, hard);
  }
};

/// Variables of a motion with its sequence fixed, all in one vector; the first state stays.
struct Flat {
  Flat(const polish::FixedSequence& sequence, const Trajectory& at) : fixed(sequence), trajectory(at) {}
  const polish::FixedSequence& fixed;
  Trajectory trajectory;

  int size() const { return first(fixed.steps()) + fixed.nx(); }
  int first(int knot) const {
    int n = -fixed.nx();
    for (int k = 0; k < knot; ++k) n += fixed.size(k);
    return n;
  }
  Trajectory moved(const VectorXd& by) const {
    Trajectory out = trajectory;
    int at = 0;
    for (int k = 0; k <= fixed.steps(); ++k) {
      if (k > 0) out.x[k] += by.segment(at, fixed.nx());
      if (k > 0) at += fixed.nx();
      if (k == fixed.steps()) break;
      for (int input : fixed.phase(k).inputs) out.u[k][input] += by[at++];
    }
    return out;
  }
};

}  // namespace

TEST_CASE("on fixed sequences of the four scenes the interior point ends below the penalty, accepted by the checker") {
  for (const mcplan::Scene& scene : scenes::all_four()) {
    CAPTURE(scene.name);
    Bench bench(scene);
    const Incumbent begin = bench.discovered();
    Incumbent penalty = begin, optimum = begin;
    bench.penalty(penalty);
    REQUIRE(bench.search.make_exact(penalty, bench.problem.tuning()));
    polish::InteriorPoint solver(bench.problem, begin.sequence, bench.problem.tuning());
    CHECK(solver.solve(optimum.trajectory, {}) == polish::Outcome::converged);
    CHECK(solver.defect() < 1e-5);
    CHECK(std::abs(solver.gain()) < 1e-4 * solver.objective());
    // Exact contacts and dynamics are no more than rounding away, and the cost is that of the other solver's terms.
    const double before = bench.search.evaluate(optimum, bench.problem.tuning()).cost;
    CHECK(std::abs(before - solver.objective()) < 1e-3 * before);
    REQUIRE(bench.search.make_exact(optimum, bench.problem.tuning()));
    CHECK(std::abs(optimum.evaluation.cost - before) < 1e-3 * before);
    CHECK(optimum.evaluation.cost <= penalty.evaluation.cost);
    const mcplan::Plan plan = to_plan(bench.problem, optimum);
    CHECK(mcplan::check(plan, plan.scene, plan.robot).ok());
  }
}

TEST_CASE("the result is stationary: differences of the cost terms and of the dynamics leave no direction") {
  for (Model model : kModels) {
    CAPTURE(name(model));
    Bench bench(scenes::flat(0.4), phases(6, model));
    Incumbent now = bench.stepping();
    polish::Settings tight;
    tight.tolerance = 1e-10;
    polish::InteriorPoint solver(bench.problem, now.sequence, bench.problem.tuning());
    CHECK(solver.solve(now.trajectory, tight) == polish::Outcome::converged);
    const polish::FixedSequence fixed(bench.problem, now.sequence);
    const Pendulum& pendulum = bench.search.model().pendulum();
    const Flat flat(fixed, now.trajectory);
    polish::Limits limits(fixed, pendulum, bench.problem.tuning());
    limits.head(now.trajectory);
    // The cost terms have max(r, 0)^2 where the barrier has, at its last parameter, a smooth function with as much
    // slope.
    const auto smooth_less_sharp = [&](const Trajectory& t) {
      constexpr double kBarrier = 1e-6;
      polish::Motion motion(fixed);
      motion.trajectory = t;
      motion.evaluate(pendulum);
      polish::RowArray r;
      limits.values(motion, r);
      double sum = 0.0;
      for (int i = 0; i < limits.count(); ++i) {
        const double w2 = limits.precision()[i];
        const double s = 0.5 * (std::sqrt(r[i] * r[i] + 4.0 * kBarrier / w2) - r[i]);
        sum += 0.5 * w2 * (r[i] + s) * (r[i] + s) - kBarrier * std::log(s);
        if (r[i] > 0.0) sum -= 0.5 * w2 * r[i] * r[i];
      }
      return sum;
    };
    const MatrixXd gradient = differences(
        [&](const VectorXd& by) {
          Incumbent other = now;
          other.trajectory = flat.moved(by);
          const double cost = bench.search.evaluate(other, bench.problem.tuning()).cost;
          return VectorXd::Constant(1, cost + smooth_less_sharp(other.trajectory));
        },
        VectorXd::Zero(flat.size()), 1e-7);
    const MatrixXd jacobian = differences(
        [&](const VectorXd& by) {
          const Trajectory t = flat.moved(by);
          VectorXd out(fixed.steps() * fixed.nx()), next;
          for (int k = 0; k < fixed.steps(); ++k) {
            pendulum.next(t.x[k], t.u[k], next);
            out.segment(k * fixed.nx(), fixed.nx()) = next - t.x[k + 1];
          }
          return out;
        },
        VectorXd::Zero(flat.size()));
    // Footholds are chosen in their planes, which are level here.
    const VectorXd g = gradient.transpose();
    const std::size_t planes = fixed.touchdowns().size();
    MatrixXd held = MatrixXd::Zero(flat.size(), jacobian.rows() + static_cast<int>(planes));
    held.leftCols(jacobian.rows()) = jacobian.transpose();
    for (std::size_t i = 0; i < planes; ++i) {
      const polish::Touchdown& touchdown = fixed.touchdowns()[i];
      held(flat.first(touchdown.knot) + bench.problem.layout.end(touchdown.l) + 2,
           jacobian.rows() + static_cast<int>(i)) = 1.0;
    }
    const VectorXd multipliers = held.colPivHouseholderQr().solve(-g);
    CHECK((g + held * multipliers).norm() < 1e-3 * g.norm());
  }
}

TEST_CASE("a sequence whose feet cannot reach is given up once another one is better") {
  Bench bench(scenes::gap());
  Incumbent now = bench.stepping();
  polish::InteriorPoint solver(bench.problem, now.sequence, bench.problem.tuning());
  polish::Settings settings;
  settings.give_up_above = 1.3;
  CHECK(solver.solve(now.trajectory, settings) == polish::Outcome::gave_up);
  CHECK(solver.iterations() < 50);
}
