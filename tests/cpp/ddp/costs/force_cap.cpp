#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

Writer force_cap_of(const ddp::Problem& problem) { return term(problem, "force_cap", {2, 1, 0, 100.0, 3.0}); }

}  // namespace

TEST_CASE("force cap: gradients") {
  for (ddp::Model model : kModels)
    for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
      ddp::Options options = phases(6, model);
      options.stiffness_input = input;
      const ddp::Problem problem = workshop(options);
      const Writer capped = [&](const VectorXd& x, const VectorXd& u, Rows& rows) {
        VectorXd stiff = u;
        stiff[problem.layout.stiffness(1)] += input == ddp::StiffnessInput::lambda ? 2.0 : 5.0;
        force_cap_of(problem)(x, stiff, rows);
      };
      check_rows(problem, capped, 49, 0.5, 40);
    }
}

TEST_CASE("force cap: mu |p - s_l| against the end-effector's largest force, nothing written below it") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    const ddp::Layout& at = problem.layout;
    const double cap = 1750.0 / (44.0 * 9.8);
    const auto price = [&](double stiffness, double line) {
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x.segment<3>(at.com()) = Vector3d(0.6 + line, 0, 0.8);
      if (at.force_line_count(1) > 0) u[at.force_line(1)] = line;
      u[at.stiffness(1)] = stiffness;
      const int instants = problem.options.interior_points + 2;
      return cost(problem, force_cap_of(problem), x, u) / (instants * 0.5 * 9.0);
    };
    for (double line : {0.0, 0.4}) {
      if (model == ddp::Model::lipm && line != 0.0) continue;
      CHECK(price(0.99 * cap, line) == 0.0);
      CHECK(price(cap + 0.5, line) == doctest::Approx(0.25));
    }
  }
}
