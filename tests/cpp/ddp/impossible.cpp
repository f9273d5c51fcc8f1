#include "ddp/impossible.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mcplan/base/rotation.hpp"
#include "mcplan/ddp/switched_ddp.hpp"
#include "mcplan/plan/checker.hpp"
#include "mcplan/scene/polygon.hpp"
#include "support.hpp"

namespace {

using namespace support;
using namespace mcplan::ddp;
using Eigen::Vector3d;
using mcplan::Plan;
using mcplan::Robot;
using mcplan::Scene;
using mcplan::Status;
using mcplan::Surface;

Scene ground_with_goal(const Vector3d& goal) {
  return scenes::made_of("ground", {scenes::rectangle("ground", -3, 3, -3, 3, 0)}, "ground", "ground", goal);
}

Scene two(double gap, double rise = 0.0) {
  return scenes::made_of(
      "two",
      {scenes::rectangle("before", -1, 0.5, -2, 2, 0), scenes::rectangle("after", 0.5 + gap, 3 + gap, -2, 2, rise)},
      "before", "after", {1.0 + gap, 0, rise});
}

Robot running(double max_com_speed) {
  Robot robot = scenes::humanoid44();
  robot.max_com_speed = max_com_speed;
  return robot;
}

/// A square of side 2 about a point, with this normal.
Surface tilted(const std::string& name, const Vector3d& center, const Vector3d& normal, double friction) {
  Surface surface;
  surface.name = name;
  surface.friction = friction;
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal).toRotationMatrix();
  for (const Vector3d& v : {Vector3d(-1, -1, 0), Vector3d(1, -1, 0), Vector3d(1, 1, 0), Vector3d(-1, 1, 0)})
    surface.vertices_W.push_back(center + turn * v);
  return surface;
}

/// An endless slope through the origin, up in x.
Scene slope(double angle, double friction, double way = 1.0) {
  const Vector3d normal(-std::sin(angle), 0.0, std::cos(angle));
  Scene scene = scenes::made_of("slope", {tilted("slope", Vector3d::Zero(), normal, friction)}, "slope", "slope",
                                {way * std::cos(angle), 0.0, way * std::sin(angle)});
  for (Vector3d& v : scene.surfaces[0].vertices_W) v *= 3.0;
  return scene;
}

/// Robot and scene made so tight about a plan that it only just satisfies the checker: reach boxes, force caps and
/// speed of what it uses, friction likewise, surfaces a millimetre larger than its footholds.
void tighten(const Plan& plan, Scene& scene, Robot& robot) {
  const std::size_t ends = robot.end_effectors.size();
  std::vector<Eigen::AlignedBox3d> boxes(ends);
  std::vector<double> forces(ends, 1.0), friction(scene.surfaces.size(), 0.01);
  std::vector<std::vector<Vector3d>> footholds(scene.surfaces.size());
  double speed = 0.1;
  for (std::size_t k = 0; k < plan.phases.size(); ++k)
    for (int i = 0; i <= 200; ++i) {
      const mcplan::PlanState at = plan.at_phase(static_cast<int>(k), plan.phases[k].duration * i / 200.0);
      speed = std::max(speed, at.com_velocity_W.norm());
      const Eigen::Matrix3d to_base = mcplan::rotation_from_rpy(at.base_rpy).transpose();
      for (std::size_t l = 0; l < ends; ++l) {
        const auto& end = at.end_effectors[l];
        boxes[l].extend(Vector3d(to_base * (end.position_W - at.com_W)));
        forces[l] = std::max(forces[l], end.force_W.norm());
        if (end.surface < 0) continue;
        footholds[end.surface].push_back(end.position_W);
        const Vector3d n = mcplan::Polygon(scene.surfaces[end.surface].vertices_W).normal_W();
        const double normal = n.dot(end.force_W);
        if (normal > 1.0)
          friction[end.surface] = std::max(friction[end.surface], (end.force_W - normal * n).norm() / normal);
      }
    }
  robot.max_com_speed = speed;
  for (std::size_t l = 0; l < ends; ++l) {
    boxes[l].extend(robot.end_effectors[l].nominal_B);
    robot.end_effectors[l].reach_min_B = boxes[l].min() - Vector3d::Constant(1e-4);
    robot.end_effectors[l].reach_max_B = boxes[l].max() + Vector3d::Constant(1e-4);
    robot.end_effectors[l].max_force = forces[l];
  }
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    Surface& surface = scene.surfaces[i];
    if (!surface.grasp) surface.friction = friction[i];
    if (footholds[i].empty()) continue;
    // The rectangle about the footholds, in the axes of the surface.
    const Vector3d x = (surface.vertices_W[1] - surface.vertices_W[0]).normalized();
    const Vector3d n = mcplan::Polygon(surface.vertices_W).normal_W(), y = n.cross(x), o = surface.vertices_W[0];
    Eigen::AlignedBox2d box;
    for (const Vector3d& p : footholds[i]) box.extend(Eigen::Vector2d((p - o).dot(x), (p - o).dot(y)));
    const Eigen::Vector2d a = box.min().array() - 1e-3, b = box.max().array() + 1e-3;
    surface.vertices_W = {o + a[0] * x + a[1] * y, o + b[0] * x + a[1] * y, o + b[0] * x + b[1] * y,
                          o + a[0] * x + b[1] * y};
  }
}

Scene random_scene(Random& random, int kind) {
  const double gap = uniform(random, 0.2, 1.2), rise = uniform(random, -0.1, 0.1);
  if (kind == 0) return scenes::flat(uniform(random, 0.5, 2.0));
  if (kind == 1) return two(gap, rise);
  Scene scene = slope(uniform(random, -0.35, 0.35), uniform(random, 0.5, 0.9), uniform(random, 0.6, 1.2));
  scene.surfaces[0].end_effectors = {"foot"};
  return scene;
}

}  // namespace

TEST_CASE("no scene of a plan that the checker accepts is called impossible, however tight it is made about the plan") {
  Random random(20);
  int solved = 0, tight = 0;
  for (int i = 0; i < (kSlowBuild ? 3 : 18); ++i) {
    Scene scene = random_scene(random, i % 3);
    Robot robot = scenes::humanoid44();
    Options options;
    options.model = i % 2 == 0 ? Model::wrench : Model::lipm;
    const mcplan::PlanResult result = SwitchedDdp(scene, robot, options).solve();
    CAPTURE(i);
    if (result.report.status != Status::solved) continue;
    ++solved;
    CHECK_FALSE(why_impossible(scene, robot, false));
    tighten(result.plan, scene, robot);
    if (!mcplan::check(result.plan, scene, robot).ok()) continue;
    ++tight;
    const auto found = why_impossible(scene, robot, false);
    CHECK_MESSAGE(!found, (found ? found->message : ""));
  }
  MESSAGE("solved: ", solved, ", accepted when made tight: ", tight);
  CHECK(solved >= (kSlowBuild ? 1 : 12));
  CHECK(tight >= (kSlowBuild ? 1 : 8));
}

TEST_CASE("none of the paper's scenes is impossible, without a speed limit or with one") {
  for (const Scene& scene : scenes::all_four())
    for (double speed : {std::numeric_limits<double>::infinity(), 5.0})
      CHECK_FALSE(why_impossible(scene, running(speed), false));
}

TEST_CASE("a goal above its ground is out of reach from where the legs, and all that the checker allows, end") {
  // CoM 0.70 m above the goal, feet down to 0.75 m below it: a rise of 0.05 m, reach, foothold and CoM within 1 mm,
  // sqrt(2) mm and 10 mm, angles within 3 x 0.01 + 1 degree about legs of |(0.30, 0.15, 0.75)| and sqrt(3) mm.
  const double leg = std::sqrt(0.3 * 0.3 + 0.15 * 0.15 + 0.75 * 0.75) + std::sqrt(3.0) * 1e-3;
  const double rise = 0.05 + 1e-3 + std::sqrt(2.0) * 1e-3 + 0.01 + (0.03 + M_PI / 180.0) * leg;
  CHECK_FALSE(stance_out_of_reach(ground_with_goal({1.0, 0.0, rise - 1e-6}), scenes::humanoid44(), true));
  const auto found = stance_out_of_reach(ground_with_goal({1.0, 0.0, rise + 1e-6}), scenes::humanoid44(), true);
  REQUIRE(found);
  CHECK(found->violation.name == "reach");
  CHECK(found->violation.end_effector == "right_foot");
  CHECK(found->violation.surface == "ground");
  CHECK(found->violation.value == doctest::Approx(rise - 0.05));
  CHECK(found->violation.tolerance == doctest::Approx(rise - 0.05));
}

TEST_CASE("a start has its footholds, not any point of its surface") {
  Scene scene = ground_with_goal({1.0, 0.0, 0.0});
  scene.start.position_W.z() = 0.16;
  const auto found = why_impossible(scene, scenes::humanoid44(), false);
  REQUIRE(found);
  CHECK(found->message.rfind("start: right_foot would stand on \"ground\", 0.11 m out of its reach", 0) == 0);
  // A measured start is where it is.
  CHECK_FALSE(why_impossible(scene, scenes::humanoid44(), true));
}

TEST_CASE("a slope is too steep beyond the angle of friction, and what the checker allows is too little to matter") {
  for (double friction : {0.05, 0.3, 0.8}) {
    const double angle = std::atan(friction + 1e-3);
    CHECK_FALSE(slips_everywhere(slope(angle - 1e-6, friction), scenes::humanoid44()));
    // 0.01 rad beyond, two hundredths of a metre a second would last for 0.2 s.
    CHECK_FALSE(slips_everywhere(slope(angle + 1e-4, friction), scenes::humanoid44()));
    const auto found = slips_everywhere(slope(angle + 0.05, friction), scenes::humanoid44());
    REQUIRE(found);
    CHECK(found->violation.name == "friction");
  }
  const auto found = slips_everywhere(slope(M_PI / 6.0, 0.05), scenes::humanoid44());
  REQUIRE(found);
  CHECK(found->message == "friction 0.05 of \"slope\" cannot hold on a slope of 30 degrees, which takes 0.577");
  // A stance that is its own goal is there at once.
  CHECK_FALSE(slips_everywhere(slope(M_PI / 6.0, 0.05, 0.0), scenes::humanoid44()));
  Scene held = slope(M_PI / 6.0, 0.05);
  held.surfaces[0].grasp = true;
  CHECK_FALSE(slips_everywhere(held, scenes::humanoid44()));
  // What nobody may touch holds nobody up, what a hand may does.
  Scene rail = slope(M_PI / 6.0, 0.05);
  rail.surfaces.push_back(scenes::rectangle("rail", 0, 1, 0, 1, 1, "tail"));
  CHECK(slips_everywhere(rail, scenes::humanoid44()));
  rail.surfaces.back().end_effectors = {"hand"};
  CHECK_FALSE(slips_everywhere(rail, scenes::humanoid44()));
}

TEST_CASE("several surfaces hold the robot up together or not, as forces drawn from their cones say") {
  Random random(7);
  int claimed = 0, held = 0;
  for (int i = 0; i < 200; ++i) {
    Scene scene = slope(0.0, 0.5);
    scene.surfaces.clear();
    const int count = 1 + i % 3;
    for (int s = 0; s < count; ++s) {
      const double around = uniform(random, -M_PI, M_PI), steep = uniform(random, 0.6, 2.0);
      const Vector3d normal(std::sin(steep) * std::cos(around), std::sin(steep) * std::sin(around), std::cos(steep));
      scene.surfaces.push_back(
          tilted("slope_" + std::to_string(s), {3.0 * s, 0, 0}, normal, uniform(random, 0.05, 0.6)));
    }
    scene.start.contacts = scene.goal.contacts = {{"foot", "slope_0"}};
    const bool slips = slips_everywhere(scene, scenes::humanoid44()).has_value();
    claimed += slips;
    std::vector<Vector3d> forces;
    for (const Surface& surface : scene.surfaces) {
      const mcplan::Polygon polygon(surface.vertices_W);
      for (int j = 0; j < 48; ++j) {
        const double angle = 2.0 * M_PI * j / 48;
        forces.push_back((polygon.normal_W() + surface.friction * (std::cos(angle) * polygon.tangent_W(0) +
                                                                   std::sin(angle) * polygon.tangent_W(1)))
                             .normalized());
      }
    }
    // A direction that is opposed to all of them and points up, among directions all over the sphere, 0.06 rad apart.
    double highest = -1.0, nearly = -1.0;
    constexpr int kDirections = 4000;
    for (int j = 0; j < kDirections; ++j) {
      const double z = 1.0 - (2.0 * j + 1.0) / kDirections, around = 2.399963229728653 * j;
      const Vector3d d(std::sqrt(1.0 - z * z) * std::cos(around), std::sqrt(1.0 - z * z) * std::sin(around), z);
      double most = -1.0;
      for (std::size_t f = 0; f < forces.size() && most <= 0.06; ++f) most = std::max(most, d.dot(forces[f]));
      if (most <= 0.0) highest = std::max(highest, z);
      if (most <= 0.06) nearly = std::max(nearly, z);
    }
    CAPTURE(i);
    if (highest > 0.05) CHECK(slips);
    if (slips) CHECK(nearly > -0.06);
    held += !slips;
  }
  MESSAGE("claimed: ", claimed, ", not: ", held);
  CHECK(claimed > 20);
  CHECK(held > 20);
}

TEST_CASE("the way of a flight and its rise are at most v^2 / g together, and can be as much") {
  Random random(8);
  double closest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d v0 = Vector3d(uniform(random, 0, 5), 0, uniform(random, -5, 5)), g(0, 0, -9.8);
    const double t = uniform(random, 0.0, 1.5);
    const Vector3d v1 = v0 + g * t, way = v0 * t + 0.5 * g * t * t;
    const double speed = std::max(v0.norm(), v1.norm()), most = speed * speed / 9.8;
    CHECK(way.norm() + std::abs(way.z()) <= most * (1.0 + 1e-12));
    closest = std::max(closest, (way.norm() + std::abs(way.z())) / most);
  }
  CHECK(closest > 0.999);
}

TEST_CASE("a gap is too wide beyond two legs and the longest flight") {
  // Farthest corners of the boxes of feet, the speed with its tolerance, 1 mm for the defects of many knots; tolerances
  // of reach and footholds for both contacts.
  const double leg = std::sqrt(0.3 * 0.3 + 0.15 * 0.15 + 0.75 * 0.75), slack = 2e-3 * (std::sqrt(3.0) + std::sqrt(2.0));
  for (double speed : {1.0, 3.0, 5.0}) {
    const double flight = (speed + 0.01) * (speed + 0.01) / 9.8 + 1e-3, widest = 2.0 * leg + flight + slack;
    CHECK_FALSE(gap_too_wide(two(widest - 1e-6), running(speed)));
    const auto wide = gap_too_wide(two(widest + 1e-6), running(speed));
    REQUIRE(wide);
    CHECK(wide->violation.name == "contact_sequence");
    CHECK(wide->violation.value == doctest::Approx(1e-6).epsilon(1e-3));
    const double highest = 2.0 * leg + 0.5 * flight + slack;
    CHECK_FALSE(gap_too_wide(two(0.1, highest - 1e-6), running(speed)));
    CHECK(gap_too_wide(two(0.1, highest + 1e-6), running(speed)));
    // A stone in the middle, wherever it comes in the list.
    Scene stone = two(widest + 0.3);
    stone.surfaces.insert(stone.surfaces.begin(), scenes::rectangle("stone", 1.0, 1.2, 0, 0.2, 0.0));
    CHECK_FALSE(gap_too_wide(stone, running(speed)));
  }
  const auto found = gap_too_wide(two(5.0), running(5.0));
  REQUIRE(found);
  CHECK(found->message ==
        "the gap of 5 m between \"before\" and \"after\" is wider than any jump of humanoid44: at most 4.21 m, "
        "with the CoM at 5 m/s");
  CHECK_FALSE(gap_too_wide(two(500.0), scenes::humanoid44()));
}

TEST_CASE("where rules forbid flights a gap is no wider than a step") {
  const auto with_rule = [](double gap) {
    Scene scene = two(gap);
    scene.rules = {{{"foot"}, {"right_hand", "left_hand"}}};
    return scene;
  };
  const double step = std::sqrt(0.6 * 0.6 + 0.3 * 0.3 + 0.2 * 0.2) + 2e-3 * (std::sqrt(3.0) + std::sqrt(2.0));
  CHECK_FALSE(gap_too_wide(with_rule(step - 1e-6), scenes::humanoid44()));
  const auto found = gap_too_wide(with_rule(step + 1e-6), scenes::humanoid44());
  REQUIRE(found);
  CHECK(found->message.find("wider than any step of humanoid44") != std::string::npos);
  CHECK(found->message.find("rules forbid flights") != std::string::npos);
  // Hands reach farther, if there is something for them in between.
  Scene rail = with_rule(step + 0.3);
  rail.surfaces.push_back(scenes::rectangle("pad", 0.8, 1.0, -0.5, -0.25, 0.5, "right_hand"));
  CHECK_FALSE(gap_too_wide(rail, scenes::humanoid44()));
}

TEST_CASE("turned and moved, a gap is as wide as before") {
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    Scene scene = two(4.5);
    const Eigen::AngleAxisd turn(uniform(random, -M_PI, M_PI), Vector3d::UnitZ());
    const Vector3d by(uniform(random, -10, 10), uniform(random, -10, 10), uniform(random, -1, 1));
    for (Surface& surface : scene.surfaces)
      for (Vector3d& v : surface.vertices_W) v = turn * v + by;
    scene.start.position_W = by;
    scene.goal.position_W = turn * scene.goal.position_W + by;
    scene.start.yaw = scene.goal.yaw = turn.angle();
    const auto found = gap_too_wide(scene, running(5.0));
    REQUIRE(found);
    CHECK(found->violation.value == doctest::Approx(4.5 - 4.2116).epsilon(1e-2));
  }
}

TEST_CASE("an impossible scene is infeasible before the first iteration, and has no plan") {
  for (const Scene& scene : {two(5.0), slope(M_PI / 6.0, 0.05), ground_with_goal({1.0, 0.0, 0.2})}) {
    const mcplan::PlanResult result = SwitchedDdp(scene, running(5.0)).solve();
    CHECK(result.report.status == Status::infeasible);
    CHECK(result.report.iterations == 0);
    CHECK(result.plan.phases.empty());
    CHECK(result.plan.scene.surfaces.size() == scene.surfaces.size());
    CHECK(result.report.message == why_impossible(scene, running(5.0), false)->message);
  }
}

TEST_CASE("a start that is beyond reach is told before the search, with the foot and by how much") {
  // One foot 27 mm higher and one 27 mm lower than the robot's, whose legs have 10 mm either way.
  Robot robot = scenes::humanoid44();
  for (mcplan::EndEffector& end : robot.end_effectors) {
    if (end.kind != "foot") continue;
    end.reach_min_B.z() = end.nominal_B.z() - 0.01;
    end.reach_max_B.z() = end.nominal_B.z() + 0.01;
  }
  const double slope = std::tan(15.0 * M_PI / 180.0);
  Scene scene = ground_with_goal({1.0, 0.0, 0.0});
  for (Vector3d& vertex : scene.surfaces[0].vertices_W) vertex.z() = slope * vertex.y();
  const mcplan::PlanResult result = SwitchedDdp(scene, robot).solve();
  CHECK(result.report.status == Status::infeasible);
  CHECK(result.report.iterations == 0);
  CHECK(result.plan.phases.empty());
  CHECK(result.report.message.rfind("start: ", 0) == 0);
  CHECK(result.report.message.find("_foot would stand on \"ground\", ") != std::string::npos);
  CHECK(result.report.message.find(" mm beyond its reach from the CoM at [0, 0, 0.7]") != std::string::npos);
  // The nearest points of the ground are y cos^2 and y sin cos away from below the hips.
  const double fall = 0.1 * std::sin(15.0 * M_PI / 180.0) * std::cos(15.0 * M_PI / 180.0);
  CHECK(result.report.worst_violation.value == doctest::Approx(fall - 0.01).epsilon(1e-6));
  CHECK(result.report.worst_violation.surface == "ground");
  // What is no more than acceptable is searched, and what is within the tolerance is not named.
  CHECK(!start_beyond_reach(scene, robot, 1e3 * (fall - 0.0099)));
  CHECK(start_beyond_reach(scene, robot, 1.0));
  CHECK(!start_beyond_reach(ground_with_goal({1.0, 0.0, 0.0}), robot, 1.0));
}

TEST_CASE("a search that fails says of the scene what is certain: the flight that it takes") {
  CHECK(flight_needed(two(0.6), scenes::humanoid44()).empty());
  CHECK(flight_needed(two(2.5), scenes::humanoid44()) ==
        "no steps lead to the goal: it takes a flight over 2.5 m at least, as between \"before\" and \"after\"");
  Scene stone = two(2.5);
  stone.surfaces.push_back(scenes::rectangle("stone", 1.6, 1.8, 0, 0.2, 0.0));
  CHECK(flight_needed(stone, scenes::humanoid44()) ==
        "no steps lead to the goal: it takes a flight over 1.1 m at least, as between \"before\" and \"stone\"");
  Options options;
  options.max_iterations = 5;
  const mcplan::PlanResult result = SwitchedDdp(two(2.5), scenes::humanoid44(), options).solve();
  CHECK(result.report.status == Status::iteration_limit);
  CHECK(result.report.message.rfind("the best plan violates ", 0) == 0);
  CHECK(result.report.message.find("; no steps lead to the goal: it takes a flight over 2.5 m") != std::string::npos);
}
