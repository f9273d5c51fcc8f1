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
/// a_hat is the push's acceleration, at most 3 m/s^2. Poles are at 150 1/s, or as far down to 20 1/s as keeps three
/// standard deviations of what the noise of v makes of a_hat below a dead zone of 0.15 m/s^2, in which nothing pushes;
/// with more noise than that they are the dead zone. While contacts are others than the model thinks, and for 30 ms
/// after it, nothing can be said, since soles have not settled, and what a landing does to the CoM is no push: what was
/// felt is held for a fifth of the time for which it had been felt, 0.3 s at most, and fades then. A push that turns
/// has lasted for as long as it would take to have given the impulse in its direction that was felt; a pause of 0.1 s
/// does not end it.
class PushObserver {
 public:
  /// @param velocity_W  of the CoM on the level, as measured [m/s]
  /// @param promised_W  acceleration since the last call, by the controller's model [m/s^2]; none: contacts are not
  ///                    those of which the model thought, or it had no solution.
  /// @param dt_s        since the last call, positive
  /// Of a velocity or an acceleration that no robot has, or that is no number, nothing can be said either. Throws
  /// InvalidInput for dt_s.
  const FeltPush& update(const Eigen::Vector2d& velocity_W, const std::optional<Eigen::Vector2d>& promised_W,
                         double dt_s);

  const FeltPush& push() const { return push_; }

 private:
  double set_poles(double dt_s);
  void observe(const Eigen::Vector2d& velocity_W, const Eigen::Vector2d& promised_W, double dt_s);
  void learn(const Eigen::Vector2d& noise_W, double dt_s);
  void tell(double dead_m_s2, double dt_s);

  Eigen::Vector2d velocity_W_ = Eigen::Vector2d::Zero();      // v_hat
  Eigen::Vector2d acceleration_W_ = Eigen::Vector2d::Zero();  // a_hat
  Eigen::Vector2d impulse_W_ = Eigen::Vector2d::Zero();       // of what is felt, over the mass [m/s]
  double felt_s_ = 0.0, quiet_s_ = 0.0;                       // for which anything is, and nothing since
  double settled_s_ = 0.0, unsure_s_ = 0.0;                   // for which something could be said, and not
  double learnt_s_ = 0.0, variance_ = 0.0;                    // of the noise of v [m^2/s^2]
  bool observed_ = false;                                     // anything yet
  double q_ = 1.0;                                            // exp(-w dt)
  FeltPush push_;
};

}  // namespace mcplan::online
