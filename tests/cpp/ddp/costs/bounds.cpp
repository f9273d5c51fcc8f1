#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("bounds: gradients") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    check_rows(problem, term(problem, "bounds"), 43, 5.0, 20);
  }
}

TEST_CASE("stiffness lies between nothing and what gives the largest force; nothing is written inside") {
  for (ddp::Model model : kModels)
    for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
      ddp::Options options = phases(6, model);
      options.stiffness_input = input;
      const ddp::Problem problem = workshop(options);
      const ddp::Layout& at = problem.layout;
      // In units of the weight at a distance of |(0, 0.1, 0.7)| = 0.707 m.
      double most = 1750.0 / (44.0 * 9.8) / (std::hypot(0.1, 0.7) / 0.7);
      if (input == ddp::StiffnessInput::lambda) most = std::sqrt(most);
      const auto price = [&](int i, double value) {
        VectorXd u = VectorXd::Zero(at.nu());
        u[i] = value;
        return cost(problem, term(problem, "bounds"), VectorXd(), u) / (0.5 * 100.0 * 100.0);
      };
      CHECK(price(at.stiffness(1), 0.0) == 0.0);
      CHECK(price(at.stiffness(1), 0.999 * most) == 0.0);
      CHECK(price(at.stiffness(1), -0.1) == doctest::Approx(0.01));
      CHECK(price(at.stiffness(1), most + 0.1) == doctest::Approx(0.01));

      // Moment input 0: the right foot's, about x; in the paper's model each axis has its own cap.
      const double moment = (model == ddp::Model::lipm ? 20.0 : 10.0) / (44.0 * 9.8 * 0.7);
      CHECK(price(at.moment(0), 0.999 * moment) == 0.0);
      CHECK(price(at.moment(0), -0.999 * moment) == 0.0);
      CHECK(price(at.moment(0), moment + 0.1) == doctest::Approx(0.01));
      CHECK(price(at.moment(0), -moment - 0.1) == doctest::Approx(0.01));
    }
}
