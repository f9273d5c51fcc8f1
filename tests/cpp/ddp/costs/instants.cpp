#include "check_rows.hpp"

namespace {

using namespace support;

}  // namespace

TEST_CASE("instants lie on the motion of the phase, evenly, from its start to its end") {
  Random random(50);
  for (int interior : {0, 2, 3}) {
    ddp::Options options = phases(6);
    options.interior_points = interior;
    options.stiffness_input = interior == 3 ? ddp::StiffnessInput::lambda : ddp::StiffnessInput::mu;
    const ddp::Problem problem = workshop(options);
    const ddp::Layout& at = problem.layout;
    const ddp::Pendulum pendulum(at, problem.inertia, options.stiffness_input);
    const VectorXd z = random_z(problem, random, 0.3);
    ddp::PendulumStep step;
    std::vector<ddp::Instant> instants;
    make_instants(problem, pendulum, z.head(at.nx()), z.tail(at.nu()), true, step, instants);
    REQUIRE(instants.size() == static_cast<std::size_t>(interior + 2));
    for (int i = 0; i < interior + 2; ++i) {
      const ddp::Instant& instant = instants[i];
      CHECK(instant.fraction == doctest::Approx(i / (interior + 1.0)));
      // CoM and angles at that instant, as a function of z.
      const auto there = [&](const VectorXd& from) {
        VectorXd u = from.tail(at.nu()), next;
        u[at.duration()] *= instant.fraction;
        pendulum.next(from.head(at.nx()), u, next);
        VectorXd out(6);
        out << next.segment<3>(at.com()), next.segment<3>(at.angle());
        return out;
      };
      CHECK((there(z).head<3>() - instant.com).norm() <= 1e-14);
      CHECK((there(z).tail<3>() - instant.rpy).norm() <= 1e-14);
      const MatrixXd jacobian = differences(there, z);
      CHECK((jacobian.topRows(3) - instant.com_jacobian).cwiseAbs().maxCoeff() <= 1e-8);
      CHECK((jacobian.bottomRows(3) - instant.angle_jacobian).cwiseAbs().maxCoeff() <= 1e-8);
    }
  }
}

TEST_CASE("base axes that nothing drives keep their angle at every instant") {
  mcplan::Scene scene = scenes::flat();
  scene.start.yaw = 0.6;
  mcplan::Robot robot = scenes::humanoid44();
  for (auto& end : robot.end_effectors) end.max_moment.setZero();
  const ddp::Problem problem(scene, robot, phases(6));
  const ddp::Pendulum pendulum(problem.layout, problem.inertia, problem.options.stiffness_input);
  REQUIRE(problem.layout.axis_count() == 0);
  Random random(51);
  const VectorXd z = random_z(problem, random, 0.3);
  ddp::PendulumStep step;
  std::vector<ddp::Instant> instants;
  make_instants(problem, pendulum, z.head(problem.layout.nx()), z.tail(problem.layout.nu()), true, step, instants);
  for (const ddp::Instant& instant : instants) CHECK((instant.rpy - Eigen::Vector3d(0, 0, 0.6)).norm() == 0.0);
}
