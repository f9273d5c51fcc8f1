#pragma once

#include <string>

#include "mcplan/robot/robot.hpp"
#include "model/fields.hpp"
#include "model/read.hpp"
#include "model/schema.hpp"

namespace mcplan::model {

template <>
struct Fields<Polytope> {
  static constexpr const char* name = "Polytope";
  static constexpr const char* meaning = "Convex set {x : A x <= b} [m]. Without rows: not given.";
  static constexpr auto all =
      std::make_tuple(field("A", &Polytope::A, "-", "N x 3, rows of unit length.").required(),
                      field("b", &Polytope::b, "m", "Distance of each face from the origin.").required());
};

/// A polytope as it stands in a file.
struct PolytopeTable {
  Eigen::Matrix<double, Eigen::Dynamic, 3> A;
  Eigen::VectorXd b;
  std::string file, name;
};

template <>
struct InFiles<Polytope> {
  using Type = PolytopeTable;
};

template <>
struct Fields<PolytopeTable> {
  static constexpr const char* name = "Polytope";
  static constexpr const char* meaning = "Convex set {x : A x <= b}: given by A and b, or by the file that holds them.";
  static constexpr auto all = std::make_tuple(
      field("A", &PolytopeTable::A, "-", "Outward normals of the faces, of length 1 within 0.001.").entries(0, 10'000),
      field("b", &PolytopeTable::b, "m", "Distance of each face from the origin.").entries(0, 10'000),
      field("file", &PolytopeTable::file, "", "JSON file with A and b, relative to the robot's file."),
      field("name", &PolytopeTable::name, "", "Key of the polytope among the file's `polytopes`."));
};

template <>
struct Fields<LimbLimits> {
  static constexpr const char* name = "LimbLimits";
  static constexpr const char* meaning =
      "What the main joints of a leg can do, and how thick it is: a virtual leg of two links between hip and ankle "
      "that "
      "bend in the plane in which the sole heads.";
  static constexpr auto all = std::make_tuple(
      field("hip_B", &LimbLimits::hip_B, "m", "Hip relative to the CoM in the nominal stance, axes of the base.")
          .in_files("hip")
          .required(),
      field("hip_shift", &LimbLimits::hip_shift, "-",
            "Motion of the hip against the CoM over that of each end-effector with limits against it.")
          .above(-1.0)
          .at_most(0.0),
      field("upper", &LimbLimits::upper, "m", "Length from hip to knee; 0 in memory: no limits.").required().positive(),
      field("lower", &LimbLimits::lower, "m", "Length from knee to ankle.").required().positive(),
      field("ankle", &LimbLimits::ankle, "m", "From the end-effector to the ankle, axes of the sole."),
      field("bends_backward", &LimbLimits::bends_backward, "",
            "Whether the knee is behind the line from hip to ankle."),
      field("margin", &LimbLimits::margin, "m",
            "By how much the hip may be elsewhere: levers are those of the worse leg.")
          .not_negative(),
      field("radius", &LimbLimits::radius, "m",
            "Of capsules from hip to knee and on to the middle of the lower link that keep out of solids; 0: none.")
          .not_negative(),
      field("beside", &LimbLimits::beside, "m",
            "By how much the capsules' lines lie to the left of the joints, along the axis of the knee."),
      field("knee_torque", &LimbLimits::knee_torque, "N m", "Largest torque of the knee.").positive().or_infinite(),
      field("knee_speed", &LimbLimits::knee_speed, "rad/s", "Largest speed of the knee.").positive().or_infinite(),
      field("hip_torque", &LimbLimits::hip_torque, "N m", "Largest torque of the hip about its roll and pitch axes.")
          .positive()
          .or_infinite(),
      field("ankle_torque", &LimbLimits::ankle_torque, "N m", "Largest torque of the ankle, likewise.")
          .positive()
          .or_infinite());
};

template <>
struct Fields<TrunkPart> {
  static constexpr const char* name = "TrunkPart";
  static constexpr const char* meaning =
      "A capsule that turns with the base, about as large as what it stands for: all points within a radius of a line.";
  static constexpr auto all =
      std::make_tuple(field("from_B", &TrunkPart::from_B, "m",
                            "Lower, rear or right end of the line, relative to the CoM, axes of the "
                            "base.")
                          .in_files("from")
                          .required(),
                      field("to_B", &TrunkPart::to_B, "m", "The other end, likewise.").in_files("to").required(),
                      field("radius", &TrunkPart::radius, "m", "Distance from the line.").required().positive());
};

template <>
struct Fields<EndEffector> {
  static constexpr const char* name = "EndEffector";
  static constexpr const char* meaning =
      "A contact link. Positions relative to the CoM, in axes that turn with the base (x forward, y left, z up).";
  static constexpr auto all = std::make_tuple(
      field("name", &EndEffector::name, "", "Unique name.").required().not_empty(),
      field("kind", &EndEffector::kind, "", "Group that scenes may address as a whole, e.g. foot, hand.")
          .not_empty()
          .always_written(),
      field("frame", &EndEffector::frame, "", "URDF frame; empty for robots without a URDF."),
      field("frame_offset", &EndEffector::frame_offset, "m", "Contact point in the axes of the URDF frame."),
      field("half_size", &EndEffector::half_size, "m", "Half length and half width of the sole; zero: point contact.")
          .not_negative(),
      field("nominal_B", &EndEffector::nominal_B, "m", "Position in the nominal stance.")
          .in_files("nominal")
          .required(),
      field("reach_min_B", &EndEffector::reach_min_B, "m", "Lower corner of the box of reachable positions.")
          .in_files("reach_min")
          .required(),
      field("reach_max_B", &EndEffector::reach_max_B, "m", "Upper corner of the box of reachable positions.")
          .in_files("reach_max")
          .required(),
      field("usual_reach", &EndEffector::usual_reach, "m",
            "What of the box's length plans keep to where steps within it make an easy walk, back and ahead; left out: "
            "all "
            "of it."),
      field("reach_cut", &EndEffector::reach_cut, "m",
            "Faces that cut the box, four at most: a sole is lifted higher ahead than behind. Not beside com_reach."),
      field("max_force", &EndEffector::max_force, "N", "Largest norm of the contact force.").positive().or_infinite(),
      field("max_moment", &EndEffector::max_moment, "N m",
            "Largest contact moment about each world axis; under ForceLaw.wrench the third about the surface's normal.")
          .not_negative(),
      field("yaw_range", &EndEffector::yaw_range, "rad",
            "How far the sole may be turned against the base, right and left; left out: any way."),
      field("com_reach", &EndEffector::com_reach, "m",
            "Where the CoM may be relative to the sole's centre. Axes: level, x along the heading."),
      field("partner_reach", &EndEffector::partner_reach, "m",
            "Where other end-effectors may stand relative to it, by name. Same axes. Assign a dict to change it."),
      field("limb", &EndEffector::limb, "", "Joint limits of the leg that carries it, where given."));
};

template <>
struct Fields<Robot> {
  static constexpr const char* name = "Robot";
  static constexpr const char* meaning =
      "What a planner needs to know of a robot: lumped inertia and where its limbs reach. SI units.";
  static constexpr auto all = std::make_tuple(
      field("name", &Robot::name, "", "Name; of a file that says none, the file's.").always_written(),
      field("description", &Robot::description, "", "One line."),
      field("mass", &Robot::mass, "kg", "Total mass.").positive().required(),
      field("inertia", &Robot::inertia, "kg m^2", "Diagonal, about the CoM, in the nominal posture.")
          .positive()
          .required(),
      field("com_height", &Robot::com_height, "m", "Of the CoM above the ground in the nominal stance.")
          .positive()
          .required(),
      field("max_com_speed", &Robot::max_com_speed, "m/s",
            "Largest speed of the CoM: with it a gap can be too wide for any jump.")
          .positive()
          .or_infinite(),
      field("swing_height", &Robot::swing_height, "m",
            "Clearance of a swinging end-effector. The default goes with the robot's size.")
          .positive()
          .always_written(),
      field("phase_duration", &Robot::phase_duration, "s",
            "Shortest and longest phase of a contact sequence. The default goes with the robot's size.")
          .positive(),
      field("sole_support", &Robot::sole_support, "-",
            "Ratio of a sole that a contact sequence keeps on its surface; 0: its centre.")
          .at_least(0.0)
          .at_most(1.0),
      field("pressure_ratio", &Robot::pressure_ratio, "-",
            "Ratio of a sole's half size within which a plan keeps the centre of pressure.")
          .formerly("pressure_share")
          .above(0.0)
          .at_most(1.0),
      field("tracked", &Robot::tracked, "",
            "Whether a controller follows the plans with limbs whose momentum they do not know of: contact sequences "
            "keep "
            "the base upright and the centre of pressure near the middle of the sole."),
      field(
          "trunk", &Robot::trunk, "",
          "What keeps out of solids beside the ball about the CoM: spine and head, shoulders. Assign a list to add or "
          "remove.")
          .entries(0, 8),
      field("urdf", &Robot::urdf, "", "Path, or 'example-robot-data:NAME'; empty: none."),
      field("end_effectors", &Robot::end_effectors, "", "End-effectors; assign a list to add or remove.")
          .required()
          .entries(1, 8),
      field("posture", &Robot::posture, "rad",
            "Nominal joint positions by URDF joint name. Assign a dict to change it."));
};

/// A polytope of a robot's file: A and b, or the JSON file beside the robot's that holds them under a name.
bool read_value(const Value& value, Polytope& out, const Rules& rules, const Place& at, Reading& reading);

/// What is wrong with a robot beyond the ranges of its fields; fields with findings are left out.
void relations(const Robot& robot, Findings& found);

/// The robot of the plain data of a file; `folder`: where files that it names are looked for, nullptr: it may name
/// none, and the path of its URDF is taken as it is. Throws InvalidRobot with all that is wrong.
Robot robot_from(const Value& data, const std::string& source = "", const std::filesystem::path* folder = nullptr);

}  // namespace mcplan::model
