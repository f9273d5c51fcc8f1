#include "ddp/local_model.hpp"

#include <doctest/doctest.h>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

struct Point {
  Point(const mcplan::Scene& scene, const Options& options, std::uint64_t seed, double size)
      : problem(scene, scenes::humanoid44(), options),
        random(seed),
        trajectory(shaken_guess(problem, random, size)),
        sequence(random_sequence(problem, random)) {}
  Problem problem;
  Random random;
  Trajectory trajectory;
  ContactSequence sequence;
};

std::vector<Options> variants() {
  std::vector<Options> out(5, phases(12));
  out[1].stiffness_input = StiffnessInput::lambda;
  out[1].friction_sides = 6;
  out[2].model = out[3].model = Model::lipm;
  out[3].stiffness_input = StiffnessInput::lambda;
  out[4].method = Method::paper;
  return out;
}

Schedule schedule(double contact, double interior, double proximal, bool discovering) {
  Schedule out = support::schedule(contact, interior, proximal);
  out.discovering = discovering;
  return out;
}

}  // namespace

TEST_CASE("the model's cost at the point of expansion is the true cost, and its defects the true ones") {
  std::uint64_t seed = 60;
  for (const mcplan::Scene& scene : scenes_of_all_kinds())
    for (const Options& options : variants())
      for (double interior : {0.0, 100.0}) {
        Point at(scene, options, ++seed, 0.2);
        const Schedule weights = schedule(3.0, interior, 10.0, interior == 0.0);
        LocalModel model(at.problem);
        model.expand(at.trajectory, weights);
        double cost = 0.0;
        for (int k = 0; k <= at.problem.steps; ++k) {
          Quadratic q = model.base(k);
          model.add_contacts(k, at.sequence[k], q);
          cost += q.c;
        }
        Evaluator evaluate(at.problem);
        const Evaluation truth = evaluate(at.trajectory, at.sequence, weights);
        if (interior > 0.0) cost += change_cost(at.problem, at.sequence);
        CHECK(cost == doctest::Approx(truth.cost).epsilon(1e-12));
        double terms = 0.0;
        for (double term : truth.terms) terms += term;
        CHECK(terms == doctest::Approx(truth.cost).epsilon(1e-12));

        double sum = 0.0, most = 0.0;
        VectorXd next;
        for (int k = 0; k < at.problem.steps; ++k) {
          model.pendulum().next(at.trajectory.x[k], at.trajectory.u[k], next);
          const VectorXd defect = next - at.trajectory.x[k + 1];
          CHECK((model.defect(k) - defect).cwiseAbs().maxCoeff() <= 1e-13);
          // [com, velocity, angles, momenta, end-effectors], the yaw's alone or all three
          const int axes = at.problem.layout.axis_count(), angles = 2 * axes;
          sum += defect.head<3>().norm() + defect.segment<3>(3).norm() + defect.segment(6, axes).cwiseAbs().sum() +
                 defect.segment(6 + axes, axes).norm();
          for (int i = 6 + angles; i < defect.size(); i += 3) sum += defect.segment<3>(i).norm();
          most = std::max(most, defect.lpNorm<Eigen::Infinity>());
        }
        CHECK(truth.defect_sum == doctest::Approx(sum));
        CHECK(truth.defect_max == doctest::Approx(most));
        CHECK(truth.merit() == doctest::Approx(truth.cost + 30.0 * sum));
      }
}

TEST_CASE("the model's gradient is that of the true cost, step by step") {
  std::uint64_t seed = 80;
  int checked = 0;
  for (const mcplan::Scene& scene : {scenes::stairs(), scenes::gap_with_rail(), gap_with_walls()})
    for (const Options& options : variants()) {
      Point at(scene, options, ++seed, 0.2);
      const Schedule weights = schedule(3.0, 5.0, 10.0, false);
      LocalModel model(at.problem);
      model.expand(at.trajectory, weights);
      Evaluator evaluate(at.problem);
      for (int k : {0, 5, at.problem.steps}) {
        const bool last = k == at.problem.steps;
        const int nx = at.problem.layout.nx(), nu = last ? 0 : at.problem.layout.nu();
        VectorXd z(nx + nu);
        z.head(nx) = at.trajectory.x[k];
        if (!last) z.tail(nu) = at.trajectory.u[k];
        Quadratic q = model.base(k);
        model.add_contacts(k, at.sequence[k], q);
        REQUIRE(q.g.size() == nx + nu);
        Trajectory moved = at.trajectory;
        // Sums of squares of clipped distances: once differentiable everywhere, so a kink costs the differences digits
        // only where it lies within them.
        const auto cost = [&](const VectorXd& there) {
          moved.x[k] = there.head(nx);
          if (!last) moved.u[k] = there.tail(nu);
          return VectorXd::Constant(1, evaluate(moved, at.sequence, weights).cost);
        };
        const MatrixXd fine = differences(cost, z, 1e-4), coarse = differences(cost, z, 2e-4);
        for (int i = 0; i < nx + nu; ++i) {
          const double scale = 1.0 + q.g.cwiseAbs().maxCoeff();
          if (std::abs(fine(0, i) - coarse(0, i)) > 1e-7 * scale) continue;
          CHECK(std::abs(q.g[i] - fine(0, i)) <= 1e-6 * scale);
          ++checked;
        }
      }
    }
  CHECK(checked > 400);
}

TEST_CASE("contact states enter as blocks: any sequence can be assembled without a new expansion") {
  for (Model of : kModels) {
    Point at(scenes::gap_with_rail(), phases(12, of), 90, 0.1);
    const Schedule weights = schedule(3.0, 100.0, 10.0, false);
    LocalModel model(at.problem);
    model.expand(at.trajectory, weights);
    Evaluator evaluate(at.problem);
    for (int i = 0; i < 5; ++i) {
      const ContactSequence other = random_sequence(at.problem, at.random);
      double cost = 0.0;
      for (int k = 0; k <= at.problem.steps; ++k) {
        Quadratic q = model.base(k);
        model.add_contacts(k, other[k], q);
        cost += q.c;
      }
      cost += change_cost(at.problem, other);
      CHECK(cost == doctest::Approx(evaluate(at.trajectory, other, weights).cost).epsilon(1e-12));
    }
  }
}

TEST_CASE("the proximal term adds its weight to the inputs' curvature and nothing else") {
  Point at(scenes::flat(), phases(6), 91, 0.1);
  using support::schedule;
  LocalModel loose(at.problem), tight(at.problem);
  loose.expand(at.trajectory, schedule(1.0, 0.0, 0.0));
  tight.expand(at.trajectory, schedule(1.0, 0.0, 7.0));
  const int nx = at.problem.layout.nx(), nu = at.problem.layout.nu();
  for (int k = 0; k < 6; ++k) {
    CHECK(tight.base(k).c == loose.base(k).c);
    CHECK(tight.base(k).g == loose.base(k).g);
    MatrixXd expected = MatrixXd::Zero(nx + nu, nx + nu);
    expected.diagonal().tail(nu).setConstant(7.0);
    CHECK((tight.base(k).h - loose.base(k).h - expected).cwiseAbs().maxCoeff() <= 1e-9);
  }
}
