#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mcplan/scene/scene.hpp"

namespace mcplan {

/// Convex set {x : A x <= b} [m], rows of A of unit length. Without rows: not given.
struct Polytope {
  Eigen::Matrix<double, Eigen::Dynamic, 3> A;
  Eigen::VectorXd b;

  bool given() const { return A.rows() > 0; }
};

/// Most faces that cut a reach box.
constexpr int kReachCuts = 4;

/// What the main joints of a leg can do, as functions of where its end-effector and hip are: a virtual leg of two links
/// that bend in the plane of the hip, the ankle and the direction in which the sole heads (without a sole, in which the
/// base does). Torques are those of the contact force alone, at rest. Theory: docs/theory/ddp.md, "Joint limits". With
/// a radius the leg is a body as well, which keeps out of solids: two capsules, from the hip to the knee and from there
/// down half of the lower link.
struct LimbLimits {
  Eigen::Vector3d hip_B = Eigen::Vector3d::Zero();  ///< [m] hip relative to the CoM, nominal stance
  double hip_shift = 0.0;  ///< [-] motion of the hip against the CoM over that of an end-effector with limits against
                           ///< both: what moves the CoM in the base
  double upper = 0.0;      ///< [m] from the hip to the knee; 0: no limits are given
  double lower = 0.0;      ///< [m] from the knee to the ankle
  Eigen::Vector3d ankle = Eigen::Vector3d::Zero();  ///< [m] from the end-effector to the ankle, axes of the sole
  bool bends_backward = false;                      ///< the knee is behind the line from hip to ankle
  double margin = 0.0;  ///< [m] by which the hip may be elsewhere: levers are those of the worse leg
  double radius = 0.0;  ///< [m] of the capsules; 0: none
  double beside = 0.0;  ///< [m] by which their lines lie to the left of the joints, along the axis of the knee
  double knee_torque = std::numeric_limits<double>::infinity();  ///< [N m]
  double knee_speed = std::numeric_limits<double>::infinity();   ///< [rad/s]
  Eigen::Vector2d hip_torque =
      Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());  ///< [N m] roll, pitch
  Eigen::Vector2d ankle_torque = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());  ///< likewise

  bool given() const { return upper > 0.0; }
};

/// A contact link of the robot. Frame B sits at the CoM and turns with the base.
struct EndEffector {
  std::string name;           ///< e.g. "left_foot"
  std::string kind = "foot";  ///< group that scenes may address as a whole, e.g. "foot", "hand"
  std::string frame;          ///< URDF frame, empty for robots without a URDF
  Eigen::Vector3d frame_offset = Eigen::Vector3d::Zero();  ///< [m] contact point in the axes of the URDF frame
  Eigen::Vector2d half_size =
      Eigen::Vector2d::Zero();  ///< [m] half length and half width of the sole; 0: point contact
  Eigen::Vector3d nominal_B = Eigen::Vector3d::Zero();    ///< [m] nominal position relative to the CoM
  Eigen::Vector3d reach_min_B = Eigen::Vector3d::Zero();  ///< [m] box of reachable positions relative to the CoM
  Eigen::Vector3d reach_max_B = Eigen::Vector3d::Zero();
  /// [m] what of the box's length, along x, plans keep to where steps within it make an easy walk; what is beyond takes
  /// legs that are stretched or bent far. Infinite: all of it.
  Eigen::Vector2d usual_reach{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  /// Faces, kReachCuts at most, that cut the box where it says more than the limb can do: a sole is lifted higher ahead
  /// of the body than behind it. Same axes; not beside com_reach.
  Polytope reach_cut;
  double max_force = std::numeric_limits<double>::infinity();  ///< [N] largest norm of the contact force
  /// [N m] largest contact moment about each world axis; under laws::Wrench the third about the surface's normal,
  /// the others being what the centre of pressure does.
  Eigen::Vector3d max_moment = Eigen::Vector3d::Zero();
  /// [rad] how far the sole may be turned against the base about the vertical while it is in contact: min <= 0 <= max.
  Eigen::Vector2d yaw_range{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  /// Finer than the box, where given. Axes: level, x along the heading (yaw alone), whatever the slope of the sole.
  Polytope
      com_reach;  ///< where the CoM may be relative to this end-effector (its sole's centre) while it is in contact
  std::map<std::string, Polytope> partner_reach;  ///< where other end-effectors may stand relative to it, by name
  LimbLimits limb;                                ///< of the leg that carries it, where given

  /// What of the reach box is usual: corners [m].
  Eigen::AlignedBox3d usual_box() const;
};

/// A capsule that turns with the base, about as large as what it stands for: all points within `radius` of a line.
struct TrunkPart {
  Eigen::Vector3d from_B = Eigen::Vector3d::Zero();  ///< [m] ends of the line relative to the CoM, axes of the base
  Eigen::Vector3d to_B = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< [m]
};

/// What a planner needs to know of a robot: lumped inertia and where its limbs reach.
struct Robot {
  std::string name;
  std::string description;
  double mass = 0.0;                                  ///< [kg]
  Eigen::Vector3d inertia = Eigen::Vector3d::Ones();  ///< [kg m^2] diagonal, about the CoM, nominal posture
  double com_height = 0.0;                            ///< [m] of the CoM above the ground in the nominal stance
  double max_com_speed = std::numeric_limits<double>::infinity();  ///< [m/s] largest speed of the CoM
  double swing_height = 0.10;                  ///< [m] clearance of a swinging end-effector; at its default by_size()
  Eigen::Vector2d phase_duration{0.15, 0.50};  ///< [s] shortest and longest phase of a contact sequence; likewise
  double sole_support = 0.0;                   ///< ratio of a sole that a contact sequence keeps on its surface
  double pressure_ratio = 1.0;   ///< ratio of a sole's half size within which a plan keeps the centre of pressure
  bool tracked = false;          ///< a controller follows the plans with limbs whose momentum they do not know of:
                                 ///< contact sequences keep the base upright and the centre of pressure near the middle
  std::vector<TrunkPart> trunk;  ///< what keeps out of solids beside the ball about the CoM: spine and head, shoulders
  std::vector<EndEffector> end_effectors;
  std::string urdf;                       ///< path, or "example-robot-data:NAME"; empty: none
  std::map<std::string, double> posture;  ///< nominal joint positions [rad] by URDF joint name

  int end_effector_index(const std::string& end_effector_name) const;  ///< or -1

  /// Throws InvalidRobot naming the first field out of its range: among others polytopes with a b for each row of A,
  /// rows of length 1 within 1e-3, the nominal stance inside, partners that exist.
  void validate() const;
};

/// Whether `who` (a name or a kind) addresses this end-effector.
bool addresses(const std::string& who, const EndEffector& end_effector);

/// Whether the surface lists the end-effector, by name or kind, or lists nobody.
bool may_touch(const Surface& surface, const EndEffector& end_effector);

/// A stance of a scene worked out for one robot.
struct ResolvedStance {
  Eigen::Vector3d com_W;                         ///< [m]
  double yaw;                                    ///< [rad]
  Eigen::Vector3d base_rpy{0.0, 0.0, 0.0};       ///< [rad] upright, or on three feet and more parallel to the ground
  std::vector<int> contacts;                     ///< surface index per end-effector, -1: free
  std::vector<Eigen::Vector3d> end_effectors_W;  ///< [m] nominal positions, those in contact on their surface
};

/// Throws InvalidScene when contacts name an end-effector that the robot does not have, or one that may not touch the
/// surface. `field` is "start" or "goal", for the message.
ResolvedStance resolve_stance(const Scene& scene, const Robot& robot, const Stance& stance, const std::string& field);

}  // namespace mcplan
