#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "clocks.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/nlp/solver.hpp"
#include "nlp/problems.hpp"
#include "nlp/valley.hpp"

using namespace mcplan;
using namespace mcplan::nlp;
using namespace mcplan::nlp::tests;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

TEST_CASE("the time limit holds to one evaluation when pieces are slow") {
  const CountingClock clock;
  const Valley::Spy slow = [&](const ConstVector&) { clock.advance(0.01); };
  for (const Valley& valley : {Valley(slow), Valley(nullptr, slow), Valley(nullptr, nullptr, slow)}) {
    SolverOptions options;
    options.time_limit_s = 0.055;
    options.clock = clock;
    const Solution s = solve(valley.problem, valley.x0, options);
    CHECK(s.outcome == Outcome::time_limit);
    // One that has begun before the limit, and the cost of the point that is handed back.
    CHECK(s.time_s <= 0.06 + 0.01 + 1e-9);
    CHECK(s.evaluation_s <= 0.06 + 1e-9);
    CHECK(s.cost <= valley.problem.cost(valley.x0));
  }
  SolverOptions options;
  options.time_limit_s = 1e-9;  // over before the first evaluation
  const Valley valley;
  const Solution s = solve(valley.problem, valley.x0, options);
  CHECK(s.outcome == Outcome::time_limit);
  CHECK(same_bytes(s.x, valley.x0));
}

TEST_CASE("an iteration that would not be over in time is not begun") {
  const CountingClock clock;
  SolverOptions options;
  options.time_limit_s = 0.35;
  options.clock = clock;
  options.logger = [&](LogLevel, const std::string& line) {
    if (line.substr(0, 4) != "iter") clock.advance(0.1);  // what an iteration takes outside of the problem's functions
  };
  const Valley valley;
  const Solution s = solve(valley.problem, valley.x0, options);
  CHECK(s.outcome == Outcome::time_limit);
  CHECK(s.iterations == 2);  // at 0.3 s, with 0.05 s left
  CHECK(s.time_s <= 0.35);
}

TEST_CASE("what the caller needs after a solve is kept from its limit, by the best point so far") {
  const Valley valley;
  for (double finishing_s : {0.0, 0.1, 0.3, 10.0}) {
    CAPTURE(finishing_s);
    const CountingClock clock;
    VectorXd last;
    SolverOptions options;
    options.time_limit_s = 0.95;
    options.clock = clock;
    options.finishing_s = [&](const VectorXd& x) {
      last = x;
      return finishing_s;
    };
    options.logger = [&](LogLevel, const std::string& line) {
      if (line.substr(0, 4) != "iter") clock.advance(0.1);
    };
    const Solution s = solve(valley.problem, valley.x0, options);
    CHECK(s.outcome == Outcome::time_limit);
    // At 0.1, 0.2, ... s, while one more iteration and what is kept, at most half of the limit, fit into the limit.
    const int iterations = static_cast<int>((0.95 - std::min(finishing_s, 0.475)) / 0.1 + 1e-9) - 1;
    CHECK(s.iterations == iterations);
    CHECK(s.time_s <= 0.95 - std::min(finishing_s, 0.475));
    CHECK(s.start_s == doctest::Approx(0.1));
    CHECK(same_bytes(last, s.x));
  }
  SolverOptions options;
  options.finishing_s = [](const VectorXd&) -> double { throw std::logic_error("asked without a limit"); };
  CHECK(solve(valley.problem, valley.x0, options).outcome == Outcome::converged);
}

TEST_CASE("waiting for a solve of another thread counts against the time limit") {
  // The other solve goes on until this one has ended: it ends by its limit, or never.
  std::atomic<bool> inside = false, released = false;
  const Valley slow([&](const ConstVector&) {
    inside = true;
    while (!released) std::this_thread::yield();
  });
  std::thread other([&] { solve(slow.problem, slow.x0); });
  while (!inside) std::this_thread::yield();
  const Valley valley;
  SolverOptions options;
  options.time_limit_s = 0.05;
  // Its looks at the clock while it waits are all that takes time; far beyond the limit the other one gives way, so
  // that a limit that is not heeded fails the test instead of hanging it.
  options.clock = [&, clock = CountingClock(0.01)] {
    const double now = clock();
    if (now > 1.0) released = true;
    return now;
  };
  const Solution s = solve(valley.problem, valley.x0, options);
  released = true;
  other.join();
  if (before_3_14()) CHECK(s.outcome == Outcome::time_limit);
}

TEST_CASE("what a piece, the logger or the stop request throws arrives unchanged, and the next solve works") {
  struct Own : std::runtime_error {
    using std::runtime_error::runtime_error;
  };
  for (int when : {0, 5}) {
    int calls = 0;
    const auto raise = [&] {
      if (calls++ == when) throw Own("knee 3");
    };
    const Valley::Spy spy = [&](const ConstVector&) { raise(); };
    SolverOptions logging, stopping;
    logging.logger = [&](LogLevel, const std::string&) { raise(); };
    stopping.stop = [&] { return raise(), false; };
    struct Case {
      Valley valley;
      SolverOptions options;
    };
    const Case cases[] = {{Valley(spy), {}},
                          {Valley(nullptr, spy), {}},
                          {Valley(nullptr, nullptr, spy), {}},
                          {Valley(), logging},
                          {Valley(), stopping}};
    for (const auto& [valley, options] : cases) {
      calls = 0;
      CHECK_THROWS_WITH_AS(solve(valley.problem, valley.x0, options), "knee 3", Own);
      CHECK(calls == when + 1);
      CHECK(solve(Valley().problem, valley.x0).outcome == Outcome::converged);
    }
  }
}

TEST_CASE("a value or derivative that is not finite is named, and the point returned is finite") {
  for (const double bad : {std::nan(""), kInfinity})
    for (int where = 0; where < 3; ++where)
      for (int when : {0, 4}) {
        int calls = 0;
        bool armed = false;
        const auto number = [&, when](int here, double value) {
          return armed && here == where && calls++ >= when ? bad : value;
        };
        Problem problem;
        problem.add_variables("x", 2, -3.0, 3.0, {7, 7});
        problem.add_cost(squared_distance({0, 1}, Vector2d(2, 1)));
        problem.add_constraint(std::make_unique<FunctionPiece>(
                                   "ring", std::vector<int>{0, 1}, 1,
                                   [&](const ConstVector& x, Vector f) { f[0] = number(0, x.squaredNorm()); },
                                   [&](const ConstVector& x, Matrix J) { J << number(1, 2 * x[0]), 2 * x[1]; },
                                   [&](const ConstVector&, const ConstVector& w, Matrix H) {
                                     H(0, 0) = number(2, 2 * w[0]);
                                     H(1, 1) = 2 * w[0];
                                   }),
                               1.0, 1.5);
        problem.finish();
        armed = true;
        const Solution s = solve(problem, Vector2d(-2.5, 0.3));
        CHECK(s.outcome == Outcome::numerical_failure);
        CHECK(s.message == "not finite: constraint ring at stage 7");
        CHECK(s.x.allFinite());
      }
}

TEST_CASE("the stop request is polled once an iteration") {
  const Valley valley;
  int polls = 0;
  SolverOptions options;
  options.stop = [&] { return ++polls == 4; };
  const Solution stopped = solve(valley.problem, valley.x0, options);
  CHECK(stopped.outcome == Outcome::interrupted);
  CHECK(polls == 4);
  CHECK(stopped.iterations == 3);  // the first poll is at iteration 0
  CHECK(stopped.cost < valley.problem.cost(valley.x0));

  polls = -1000;
  const Solution s = solve(valley.problem, valley.x0, options);
  CHECK(s.outcome == Outcome::converged);
  CHECK(polls + 1000 == s.iterations + 1);
}

TEST_CASE("derivatives are evaluated once an iterate") {
  std::vector<VectorXd> gradients, hessians;
  const Valley valley(
      nullptr, [&](const ConstVector& x) { gradients.push_back(x); },
      [&](const ConstVector& x) { hessians.push_back(x); });
  const Solution s = solve(valley.problem, valley.x0);
  REQUIRE(s.iterations > 10);
  CHECK(static_cast<int>(hessians.size()) == s.iterations);
  CHECK(static_cast<int>(gradients.size()) == s.iterations + 2);  // Ipopt's scaling asks for the first one as well
  for (std::size_t i = 1; i < hessians.size(); ++i) CHECK_FALSE(same_bytes(hessians[i - 1], hessians[i]));
}
