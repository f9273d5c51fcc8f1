#pragma once

#include <Eigen/Core>

#include "base/base_rotation.hpp"
#include "base/entire_functions.hpp"
#include "ddp/layout.hpp"
#include "mcplan/ddp/options.hpp"

namespace mcplan::ddp {

/// Value and Jacobian of a step of the Pendulum over a time t. The part of p and v is a few scalars and vectors, not a
/// dense matrix, and is stored as such.
struct PendulumStep {
  double duration = 0.0;                        ///< t
  double slope = 1.0;                           ///< dt/dh: the fraction of the phase at an instant inside it
  double pp = 1.0;                              ///< dp+/dp = dv+/dv (times the identity)
  double pv = 0.0;                              ///< dp+/dv
  double vp = 0.0;                              ///< dv+/dp
  double p_end = 0.0;                           ///< dp+/ds_l = p_end * mu_l
  double v_end = 0.0;                           ///< dv+/ds_l = v_end * mu_l
  Eigen::VectorXd mu;                           ///< mu_l
  Eigen::Matrix3Xd p_mu, v_mu;                  ///< d/d(stiffness input l)
  Eigen::Vector3d com, velocity, acceleration;  ///< p+, v+ and v+'; also dp+/dt, dv+/dt
  Eigen::VectorXd angle, momentum;              ///< theta+, L+ (by active axis)
  Eigen::MatrixXd turn;                         ///< d[theta+; L+]/dz, dense, zero in the columns of the strides
  Eigen::MatrixXd angle_inverse;                ///< (d theta+/d theta)^-1
};

/// Multi-contact pendulum in closed form, over a time t of one phase. With s_l = p_l + c_l + r_l, a_l = p_l + c_l,
///
/// the force on an end-effector is f_l = mu_l (p - s_l), acting at a_l. Then, with sums over the end-effectors
///
///     Lambda = sum mu_l,   z = Lambda t^2,   a = Lambda p - sum mu_l s_l - g
///
///     p(t) = p + t F_1(z) v + t^2 F_2(z) a
///
///     v(t) = F_0(z) v + t F_1(z) a
///
///     P(t) = t p + t^2 F_2(z) v + t^3 F_3(z) a,   the integral of p
///
///     L(t) = L + P(t) x rho + t kappa,   rho = sum mu_l r_l,   kappa = sum (tau_l - mu_l a_l x r_l)
///
/// with the entire functions F_n (base/entire_functions.hpp): no case distinction, exact in flight. Non-dimensional:
/// mass 1, g = e_z. The base turns by theta' = E(theta) R I^-1 R^T L (base/base_rotation.hpp).
///
/// Model::lipm is Tazaki's (sec. II): without c_l and r_l, so that forces act at p_l and point at the CoM, and with
/// E = R = 1, so that theta(t) = theta + t I^-1 L + t^2/2 I^-1 sum_l tau_l.
class Pendulum {
 public:
  Pendulum() = default;
  Pendulum(const Layout& layout, const Eigen::Vector3d& inertia, StiffnessInput input, Model model);

  const Layout& layout() const { return layout_; }

  /// mu_l of an input, whichever way it is parametrised.
  double mu(const Eigen::VectorXd& u, int l) const;

  /// Value and derivatives at `fraction` of the phase (1: its end). Reuses the memory of `out`.
  void step(const Eigen::VectorXd& x, const Eigen::VectorXd& u, double fraction, PendulumStep& out) const;

  /// What drives a phase: the sums over the end-effectors, the same at all its instants.
  struct Drive {
    double total = 0.0;  ///< Lambda
    Eigen::Vector3d p, v, pull, acceleration, angle, momentum, rho, kappa;
  };
  Drive drive(const Eigen::VectorXd& x, const Eigen::VectorXd& u) const;

  /// The part of step() that is the CoM's: all but the angles, the momenta and their derivatives. Returns the entire
  /// functions of Lambda t^2.
  EntireFunctions sway(const Drive& drive, const Eigen::VectorXd& x, const Eigen::VectorXd& u, double fraction,
                       PendulumStep& out) const;

  /// theta' under a momentum, by all three axes.
  RpyRate base_rate(const Eigen::Vector3d& angle, const Eigen::Vector3d& momentum) const;

  /// p(t) and theta(t) at several instants of a phase, for cost evaluations. Angles by axis: those not in the layout
  /// are 0.
  class Course {
   public:
    Course(const Pendulum& pendulum, const Drive& drive)
        : pendulum_(&pendulum), drive_(drive), turning_(drive.angle, drive.momentum, pendulum.inertia_) {}
    void at(double t, Eigen::Vector3d& com, Eigen::Vector3d& angle) const;
    Eigen::Vector3d velocity(double t) const;  ///< v(t)

   private:
    const Pendulum* pendulum_;
    Drive drive_;
    BaseRotation turning_;
  };

  /// x+ = f(x, u).
  void next(const Eigen::VectorXd& x, const Eigen::VectorXd& u, Eigen::VectorXd& x_next) const;

  /// x with f(x, u) = x_next (the paper's f-hat): the closed form with -h; theta, where it is not linear, by Newton.
  void previous(const Eigen::VectorXd& x_next, const Eigen::VectorXd& u, Eigen::VectorXd& x) const;

  // Products with the Jacobian [A B] = [df/dx df/du] that never form it.

  /// out = A dx + B du.
  void apply(const PendulumStep& s, const Eigen::VectorXd& dx, const Eigen::VectorXd& du, Eigen::VectorXd& out) const;
  /// g (nz) += [A B]^T v.
  void add_transposed(const PendulumStep& s, const Eigen::VectorXd& v, Eigen::Ref<Eigen::VectorXd> g) const;
  /// g (nz) += (dp+/dz)^T along_com + (d theta+/dz)^T along_angle (by active axis).
  void add_along(const PendulumStep& s, const Eigen::Vector3d& along_com, const Eigen::Vector3d& along_angle,
                 Eigen::Ref<Eigen::VectorXd> g) const;
  /// g (nz) += (dv+/dz)^T along.
  void add_along_velocity(const PendulumStep& s, const Eigen::Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const;
  /// Substitution of x = A^-1 (x' - B u) into [x u]: in place on the columns of M (r x nz) = M T, T = [[A^-1, -A^-1 B],
  /// [0, I]].
  void substitute_inverse(const PendulumStep& s, Eigen::MatrixXd& m) const;
  /// out = A^-1 v.
  void apply_inverse(const PendulumStep& s, const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  /// Dense [A B] (nx x nz), for tests.
  Eigen::MatrixXd dense_jacobian(const PendulumStep& s) const;

 private:
  Eigen::Vector3d momentum_at(const Drive& drive, const EntireFunctions& f, double t) const;
  /// A time t = slope h within a phase of duration h, with the entire functions of Lambda t^2.
  struct Time {
    const EntireFunctions& f;
    double t, slope;
  };
  void momentum_jacobian(const Drive& drive, const Eigen::VectorXd& x, const Eigen::VectorXd& u, const Time& time,
                         Eigen::Ref<Eigen::Matrix3Xd> out) const;
  void turn_rows(const Drive& drive, const Eigen::VectorXd& x, const Eigen::VectorXd& u, const EntireFunctions& f,
                 PendulumStep& s) const;

  Layout layout_;
  Eigen::Vector3d inertia_ = Eigen::Vector3d::Ones();
  StiffnessInput input_ = StiffnessInput::mu;
  Model model_ = Model::wrench;
  // Scratch: one object serves one thread.
  mutable Eigen::Matrix3Xd by_middle_, by_end_;  ///< dL/dz at the middle and the end of a step
  mutable Eigen::MatrixXd pushed_, turned_;
};

}  // namespace mcplan::ddp
