#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

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

namespace {

/// Everything that is written to the process's standard output and error while it lives.
class Output {
 public:
  Output() {
    std::fflush(nullptr);
    const int file = open(path_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    for (int i : {1, 2}) {
      saved_[i] = dup(i);
      dup2(file, i);
    }
    close(file);
  }
  std::string text() {
    restore();
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  ~Output() {
    restore();
    std::filesystem::remove(path_);
  }

 private:
  void restore() {
    if (!saved_[1]) return;
    std::fflush(nullptr);
    for (int i : {1, 2}) {
      dup2(saved_[i], i);
      close(saved_[i]);
      saved_[i] = 0;
    }
  }
  std::string path_ = std::filesystem::temp_directory_path() / ("mcplan_output_" + std::to_string(getpid()));
  int saved_[3] = {0, 0, 0};
};

}  // namespace

TEST_CASE("problem 71 of Hock and Schittkowski: the published optimum and multipliers, by every option") {
  const HockSchittkowski71 hs;
  for (const Ordering ordering : {Ordering::amd, Ordering::automatic})
    for (const Hessian hessian : {Hessian::exact, Hessian::limited_memory})
      for (const bool adaptive : {false, true}) {
        SolverOptions options;
        options.tolerance = options.constraint_tolerance = 1e-9;
        options.ordering = ordering;
        options.hessian = hessian;
        options.adaptive_barrier = adaptive;
        const Solution s = solve(hs.problem, hs.x0, options);
        CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
        CHECK((s.x - hs.optimum).lpNorm<Eigen::Infinity>() < 1e-6);
        CHECK(std::abs(s.cost - hs.cost) < 1e-6);
        CHECK(s.worst.value < 1e-8);
        // Negative at a lower limit, positive or of any sign at an equality.
        CHECK(std::abs(s.multipliers[0] + 0.55229366) < 1e-5);
        CHECK(std::abs(s.multipliers[1] - 0.16146857) < 1e-5);
      }
}

TEST_CASE("gradient + Jacobian' multipliers vanishes in the variables that are at no bound; bounds hold exactly") {
  Problem problem;
  problem.add_variables("x", 2, 0.0, 5.0, {0, 0});
  problem.add_variables("y", 1, 0.0, 1.0, {0, 0});
  problem.add_cost(squared_distance({0, 1, 2}, Eigen::Vector3d(1, 2, 7)));
  problem.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)), -kInfinity,
                         2.0);
  problem.finish();
  SolverOptions options;
  options.tolerance = 1e-9;
  const Solution s = solve(problem, VectorXd::Zero(3), options);
  CHECK(s.outcome == Outcome::converged);
  CHECK((s.x - Eigen::Vector3d(0.5, 1.5, 1.0)).lpNorm<Eigen::Infinity>() < 1e-7);
  CHECK(s.x[2] <= 1.0);
  CHECK(std::abs(s.multipliers[0] - 1.0) < 1e-6);  // an upper limit: positive
}

TEST_CASE("no rows; fixed variables; nothing but fixed variables") {
  Problem free;
  free.add_variables("x", 2, 0.0, 2.0, {0, 0});
  free.add_cost(squared_distance({0, 1}, Vector2d(3, 1)));
  free.finish();
  const Solution at_bound = solve(free, Vector2d(-5, 9));  // outside: projected
  CHECK(at_bound.outcome == Outcome::converged);
  CHECK((at_bound.x - Vector2d(2, 1)).lpNorm<Eigen::Infinity>() < 1e-4);
  CHECK(at_bound.multipliers.size() == 0);

  for (const double limit : {kInfinity, 2.0}) {
    Problem some;
    some.add_variables("x", 3, -10.0, 10.0, {0, 0});
    some.set_bounds(1, 4.0, 4.0);
    some.add_cost(squared_distance({0, 1, 2}, Eigen::Vector3d(1, 2, 3)));
    some.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1, 2}, MatrixXd::Ones(1, 3)), 6.0,
                        limit == 2.0 ? 6.0 : kInfinity);
    some.finish();
    SolverOptions options;
    options.tolerance = 1e-8;
    const Solution s = solve(some, VectorXd::Zero(3), options);
    CHECK_MESSAGE(s.outcome == Outcome::converged, s.message);
    CHECK(s.x[1] == 4.0);
    const Eigen::Vector3d expected = limit == 2.0 ? Eigen::Vector3d(0, 4, 2) : Eigen::Vector3d(1, 4, 3);
    CHECK((s.x - expected).lpNorm<Eigen::Infinity>() < 1e-6);

    options.max_iterations = 0;  // the best iterate has all three variables too
    const Solution first = solve(some, VectorXd::Zero(3), options);
    CHECK(first.x.size() == 3);
    CHECK(first.x[1] == 4.0);
  }

  Problem none;
  none.add_variables("x", 2, 1.0, 1.0, {0, 0});
  none.add_cost(squared_norm("norm", {0, 1}));
  none.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)), 0.0, 3.0);
  none.finish();
  const Solution fixed = solve(none, VectorXd::Zero(2));
  CHECK(fixed.outcome == Outcome::converged);
  CHECK(fixed.cost == 2.0);
}

TEST_CASE("what cannot be satisfied is infeasible, and the least violated point is returned") {
  Problem apart;  // x + y = 3 in the unit square
  apart.add_variables("x", 2, 0.0, 1.0, {0, 0});
  apart.add_cost(squared_norm("norm", {0, 1}));
  apart.add_constraint(std::make_unique<LinearPiece>("sum", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)), 3.0, 3.0);
  apart.finish();
  const Solution corner = solve(apart, Vector2d(0.5, 0.5));
  CHECK_MESSAGE(corner.outcome == Outcome::infeasible, corner.message);
  CHECK(corner.x.minCoeff() > 0.99);
  CHECK(corner.worst.name == "sum at stage 0");
  CHECK(std::abs(corner.worst.value - 1.0) < 0.02);

  Problem curved;  // x^2 + y^2 <= -1: found out in Ipopt's restoration phase
  curved.add_variables("x", 2, -5.0, 5.0, {0, 0});
  curved.add_cost(squared_distance({0, 1}, Vector2d(3, 1)));
  curved.add_constraint(squared_norm("norm", {0, 1}), -kInfinity, -1.0);
  curved.finish();
  bool restored = false;
  SolverOptions options;
  options.logger = [&](LogLevel, const std::string& line) { restored |= line.size() > 4 && line[4] == 'r'; };
  const Solution centre = solve(curved, Vector2d(2, 2), options);
  CHECK_MESSAGE(centre.outcome == Outcome::infeasible, centre.message);
  CHECK(restored);
  CHECK(centre.x.norm() < 0.05);

  Problem square;  // two equalities for one variable
  square.add_variables("x", 1, -5.0, 5.0, {0, 0});
  square.add_constraint(std::make_unique<LinearPiece>("twice", std::vector<int>{0}, MatrixXd::Ones(2, 1)),
                        Vector2d(1, 2), Vector2d(1, 2));
  square.finish();
  CHECK(solve(square, VectorXd::Zero(1)).outcome == Outcome::infeasible);

  Problem crossed;
  crossed.add_variables("x", 2, 0.0, 1.0, {0, 0});
  crossed.set_bounds(1, 2.0, 1.0);
  crossed.add_cost(squared_norm("norm", {0, 1}));
  crossed.finish();
  const Solution upside_down = solve(crossed, VectorXd::Zero(2));
  CHECK(upside_down.outcome == Outcome::infeasible);
  CHECK(upside_down.message == "the lower bound of x[1] at stage 0 lies above its upper bound");

  Problem fixed;
  fixed.add_variables("x", 1, 1.0, 1.0, {0, 0});
  fixed.add_constraint(squared_norm("norm", {0}), 2.0, 3.0);
  fixed.finish();
  CHECK(solve(fixed, VectorXd::Zero(1)).outcome == Outcome::infeasible);
}

TEST_CASE("a cost without a lower bound is a numerical failure") {
  Problem problem;
  problem.add_variables("x", 2, -kInfinity, kInfinity, {0, 0});
  problem.add_cost(std::make_unique<LinearPiece>("fall", std::vector<int>{0, 1}, MatrixXd::Ones(1, 2)));
  problem.finish();
  SolverOptions options;
  options.max_iterations = 3000;
  CHECK(solve(problem, VectorXd::Zero(2), options).outcome == Outcome::numerical_failure);
}

TEST_CASE("at a limit of iterations no point that was evaluated is better than the one returned") {
  for (int limit = 0; limit < 9; ++limit) {
    std::vector<VectorXd> seen;
    Problem problem;
    problem.add_variables("x", 2, -3.0, 3.0, {0, 0});
    bool armed = false;
    problem.add_cost(squared_distance({0, 1}, Vector2d(2, 1), [&](const ConstVector& x) {
      if (armed) seen.push_back(x);
    }));
    problem.add_constraint(squared_norm("ring", {0, 1}), 1.0, 1.5);
    problem.finish();
    armed = true;
    SolverOptions options;
    options.max_iterations = limit;
    options.tolerance = 1e-12;
    const Solution s = solve(problem, Vector2d(-2.5, 0.3), options);
    armed = false;
    if (s.outcome == Outcome::converged) continue;
    CHECK(s.outcome == Outcome::iteration_limit);
    CHECK(s.iterations == limit);
    const double violation = problem.worst_violation(s.x).value;
    CHECK(s.worst.value == violation);
    for (const VectorXd& x : seen) {
      const double other = problem.worst_violation(x).value;
      if (violation > options.constraint_tolerance) CHECK(violation <= other);
      if (violation <= options.constraint_tolerance && other <= options.constraint_tolerance)
        CHECK(s.cost <= problem.cost(x));
    }
  }
}

TEST_CASE("the logger gets a header and a line an iteration; nothing else is printed, and no ipopt.opt is read") {
  const std::filesystem::path before = std::filesystem::current_path(),
                              folder = std::filesystem::temp_directory_path() / ("mcplan_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::filesystem::current_path(folder);
  std::ofstream("ipopt.opt") << "max_iter 1\nprint_level 5\noutput_file ipopt.out\n";
  const Valley valley;
  std::vector<std::string> lines;
  SolverOptions options;
  options.logger = [&](LogLevel, const std::string& line) { lines.push_back(line); };
  Output output;
  const Solution s = solve(valley.problem, valley.x0, options);
  CHECK(output.text() == "");
  CHECK(!std::filesystem::exists("ipopt.out"));
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
  CHECK(s.outcome == Outcome::converged);
  CHECK(static_cast<int>(lines.size()) == s.iterations + 2);
  CHECK(lines[0].substr(0, 4) == "iter");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(std::stoi(lines[i]) == static_cast<int>(i) - 1);
    CHECK(lines[i].find('\n') == std::string::npos);
  }
}

TEST_CASE("solves from several threads give the same bytes as one after the other") {
  const HockSchittkowski71 reference;
  const Solution expected = solve(reference.problem, reference.x0);
  CHECK(same_bytes(solve(reference.problem, reference.x0).x, expected.x));
  std::vector<std::thread> threads;
  constexpr int kSolves = 40;
  std::vector<int> same(3, 0);
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      const HockSchittkowski71 own;  // a Problem serves one thread at a time
      for (int i = 0; i < kSolves; ++i) {
        const Solution s = solve(own.problem, own.x0);
        same[t] += same_bytes(s.x, expected.x) && same_bytes(s.multipliers, expected.multipliers);
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(same == std::vector<int>(3, kSolves));
}

TEST_CASE("a solve within a solve is refused instead of waiting for itself") {
  const Valley inner, outer([&](const ConstVector&) { solve(inner.problem, inner.x0); });
  if (before_3_14())
    CHECK_THROWS_AS(solve(outer.problem, outer.x0), std::logic_error);
  else
    CHECK(solve(outer.problem, outer.x0).outcome == Outcome::converged);
}

TEST_CASE("a start that is no start is refused by name") {
  const Valley valley;
  CHECK_THROWS_WITH_AS(solve(valley.problem, VectorXd::Zero(3)), "x0: must have 2 values, got 3", InvalidInput);
  CHECK_THROWS_WITH_AS(solve(valley.problem, Vector2d(0, std::nan(""))), "x0, x[1] at stage 3: must be finite, got nan",
                       InvalidInput);
  SolverOptions options;
  options.tolerance = -1.0;
  CHECK_THROWS_AS(solve(valley.problem, valley.x0, options), InvalidOptions);
}

TEST_CASE("the parts of the time add up to no more than the whole") {
  const HockSchittkowski71 hs;
  const Solution s = solve(hs.problem, hs.x0);
  CHECK(s.linear_solver_s > 0.0);
  CHECK(s.evaluation_s > 0.0);
  CHECK(s.linear_solver_s + s.evaluation_s < s.time_s);
}
