#include "check_rows.hpp"
#include "mcplan/base/rotation.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

Writer reach_of(const ddp::Problem& problem) { return term(problem, "reach"); }

}  // namespace

TEST_CASE("reach: gradients at the knot") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    REQUIRE(problem.layout.axis_count() == 3);
    check_rows(problem, reach_of(problem), 44, 0.5, 60);
  }
}

TEST_CASE("reach: gradients at faces that cut the box") {
  for (ddp::Model model : kModels) {
    mcplan::Scene scene = scenes::gap_with_rail();
    scene.start.yaw = 0.4;
    const ddp::Problem problem(scene, scenes::humanoid44_cut(), phases(6, model));
    check_rows(problem, reach_of(problem), 45, 0.5, 60);
  }
}

TEST_CASE("a face that cuts the box adds a row by how far a foot is beyond it, less the margin") {
  const ddp::Problem problem(scenes::flat(0.0), scenes::humanoid44_cut(), phases(6));
  VectorXd x = nominal(problem), u;
  const Eigen::Matrix3d r = mcplan::rotation_from_rpy(x.segment<3>(problem.layout.angle()));
  const Vector3d normal = problem.robot.end_effectors[1].reach_cut.A.row(0);
  const double margin = problem.options.reach_margin_m / 0.7, to_face = 0.08 / 0.7;
  const auto cost_beyond = [&](double by) {
    VectorXd moved = x;
    moved.segment<3>(problem.layout.end(1)) += (to_face - margin + by) * (r * normal);
    return cost(problem, reach_of(problem), moved, u);
  };
  CHECK(cost_beyond(-1e-6) == 0.0);
  CHECK(cost_beyond(0.01) == doctest::Approx(0.5 * 100.0 * 100.0 * 1e-4));
}

TEST_CASE("reach is a box in the base's frame, planned smaller by its margin; nothing is written inside") {
  for (ddp::Model model : kModels) {
    const ddp::Problem problem = workshop(phases(6, model));
    const VectorXd inside = nominal(problem), u;
    CHECK(values(problem, reach_of(problem),
                 (VectorXd(problem.layout.nz()) << inside, VectorXd::Zero(problem.layout.nu())).finished())
              .size() == 0);
    const Eigen::Matrix3d r = mcplan::rotation_from_rpy(inside.segment<3>(problem.layout.angle()));
    const double margin = problem.options.reach_margin_m / 0.7;
    for (int l = 0; l < 4; ++l)
      for (int i = 0; i < 3; ++i) {
        VectorXd x = inside;
        const mcplan::EndEffector& end = problem.robot.end_effectors[l];
        const double to_edge = (end.reach_max_B[i] - end.nominal_B[i]) / 0.7;
        x.segment<3>(problem.layout.end(l)) += (to_edge + 0.05) * r.col(i);
        const double beyond = 0.05 + margin;
        CHECK(cost(problem, reach_of(problem), x, u) == doctest::Approx(0.5 * 100.0 * 100.0 * beyond * beyond));
        x.segment<3>(problem.layout.end(l)) -= (0.0501 + margin) * r.col(i);
        CHECK(cost(problem, reach_of(problem), x, u) == 0.0);
      }
  }
}
