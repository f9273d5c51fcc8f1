#include <doctest/doctest.h>

#include "ddp/problem.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/mcplan.hpp"
#include "support.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

/// Ground that ends so far ahead of the middle of the feet at the goal, or for a negative number behind those at the
/// start: half soles are 0.10 m long.
mcplan::Scene ground(double ahead_of_goal, double behind_start = -1.0, double goal_x = 0.6) {
  return scenes::made_of("ground", {scenes::rectangle("ground", behind_start, goal_x + ahead_of_goal, -1, 1, 0)},
                         "ground", "ground", {goal_x, 0.0, 0.0});
}

/// Whole soles stay on the ground.
ddp::Options whole_soles(int n) {
  ddp::Options options = phases(n);
  options.sole_inside = 1.0;
  return options;
}

int edge_towards(const ddp::Problem& problem, const Vector3d& direction) {
  const mcplan::Polygon& polygon = problem.polygons[0];
  for (int i = 0; i < polygon.edge_count(); ++i)
    if (polygon.edge_outward_W(i).dot(direction) > 0.99) return i;
  return -1;
}

/// Margin of the left foot there, of the edge behind.
double margin_behind(const ddp::Problem& problem, const Vector3d& place, Vector3d* by_place = nullptr) {
  const int edge = edge_towards(problem, -Vector3d::UnitX());
  return problem.margin_of_given(1, 0, edge, place, problem.foothold_margin(1, 0, edge), by_place);
}

}  // namespace

TEST_CASE("the margin of a foothold that the scene gives is what that leaves, and grows with the distance from it") {
  const ddp::Problem problem(ground(1.0, -0.03), scenes::humanoid44(), whole_soles(6));
  const double m = 1.0 / problem.units.length;
  const double usual = problem.foothold_margin(1, 0, edge_towards(problem, -Vector3d::UnitX()));
  const Vector3d given = problem.start.segment<3>(problem.layout.end(1));
  CHECK(usual > 0.09 * m);
  CHECK(margin_behind(problem, given) == doctest::Approx(0.03 * m));
  CHECK(margin_behind(problem, given + 0.02 * m * Vector3d::UnitY()) == doctest::Approx(0.05 * m));
  CHECK(margin_behind(problem, given + 0.5 * m * Vector3d::UnitX()) == doctest::Approx(usual));
  // Room to the other edges is the usual one.
  CHECK(problem.margin_of_given(1, 0, edge_towards(problem, Vector3d::UnitY()), given, usual) == usual);
}

TEST_CASE("the derivative of such a margin is that of its values") {
  const ddp::Problem problem(ground(1.0, -0.03), scenes::humanoid44(), whole_soles(6));
  const Vector3d given = problem.start.segment<3>(problem.layout.end(1));
  for (const Vector3d& off : {Vector3d(0.02, 0.01, 0.005), Vector3d(-0.01, 0.03, 0.0), Vector3d(0.6, 0.0, 0.0)}) {
    Vector3d by_place = Vector3d::Zero();
    margin_behind(problem, given + off, &by_place);
    const auto margin = [&](const VectorXd& place) { return VectorXd::Constant(1, margin_behind(problem, place)); };
    CHECK((differences(margin, given + off, 1e-4) - by_place.transpose()).norm() < 1e-8);
  }
}

TEST_CASE("feet that start or end at an edge cost no more than on ground that goes on") {
  for (const ddp::Polish polish : {ddp::Polish::penalty, ddp::Polish::interior_point}) {
    ddp::Options options = whole_soles(10);
    options.restarts = 0;
    options.polish = polish;
    const auto cost = [&](const mcplan::Scene& scene) {
      const auto result = ddp::SwitchedDdp(scene, scenes::humanoid44(), options).solve();
      CHECK(result.report.status == mcplan::Status::solved);
      return result.report.cost;
    };
    const double wide = cost(ground(1.0));
    CHECK(cost(ground(1.0, -0.03)) < 1.5 * wide);
    CHECK(cost(ground(0.03)) < 1.5 * wide);
  }
}

TEST_CASE("margins are those of the soles as they head where the course passes the surface") {
  mcplan::Scene scene =
      scenes::made_of("aside",
                      {scenes::rectangle("near", -1, 1, -1, 0.3, 0), scenes::rectangle("tread", -1, 1, 0.3, 0.9, 0),
                       scenes::rectangle("far", -1, 1, 0.9, 3.0, 0)},
                      "near", "far", {0.0, 2.0, 0.0});
  const mcplan::Robot robot = mcplan::load_robot("talos");
  const Eigen::Vector2d half = robot.end_effectors[0].half_size;
  const auto margin_across = [&](bool faces_way) {
    const ddp::Problem problem(scene, robot, whole_soles(0), {{}, faces_way});
    const mcplan::Polygon& polygon = problem.polygons[1];
    for (int i = 0; i < polygon.edge_count(); ++i)
      if (polygon.edge_outward_W(i).y() > 0.99) return problem.foothold_margin(0, 1, i) * problem.units.length;
    return -1.0;
  };
  CHECK(margin_across(false) >= half.y());
  CHECK(margin_across(false) < half.x());
  CHECK(margin_across(true) >= half.x() - 1e-12);
}
