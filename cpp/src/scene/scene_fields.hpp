#pragma once

#include <string>

#include "mcplan/scene/scene.hpp"
#include "model/fields.hpp"
#include "model/findings.hpp"
#include "model/value.hpp"

namespace mcplan::model {

template <>
struct Fields<Surface> {
  static constexpr const char* name = "Surface";
  static constexpr const char* meaning = "A flat patch of the world that end-effectors may touch.";
  static constexpr auto all = std::make_tuple(
      field("name", &Surface::name, "", "Unique name.").required().not_empty(),
      field("vertices_W", &Surface::vertices_W, "m",
            "Corners of a convex polygon, world frame, counter-clockwise about the outward normal.")
          .in_files("vertices")
          .required()
          .entries(3, 1000),
      field("friction", &Surface::friction, "-", "Coulomb coefficient.").positive(),
      field("grasp", &Surface::grasp, "", "May be held: no friction cone, only the end-effector's force cap."),
      field("thickness", &Surface::thickness, "m", "Solid below the surface that swings must clear.").positive(),
      field("end_effectors", &Surface::end_effectors, "", "Names or kinds of those that may touch it; empty: all.")
          .not_empty()
          .entries(0, 1000));
};

template <>
struct Fields<Stance> {
  static constexpr const char* name = "Stance";
  static constexpr const char* meaning = "Where the robot is at the start or the goal. Heights come from the robot.";
  static constexpr auto all =
      std::make_tuple(field("position_W", &Stance::position_W, "m", "Point of the ground below the CoM, world frame.")
                          .in_files("position")
                          .required(),
                      field("yaw", &Stance::yaw, "rad", "Heading."),
                      field("contacts", &Stance::contacts, "",
                            "End-effector or kind -> surface; a name beats its kind. Assign a dict to change it.")
                          .required()
                          .not_empty());
};

template <>
struct Fields<ContactRule> {
  static constexpr const char* name = "ContactRule";
  static constexpr const char* meaning = "If none of `when_free` is in contact, all of `require` must be.";
  static constexpr auto all =
      std::make_tuple(field("when_free", &ContactRule::when_free, "", "Names or kinds of end-effectors.")
                          .required()
                          .not_empty()
                          .entries(1, 1000),
                      field("require", &ContactRule::require, "", "Names or kinds of end-effectors.")
                          .required()
                          .not_empty()
                          .entries(1, 1000));
};

template <>
struct Fields<Step> {
  static constexpr const char* name = "Step";
  static constexpr const char* meaning = "One step of a walk: the foot that swings and the surface on which it lands.";
  static constexpr auto all = std::make_tuple(
      field("end_effector", &Step::end_effector, "", "Name of the end-effector that swings.").required().not_empty(),
      field("surface", &Step::surface, "", "Name of the surface on which it lands.").required().not_empty());
};

template <>
struct Fields<Scene> {
  static constexpr const char* name = "Scene";
  static constexpr const char* meaning = "The world: surfaces, start and goal. World frame W with z up, SI units.";
  static constexpr auto all = std::make_tuple(
      field("name", &Scene::name, "", "Name; of a file that says none, the file's.").always_written(),
      field("description", &Scene::description, "", "One line."),
      field("gravity", &Scene::gravity, "m/s^2", "Acceleration, downwards.").positive().always_written(),
      field("surfaces", &Scene::surfaces, "", "Surfaces; assign a list to add or remove.")
          .required()
          .entries(1, 10'000),
      field("start", &Scene::start, "", "Stance at the start.").required(),
      field("goal", &Scene::goal, "", "Stance at the goal.").required(),
      field("rules", &Scene::rules, "", "Rules of contacts; assign a list to add or remove.").entries(0, 1000),
      field("steps", &Scene::steps, "",
            "Contact sequence of a walk, for planners that want it given; assign a list to change it.")
          .entries(0, 10'000));
};

/// What is wrong with a scene beyond the ranges of its fields; fields with findings are left out.
void relations(const Scene& scene, Findings& found);

/// The scene of the plain data of a file. Throws InvalidScene with all that is wrong.
Scene scene_from(const Value& data, const std::string& source = "");

}  // namespace mcplan::model
