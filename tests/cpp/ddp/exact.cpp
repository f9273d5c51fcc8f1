#include <doctest/doctest.h>

#include <limits>

#include "ddp/search.hpp"
#include "ddp/stepping_sequence.hpp"
#include "support.hpp"

namespace {

using mcplan::Deadline;
using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;

void check_exact(const Problem& problem, const Incumbent& now) {
  const Layout& at = problem.layout;
  const Pendulum pendulum(at, problem.inertia, problem.options.stiffness_input, problem.model);
  double defect = 0.0;
  VectorXd next;
  for (int k = 0; k < problem.steps; ++k) {
    const VectorXd &x = now.trajectory.x[k], &u = now.trajectory.u[k];
    pendulum.next(x, u, next);
    defect = std::max(defect, (next - now.trajectory.x[k + 1]).cwiseAbs().maxCoeff());
    for (int l = 0; l < at.end_effector_count(); ++l) {
      const int surface = now.sequence[k][l];
      const Vector3d pressure = at.pressure_offset(u, l);
      if (surface == kFree) {
        CHECK(u[at.stiffness(l)] == 0.0);
        CHECK(pressure == Vector3d::Zero());
        CHECK(at.line_offset(u, l) == Vector3d::Zero());
        continue;
      }
      const Eigen::Matrix3d sole = problem.sole_frame(surface, now.trajectory.sole_yaw[k][l]);
      for (int i : {0, 1}) CHECK(std::abs(sole.col(i).dot(pressure)) <= problem.limits[l].pressure_half[i] + 1e-14);
      CHECK(std::abs(sole.col(2).dot(pressure)) <= 1e-14);
      CHECK(pendulum.mu(u, l) >= 0.0);
      const Vector3d foot = x.segment<3>(at.end(l));
      // A contact holds from the knot at which it is made to the end of its last phase.
      CHECK(now.trajectory.x[k + 1].segment<3>(at.end(l)) == foot);
      CHECK(std::abs(problem.polygons[surface].height(foot)) <= 1e-14);
      CHECK(problem.polygons[surface].outside(foot) <= 1e-14);
    }
    for (int i = 0; i < at.moment_count(); ++i) {
      const int l = at.moments()[i].end_effector;
      double most = 0.0;
      const Vector3d& about = at.moments()[i].direction_W;
      const int surface = now.sequence[k][l];
      if (surface != kFree && (problem.model == Model::lipm || about.dot(problem.polygons[surface].normal_W()) > 0.999))
        most = std::min(at.moments()[i].max,
                        torsion_arm(problem, l, surface) * pendulum.mu(u, l) *
                            problem.polygons[surface].normal_W().dot(x.segment<3>(at.com()) - at.line_point(x, u, l)));
      CHECK(std::abs(u[at.moment(i)]) <= most);
    }
  }
  CHECK(defect <= 1e-12);
  // In the paper's model the CoM is not held: on point feet side by side nothing could move it forward.
  const int held = problem.model == Model::wrench ? at.nx() : at.nx() - at.angle();
  CHECK(now.trajectory.x[0].tail(held) == problem.start.tail(held));
}

}  // namespace

TEST_CASE("an exact plan has no defects, contacts at rest on their surfaces and no force elsewhere") {
  mcplan::Scene ramp = scenes::flat();
  ramp.surfaces = {scenes::rectangle("ground", -1, 1, -5, 5, 0), scenes::rectangle("ramp", 1, 5, -5, 5, 0)};
  ramp.name = "ramp";
  for (auto& v : ramp.surfaces[1].vertices_W) v.z() += 0.2 * (v.x() - 1.0);
  ramp.goal = scenes::made_of("", {}, "ground", "ramp", {2, 0, 0.2}).goal;
  for (Model model : kModels)
    for (auto input : {StiffnessInput::mu, StiffnessInput::lambda})
      for (const mcplan::Scene& scene : {scenes::flat(), scenes::stairs(), ramp}) {
        if (input == StiffnessInput::lambda && scene.name != "flat") continue;
        CAPTURE(name(model));
        CAPTURE(scene.name);
        Options options = phases(18, model);
        options.stiffness_input = input;
        const Problem problem(scene, scenes::humanoid44(), options);
        const Deadline deadline(options.time_limit_s);
        mcplan::Report report;
        Search search(problem, deadline, report);
        Incumbent now;
        now.sequence = stepping_sequence(problem, 0);
        REQUIRE_FALSE(now.sequence.empty());
        now.trajectory = problem.initial_guess(now.sequence);
        search.polish(now, 80, 1e-5, std::numeric_limits<double>::infinity(), problem.tuning());
        const Evaluation soft = now.evaluation;
        const Trajectory before = now.trajectory;
        REQUIRE(search.make_exact(now, problem.tuning()));
        check_exact(problem, now);
        // A small correction, not another motion.
        for (int k = 0; k <= 18; ++k) CHECK((now.trajectory.x[k] - before.x[k]).cwiseAbs().maxCoeff() < 0.05);
        CHECK(now.evaluation.defect_max <= 1e-12);
        CHECK(soft.defect_max > 1e-12);
      }
}

TEST_CASE("what cannot be made exact is left as it is") {
  const Problem problem(scenes::flat(), scenes::humanoid44(), phases(4));
  const Deadline deadline(1e9);
  mcplan::Report report;
  Search search(problem, deadline, report);
  Incumbent now;
  now.sequence.assign(5, problem.start_contacts);
  now.trajectory = problem.initial_guess(now.sequence);
  now.trajectory.u[1].setConstant(std::numeric_limits<double>::quiet_NaN());
  const Trajectory before = now.trajectory;
  CHECK_FALSE(search.make_exact(now, problem.tuning()));
  CHECK(now.trajectory.x[2] == before.x[2]);
  CHECK(now.trajectory.u[2] == before.u[2]);
}
