#include "costs/check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

}  // namespace

TEST_CASE("instants lie on the motion of the phase, evenly, from its start to its end") {
  Random random(50);
  for (ddp::Model model : kModels)
    for (int interior : {0, 2, 3}) {
      ddp::Options options = phases(6, model);
      options.interior_points = interior;
      options.stiffness_input = interior == 3 ? ddp::StiffnessInput::lambda : ddp::StiffnessInput::mu;
      const ddp::Problem problem = workshop(options);
      const ddp::Layout& at = problem.layout;
      const ddp::Pendulum pendulum(at, problem.inertia, options.stiffness_input, model);
      const VectorXd z = random_z(problem, random, 0.1), x = z.head(at.nx()), u = z.tail(at.nu());
      ddp::Instants instants;
      instants.of(problem, pendulum, x, u);
      REQUIRE(instants.size() == static_cast<std::size_t>(interior + 2));
      for (int i = 0; i < interior + 2; ++i) {
        const ddp::Instant& instant = instants[i];
        CAPTURE(name(model));
        CAPTURE(i);
        CHECK(instant.fraction == doctest::Approx(i / (interior + 1.0)));
        // CoM and angles at that instant, as a function of z.
        const auto there = [&](const VectorXd& from) {
          VectorXd input = from.tail(at.nu()), next;
          input[at.duration()] *= instant.fraction;
          pendulum.next(from.head(at.nx()), input, next);
          VectorXd out(6);
          out << next.segment<3>(at.com()), next.segment<3>(at.angle());
          return out;
        };
        CHECK((there(z).head<3>() - instant.com).norm() <= 1e-14);
        CHECK((there(z).tail<3>() - instant.rpy).norm() <= 1e-14);
        const MatrixXd jacobian = differences(there, z);
        // Asked for again and for other directions: the derivatives are worked out once and added to what is there.
        for (int direction = 0; direction < 6; ++direction) {
          VectorXd along = VectorXd::Unit(6, direction), g = VectorXd::Ones(at.nz());
          instant.add_along(along.head<3>(), along.tail<3>(), g);
          CHECK((g.array() - 1.0 - jacobian.row(direction).transpose().array()).abs().maxCoeff() <= 1e-8);
        }
      }
    }
}

TEST_CASE("instants that are made anew forget what they were") {
  Random random(57);
  const ddp::Problem problem = workshop();
  const ddp::Layout& at = problem.layout;
  const ddp::Pendulum pendulum(at, problem.inertia, problem.options.stiffness_input, problem.model);
  ddp::Instants used, fresh;
  VectorXd z = random_z(problem, random, 0.1), x = z.head(at.nx()), u = z.tail(at.nu());
  VectorXd there = VectorXd::Zero(at.nz()), expected = there;
  const Vector3d com(0.3, -0.4, 0.5), rpy(-0.1, 0.2, 0.7);
  used.of(problem, pendulum, x, u);
  for (const ddp::Instant& instant : used) instant.add_along(com, rpy, there);
  z = random_z(problem, random, 0.1), x = z.head(at.nx()), u = z.tail(at.nu());
  used.of(problem, pendulum, x, u);
  fresh.of(problem, pendulum, x, u);
  there.setZero();
  for (const ddp::Instant& instant : used) instant.add_along(com, rpy, there);
  for (const ddp::Instant& instant : fresh) instant.add_along(com, rpy, expected);
  CHECK(there == expected);
}

TEST_CASE("in the paper's model, base axes that nothing drives keep their angle at every instant") {
  mcplan::Scene scene = scenes::flat();
  scene.start.yaw = 0.6;
  mcplan::Robot robot = scenes::humanoid44();
  for (auto& end : robot.end_effectors) end.max_moment.setZero();
  const ddp::Problem problem(scene, robot, phases(6, ddp::Model::lipm));
  const ddp::Pendulum pendulum(problem.layout, problem.inertia, problem.options.stiffness_input, problem.model);
  REQUIRE(problem.layout.axis_count() == 0);
  Random random(51);
  const VectorXd z = random_z(problem, random, 0.3), x = z.head(problem.layout.nx()), u = z.tail(problem.layout.nu());
  ddp::Instants instants;
  instants.of(problem, pendulum, x, u);
  for (const ddp::Instant& instant : instants) CHECK((instant.rpy - Vector3d(0, 0, 0.6)).norm() == 0.0);
}
