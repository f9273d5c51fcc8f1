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

/// A push is taken to last for this much longer, over the time for which it has lasted.
constexpr double kLastsRatio = 2.0;

/// How far beside the measured CoM to plan from, in the direction of the push [m]; the controller's references of the
/// CoM are then as far on the other side of the plan's. `omega` is sqrt(g / h) of the pendulum [1/s].
///
/// A pendulum that is pushed by an acceleration a moves as c'' = omega^2 (c - p) + a, so c + a / omega^2 moves as one
/// that is not: a plan from there has its steps where they hold the robot that leans against the push. A push that ends
/// after T moves the capture point c + c' / omega by (1 - exp(-omega T)) a / omega^2 in all. How long it lasts nobody
/// knows; that it goes on for as long as it has, more or less, is the usual guess (Lindy's). Throws InvalidInput.
Eigen::Vector3d com_shift_W(const FeltPush& push, double omega);

/// Feels pushes by the CoM's velocity. Call update() once a control step.
///
/// With the measured velocity v, the acceleration u that the controller's model promised, and poles at -w,
///
///   d/dt v_hat = u + a_hat + 2 w (v - v_hat),   d/dt a_hat = w^2 (v - v_hat),
///
/// a_hat is the push's acceleration. What is below a dead zone is none: 0.15 m/s^2, or three standard deviations of
/// what the noise of v makes of a_hat. A push that turns has lasted for as long as it would take to have given the
/// impulse in its direction that was felt.
class PushObserver {
 public:
  /// @param velocity_W  of the CoM on the level, as measured [m/s]
  /// @param promised_W  acceleration since the last call, by the controller's model [m/s^2]; none: contacts are not
  ///                    those of which the model thought, or it had no solution. The push then fades.
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
  bool started_ = false;
  FeltPush push_;
};

}  // namespace mcplan::online
