#pragma once

#include <Eigen/Core>
#include <optional>

namespace mcplan::online {

/// What pushes a robot to a side, as its controller feels it.
struct FeltPush {
  Eigen::Vector2d acceleration_W = Eigen::Vector2d::Zero();  ///< of the CoM on the level, which the model does not
                                                             ///< explain [m/s^2]
  double lasted_s = 0.0;                                     ///< for which it has been felt

  /// Throws InvalidInput naming what is not finite or negative.
  void validate() const;
};

/// A push is taken to go on for so many times as long as it has lasted. Chosen: with 1 as many pushes of 1 s are
/// survived by TALOS, and fewer of 0.2 s.
constexpr double kLastsRatio = 2.0;

/// How far beside the measured CoM to plan from, in the direction of the push [m]; the controller's references of the
/// CoM are then as far on the other side of the plan's. Throws InvalidInput where the push is none, or the height of
/// the CoM [m] or gravity [m/s^2] is not positive.
///
/// A linear inverted pendulum of omega^2 = g / h that is pushed by an acceleration a moves as c'' = omega^2 (c - p) +
/// a, with its center of pressure p, so c + a / omega^2 moves as one that is not: a plan from there has its steps where
/// they hold the robot that leans against the push. A push that ends after T moves the capture point c + c' / omega by
/// (1 - exp(-omega T)) a / omega^2 in all. How long it lasts nobody knows; that it goes on in proportion to how long it
/// has is the usual guess (Lindy's).
Eigen::Vector3d com_shift_W(const FeltPush& push, double com_height, double gravity);

/// Feels pushes by the CoM's velocity (a Luenberger observer). Call update() once a control step.
///
/// With the measured velocity v, the acceleration u that the controller's model promised, and poles at -w,
///
///   d/dt v_hat = u + a_hat + 2 w (v - v_hat),   d/dt a_hat = w^2 (v - v_hat),
///
/// a_hat is the push's acceleration. For 30 ms after contacts were others than the model thought nothing is felt: soles
/// have not settled, and what a landing does to the CoM is no push. What is below a dead zone is none: 0.15 m/s^2, or
/// three standard deviations of what the noise of v makes of a_hat. A push that turns has lasted for as long as it
/// would take to have given the impulse in its direction that was felt.
class PushObserver {
 public:
  /// @param velocity_W  of the CoM on the level, as measured [m/s]
  /// @param promised_W  acceleration since the last call, by the controller's model [m/s^2]; none: contacts are not
  ///                    those of which the model thought, or it had no solution. The push fades then.
  /// @param dt_s        since the last call, positive
  /// A velocity or an acceleration that no robot has, or that is no number, is left out. Throws InvalidInput for dt_s.
  const FeltPush& update(const Eigen::Vector2d& velocity_W, const std::optional<Eigen::Vector2d>& promised_W,
                         double dt_s);

  const FeltPush& push() const { return push_; }

 private:
  Eigen::Vector2d velocity_W_ = Eigen::Vector2d::Zero();      // v_hat
  Eigen::Vector2d acceleration_W_ = Eigen::Vector2d::Zero();  // a_hat
  Eigen::Vector2d impulse_W_ = Eigen::Vector2d::Zero();       // of what is felt, over the mass [m/s]
  double felt_s_ = 0.0;                                       // for which anything is
  double variance_ = 0.0;                                     // of v - v_hat [m^2/s^2]
  double settled_s_ = 0.0;                                    // for which something has been promised
  bool started_ = false;
  FeltPush push_;
};

}  // namespace mcplan::online
