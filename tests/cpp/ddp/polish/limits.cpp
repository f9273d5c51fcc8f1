#include "ddp/polish/limits.hpp"

#include <doctest/doctest.h>

#include "ddp/support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;

/// Feet, with or without soles, at the end of legs of two links with weak and slow joints, hips that move with the
/// feet.
mcplan::Robot with_legs(bool soles) {
  mcplan::Robot robot = scenes::humanoid44();
  for (const char* name : {"right_foot", "left_foot"}) {
    mcplan::EndEffector& foot = robot.end_effectors[robot.end_effector_index(name)];
    foot.limb.hip_B = {0.02, 0.8 * foot.nominal_B.y(), -0.05};
    foot.limb.hip_shift = -0.1;
    foot.limb.upper = 0.36;
    foot.limb.lower = 0.34;
    foot.limb.ankle = {-0.01, 0.005, 0.06};
    foot.limb.margin = 0.01;
    foot.limb.knee_torque = 40.0;
    foot.limb.knee_speed = 1.0;
    foot.limb.hip_torque = {30.0, 50.0};
    foot.limb.ankle_torque = {10.0, 20.0};
    if (soles) continue;
    foot.half_size.setZero();
    foot.limb.ankle.setZero();
  }
  return robot;
}

Tuning holding_joints(const Problem& problem) {
  Tuning tuning = problem.tuning();
  tuning.hold_joints = true;
  return tuning;
}

/// A shaken motion with a random sequence, and its rows.
struct Rowed {
  Rowed(const mcplan::Scene& scene, const Options& options, std::uint64_t seed)
      : problem(scene,
                seed % 3 == 0   ? with_legs(seed % 2 == 0)
                : seed % 3 == 1 ? scenes::humanoid44()
                                : scenes::humanoid44_cut(),
                options),
        random(seed),
        fixed(problem, random_sequence(problem, random)),
        pendulum(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model),
        limits(fixed, pendulum, holding_joints(problem)),
        motion(fixed) {
    motion.trajectory = shaken_guess(problem, random, 0.05);
    fixed.impose(motion.trajectory);
    problem.set_sole_yaw(fixed.contacts(), motion.trajectory);
    limits.head(motion.trajectory);
    REQUIRE(motion.evaluate(pendulum));
  }
  Problem problem;
  Random random;
  polish::FixedSequence fixed;
  Pendulum pendulum;
  polish::Limits limits;
  polish::Motion motion;

  /// The rows where the variables of knot k are moved.
  VectorXd moved(int k, const VectorXd& by) {
    polish::Motion other(fixed);
    other.trajectory = motion.trajectory;
    other.trajectory.x[k] += by.head(fixed.nx());
    if (k < fixed.steps())
      for (std::size_t i = 0; i < fixed.phase(k).inputs.size(); ++i)
        other.trajectory.u[k][fixed.phase(k).inputs[i]] += by[fixed.nx() + static_cast<int>(i)];
    other.evaluate(pendulum);
    polish::RowArray r;
    limits.values(other, r);
    return r;
  }
  MatrixXd jacobian(int k) {
    return differences([&](const VectorXd& by) { return moved(k, by); }, VectorXd::Zero(fixed.size(k)), 1e-4);
  }
};

std::vector<Options> all_options() {
  std::vector<Options> out;
  for (Model model : kModels) {
    out.push_back(phases(8, model));
    out.push_back(out.back());
    out.back().stiffness_input = StiffnessInput::lambda;
    out.back().friction_sides = 5;
  }
  return out;
}

}  // namespace

TEST_CASE("rows along a step and as a quadratic are those of differences") {
  std::uint64_t seed = 700;
  for (const mcplan::Scene& scene : scenes_of_all_kinds())
    for (const Options& options : all_options()) {
      Rowed m(scene, options, ++seed);
      CAPTURE(scene.name);
      CAPTURE(seed);
      const int rows = m.limits.count();
      const polish::RowArray y = noise(m.random, rows, 1.0).array(), d = noise(m.random, rows, 1.0).array().abs();
      std::vector<VectorXd> dz;
      for (int k = 0; k <= m.fixed.steps(); ++k) dz.push_back(noise(m.random, m.fixed.size(k), 1.0));
      VectorXd along = VectorXd::Zero(rows);
      for (int k = 0; k <= m.fixed.steps(); ++k) {
        CAPTURE(k);
        const MatrixXd a = m.jacobian(k);
        along += a * dz[k];
        polish::StageModel model{VectorXd::Zero(m.fixed.size(k)), MatrixXd::Zero(m.fixed.size(k), m.fixed.size(k))};
        m.limits.add(m.motion, k, y, d, model);
        const VectorXd g = a.transpose() * y.matrix();
        const MatrixXd h = a.transpose() * d.matrix().asDiagonal() * a;
        CHECK((model.g - g).lpNorm<Eigen::Infinity>() < 1e-6 * (1.0 + g.lpNorm<Eigen::Infinity>()));
        CHECK((model.h - h).lpNorm<Eigen::Infinity>() < 1e-6 * (1.0 + h.lpNorm<Eigen::Infinity>()));
      }
      polish::RowArray out;
      m.limits.along(m.motion, dz, out);
      CHECK((out.matrix() - along).lpNorm<Eigen::Infinity>() < 1e-6 * (1.0 + along.lpNorm<Eigen::Infinity>()));
    }
}

TEST_CASE(
    "contacts keep inside of their reach between the knots by what is asked for, and at the knots they need not") {
  Rowed m(scenes::flat(), phases(8), 31);
  polish::RowArray before, after;
  m.limits.values(m.motion, before);
  m.problem.reach_room = 0.01;
  m.limits.values(m.motion, after);
  int between = 0;
  for (int k = 0; k < m.fixed.steps(); ++k)
    for (const polish::Standing& standing : m.fixed.phase(k).standing)
      between += m.problem.options.interior_points * polish::reach_rows(m.problem.limits[standing.l]);
  const polish::RowArray grown = after - before;
  CHECK((grown > 0.005).count() == between);
  CHECK(grown.maxCoeff() == doctest::Approx(0.01));
  CHECK(grown.sum() == doctest::Approx(0.01 * between));
}
