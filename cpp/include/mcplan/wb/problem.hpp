#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace mcplan::wb {

/// A link and the joint of one degree of freedom that carries it. The first six are the floating base: they slide along
/// the world's x, y, z and turn about z, y, x, so that configurations are vectors and velocities their derivatives.
struct Link {
  std::string joint;
  int parent = -1;  ///< index of a link before it; -1: the world
  bool prismatic = false;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();           ///< of the joint, in the link
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();    ///< of the link at zero in its parent
  Eigen::Vector3d position = Eigen::Vector3d::Zero();        ///< of the joint in its parent [m]
  double mass = 0.0;                                         ///< [kg]
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< in the link [m]
  double position_min = 0.0, position_max = 0.0;             ///< [rad, m]
  double velocity_max = 0.0, torque_max = 0.0;               ///< [rad/s, N m]
};

/// A sole or a point fixed to a link; its frame S has z along the normal of the ground on which it lies.
struct EndEffector {
  std::string name;
  int link = 0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< of S in the link
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< of S in the link [m]
  Eigen::Matrix3Xd points_S;                               ///< kept off the ground in swings [m]
  bool is_point() const { return points_S.cols() == 1; }   ///< of no rotation of its own
};

/// An end-effector in contact at a node.
struct Contact {
  int end_effector = 0;
  bool carries = false;  ///< a force: not at a node at which the contact is made or broken
  bool rests = false;    ///< its velocity is zero by an equality: at the first and the last node of a contact
  double friction = 0.0;
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation_W = Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 6, 1> wrench_S = Eigen::Matrix<double, 6, 1>::Zero();  ///< the plan's [N, N m]
  Eigen::Matrix3Xd points_S;  ///< where forces act, as many as the end-effector has points, on the surface [m]
  double load_max = std::numeric_limits<double>::infinity();  ///< of the normal force of a contact that carries [N]
  bool limited() const { return carries && load_max < std::numeric_limits<double>::infinity(); }
};

/// An end-effector in the air at a node.
struct Swing {
  int end_effector = 0;
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation_W = Eigen::Matrix3d::Identity();
  double weight = 1.0;   ///< of the costs of its position and rotation, beside Weights
  bool in_tube = false;  ///< its points keep within these distances of where the plan has them [m]
  Eigen::Vector3d tube_min_W = Eigen::Vector3d::Zero(), tube_max_W = Eigen::Vector3d::Zero();
};

struct Node {
  double time_s = 0.0;
  Eigen::Vector3d com_W = Eigen::Vector3d::Zero();     ///< the plan's
  Eigen::Vector3d base_zyx = Eigen::Vector3d::Zero();  ///< the plan's angles about z, y, x [rad]
  std::vector<Contact> contacts;
  std::vector<Swing> swings;
  double acceleration = 1.0, torque = 1.0;  ///< of the costs of accelerations and of torques, beside Weights
};

/// A link's hull: all points nearer than `radius` to a segment.
struct Capsule {
  int link = 0;
  Eigen::Vector3d start = Eigen::Vector3d::Zero(), end = Eigen::Vector3d::Zero();  ///< in the link [m]
  double radius = 0.0;
};

/// Two capsules that keep a distance.
struct CapsulePair {
  int first = 0, second = 0;
  double distance_min = 0.0;  ///< [m]
};

/// Weights of the cost, each of half a square. A second of the motion counts as `rate` of them.
struct Weights {
  double rate = 50.0;            ///< [1/s]
  double com = 1e4;              ///< distance to the plan's CoM [1/m^2]
  double base = 50.0;            ///< angles of the base off the plan's [1/rad^2]
  double swing = 2e3;            ///< distance of end-effectors in the air to the plan's [1/m^2]
  double swing_rotation = 20.0;  ///< [1/rad^2]
  double posture = 2.0;          ///< joints off the posture [1/rad^2]
  double velocity = 0.2;         ///< of joints [s^2/rad^2]
  double acceleration = 2e-3;    ///< of base and joints [s^4/rad^2, s^4/m^2]
  double torque = 0.3;           ///< over its limit
  double wrench = 1.0;           ///< off the plan's, over weight, and weight times a metre
  double force = 1.0;            ///< along each edge of a friction pyramid, over weight
  double elastic = 100.0;        ///< of a limit that is exceeded, over its scale; not squared
};

/// A whole-body motion sought for a centroidal plan: docs/theory/wb.md.
struct Problem {
  std::vector<Link> links;
  std::vector<EndEffector> end_effectors;
  std::vector<Node> nodes;
  std::vector<Capsule> capsules;
  std::vector<CapsulePair> pairs;
  Eigen::VectorXd posture;        ///< of the joints after the base
  double weight_N = 0.0;          ///< m g
  double limit_ratio = 0.97;      ///< of velocity and torque limits, for what happens between nodes
  double position_margin = 1e-3;  ///< inside of the joints' limits [rad, m]
  double point_load_min = 0.01;   ///< normal force of a point that carries, over weight_N: room to correct it
  Weights weights;

  int velocity_count() const { return static_cast<int>(links.size()); }
  int joint_count() const { return velocity_count() - 6; }
  int node_count() const { return static_cast<int>(nodes.size()); }

  /// Throws InvalidInput naming what does not fit together.
  void validate() const;
};

/// Inverse dynamics at all nodes, tau = RNEA(q, v, a, wrenches), as somebody else computes it: row k is of node k.
struct Dynamics {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Rows q, v, a;     ///< (n, nv), given
  Rows wrenches_S;  ///< (n, 6 e) force and moment of each end-effector, in its frame S [N, N m], given
  Rows tau;         ///< (n, nv) generalised forces of base and joints
  Rows dq, dv, da;  ///< (n nv, nv) derivatives, wrenches held fixed in their frames

  void resize(int nodes, int velocities, int end_effectors);

  /// Fills tau and, if asked, the derivatives.
  using Callback = std::function<void(bool derivatives)>;
};

}  // namespace mcplan::wb
