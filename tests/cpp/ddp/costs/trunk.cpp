#include "check_rows.hpp"

namespace {

using namespace support;
using Eigen::Vector3d;

/// A post of 0.1 m beside the middle of the way, and a ceiling above it that nobody comes near.
ddp::Problem with_post() {
  mcplan::Scene scene = scenes::flat();
  mcplan::Surface post = scenes::rectangle("post", 0.9, 1.0, 0.05, 0.15, 1.4, "hand");
  post.thickness = 1.4;
  mcplan::Surface ceiling = scenes::rectangle("ceiling", -1, 3, -1, 1, 2.5, "hand");
  scene.surfaces.push_back(post);
  scene.surfaces.push_back(ceiling);
  return ddp::Problem(scene, scenes::humanoid44(), phases(6));
}

VectorXd at_place(const ddp::Problem& problem, const Vector3d& com_W) {
  VectorXd x = VectorXd::Zero(problem.layout.nx());
  x.segment<3>(problem.layout.com()) = com_W / 0.7;
  return x;
}

}  // namespace

TEST_CASE("the trunk stays 0.15 CoM heights away from what stands about the way, at the knots and between them") {
  const ddp::Problem problem = with_post();
  REQUIRE(problem.standing_solids.size() == 1);
  CHECK(problem.scene.surfaces[problem.standing_solids[0]].name == "post");
  const Writer trunk = term(problem, "trunk", {2, 0, ddp::kFree, 100.0, 3.0});
  const double w = problem.tuning().limit_weight;
  const auto price = [&](const Vector3d& com_W) {  // at the last knot, without a phase
    return std::sqrt(2.0 * cost(problem, trunk, at_place(problem, com_W), VectorXd())) / w * 0.7;
  };
  CHECK(price({0.95, -0.10, 0.7}) == 0.0);
  CHECK(price({0.95, 0.0, 0.7}) == doctest::Approx(0.105 - 0.05));    // before a side
  CHECK(price({0.86, 0.02, 0.7}) == doctest::Approx(0.105 - 0.05));   // before an edge: 3, 4, 5
  CHECK(price({0.95, 0.06, 0.7}) == doctest::Approx(0.105 + 0.01));   // inside
  CHECK(price({0.95, 0.10, 1.45}) == doctest::Approx(0.105 - 0.05));  // above
  check_rows(problem, trunk, 11, 0.3, 40);
}

TEST_CASE("parts of the robot's own trunk stay 1.25 radii away, by the angles of the base") {
  mcplan::Robot robot = scenes::humanoid44();
  robot.trunk = {{Vector3d(0, 0, 0.1), Vector3d(0, 0, 0.5), 0.07},
                 {Vector3d(0, -0.2, 0.4), Vector3d(0, 0.2, 0.4), 0.05}};
  mcplan::Scene scene = scenes::flat();
  mcplan::Surface beam = scenes::rectangle("beam", 0.9, 1.0, -0.4, 0.4, 1.6, "hand");
  beam.thickness = 0.3;
  scene.surfaces.push_back(beam);
  const ddp::Problem problem(scene, robot, phases(6));
  REQUIRE(problem.trunk_solids.size() == 1);
  CHECK(problem.scene.surfaces[problem.trunk_solids[0]].name == "beam");
  const Writer trunk = term(problem, "trunk", {2, 0, ddp::kFree, 100.0, 3.0});
  const double w = problem.tuning().limit_weight;
  const auto price = [&](const Vector3d& com_W) {
    return std::sqrt(2.0 * cost(problem, trunk, at_place(problem, com_W), VectorXd())) / w * 0.7;
  };
  CHECK(price({0.95, 0.0, 0.69}) == 0.0);  // the head ends at 1.26, the shoulders at 1.14
  CHECK(price({0.95, 0.0, 0.72}) == doctest::Approx(0.72 + 0.5 + 1.25 * 0.07 - 1.3));
  CHECK(price({1.05, 0.0, 0.85}) == doctest::Approx(1.25 * 0.07 - 0.05));   // beside the head
  CHECK(price({0.95, 0.65, 0.95}) == doctest::Approx(1.25 * 0.05 - 0.05));  // with a shoulder alone
  // Below a ceiling one end of a part is nearest, but where it turns over: rows have a gradient there.
  scene.surfaces.back() = scenes::rectangle("ceiling", -2, 4, -3, 3, 1.6, "hand");
  scene.surfaces.back().thickness = 0.3;
  const ddp::Problem below(scene, robot, phases(6));
  check_rows(below, term(below, "trunk", {2, 0, ddp::kFree, 100.0, 3.0}), 11, 0.1, 40);
  // Where the start leaves less than that, 0.08 m of which 0.07 are the radius, no more is asked for.
  scene.surfaces.back() = scenes::rectangle("shelf", -0.2, -0.08, -3, 3, 1.6, "hand");
  scene.surfaces.back().thickness = 0.6;
  const ddp::Problem beside(scene, robot, phases(6));
  const Writer at_wall = term(beside, "trunk", {2, 0, ddp::kFree, 100.0, 3.0});
  CHECK(cost(beside, at_wall, at_place(beside, {0.0, 0.0, 0.7}), VectorXd()) == 0.0);
  CHECK(cost(beside, at_wall, at_place(beside, {-0.005, 0.0, 0.7}), VectorXd()) > 0.0);
  robot.trunk.clear();
  CHECK(ddp::Problem(scene, robot, phases(6)).trunk_solids.empty());
}

TEST_CASE("ground is nothing that stands, and the paper's method knows of no trunk") {
  for (const mcplan::Scene& scene : scenes::all_four())
    CHECK(ddp::Problem(scene, scenes::humanoid44(), phases(18)).standing_solids.empty() ==
          (scene.name != "gap_with_rail"));
  ddp::Options options = phases(18);
  options.method = ddp::Method::paper;
  CHECK(ddp::Problem(scenes::gap_with_rail(), scenes::humanoid44(), options).standing_solids.empty());
}
