#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mcplan/planar/force_laws.hpp"
#include "mcplan/planar/robot.hpp"
#include "mcplan/planar/task.hpp"

namespace mcplan {

/// Contact force at one point of an end-effector.
struct PlanarPointForce {
  int contact = 0;  ///< index into the phase's contacts
  int end_effector = 0;
  int surface = 0;
  int point = 0;                          ///< index into the end-effector's points
  Eigen::Vector2d position_W, force_W;    ///< actual place of the point [m]; force on the robot [N]
  double tangential = 0.0, normal = 0.0;  ///< components of the force along the surface [N]
};

/// The robot at an instant.
struct PlanarState {
  double time = 0.0;  ///< [s]
  int phase = 0;
  PlanarConfiguration configuration;                        ///< base and joints: position, velocity, acceleration
  Eigen::VectorXd torque;                                   ///< of the joints [N m]
  Eigen::Vector3d base_residual = Eigen::Vector3d::Zero();  ///< force [N] and moment [N m] that nothing carries
  std::vector<PlanarPointForce> forces;
  std::vector<Eigen::Vector3d> contact_error;  ///< of each contact: actual minus expected x, y [m], angle [rad]
  Eigen::Vector2d com_W = Eigen::Vector2d::Zero(), com_velocity_W = Eigen::Vector2d::Zero();
  double angular_momentum = 0.0;  ///< about the CoM [kg m^2/s]
};

/// A motion of a planar robot: joint splines, phase durations and what fixes the contact forces. Everything
/// else follows in closed form at any instant: base, velocities, accelerations, forces, torques. Plain data; carries
/// the task it was made for.
///
/// Joints: one cubic B-spline each over the knots of all intervals, whose lengths are phase
/// duration / intervals of the phase. Interval k has the control points k .. k + 3.
///
/// Base: without base_control_points, where it brings the contacts closest to where they should be (eqs. 9-12):
///
///     angle = mean_i (expected_i - relative_i),    position = mean_i (expected_i - R(angle) relative_i)
///
/// Forces under planar_laws::LeastNorm, at points x_v with tangent t and outward normal n of the expected contacts,
/// about the mean p of the phase's expected points:
///
///     min 1/2 sum_v weight_v (10 f_t^2 + f_n^2)    s.t.  sum_v [f_v; (x_v - p) x f_v] = [m (a - g); moment about p]
///
/// which has a constant gain from the right-hand side to the forces in each phase.
class PlanarPlan {
 public:
  PlanarTask task;
  std::string planner;                             ///< e.g. "sip"
  std::vector<double> durations;                   ///< of the phases [s]
  Eigen::MatrixXd control_points;                  ///< joints x (intervals + 3) [rad]
  Eigen::MatrixXd base_control_points;             ///< 3 x (intervals + 3): x, y [m], angle [rad]; empty: computed
  PlanarForceLaw force_law;                        ///< planar_laws::LeastNorm where nothing is said
  std::vector<Eigen::VectorXd> weights;            ///< LeastNorm: of each phase, contact by contact, point by point
  std::vector<Eigen::MatrixXd> force_polynomials;  ///< Polynomial: of each interval, 4 x (2 * points of its phase):
                                                   ///< coefficients of s^0..s^3, s = -1..1, of tangential and normal
                                                   ///< force [N], contact by contact, point by point

  double duration() const;                 ///< [s]
  std::vector<double> knot_times() const;  ///< [s] phase boundaries, phases + 1 entries, from 0

  /// [s] Throws InvalidPlanarTask where a phase has no interval, or too many.
  std::vector<double> interval_lengths() const;

  /// State at time t [s] in [0, duration]. At a boundary the phase that begins there is meant (the last one at the
  /// end). Throws InvalidInput outside.
  PlanarState at(double t) const;

  /// State at `since_start` [s] after the start of phase k: like at(), but says which side of a boundary is meant.
  PlanarState at_phase(int k, double since_start) const;

  /// Throws InvalidPlan when sizes do not fit together, a duration or weight is not positive or a number is not finite.
  void validate() const;

  /// Writes a JSON file, which is complete or not there at all and which load_planar_plan() and Python read. Throws
  /// InvalidPlan, InvalidPlanarTask, InvalidRobot, InvalidInput where the name does not end in .json, and
  /// std::filesystem::filesystem_error.
  void save(const std::string& path) const;
};

/// Gain from [m (a - g); moment about p] to the forces (tangential, normal) of all points of a phase: (2 points) x 3.
/// weights: one for each point. Throws InvalidPlan where the points cannot balance a moment.
Eigen::MatrixXd least_norm_gain(const PlanarTask& task, int phase, const Eigen::VectorXd& weights);

/// The mean p of the phase's expected points [m], about which its moments are taken.
Eigen::Vector2d moment_point_W(const PlanarTask& task, int phase);

}  // namespace mcplan
