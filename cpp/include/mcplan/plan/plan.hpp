#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "mcplan/plan/force_laws.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan {

/// What one end-effector does during one phase. Under laws::Pendulum stiffness, anchor and moment say its force, under
/// laws::Wrench these and the centre of pressure; otherwise the forces at its points do, and those four stay zero.
struct Contact {
  int surface = -1;                                    ///< index into scene.surfaces, -1: free
  double stiffness = 0.0;                              ///< mu_l [1/s^2], 0 when free
  Eigen::Vector3d anchor_W = Eigen::Vector3d::Zero();  ///< s_l [m], through which the line of force passes
  Eigen::Vector3d moment_W = Eigen::Vector3d::Zero();  ///< contact moment [N m], constant over the phase; along the
                                                       ///< surface's normal under laws::Wrench
  std::vector<Eigen::Vector3d> points_W;               ///< [m] where forces act, e.g. the corners of the sole
  std::vector<Eigen::Vector3d>
      point_forces_W;  ///< [N] node by node, a force for each point: Phase::node_count() x points
  Eigen::Vector3d center_of_pressure_W = Eigen::Vector3d::Zero();  ///< a_l [m], where the force acts under laws::Wrench
};

/// A stretch of time with constant contacts.
struct Phase {
  static constexpr int max_intervals = 100000;

  double duration = 0.0;          ///< [s]
  std::vector<Contact> contacts;  ///< one per end-effector
  ForceLaw law;                   ///< how forces depend on time; laws::Pendulum where nothing is said
  int intervals = 0;              ///< of the forces at points, equally long; 0 where there are none

  /// Whether forces act at points, not as one force that follows the CoM.
  bool has_points() const {
    return std::visit([](auto kind) { return kind.has_points; }, law);
  }

  /// Whether the angular momentum is a state, Knot::angular_momentum_W, not what the base has by its rates.
  bool has_momentum() const {
    return std::visit([](auto kind) { return kind.has_momentum; }, law);
  }

  /// Whether contacts have wrenches: a force at a centre of pressure of their own, and a moment about the normal, which
  /// together turn the base.
  bool has_wrenches() const {
    return std::visit([](auto kind) { return kind.has_wrenches; }, law);
  }

  /// Instants at which forces are given: `intervals` when held (at the begin of each), one more when linear.
  int node_count() const {
    return std::visit([this](auto kind) { return kind.node_count(intervals); }, law);
  }
};

/// State at the instant between two phases.
struct Knot {
  Eigen::Vector3d com_W = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Vector3d com_velocity_W = Eigen::Vector3d::Zero();      ///< [m/s]
  Eigen::Vector3d base_rpy = Eigen::Vector3d::Zero();            ///< roll, pitch, yaw of the base [rad]
  Eigen::Vector3d base_rpy_rate = Eigen::Vector3d::Zero();       ///< [rad/s]
  std::vector<Eigen::Vector3d> end_effectors_W;                  ///< [m]
  std::vector<Eigen::Vector3d> end_effector_velocities_W;        ///< [m/s], zero at contacts; of the spline (Swing)
  Eigen::Vector3d angular_momentum_W = Eigen::Vector3d::Zero();  ///< about the CoM [kg m^2/s]; see Plan
  std::vector<double> end_effector_yaw;  ///< heading of each sole [rad]; empty: all head where the base does
};

/// A stretch of phases in which an end-effector is free. Its path is the C2 quintic spline through the knots (zero
/// acceleration there) plus a lift
///
///     L(s) = b(s) height n(s),   b = 96/5 x^3 / (x + 1/20),   x = s (1-s),   s = 0..1 over the swing:
///
/// it leaves and arrives near the normals of the surfaces, with zero velocity and acceleration. Where a swing is under
/// way at the plan's start, the first knot has some of the lift already: there L goes on from s_0 = elapsed_s /
/// (elapsed_s + time left), less the quintic that leads from L(s_0) and its rate to nothing at the end. Where a path
/// would leave the reach box, it bends, with continuous velocity, into the box's side (docs/theory/ddp.md,
/// "Continuous-time plan").
struct Swing {
  int end_effector = 0;
  int first_phase = 0, end_phase = 0;  ///< phases first_phase .. end_phase - 1
  double height = 0.0;                 ///< [m]
  /// Of the surface it leaves; of a sole that is in the air at the plan's start, and lifted from there, the sole's.
  Eigen::Vector3d lift_normal_W = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d land_normal_W = Eigen::Vector3d::UnitZ();
  double elapsed_s = 0.0;  ///< [s] since lift-off, at the plan's start; 0 where the swing begins in the plan
};

/// An end-effector at an instant.
struct EndEffectorState {
  int surface = -1;                      ///< index into scene.surfaces, -1: free
  Eigen::Vector3d position_W;            ///< [m]
  Eigen::Vector3d velocity_W;            ///< [m/s]
  Eigen::Vector3d force_W;               ///< contact force on the robot [N], zero when free
  Eigen::Vector3d moment_W;              ///< contact moment on the robot about position_W [N m], zero when free
  Eigen::Vector3d center_of_pressure_W;  ///< where the force acts [m]; position_W when free
  double yaw = 0.0;                      ///< heading of the sole [rad]
  std::vector<Eigen::Vector3d> points_W, point_forces_W;  ///< [m], [N] where the law has forces at points
};

/// The robot at an instant.
struct PlanState {
  double time = 0.0;  ///< [s]
  int phase = 0;
  Eigen::Vector3d com_W, com_velocity_W, com_acceleration_W;  ///< [m], [m/s], [m/s^2]
  Eigen::Vector3d base_rpy, base_rpy_rate;                    ///< [rad], [rad/s]
  Eigen::Vector4d base_quat_wxyz;                             ///< R_WB
  Eigen::Vector3d angular_momentum_W;                         ///< about the CoM [kg m^2/s]
  std::vector<EndEffectorState> end_effectors;
};

/// A motion: phases with constant contacts between knots. Plain data; carries the scene and the robot it was made for.
///
/// What moves the CoM, turns the base and changes the angular momentum, each phase's force law says
/// (plan/force_laws.hpp). Where the angular momentum is no state, Knot::angular_momentum_W is not looked at.
class Plan {
 public:
  Scene scene;
  Robot robot;
  std::string planner;      ///< e.g. "ddp"
  std::vector<Knot> knots;  ///< phases + 1
  std::vector<Phase> phases;
  std::vector<int> final_contacts;  ///< surface index per end-effector after the last phase
  std::vector<Swing> swings;
  bool measured_start = false;  ///< starts from a measured state, not from the scene's start
  bool open_end = false;        ///< ends on the way, not at the scene's goal: a piece of a receding horizon

  /// Time [s] within which what the measured start violates by itself has to be made good; above zero with
  /// measured_start alone. Which limits that is about, and how the checker forgives them: checker.hpp.
  double start_slack_s = 0.0;

  /// Largest component of the angular momentum about the CoM [kg m^2/s], in the axes of the start's heading, and of its
  /// rate [N m], that the plan claims to keep at all times; infinite: it claims nothing.
  double momentum_max = std::numeric_limits<double>::infinity();
  double momentum_rate_max = std::numeric_limits<double>::infinity();

  double duration() const;                 ///< [s]
  std::vector<double> knot_times() const;  ///< [s], phases + 1 entries, from 0
  int end_effector_count() const { return static_cast<int>(robot.end_effectors.size()); }

  /// Surface index per phase and end-effector, -1: free.
  std::vector<std::vector<int>> contact_sequence() const;

  /// State at time t [s] in [0, duration], in closed form. At a knot the phase that begins there is meant (the last
  /// one at the end). Throws InvalidInput outside, InvalidPlan where what is asked for does not fit together (this is
  /// no validate(): what the instant does not need is not looked at).
  PlanState at(double t) const;

  /// State at `since_start` [s] in [0, duration] after the start of phase k: like at(), but says which side of a knot
  /// is meant. Throws as at().
  PlanState at_phase(int k, double since_start) const;

  /// Throws InvalidPlan when sizes or indices do not fit together or a number is not finite.
  void validate() const;

  /// Writes a JSON file, which is complete or not there at all: load_plan() and Python read it. Throws InvalidInput for
  /// another ending than .json, InvalidPlan, std::filesystem::filesystem_error.
  void save(const std::string& path) const;
};

}  // namespace mcplan
