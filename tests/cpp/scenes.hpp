#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

/// The paper's robot and its four scenes, in code: tests of the C++ library read no files.
namespace scenes {

using Eigen::Vector3d;

inline mcplan::Robot humanoid44() {
  mcplan::Robot robot;
  robot.name = "humanoid44";
  robot.mass = 44.0;
  robot.inertia = {5.0, 5.0, 5.0};
  robot.com_height = 0.70;
  robot.swing_height = 0.10;
  const auto add = [&](const std::string& kind, double side, double y, double z, double y_near, double y_far,
                       double z_low, double z_high, double half_x) {
    mcplan::EndEffector end;
    end.name = (side < 0 ? "right_" : "left_") + kind;
    end.kind = kind;
    end.nominal_B = {0.0, side * y, z};
    end.reach_min_B = {-half_x, side < 0 ? -y_far : y_near, z_low};
    end.reach_max_B = {half_x, side < 0 ? -y_near : y_far, z_high};
    end.max_force = 1750.0;
    if (kind == "foot") {
      end.half_size = {0.10, 0.05};
      end.max_moment = {0.0, 0.0, 1.0};
    }
    robot.end_effectors.push_back(end);
  };
  for (double side : {-1.0, 1.0}) add("foot", side, 0.10, -0.70, 0.05, 0.15, -0.75, -0.55, 0.30);
  for (double side : {-1.0, 1.0}) add("hand", side, 0.225, 0.0, 0.125, 0.425, -0.15, 1.00, 0.20);
  return robot;
}

/// The same with a face that lets its feet come up less behind the body than ahead, and one that slants sideways.
inline mcplan::Robot humanoid44_cut() {
  mcplan::Robot robot = humanoid44();
  for (int l : {0, 1}) {
    mcplan::EndEffector& foot = robot.end_effectors[l];
    foot.reach_cut.A.resize(2, 3);
    foot.reach_cut.A << Eigen::RowVector3d(-0.4, 0.0, 1.0).normalized(), Eigen::RowVector3d(0.7, 0.2, 0.3).normalized();
    foot.reach_cut.b = foot.reach_cut.A * foot.nominal_B + Eigen::Vector2d(0.08, 0.1);
  }
  return robot;
}

inline mcplan::Surface rectangle(const std::string& name, double x0, double x1, double y0, double y1, double z,
                                 const std::string& who = "foot") {
  mcplan::Surface surface;
  surface.name = name;
  surface.vertices_W = {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
  surface.end_effectors = {who};
  return surface;
}

inline mcplan::Scene made_of(const std::string& name, std::vector<mcplan::Surface> surfaces, const std::string& from,
                             const std::string& to, const Vector3d& goal) {
  mcplan::Scene scene;
  scene.name = name;
  scene.gravity = 9.8;
  scene.surfaces = std::move(surfaces);
  scene.start.contacts = {{"foot", from}};
  scene.goal.contacts = {{"foot", to}};
  scene.goal.position_W = goal;
  return scene;
}

inline mcplan::Scene flat(double goal_x = 2.0) {
  return made_of("flat", {rectangle("ground", -1, 5, -5, 5, 0)}, "ground", "ground", {goal_x, 0, 0});
}

inline mcplan::Scene stairs() {
  return made_of("stairs",
                 {rectangle("ground", -1, 0.15, -0.5, 0.5, 0), rectangle("tread_1", 0.40, 0.65, -0.5, 0.5, 0.1),
                  rectangle("tread_2", 0.90, 1.15, -0.5, 0.5, 0.2), rectangle("tread_3", 1.40, 2.0, -0.5, 0.5, 0.3)},
                 "ground", "tread_3", {1.6, 0, 0.3});
}

inline mcplan::Scene gap() {
  return made_of("gap", {rectangle("before", -1, 0.5, -5, 5, 0), rectangle("after", 1.3, 5, -5, 5, 0)}, "before",
                 "after", {2, 0, 0});
}

inline mcplan::Scene gap_with_rail() {
  mcplan::Scene scene = gap();
  scene.name = "gap_with_rail";
  scene.surfaces.push_back(rectangle("right_pad", 0.85, 0.95, -0.50, -0.25, 0.5, "right_hand"));
  scene.surfaces.push_back(rectangle("left_pad", 0.85, 0.95, 0.25, 0.50, 0.5, "left_hand"));
  for (int i : {2, 3}) scene.surfaces[i].grasp = true;
  scene.rules = {{{"foot"}, {"right_hand", "left_hand"}}};
  return scene;
}

inline std::vector<mcplan::Scene> all_four() { return {flat(), stairs(), gap(), gap_with_rail()}; }

}  // namespace scenes
