#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mcplan/planar/robot.hpp"
#include "model/fields.hpp"
#include "model/findings.hpp"
#include "model/names.hpp"
#include "model/value.hpp"

namespace mcplan::model {

template <>
struct Fields<Capsule> {
  static constexpr const char* name = "Capsule";
  static constexpr const char* meaning =
      "Segment with a radius, in a body's frame: its looks, and what it collides with.";
  static constexpr auto all =
      std::make_tuple(field("from_B", &Capsule::from_B, "m", "One end of the segment.").in_files("from").required(),
                      field("to_B", &Capsule::to_B, "m", "The other end; the same: a disc.").in_files("to").required(),
                      field("radius", &Capsule::radius, "m", "Half of its thickness.").required().positive());
};

template <>
struct Fields<PlanarBody> {
  static constexpr const char* name = "PlanarBody";
  static constexpr const char* meaning =
      "A rigid body of a planar robot and the revolute joint that carries it. Its frame B has its origin at the joint, "
      "turned by offset + q against its parent's.";
  static constexpr auto all = std::make_tuple(
      field("name", &PlanarBody::name, "", "Unique name.").required().not_empty(),
      field("parent", &PlanarBody::parent, "", "Index of an earlier body; -1 for the base alone.").by_file_keys(),
      field("joint_P", &PlanarBody::joint_P, "m", "Position of the joint in the parent's frame.").in_files("joint"),
      field("offset", &PlanarBody::offset, "rad", "Angle against the parent at joint position 0."),
      field("mass", &PlanarBody::mass, "kg", "Mass.").required().positive(),
      field("com_B", &PlanarBody::com_B, "m", "Centre of mass.").in_files("com"),
      field("inertia", &PlanarBody::inertia, "kg m^2", "Moment of inertia about the centre of mass.")
          .required()
          .positive(),
      field("position_min", &PlanarBody::position_min, "rad", "Lower limit of the joint; left out: none.")
          .or_infinite(),
      field("position_max", &PlanarBody::position_max, "rad", "Upper limit of the joint; left out: none.")
          .or_infinite(),
      field("velocity_max", &PlanarBody::velocity_max, "rad/s", "Limit of the joint, both ways; left out: none.")
          .positive()
          .or_infinite(),
      field("torque_max", &PlanarBody::torque_max, "N m", "Limit of the joint, both ways; left out: none.")
          .positive()
          .or_infinite(),
      field("capsules", &PlanarBody::capsules, "", "Shape, for drawing and self-collision; assign a list to change it.")
          .entries(0, 100));
};

struct PlanarBodyKeys {
  std::optional<std::string> parent;
};

template <>
struct Fields<PlanarBodyKeys> {
  static constexpr auto all = std::make_tuple(
      field("parent", &PlanarBodyKeys::parent, "", "Name of a body above; left out for the first one, the base, alone.")
          .not_empty());
};

template <>
struct FileKeys<PlanarBody> {
  using Type = PlanarBodyKeys;
};

template <>
struct Fields<PlanarEndEffector> {
  static constexpr const char* name = "PlanarEndEffector";
  static constexpr const char* meaning =
      "A contact frame of a body: x axis in the sole, y axis from the ground into the robot. Forces act at points of "
      "the sole.";
  static constexpr auto all = std::make_tuple(
      field("name", &PlanarEndEffector::name, "", "Unique name.").required().not_empty(),
      field("body", &PlanarEndEffector::body, "", "Body that carries it.").required().index_of("bodies", "a body"),
      field("position_B", &PlanarEndEffector::position_B, "m", "Origin of the frame, in the body's frame.")
          .in_files("position"),
      field("angle_B", &PlanarEndEffector::angle_B, "rad", "Of the frame's x axis in the body's frame.")
          .in_files("angle"),
      field("points", &PlanarEndEffector::points, "m", "Where forces act, along the x axis.")
          .required()
          .entries(1, 100));
};

template <>
struct Fields<PlanarRobot> {
  static constexpr const char* name = "PlanarRobot";
  static constexpr const char* meaning =
      "A tree of rigid bodies in a vertical plane (x forward, y up) on a free base. Joint j moves body j + 1. SI "
      "units.";
  static constexpr auto all = std::make_tuple(
      field("name", &PlanarRobot::name, "", "Name; of a file that says none, the file's.").always_written(),
      field("description", &PlanarRobot::description, "", "One line."),
      field("gravity", &PlanarRobot::gravity, "m/s^2", "Acceleration along -y.").positive().always_written(),
      field("bodies", &PlanarRobot::bodies, "",
            "The base first, each one after its parent; assign a list to change it.")
          .required()
          .entries(1, 100)
          .by_file_keys(),
      field("end_effectors", &PlanarRobot::end_effectors, "", "End-effectors; assign a list to add or remove.")
          .required()
          .entries(1, 100),
      field("collision_pairs", &PlanarRobot::collision_pairs, "", "Pairs of bodies whose capsules may not touch.")
          .entries(0, 10'000)
          .index_of("bodies", "a body"));
};

struct PlanarRobotKeys {
  std::vector<InFile<PlanarBody>> bodies;
};

template <>
struct Fields<PlanarRobotKeys> {
  static constexpr auto all =
      std::make_tuple(field("bodies", &PlanarRobotKeys::bodies, "", "The base first, each one after its parent.")
                          .required()
                          .entries(1, 100));
};

template <>
struct FileKeys<PlanarRobot> {
  using Type = PlanarRobotKeys;
};

/// What is wrong with a planar robot beyond the ranges of its fields; fields with findings are left out.
void relations(const PlanarRobot& robot, Findings& found);

/// The planar robot of the plain data of a file. Throws InvalidRobot with all that is wrong.
PlanarRobot planar_robot_from(const Value& data, const std::string& source = "");

/// The planar robot of the content of a file. Throws InvalidRobot.
PlanarRobot planar_robot_in(const std::string& content, const std::filesystem::path& file);

/// The plain data of a file.
Value planar_robot_data(const PlanarRobot& robot);

}  // namespace mcplan::model
