#include "ddp/value_functions.hpp"

#include <doctest/doctest.h>

#include <Eigen/LU>

#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// A local model about a shaken guess with a random sequence.
struct Expanded {
  Expanded(const mcplan::Scene& scene, int steps, const Schedule& weights, std::uint64_t seed,
           Model of = Options().model)
      : problem(scene, scenes::humanoid44(), phases(steps, of)),
        random(seed),
        trajectory(shaken_guess(problem, random, 0.05)),
        sequence(random_sequence(problem, random)),
        model(problem) {
    model.expand(trajectory, weights);
  }
  Problem problem;
  Random random;
  Trajectory trajectory;
  ContactSequence sequence;
  LocalModel model;

  Quadratic stage(int k) {
    Quadratic q = model.base(k);
    model.add_contacts(k, sequence[k], q);
    q.mirror();
    return q;
  }
};

}  // namespace

TEST_CASE("min U_k + V_k is one number for every step") {
  std::uint64_t seed = 100;
  for (Model of : kModels)
    for (const mcplan::Scene& scene : scenes_of_all_kinds())
      for (double weight : {0.01, 1.0, 100.0})
        for (double interior : {0.0, 100.0}) {
          Expanded m(scene, 18, schedule(weight, interior, 10.0), ++seed, of);
          CAPTURE(name(of));
          CAPTURE(scene.name);
          CAPTURE(weight);
          CAPTURE(seed);
          ValueFunctions values(m.model);
          REQUIRE(values.backward(m.sequence, 18));
          REQUIRE(values.forward(m.sequence, 0));
          const double cost = values.minimum(0);
          for (int k = 1; k <= 18; ++k) CHECK(std::abs(values.minimum(k) - cost) <= 1e-9 * std::abs(cost));
        }
}

TEST_CASE("the recursion solves the linear-quadratic problem: dense KKT system") {
  for (Model of : kModels)
    for (double weight : {0.01, 1.0, 100.0}) {
      constexpr int kSteps = 3;
      CAPTURE(name(of));
      Expanded m(scenes::flat(0.2), kSteps, schedule(weight, 10.0, 10.0), 130, of);
      const int nx = m.problem.layout.nx(), nu = m.problem.layout.nu(), nz = nx + nu;
      const int variables = kSteps * nz + nx, rows = variables + kSteps * nx;
      // [H C'; C 0] [z; y] = [-g; -d],  C: A dx_k + B du_k - dx_{k+1} = -d_k.
      MatrixXd kkt = MatrixXd::Zero(rows, rows);
      VectorXd right = VectorXd::Zero(rows);
      double constant = 0.0;
      for (int k = 0; k <= kSteps; ++k) {
        const Quadratic q = m.stage(k);
        const int size = k < kSteps ? nz : nx;
        kkt.block(k * nz, k * nz, size, size) = q.h;
        right.segment(k * nz, size) = -q.g;
        constant += q.c;
        if (k == kSteps) break;
        const int row = variables + k * nx;
        kkt.block(row, k * nz, nx, nz) = m.model.pendulum().dense_jacobian(m.model.dynamics(k));
        kkt.block(row, (k + 1) * nz, nx, nx) -= MatrixXd::Identity(nx, nx);
        right.segment(row, nx) = -m.model.defect(k);
      }
      kkt.topRightCorner(variables, kSteps * nx) = kkt.bottomLeftCorner(kSteps * nx, variables).transpose();
      const VectorXd solution = kkt.fullPivLu().solve(right);
      const VectorXd z = solution.head(variables);
      const double cost =
          constant - right.head(variables).dot(z) + 0.5 * z.dot(kkt.topLeftCorner(variables, variables) * z);

      ValueFunctions values(m.model);
      REQUIRE(values.backward(m.sequence, kSteps));
      CHECK(values.minimum(0) == doctest::Approx(cost).epsilon(1e-9));
      std::vector<VectorXd> dx, du;
      values.state_forward(dx, du);
      for (int k = 0; k <= kSteps; ++k) {
        CHECK((dx[k] - z.segment(k * nz, nx)).norm() <= 1e-7 * z.norm());
        if (k < kSteps) CHECK((du[k] - z.segment(k * nz + nx, nu)).norm() <= 1e-7 * z.norm());
      }
    }
}

TEST_CASE("the step satisfies the linear dynamics and costs what V_0 promises") {
  for (Model of : kModels) {
    Expanded m(scenes::gap_with_rail(), 18, schedule(1.0, 100.0, 10.0), 140, of);
    ValueFunctions values(m.model);
    REQUIRE(values.backward(m.sequence, 18));
    std::vector<VectorXd> dx, du;
    values.state_forward(dx, du);
    double cost = 0.0;
    for (int k = 0; k <= 18; ++k) {
      const Quadratic q = m.stage(k);
      VectorXd z = dx[k];
      if (k < 18) {
        z.resize(m.problem.layout.nz());
        z << dx[k], du[k];
        const VectorXd next = m.model.pendulum().dense_jacobian(m.model.dynamics(k)) * z + m.model.defect(k);
        CHECK((next - dx[k + 1]).norm() <= 1e-9 * (1.0 + next.norm()));
      }
      cost += q.c + q.g.dot(z) + 0.5 * z.dot(q.h * z);
    }
    CHECK(values.minimum(0) == doctest::Approx(cost).epsilon(1e-9));
  }
}

TEST_CASE("after a switch at k only V up to k and U beyond k change, and updating those is enough") {
  Expanded m(scenes::gap_with_rail(), 18, schedule(10.0, 100.0, 10.0), 150);
  int switches = 0;
  for (int k = 1; k < 18; ++k) {
    const std::vector<ContactState> neighbours = m.problem.rules.neighbours(m.sequence, k);
    if (neighbours.empty()) continue;
    ValueFunctions updated(m.model), anew(m.model);
    REQUIRE(updated.backward(m.sequence, 18));
    REQUIRE(updated.forward(m.sequence, 0));
    ContactSequence changed = m.sequence;
    changed[k] = neighbours[m.random() % neighbours.size()];
    REQUIRE(updated.backward(changed, k));
    REQUIRE(updated.forward(changed, k));
    REQUIRE(anew.backward(changed, 18));
    REQUIRE(anew.forward(changed, 0));
    for (int j = 0; j <= 18; ++j) {
      CHECK(updated.V(j).c == anew.V(j).c);
      CHECK(updated.V(j).g == anew.V(j).g);
      CHECK(updated.V(j).h == anew.V(j).h);
      CHECK(updated.U(j).c == anew.U(j).c);
      CHECK(updated.U(j).h == anew.U(j).h);
    }
    ++switches;
  }
  CHECK(switches > 3);
}

TEST_CASE("a model without curvature in the inputs is reported, not divided by") {
  mcplan::ddp::Options options = phases(4);
  options.model = Model::lipm;  // the others' offsets always have a weight
  options.weights = {};
  options.weights.stiffness = options.weights.moment = options.weights.stride = options.weights.duration = 0.0;
  const Problem problem(scenes::flat(), scenes::humanoid44(), options);
  const Trajectory guess = problem.initial_guess({});
  LocalModel model(problem);
  model.expand(guess, schedule(1.0, 0.0, -1.0));
  ValueFunctions values(model);
  CHECK_FALSE(values.backward(ContactSequence(5, problem.start_contacts), 4));
}
