#include "mcplan/robot/robot.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "mcplan/base/error.hpp"

namespace {

using Eigen::Vector3d;
using mcplan::Robot;
using mcplan::Scene;
using mcplan::Stance;

Robot hopper() {
  Robot robot;
  robot.name = "hopper";
  robot.mass = 10.0;
  robot.com_height = 0.5;
  mcplan::EndEffector foot;
  foot.name = "left";
  foot.nominal_B = {0.1, 0.2, -0.5};
  foot.reach_min_B = {-0.3, -0.3, -0.7};
  foot.reach_max_B = {0.3, 0.3, -0.3};
  robot.end_effectors.push_back(foot);
  foot.name = "right";
  foot.nominal_B.y() = -0.2;
  robot.end_effectors.push_back(foot);
  return robot;
}

Scene floor_and_wall() {
  Scene scene;
  scene.surfaces.resize(2);
  scene.surfaces[0].name = "floor";
  scene.surfaces[0].vertices_W = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  scene.surfaces[1].name = "wall";
  scene.surfaces[1].vertices_W = {{1, -1, 0}, {1, -1, 2}, {1, 1, 2}, {1, 1, 0}};
  scene.surfaces[1].end_effectors = {"right"};
  return scene;
}

std::string field(const std::function<void(Robot&)>& mutate) {
  Robot robot = hopper();
  mutate(robot);
  try {
    robot.validate();
  } catch (const mcplan::InvalidRobot& error) {
    return error.field();
  }
  return "accepted";
}

std::string stance_field(const Stance& stance) {
  try {
    mcplan::resolve_stance(floor_and_wall(), hopper(), stance, "goal");
  } catch (const mcplan::InvalidScene& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a valid robot is accepted, without a force cap too") {
  CHECK(field([](Robot&) {}) == "accepted");
  CHECK(std::isinf(hopper().end_effectors[0].max_force));
  CHECK(hopper().end_effectors[0].yaw_range == Eigen::Vector2d(-INFINITY, INFINITY));
}

TEST_CASE("numbers of robots out of range are named") {
  const auto all_bad = [](const std::string& name, const std::function<void(Robot&, double)>& set) {
    for (double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
      CAPTURE(bad);
      CHECK(field([&](Robot& r) { set(r, bad); }) == name);
    }
  };
  all_bad("mass", [](Robot& r, double bad) { r.mass = bad; });
  all_bad("inertia[1]", [](Robot& r, double bad) { r.inertia.y() = bad; });
  all_bad("com_height", [](Robot& r, double bad) { r.com_height = bad; });
  all_bad("swing_height", [](Robot& r, double bad) { r.swing_height = bad; });
}

TEST_CASE("phase durations and what of a sole is supported are held to their ranges") {
  const double nan = std::nan("");
  const auto duration = [](double shortest, double longest) {
    return field([&](Robot& r) { r.phase_duration = {shortest, longest}; });
  };
  for (double bad : {0.0, -0.1, nan}) CHECK(duration(bad, 0.5) == "phase_duration[0]");
  for (double bad : {nan, double(INFINITY)}) CHECK(duration(0.2, bad) == "phase_duration[1]");
  CHECK(duration(0.5, 0.4) == "phase_duration");
  CHECK(field([](Robot& r) { r.phase_duration = {0.4, 0.4}; }) == "accepted");
  for (double share : {-0.01, 1.01, nan, double(INFINITY)}) {
    CAPTURE(share);
    CHECK(field([&](Robot& r) { r.sole_support = share; }) == "sole_support");
  }
  for (double share : {0.0, 1.0}) CHECK(field([&](Robot& r) { r.sole_support = share; }) == "accepted");
}

TEST_CASE("end-effectors out of range are named") {
  const auto end = [](const std::function<void(mcplan::EndEffector&)>& mutate) {
    return field([&](Robot& r) { mutate(r.end_effectors[1]); });
  };
  const double nan = std::nan("");
  CHECK(end([](auto& e) { e.name = ""; }) == "end_effectors[1].name");
  CHECK(end([](auto& e) { e.name = "left"; }) == "end_effectors[1].name");
  CHECK(end([](auto& e) { e.kind = ""; }) == "end_effectors[1].kind");
  CHECK(end([](auto& e) { e.half_size.x() = -0.1; }) == "end_effectors[1].half_size[0]");
  CHECK(end([&](auto& e) { e.half_size.y() = nan; }) == "end_effectors[1].half_size[1]");
  CHECK(end([&](auto& e) { e.nominal_B.x() = nan; }) == "end_effectors[1].nominal[0]");
  CHECK(end([](auto& e) { e.nominal_B.z() = 0.0; }) == "end_effectors[1].nominal");
  CHECK(end([](auto& e) { e.reach_min_B.x() = -INFINITY; }) == "end_effectors[1].reach_min[0]");
  CHECK(end([](auto& e) { e.reach_max_B.z() = -0.7; }) == "end_effectors[1].reach_max");
  for (double bad : {0.0, -5.0, nan}) CHECK(end([&](auto& e) { e.max_force = bad; }) == "end_effectors[1].max_force");
  for (double bad : {-1.0, nan})
    for (int axis : {0, 1, 2})
      CHECK(end([&](auto& e) { e.max_moment[axis] = bad; }) ==
            "end_effectors[1].max_moment[" + std::to_string(axis) + "]");
}

TEST_CASE("parts of a trunk have a size and lie above the ground") {
  const auto with = [&](const mcplan::TrunkPart& part) {
    return field([&](Robot& r) { r.trunk = {{Vector3d(0, 0, 0), Vector3d(0, 0, 0.4), 0.1}, part}; });
  };
  CHECK(with({Vector3d(0, 0, -0.3), Vector3d(0, 0, 0.4), 0.1}) == "accepted");
  CHECK(with({Vector3d(0, 0, 0.4), Vector3d(0, 0, 0.4), 0.1}) == "accepted");  // a ball
  CHECK(with({Vector3d(0, 0, -0.3), Vector3d(0, 0, 0.4), 0.0}) == "trunk[1].radius");
  CHECK(with({Vector3d(0, 0, -0.3), Vector3d(0, 0, 0.4), -0.1}) == "trunk[1].radius");
  CHECK(with({Vector3d(0, 0, -0.3), Vector3d(0, 0, std::nan("")), 0.1}) == "trunk[1].to[2]");
  CHECK(with({Vector3d(0, 0, 0.4), Vector3d(0, 0, -0.4), 0.1}) == "trunk[1]");
  CHECK(with({Vector3d(0, 0, 0.4), Vector3d(0, 0, 6.0), 0.1}) == "trunk[1]");  // farther than ten heights of the CoM
  CHECK(with({Vector3d(0, 0, 0.4), Vector3d(1e308, 0, 0.4), 0.1}) == "trunk[1]");
}

TEST_CASE("a sole may be turned both ways, or any way") {
  const auto turned = [](double right, double left) {
    return field([&](Robot& r) { r.end_effectors[1].yaw_range = {right, left}; });
  };
  const double inf = INFINITY, nan = std::nan("");
  const std::pair<double, double> good[] = {{-0.3, 0.5}, {0.0, 0.5}, {-0.3, 0.0}, {0.0, 0.0}, {-inf, inf}};
  for (const auto& [right, left] : good) CHECK(turned(right, left) == "accepted");
  const std::string whole = "end_effectors[1].yaw_range";
  const std::pair<double, double> bad[] = {{0.1, 0.5}, {-0.3, -0.1}, {0.5, -0.3}};
  for (const auto& [right, left] : bad) CHECK(turned(right, left) == whole);
  for (double right : {nan, inf, -inf}) CHECK(turned(right, 0.5) == whole + "[0]");
  for (double left : {nan, inf}) CHECK(turned(-0.3, left) == whole + "[1]");
}

TEST_CASE("the usual reach holds the nominal place, and cuts the box where it is narrower") {
  const auto usual = [](double back, double ahead) {
    return field([&](Robot& r) { r.end_effectors[1].usual_reach = {back, ahead}; });
  };
  Robot robot = hopper();
  mcplan::EndEffector& end = robot.end_effectors[1];
  const double x = end.nominal_B.x(), inf = INFINITY;
  CHECK(usual(-inf, inf) == "accepted");
  CHECK(usual(x - 0.1, x + 0.1) == "accepted");
  CHECK(usual(x - 100.0, x + 0.1) == "accepted");  // no more than the box
  const std::string whole = "end_effectors[1].usual_reach";
  for (const auto& [back, ahead] : {std::pair(x, x + 0.1), std::pair(x - 0.1, x), std::pair(x + 0.1, x - 0.1)})
    CHECK(usual(back, ahead) == whole);
  CHECK(usual(std::nan(""), x + 0.1) == whole + "[0]");

  end.usual_reach = {x - 0.01, x + 100.0};
  CHECK(end.usual_box().min() == Vector3d(x - 0.01, end.reach_min_B.y(), end.reach_min_B.z()));
  CHECK(end.usual_box().max() == end.reach_max_B);
}

TEST_CASE("a robot has one to eight end-effectors") {
  CHECK(field([](Robot& r) { r.end_effectors.clear(); }) == "end_effectors");
  CHECK(field([](Robot& r) { r.end_effectors.assign(9, r.end_effectors[0]); }) == "end_effectors");
}

TEST_CASE("reach polytopes that cannot be meant are named") {
  const auto half_space = [](const Vector3d& normal, double offset) {
    mcplan::Polytope set;
    set.A = normal.transpose();
    set.b = Eigen::VectorXd::Constant(1, offset);
    return set;
  };
  const auto com = [&](const mcplan::Polytope& set) {
    return field([&](Robot& r) { r.end_effectors[0].com_reach = set; });
  };
  const auto partner = [&](const std::string& name, const mcplan::Polytope& set) {
    return field([&](Robot& r) { r.end_effectors[0].partner_reach[name] = set; });
  };
  const Vector3d up = Vector3d::UnitZ();
  CHECK(com(half_space(up, 0.5)) == "accepted");
  CHECK(com(half_space(up, 0.499)) == "end_effectors[0].com_reach");
  CHECK(com(half_space(1.0009 * up, 0.6)) == "accepted");
  CHECK(com(half_space(1.002 * up, 0.6)) == "end_effectors[0].com_reach.A[0]");
  CHECK(com(half_space(Vector3d(0, std::nan(""), 1), 0.6)) == "end_effectors[0].com_reach.A[0]");
  CHECK(com(half_space(up, std::nan(""))) == "end_effectors[0].com_reach.b[0]");
  CHECK(com(half_space(up, INFINITY)) == "end_effectors[0].com_reach.b[0]");
  mcplan::Polytope longer = half_space(up, 0.6);
  longer.b = Eigen::Vector2d(0.6, 0.6);
  CHECK(com(longer) == "end_effectors[0].com_reach.b");

  const Vector3d left = Vector3d::UnitY();  // the right foot stands 0.4 m to the right of the left one
  CHECK(partner("right", half_space(left, -0.4)) == "accepted");
  CHECK(partner("right", half_space(left, -0.41)) == "end_effectors[0].partner_reach.right");
  CHECK(partner("left", half_space(left, 0.1)) == "end_effectors[0].partner_reach.left");
  CHECK(partner("tail", half_space(left, 0.1)) == "end_effectors[0].partner_reach.tail");
}

TEST_CASE("faces that cut a reach box are few, hold the nominal place and stand beside no polytope") {
  const auto cut = [](int rows, const Vector3d& normal, double offset, bool com_reach = false) {
    return field([&](Robot& r) {
      mcplan::EndEffector& end = r.end_effectors[1];
      end.reach_cut.A = normal.transpose().replicate(rows, 1);
      end.reach_cut.b = Eigen::VectorXd::Constant(rows, offset);
      if (com_reach) end.com_reach = {normal.transpose(), Eigen::VectorXd::Constant(1, 9.0)};
    });
  };
  const Vector3d up = Vector3d::UnitZ();
  CHECK(cut(4, up, -0.4) == "accepted");
  CHECK(cut(5, up, -0.4) == "end_effectors[1].reach_cut.A");
  CHECK(cut(1, up, -0.51) == "end_effectors[1].reach_cut");
  CHECK(cut(1, 2.0 * up, -0.4) == "end_effectors[1].reach_cut.A[0]");
  CHECK(cut(1, up, std::nan("")) == "end_effectors[1].reach_cut.b[0]");
  CHECK(cut(1, up, -0.4, true) == "end_effectors[1].reach_cut");
}

TEST_CASE("end-effectors are addressed by name or kind") {
  const Robot robot = hopper();
  CHECK(robot.end_effector_index("right") == 1);
  CHECK(robot.end_effector_index("foot") == -1);
  CHECK(mcplan::addresses("foot", robot.end_effectors[0]));
  CHECK(mcplan::addresses("left", robot.end_effectors[0]));
  CHECK_FALSE(mcplan::addresses("right", robot.end_effectors[0]));
  const Scene scene = floor_and_wall();
  CHECK(mcplan::may_touch(scene.surfaces[0], robot.end_effectors[0]));
  CHECK_FALSE(mcplan::may_touch(scene.surfaces[1], robot.end_effectors[0]));
  CHECK(mcplan::may_touch(scene.surfaces[1], robot.end_effectors[1]));
}

TEST_CASE("a stance takes its heights from the robot and turns with the heading") {
  Stance stance;
  stance.position_W = {0.1, -0.2, 0.0};
  stance.yaw = M_PI / 2;
  stance.contacts = {{"foot", "floor"}};
  const auto resolved = mcplan::resolve_stance(floor_and_wall(), hopper(), stance, "start");
  CHECK(resolved.com_W.isApprox(Vector3d(0.1, -0.2, 0.5)));
  CHECK(resolved.yaw == stance.yaw);
  CHECK(resolved.contacts == std::vector<int>{0, 0});
  // A quarter turn takes (0.1, 0.2) to (-0.2, 0.1).
  CHECK(resolved.end_effectors_W[0].isApprox(Vector3d(-0.1, -0.1, 0.0), 1e-12));
  CHECK(resolved.end_effectors_W[1].isApprox(Vector3d(0.3, -0.1, 0.0), 1e-12));
}

TEST_CASE("in a stance a name beats its kind, and who is not named is free at its nominal place") {
  Stance stance;
  stance.contacts = {{"foot", "floor"}, {"right", "wall"}};
  const auto resolved = mcplan::resolve_stance(floor_and_wall(), hopper(), stance, "start");
  CHECK(resolved.contacts == std::vector<int>{0, 1});
  CHECK(resolved.end_effectors_W[1].x() == doctest::Approx(1.0));
  stance.contacts = {{"left", "floor"}};
  stance.position_W.z() = 0.3;
  const auto one = mcplan::resolve_stance(floor_and_wall(), hopper(), stance, "start");
  CHECK(one.contacts == std::vector<int>{0, -1});
  CHECK(one.end_effectors_W[1].isApprox(Vector3d(0.1, -0.2, 0.3), 1e-12));
  CHECK(one.end_effectors_W[0].z() == doctest::Approx(0.0));
}

TEST_CASE("on ground that falls off sideways a stance is lowered until its lower foot reaches down, and no more") {
  mcplan::Robot robot = hopper();
  for (mcplan::EndEffector& end : robot.end_effectors) {
    end.nominal_B = {0.0, end.nominal_B.y() < 0.0 ? -0.2 : 0.2, -0.5};
    end.reach_min_B = {-0.3, end.nominal_B.y() - 0.1, -0.52};
    end.reach_max_B = {0.3, end.nominal_B.y() + 0.1, -0.3};
  }
  Stance stance;
  stance.contacts = {{"foot", "floor"}};
  const auto standing = [&](double slope, double height = 0.0) {
    mcplan::Scene scene = floor_and_wall();
    for (Vector3d& vertex : scene.surfaces[0].vertices_W) vertex.z() = slope * vertex.y();
    stance.position_W.z() = height;
    return mcplan::resolve_stance(scene, robot, stance, "start");
  };
  CHECK(standing(0.0).com_W.z() == 0.5);
  CHECK(standing(0.05).com_W.z() == 0.5);  // lower by 1 cm: within reach
  const auto lowered = standing(0.2);      // by 4 cm, of which 2 are beyond it
  CHECK(lowered.com_W.z() < 0.48);
  CHECK(lowered.com_W.z() > 0.47);
  for (std::size_t l = 0; l < robot.end_effectors.size(); ++l) {
    const Vector3d place = lowered.end_effectors_W[l] - lowered.com_W;
    CHECK(place.z() > robot.end_effectors[l].reach_min_B.z());
    CHECK(place.z() < robot.end_effectors[l].reach_max_B.z());
    CHECK(lowered.end_effectors_W[l].z() == doctest::Approx(0.2 * lowered.end_effectors_W[l].y()));
  }
  // A stance above its ground is no matter of the ground's slope, and where no height will do nothing changes.
  CHECK(standing(0.0, 0.1).com_W.z() == 0.6);
  for (mcplan::EndEffector& end : robot.end_effectors) end.reach_max_B.z() = -0.48;
  CHECK(standing(0.2).com_W.z() == 0.5);
}

TEST_CASE("stances that the robot cannot take are named") {
  Stance stance;
  stance.contacts = {{"tail", "floor"}};
  CHECK(stance_field(stance) == "goal.contacts");
  stance.contacts = {{"left", "ceiling"}};
  CHECK(stance_field(stance) == "goal.contacts.left");
  stance.contacts = {{"foot", "wall"}};
  CHECK(stance_field(stance) == "goal.contacts.left");
}

TEST_CASE("limits of a limb are refused where the nominal stance does not bend its knee") {
  const auto with = [](const std::function<void(mcplan::EndEffector&)>& set) {
    Robot robot = hopper();
    mcplan::EndEffector& foot = robot.end_effectors[0];
    foot.limb.hip_B = {0.1, 0.2, -0.1};
    foot.limb.upper = foot.limb.lower = 0.25;
    set(foot);
    robot.validate();
  };
  CHECK_NOTHROW(with([](auto&) {}));
  const auto message = [&](const std::function<void(mcplan::EndEffector&)>& set) -> std::string {
    try {
      with(set);
    } catch (const mcplan::InvalidRobot& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message([](auto& foot) { foot.limb.upper = 0.1; }).find("end_effectors[0].limb: must be a leg that is bent") !=
        std::string::npos);
  CHECK(message([](auto& foot) { foot.limb.margin = 0.2; }).find("end_effectors[0].limb: must be a leg that is bent") !=
        std::string::npos);
  CHECK(message([](auto& foot) { foot.limb.lower = 0.0; }).find("end_effectors[0].limb.lower") != std::string::npos);
  CHECK(message([](auto& foot) { foot.limb.knee_torque = -1.0; }).find("end_effectors[0].limb.knee_torque") !=
        std::string::npos);
  CHECK(message([](auto& foot) { foot.limb.ankle.z() = 0.05; }).find("end_effectors[0].limb.ankle: must be zero") !=
        std::string::npos);
}
