#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("load: a balancing foot in contact bears the least load, and nothing is written above it") {
  for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
    ddp::Options options = phases(6);
    options.stiffness_input = input;
    ddp::Problem problem = workshop(options);
    problem.load_min = 0.09;
    const ddp::Layout& at = problem.layout;
    const auto price = [&](double stiffness) {
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x[at.com() + 2] = 1.0;
      u[at.stiffness(1)] = input == ddp::StiffnessInput::lambda ? std::sqrt(stiffness) : stiffness;
      return cost(problem, term(problem, "load", {2, 1, 0}), x, u);
    };
    CHECK(price(0.0) == 0.0);
    problem.limits[1].balances = true;
    CHECK(price(0.0) == doctest::Approx(0.5 * 1e4 * 0.0081));
    CHECK(price(0.1) == 0.0);
    problem.load_min = 5.0;
    check_rows(problem, term(problem, "load", {2, 1, 0}), 67, 0.2, 40);
  }
}
