#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mcplan/planar/task.hpp"
#include "model/fields.hpp"
#include "model/findings.hpp"
#include "model/value.hpp"
#include "planar/robot_fields.hpp"

namespace mcplan::model {

template <>
struct Fields<PlanarSurface> {
  static constexpr const char* name = "PlanarSurface";
  static constexpr const char* meaning =
      "A straight piece of the ground or of a wall. Its outward normal is 90 degrees to the left of its tangent; what "
      "lies behind is solid.";
  static constexpr auto all = std::make_tuple(
      field("name", &PlanarSurface::name, "", "Unique name.").required().not_empty(),
      field("origin_W", &PlanarSurface::origin_W, "m", "A point of it, from which distances along it count.")
          .in_files("origin"),
      field("angle", &PlanarSurface::angle, "rad",
            "Of its tangent; its outward normal is 90 degrees to the left of that."),
      field("friction", &PlanarSurface::friction, "-", "Coulomb coefficient.").positive().always_written(),
      field("from_", &PlanarSurface::from, "m", "Begin of its extent along the tangent, from the origin.")
          .in_files("from")
          .or_infinite()
          .by_file_keys(),
      field("to", &PlanarSurface::to, "m", "End of its extent.").or_infinite().by_file_keys());
};

struct PlanarSurfaceKeys {
  Eigen::Vector2d extent{-unbounded, unbounded};
};

template <>
struct Fields<PlanarSurfaceKeys> {
  static constexpr auto all =
      std::make_tuple(field("extent", &PlanarSurfaceKeys::extent, "m",
                            "From where to where along the tangent; inf and -inf are legal. Left out: no ends.")
                          .or_infinite());
};

template <>
struct FileKeys<PlanarSurface> {
  using Type = PlanarSurfaceKeys;
};

template <>
struct Fields<PlanarContact> {
  static constexpr const char* name = "PlanarContact";
  static constexpr const char* meaning = "An end-effector that stands still on a surface for a phase.";
  static constexpr auto all = std::make_tuple(
      field("end_effector", &PlanarContact::end_effector, "", "End-effector.")
          .required()
          .index_of("end_effectors", "an end-effector of the robot"),
      field("surface", &PlanarContact::surface, "", "Surface.").required().index_of("surfaces", "one of the surfaces"),
      field("position_W", &PlanarContact::position_W, "m", "Of the end-effector's frame.")
          .in_files("position")
          .by_file_keys(),
      field("angle", &PlanarContact::angle, "rad", "Of its x axis; whole turns count.").by_file_keys());
};

struct PlanarContactKeys {
  std::optional<double> at;
  std::optional<Eigen::Vector2d> position;
  std::optional<int> turns;
  std::optional<double> angle;
};

template <>
struct Fields<PlanarContactKeys> {
  static constexpr auto all = std::make_tuple(
      field("at", &PlanarContactKeys::at, "m", "Place of the frame's origin along the surface, from its origin."),
      field("position", &PlanarContactKeys::position, "m", "The same as a point of the world, instead of `at`."),
      field("turns", &PlanarContactKeys::turns, "-",
            "Whole turns by which the end-effector is turned more (default 0).")
          .at_least(-1000.0)
          .at_most(1000.0),
      field("angle", &PlanarContactKeys::angle, "rad", "Of the end-effector's x axis, instead of `turns`."));
};

template <>
struct FileKeys<PlanarContact> {
  using Type = PlanarContactKeys;
};

template <>
struct Fields<PlanarNoClearance> {
  static constexpr const char* name = "PlanarNoClearance";
  static constexpr const char* meaning = "An end-effector that may be inside a surface's solid.";
  static constexpr auto all =
      std::make_tuple(field("end_effector", &PlanarNoClearance::end_effector, "", "End-effector.")
                          .required()
                          .index_of("end_effectors", "an end-effector of the robot"),
                      field("surface", &PlanarNoClearance::surface, "", "Surface.")
                          .required()
                          .index_of("surfaces", "one of the surfaces"));
};

template <>
struct Fields<PlanarClearance> {
  static constexpr const char* name = "PlanarClearance";
  static constexpr const char* meaning =
      "Points of a swinging end-effector stay in front of a surface, which counts as endless.";
  static constexpr auto all = std::make_tuple(
      field("end_effector", &PlanarClearance::end_effector, "", "End-effector.")
          .required()
          .index_of("end_effectors", "an end-effector of the robot"),
      field("surface", &PlanarClearance::surface, "", "Surface.")
          .required()
          .index_of("surfaces", "one of the surfaces"),
      field("first_interval", &PlanarClearance::first_interval, "-", "First interval of the phase that counts.")
          .at_least(0.0)
          .at_most(1000.0),
      field("end_interval", &PlanarClearance::end_interval, "-",
            "First interval that no longer counts; -1: to the end of the phase.")
          .at_least(-1.0)
          .at_most(1000.0),
      field("middle_height", &PlanarClearance::middle_height, "m",
            "Least height when interval n / 2 of the phase's n begins; left out: none.")
          .or_infinite());
};

template <>
struct Fields<PlanarPose> {
  static constexpr const char* name = "PlanarPose";
  static constexpr const char* meaning = "Bounds on where a body is at an instant of a phase.";
  static constexpr auto all = std::make_tuple(
      field("body", &PlanarPose::body, "", "Body.").required().index_of("bodies", "a body of the robot"),
      field("fraction", &PlanarPose::fraction, "-", "Of the phase, 0 to 1.").required().at_least(0.0).at_most(1.0),
      field("min", &PlanarPose::min, "", "x, y [m], angle [rad] of the body's frame at least.")
          .or_infinite()
          .by_file_keys(),
      field("max", &PlanarPose::max, "", "x, y [m], angle [rad] at most.").or_infinite().by_file_keys());
};

struct PlanarPoseKeys {
  Eigen::Vector2d x{-unbounded, unbounded}, y{-unbounded, unbounded}, angle{-unbounded, unbounded};
};

template <>
struct Fields<PlanarPoseKeys> {
  static constexpr auto all = std::make_tuple(
      field("x", &PlanarPoseKeys::x, "m", "From, to: of the origin of the body's frame. Left out: free.").or_infinite(),
      field("y", &PlanarPoseKeys::y, "m", "From, to.").or_infinite(),
      field("angle", &PlanarPoseKeys::angle, "rad", "From, to.").or_infinite());
};

template <>
struct FileKeys<PlanarPose> {
  using Type = PlanarPoseKeys;
};

constexpr int max_phase_intervals = 1000;

template <>
struct Fields<PlanarPhase> {
  static constexpr const char* name = "PlanarPhase";
  static constexpr const char* meaning = "A stretch of time with constant contacts.";
  static constexpr auto all = std::make_tuple(
      field("intervals", &PlanarPhase::intervals, "-", "Pieces of the joints' splines.")
          .at_least(1.0)
          .at_most(max_phase_intervals)
          .by_file_keys(),
      field("min_duration", &PlanarPhase::min_duration, "s", "Least duration.").not_negative(),
      field("max_duration", &PlanarPhase::max_duration, "s", "Largest duration; left out: no limit.")
          .positive()
          .or_infinite(),
      field("contacts", &PlanarPhase::contacts, "", "All contacts; assign a list to add or remove.")
          .required()
          .entries(1, 100)
          .by_file_keys(),
      field("clearances", &PlanarPhase::clearances, "",
            "In front of which surfaces swinging end-effectors stay, and when.")
          .entries(0, 1000),
      field("poses", &PlanarPhase::poses, "", "Where a body has to be at an instant.").entries(0, 1000).by_file_keys());
};

struct PlanarPhaseKeys {
  std::vector<InFile<PlanarContact>> contacts;
  std::vector<int> lift;
  std::vector<InFile<PlanarContact>> place;
  std::optional<int> intervals;
  std::vector<InFile<PlanarPose>> poses;
};

template <>
struct Fields<PlanarPhaseKeys> {
  static constexpr auto all = std::make_tuple(
      field("contacts", &PlanarPhaseKeys::contacts, "", "All contacts of the phase.").entries(0, 100),
      field("lift", &PlanarPhaseKeys::lift, "", "End-effectors that leave their contact, instead of `contacts`.")
          .entries(0, 1000)
          .index_of("end_effectors", "an end-effector of the robot"),
      field("place", &PlanarPhaseKeys::place, "", "Contacts that are new, instead of `contacts`.").entries(0, 100),
      field("intervals", &PlanarPhaseKeys::intervals, "-",
            "Pieces of the joints' splines. Default: 3 for the first and last phase, else 4.")
          .at_least(1.0)
          .at_most(max_phase_intervals),
      field("poses", &PlanarPhaseKeys::poses, "", "Where a body has to be at an instant.").entries(0, 1000));
};

template <>
struct FileKeys<PlanarPhase> {
  using Type = PlanarPhaseKeys;
};

template <>
struct Fields<PlanarTask> {
  static constexpr const char* name = "PlanarTask";
  static constexpr const char* meaning =
      "A task for whole-body planning: planar robot, ground, and the sequence of contact stances. SI units.";
  static constexpr auto all = std::make_tuple(
      field("name", &PlanarTask::name, "", "Name; of a file that says none, the file's.").always_written(),
      field("description", &PlanarTask::description, "", "One line."),
      field("robot", &PlanarTask::robot, "", "The planar robot.").required().by_file_keys(),
      field("surfaces", &PlanarTask::surfaces, "", "The ground; assign a list to add or remove.")
          .required()
          .entries(1, 1000)
          .by_file_keys(),
      field("no_clearance", &PlanarTask::no_clearance, "",
            "Pairs of end-effector and surface that need not keep clear of each other; all others do.")
          .entries(0, 1000),
      field("phases", &PlanarTask::phases, "", "Phases; assign a list to add or remove.")
          .required()
          .entries(1, 1000)
          .by_file_keys());
};

struct PlanarTaskKeys {
  NameOr<InFile<PlanarRobot>> robot;
  std::vector<InFile<PlanarSurface>> surfaces;
  std::vector<InFile<PlanarPhase>> phases;
};

template <>
struct Fields<PlanarTaskKeys> {
  static constexpr auto all = std::make_tuple(
      field("robot", &PlanarTaskKeys::robot, "",
            "Built-in name, path relative to this file, or the robot itself as a table.")
          .required(),
      field("surfaces", &PlanarTaskKeys::surfaces, "", "The ground.").required().entries(1, 1000),
      field("phases", &PlanarTaskKeys::phases, "", "Phases, in the order of time.").required().entries(1, 1000));
};

template <>
struct FileKeys<PlanarTask> {
  using Type = PlanarTaskKeys;
};

/// Says where a file has what is wrong at a place in memory.
using InTheFile = std::function<InvalidPlanarTask(const InvalidPlanarTask&)>;

/// What is wrong with a task beyond its robot and the ranges of its fields; what has findings is left out.
void relations(const PlanarTask& task, Findings& found, const InTheFile& in_the_file = nullptr);

/// The task of the plain data of a file; `folder`: where its robot is looked for, nullptr: the working directory.
/// Throws InvalidPlanarTask, InvalidRobot with all that is wrong, UnknownRobot.
PlanarTask planar_task_from(const Value& data, const std::string& source = "",
                            const std::filesystem::path* folder = nullptr);

/// The plain data of a file, with the robot inline and all contacts of each phase.
Value planar_task_data(const PlanarTask& task);

/// What written() with Writing::exact made. Throws InvalidPlanarTask with all that is wrong.
PlanarTask planar_task_from_exact(const Value& data);

}  // namespace mcplan::model
