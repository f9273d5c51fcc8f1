#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace mcplan {

/// Segment with a radius, in a body's frame: what the body looks like, and what it collides with.
struct Capsule {
  Eigen::Vector2d from_B = Eigen::Vector2d::Zero(), to_B = Eigen::Vector2d::Zero();  ///< [m]
  double radius = 0.0;                                                               ///< [m]
};

/// A rigid body of a planar robot and the revolute joint that carries it. Body 0 is the base, which has no joint.
///
/// The plane has x forward and y up, angles counter-clockwise. A body's frame B has its origin at the joint; at joint
/// position q it is turned by offset + q against its parent's.
struct PlanarBody {
  std::string name;
  int parent = -1;                                                 ///< an earlier body; -1 for the base alone
  Eigen::Vector2d joint_P = Eigen::Vector2d::Zero();               ///< joint in the parent's frame [m]
  double offset = 0.0;                                             ///< angle against the parent at q = 0 [rad]
  double mass = 0.0;                                               ///< [kg]
  Eigen::Vector2d com_B = Eigen::Vector2d::Zero();                 ///< [m]
  double inertia = 0.0;                                            ///< about the CoM [kg m^2]
  double position_min = -std::numeric_limits<double>::infinity();  ///< of the joint [rad]
  double position_max = std::numeric_limits<double>::infinity();
  double velocity_max = std::numeric_limits<double>::infinity();  ///< [rad/s]
  double torque_max = std::numeric_limits<double>::infinity();    ///< [N m]
  std::vector<Capsule> capsules;
};

/// A contact frame of a body: its x axis lies in the sole, its y axis points from the ground into the robot. Forces act
/// at points of the sole.
struct PlanarEndEffector {
  std::string name;  ///< e.g. "left_foot"
  int body = 0;
  Eigen::Vector2d position_B = Eigen::Vector2d::Zero();  ///< of the frame's origin [m]
  double angle_B = 0.0;                                  ///< of its x axis [rad]
  std::vector<double> points;                            ///< where forces act, along the x axis [m]
};

/// A planar tree of rigid bodies on a free base. Joint j (from 0) moves body j + 1.
struct PlanarRobot {
  std::string name;
  std::string description;
  std::vector<PlanarBody> bodies;
  std::vector<PlanarEndEffector> end_effectors;
  std::vector<std::pair<int, int>> collision_pairs;  ///< bodies whose capsules may not touch
  double gravity = 9.81;                             ///< along -y [m/s^2]

  int joint_count() const { return static_cast<int>(bodies.size()) - 1; }
  double mass() const;                                   ///< [kg]
  int body_index(const std::string& body_name) const;    ///< or -1
  int end_effector_index(const std::string& who) const;  ///< or -1
  std::vector<int> joints_to(int body) const;            ///< joints between the base and a body, base first

  /// Throws InvalidRobot naming the first field out of its range: among others bodies that come before their parent
  /// (loops), masses and inertias that are not positive, empty ranges, names twice, end-effectors without points.
  void validate() const;
};

/// Position, velocity and acceleration of the base and the joints.
struct PlanarConfiguration {
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  ///< x, y [m], angle [rad] in the world
  Eigen::Vector3d base_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d base_acceleration = Eigen::Vector3d::Zero();
  Eigen::VectorXd q, velocity, acceleration;  ///< of the joints [rad], [rad/s], [rad/s^2]
};

/// Where a frame is and how it moves.
struct PlanarMotionOfFrame {
  Eigen::Vector2d position_W, velocity_W, acceleration_W;  ///< [m], [m/s], [m/s^2]
  double angle = 0.0, rate = 0.0, angular_acceleration = 0.0;
};

/// A force at a point of a body.
struct PlanarForce {
  int body = 0;
  Eigen::Vector2d point_W, force_W;  ///< [m], [N] of the environment on the robot
};

/// Frames of all bodies, by recursion from the base.
std::vector<PlanarMotionOfFrame> planar_kinematics(const PlanarRobot& robot, const PlanarConfiguration& configuration);

/// A point of a body, e.g. its CoM; `point_B` in the body's frame, `angle_B` added to its angle.
PlanarMotionOfFrame planar_point(const PlanarMotionOfFrame& body, const Eigen::Vector2d& point_B, double angle_B = 0.0);

/// Inverse dynamics by the recursive Newton-Euler algorithm: torques of the joints [N m], and what is left over at the
/// base: force x, y [N] and moment about the base's origin [N m], which is zero where the motion obeys physics.
struct PlanarInverseDynamics {
  Eigen::VectorXd torque;
  Eigen::Vector3d base_residual;
};
PlanarInverseDynamics planar_inverse_dynamics(const PlanarRobot& robot, const PlanarConfiguration& configuration,
                                              const std::vector<PlanarForce>& forces);

/// The same from the frames of planar_kinematics(), with their velocities and accelerations.
PlanarInverseDynamics planar_inverse_dynamics(const PlanarRobot& robot, const std::vector<PlanarMotionOfFrame>& frames,
                                              const std::vector<PlanarForce>& forces);

}  // namespace mcplan
