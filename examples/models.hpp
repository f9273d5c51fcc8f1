// The robot and the scene that the C++ examples share. The same numbers stand in python/mcplan/data, which only the
// Python package reads.

#pragma once

#include <array>
#include <mcplan/mcplan.hpp>
#include <string>

namespace examples {

/// Rectangle at height z [m] with sides along x and y.
inline mcplan::Surface rectangle(const std::string& name, double x_min, double x_max, double y_min, double y_max,
                                 double z) {
  mcplan::Surface surface;
  surface.name = name;
  surface.vertices_W = {{x_min, y_min, z}, {x_max, y_min, z}, {x_max, y_max, z}, {x_min, y_max, z}};
  return surface;
}

/// End-effector of humanoid44. `side` is -1 for the right one, +1 for the left one.
inline mcplan::EndEffector foot(const std::string& name, double side) {
  mcplan::EndEffector out;
  out.name = name;
  out.kind = "foot";
  out.half_size = {0.10, 0.05};
  out.nominal_B = {0.0, side * 0.10, -0.70};
  out.reach_min_B = {-0.20, side * 0.10 - 0.05, -0.75};
  out.reach_max_B = {0.20, side * 0.10 + 0.05, -0.55};
  out.max_force = 1750.0;
  out.max_moment = {0.0, 0.0, 1.0};
  return out;
}

inline mcplan::EndEffector hand(const std::string& name, double side) {
  mcplan::EndEffector out;
  out.name = name;
  out.kind = "hand";
  out.nominal_B = {0.0, side * 0.225, 0.0};
  out.reach_min_B = {-0.20, side * 0.275 - 0.15, -0.10};
  out.reach_max_B = {0.20, side * 0.275 + 0.15, 1.00};
  out.max_force = 1750.0;
  return out;
}

/// The humanoid of Tazaki's paper: 44 kg, CoM 0.70 m above the ground.
inline mcplan::Robot humanoid44() {
  mcplan::Robot robot;
  robot.name = "humanoid44";
  robot.mass = 44.0;
  robot.inertia = {5.0, 5.0, 5.0};
  robot.com_height = 0.70;
  robot.end_effectors = {foot("right_foot", -1), foot("left_foot", 1), hand("right_hand", -1), hand("left_hand", 1)};
  return robot;
}

/// A gap of 0.80 m to jump over.
inline mcplan::Scene gap() {
  mcplan::Scene scene;
  scene.name = "gap";
  scene.gravity = 9.8;
  scene.surfaces = {rectangle("before", -1.0, 0.5, -5.0, 5.0, 0.0), rectangle("after", 1.3, 5.0, -5.0, 5.0, 0.0)};
  for (mcplan::Surface& surface : scene.surfaces) surface.end_effectors = {"foot"};
  scene.start.contacts = {{"foot", "before"}};
  scene.goal.position_W = {2.0, 0.0, 0.0};
  scene.goal.contacts = {{"foot", "after"}};
  return scene;
}

/// A humanoid on two feet with the masses and soles of talos_wang; the reach is boxes, the polytopes stand in files.
inline mcplan::Robot walker() {
  mcplan::Robot robot;
  robot.name = "walker";
  robot.mass = 95.0;
  robot.inertia = {16.2, 13.5, 3.8};
  robot.com_height = 0.75;
  for (double side : {1.0, -1.0}) {
    mcplan::EndEffector foot;
    foot.name = side > 0.0 ? "left_foot" : "right_foot";
    foot.kind = "foot";
    foot.half_size = {0.11, 0.06};
    foot.nominal_B = {0.0, side * 0.10, -0.75};
    foot.reach_min_B = {-0.35, side * 0.20 - 0.20, -0.95};
    foot.reach_max_B = {0.35, side * 0.20 + 0.20, -0.50};
    foot.max_force = 1600.0;
    robot.end_effectors.push_back(foot);
  }
  return robot;
}

/// The first patches of the scene "rubbles": 0.6 m long, tilted ahead or sideways, the left foot swings first.
inline mcplan::Scene rubbles() {
  mcplan::Scene scene;
  scene.name = "rubbles";
  scene.gravity = 9.80665;
  // Heights of the corners (near right, far right, far left, near left) in units of 0.06 m.
  const auto patch = [](const std::string& name, double x, double y, const std::array<double, 4>& heights) {
    mcplan::Surface surface = rectangle(name, x, x + 0.6, y, y + 0.5, 0.0);
    for (std::size_t i = 0; i < 4; ++i) surface.vertices_W[i].z() = 0.06 * heights[i];
    return surface;
  };
  scene.surfaces = {rectangle("start", -1.0, 1.0, -0.5, 0.5, 0.0), patch("right_1", 1.0, -0.5, {1, 1, -1, -1}),
                    patch("left_1", 1.0, 0.0, {1, -1, -1, 1}),     patch("right_2", 1.6, -0.5, {-1, -1, 1, 1}),
                    patch("left_2", 1.6, 0.0, {-1, 1, 1, -1}),     rectangle("end", 2.2, 50.0, -0.5, 0.5, 0.0)};
  for (mcplan::Surface& surface : scene.surfaces) surface.friction = 0.3;
  scene.start.position_W = {0.6, 0.0, 0.0};
  scene.start.contacts = {{"foot", "start"}};
  scene.goal.position_W = {20.0, 0.0, 0.0};
  scene.goal.contacts = {{"foot", "end"}};
  scene.steps = {{"left_foot", "start"},    {"right_foot", "right_1"}, {"left_foot", "left_1"},
                 {"right_foot", "right_2"}, {"left_foot", "left_2"},   {"right_foot", "end"}};
  return scene;
}

}  // namespace examples
