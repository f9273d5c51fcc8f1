#include "check_rows.hpp"
#include "ddp/moment_limits.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

enum { before, after, right_pad, left_pad, slope };

}  // namespace

TEST_CASE("torsion: a foot that hardly presses cannot twist; points and grips are not judged by a sole") {
  for (ddp::Model model : kModels)
    for (auto input : {ddp::StiffnessInput::mu, ddp::StiffnessInput::lambda}) {
      ddp::Options options = phases(6, model);
      options.stiffness_input = input;
      const ddp::Problem problem = workshop(options, false);  // without the slope: one normal, so one moment a foot
      const ddp::Layout& at = problem.layout;
      const Writer torsion = term(problem, "torsion", {2, 1, before, 100.0, 3.0});
      check_rows(problem, torsion, 53, 0.5, 30);
      // Friction 0.68 under a sole 0.05 m to either side, the CoM at 0.8 of its height, all instants at once.
      const double arm = 0.68 * 0.05 / 0.7, ratio = 0.8 * arm;
      CHECK(torsion_arm(problem, 1, before) == doctest::Approx(arm));
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x.segment<3>(at.com()) = Vector3d(0.3, -0.2, 0.8);
      u[at.stiffness(1)] = input == ddp::StiffnessInput::lambda ? std::sqrt(0.5) : 0.5;
      const int last = at.moment_count() - 1, yaw = at.moment(last);
      REQUIRE(at.moments()[last].end_effector == 1);
      REQUIRE(at.moments()[last].direction_W == Vector3d::UnitZ());
      for (double sign : {1.0, -1.0}) {
        const int instants = options.interior_points + 2;
        u[yaw] = sign * 0.499 * ratio;
        CHECK(cost(problem, torsion, x, u) == 0.0);
        u[yaw] = sign * (0.5 * ratio + 0.1);
        CHECK(cost(problem, torsion, x, u) == doctest::Approx(instants * 0.5 * 9.0 * 0.01));
      }
      CHECK(std::isinf(torsion_arm(problem, 2, right_pad)));
      CHECK(std::isinf(torsion_arm(problem, 2, before)));  // a hand is a point
    }
}

TEST_CASE("torsion: no moment but about the surface's normal, which is what the centre of pressure does") {
  const ddp::Problem problem = workshop(phases(6));
  const ddp::Layout& at = problem.layout;
  REQUIRE(at.moment_count() == 6);  // the feet's surfaces have different normals
  const double limit = 0.5 * 100.0 * 100.0;
  for (int surface : {before, slope}) {
    const Writer torsion = term(problem, "torsion", {2, 1, surface, 100.0, 3.0});
    check_rows(problem, torsion, 59, 0.5, 30);
    for (int i = 0; i < 6; ++i) {
      VectorXd x = VectorXd::Zero(at.nx()), u = VectorXd::Zero(at.nu());
      x[at.com() + 2] = 1.0;
      u[at.stiffness(1)] = 0.5;
      u[at.moment(i)] = 0.005;  // less than the sole bears about its normal
      const bool mine = at.moments()[i].end_effector == 1;
      const bool normal = surface == before && at.moments()[i].direction_W == Vector3d::UnitZ();
      CHECK(cost(problem, torsion, x, u) == doctest::Approx(mine && !normal ? limit * 0.005 * 0.005 : 0.0));
    }
  }
}
