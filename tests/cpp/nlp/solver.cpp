#include "mcplan/nlp/solver.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "mcplan/base/error.hpp"

using mcplan::nlp::SolverOptions;

namespace {

/// Name of the field that is refused, or "accepted".
std::string refused(const std::function<void(SolverOptions&)>& change) {
  SolverOptions options;
  change(options);
  try {
    options.validate();
  } catch (const mcplan::InvalidOptions& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("options out of their range are refused by name") {
  CHECK(refused([](SolverOptions&) {}) == "accepted");
  const double inf = mcplan::nlp::kInfinity;
  for (const double bad : {0.0, -1e-3, inf, std::nan("")}) {
    CHECK(refused([&](SolverOptions& o) { o.tolerance = bad; }) == "tolerance");
    CHECK(refused([&](SolverOptions& o) { o.constraint_tolerance = bad; }) == "constraint_tolerance");
    CHECK(refused([&](SolverOptions& o) { o.initial_barrier = bad; }) == "initial_barrier");
    CHECK(refused([&](SolverOptions& o) { o.time_limit_s = bad; }) == (bad == inf ? "accepted" : "time_limit_s"));
  }
  CHECK(refused([](SolverOptions& o) { o.max_iterations = -1; }) == "max_iterations");
  CHECK(refused([](SolverOptions& o) { o.max_iterations = 0; }) == "accepted");
}

TEST_CASE("every outcome of a solve has a status of its own") {
  using mcplan::Status;
  using mcplan::nlp::Outcome;
  CHECK(status_of(Outcome::converged) == Status::solved);
  CHECK(status_of(Outcome::nearly_converged) == Status::acceptable);
  for (auto [outcome, name] :
       {std::pair(Outcome::infeasible, "infeasible"), std::pair(Outcome::iteration_limit, "iteration_limit"),
        std::pair(Outcome::time_limit, "time_limit"), std::pair(Outcome::interrupted, "interrupted"),
        std::pair(Outcome::numerical_failure, "numerical_failure")})
    CHECK(to_string(status_of(outcome)) == name);
}
