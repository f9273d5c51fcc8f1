#pragma once

#include <array>
#include <vector>

#include "certify_trajectories.hpp"

namespace mcplan::sip::proof {

/// A vector in the world that changes with time.
struct Vector {
  TaylorModel x, y;

  Vector& operator+=(const Vector& other);
  Vector operator+(const Vector& other) const { return Vector(*this) += other; }
  Vector operator-() const { return {-x, -y}; }
  Vector& add_scaled(double factor, const Vector& other, double factor_error = 0.0);
};
TaylorModel cross(const Vector& a, const Vector& b);

/// A vector of constants, each known up to `error`.
struct Constant {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  double error = 0.0;
};

/// A contact of a phase: where it should be, its directions, and its sole in the body's frame.
struct ContactFrame {
  int end_effector = 0, surface = 0, body = 0;
  Constant position_W, tangent_W, normal_W;
  Constant position_B, along_B;  ///< the sole's origin and x axis
  double angle = 0.0, angle_B = 0.0;
  int first_point = 0;  ///< of the phase
  std::vector<double> points;
};

/// What is constant over a phase. Forces follow from the motion by the gain that least_norm_gain() gives: the gain is
/// part of the plan, as numbers. Their sum then differs from what it should be by `leak` of it.
struct PhaseConstants {
  std::vector<ContactFrame> contacts;
  int points = 0;
  Eigen::MatrixXd gain;  ///< empty: forces are polynomials
  Eigen::Vector2d moment_point_W = Eigen::Vector2d::Zero();
  Eigen::Matrix3d leak = Eigen::Matrix3d::Zero();  ///< bounds of the entries of 1 - G gain
};
PhaseConstants phase_constants(const PlanarPlan& plan, int phase);

/// Kinematics and dynamics over a piece of an interval as Taylor models. Accelerations come from
///
///     d2/dt2 (R r) = R (theta'' J r - theta'^2 r),    J r: r turned to its left
///
/// with the exact polynomials theta', theta'': no remainder is ever differentiated. Newton-Euler in world axes, about
/// each joint; contact forces act at the actual points.
class PieceModels {
 public:
  PieceModels(const PlanarPlan& plan, const PhaseConstants& constants, const Trajectories& piece, int order,
              std::vector<UncertainPolynomial> forces = {});

  void kinematics();  ///< once, before all that follows
  void dynamics();

  /// A point of a body in the world, and from the base's origin.
  Vector point_W(int body, const Constant& point_B) const { return base_W_ + from_base(body, point_B); }
  Vector from_base(int body, const Constant& point_B) const;

  // After kinematics():
  std::vector<Vector> contact_errors;  ///< actual minus expected position [m]
  std::vector<UncertainPolynomial> contact_angle_errors;

  // After dynamics():
  std::vector<TaylorModel> torques;             ///< [N m]
  std::vector<TaylorModel> tangential, normal;  ///< of each point [N]
  Vector force_residual;                        ///< that nothing carries [N]
  TaylorModel moment_residual;                  ///< about the base's origin [N m]

 private:
  TaylorModel zero() const { return TaylorModel::constant(order_, 0.0); }
  Vector zero_vector() const { return {zero(), zero()}; }
  Vector constant(const Constant& c) const;
  Vector rotated(int body, const Constant& v_B) const;               ///< R v
  Vector rotated_acceleration(int body, const Constant& v_B) const;  ///< d2/dt2 (R v)
  void accelerations();
  void inertial_forces();
  void contact_forces();
  void contact_torques();
  void residuals();

  const PlanarPlan& plan_;
  const PlanarRobot& robot_;
  const PhaseConstants& constants_;
  const Trajectories& piece_;
  std::vector<UncertainPolynomial> force_polynomials_;
  int order_;

  std::vector<TaylorModel> cosine_, sine_, cosine_acceleration_, sine_acceleration_;
  std::vector<Vector> origin_;  ///< of the bodies, relative to the base
  Vector base_W_;
  std::vector<Vector> com_acceleration_;
  std::vector<Vector> inertial_force_;        ///< m (a - g) of a body and all that hang on it
  std::vector<TaylorModel> inertial_moment_;  ///< about its joint
  std::vector<Vector> point_forces_;          ///< in the world
  std::vector<Vector> contact_forces_;        ///< of a contact: sum, and sum of its points' places times theirs
  std::vector<Vector> contact_first_moments_;
  std::array<TaylorModel, 3> desired_;  ///< [m (a - g); moment about the moment point]
};

}  // namespace mcplan::sip::proof
