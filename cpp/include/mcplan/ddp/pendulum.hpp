#pragma once

#include <Eigen/Core>

#include "mcplan/ddp/layout.hpp"
#include "mcplan/ddp/options.hpp"

namespace mcplan::ddp {

/// Multi-contact linear inverted pendulum in closed form (Tazaki, sec. II), over a time tau of one phase:
///
///     p'' = Lambda p - sum_l mu_l p_l - g,   Lambda = sum_l mu_l,   a = Lambda p - sum_l mu_l p_l - g,   z = Lambda
///     tau^2 p(tau) = p + tau F_1(z) v + tau^2 F_2(z) a          v(tau) = F_0(z) v + tau F_1(z) a theta(tau) = theta +
///     tau omega + tau^2/2 I^-1 sum_l tau_l      omega(tau) = omega + tau I^-1 sum_l tau_l
///
/// with the entire functions F_n (base/entire_functions.hpp): no case distinction, exact in flight. Non-dimensional:
/// g = e_z. Its Jacobian is a few scalars and vectors, not a dense matrix, and is stored as such.
struct PendulumStep {
  double duration = 0.0;                        ///< tau
  double slope = 1.0;                           ///< dtau/dh: the fraction of the phase at an instant inside it
  double pp = 1.0;                              ///< dp+/dp = dv+/dv (times the identity)
  double pv = 0.0;                              ///< dp+/dv
  double vp = 0.0;                              ///< dv+/dp
  double p_end = 0.0;                           ///< dp+/dp_l = p_end * mu_l
  double v_end = 0.0;                           ///< dv+/dp_l = v_end * mu_l
  Eigen::VectorXd mu;                           ///< mu_l
  Eigen::Matrix3Xd p_mu, v_mu;                  ///< d/d(stiffness input l)
  Eigen::Vector3d com, velocity, acceleration;  ///< p+, v+ and v+'; also dp+/dtau, dv+/dtau
  Eigen::VectorXd angle, rate, spin_up;         ///< theta+, omega+, I^-1 sum tau_l (by active axis)
  Eigen::VectorXd per_moment;                   ///< 1 / inertia of the axis of each moment input
};

class Pendulum {
 public:
  Pendulum() = default;
  Pendulum(const Layout& layout, const Eigen::Vector3d& inertia, StiffnessInput input);

  const Layout& layout() const { return layout_; }

  /// mu_l of an input, whichever way it is parametrised.
  double mu(const Eigen::VectorXd& u, int l) const;

  /// Value and derivatives at `fraction` of the phase (1: its end). Reuses the memory of `out`.
  void step(const Eigen::VectorXd& x, const Eigen::VectorXd& u, double fraction, PendulumStep& out) const;

  /// p(fraction h) alone, for cost evaluations.
  Eigen::Vector3d com_at(const Eigen::VectorXd& x, const Eigen::VectorXd& u, double fraction) const;

  /// theta(fraction h) of an active base axis alone, likewise.
  double angle_at(const Eigen::VectorXd& x, const Eigen::VectorXd& u, double fraction, int axis) const;

  /// x+ = f(x, u).
  void next(const Eigen::VectorXd& x, const Eigen::VectorXd& u, Eigen::VectorXd& x_next) const;

  /// x with f(x, u) = x_next (the paper's f-hat), by running the closed form with -h.
  void previous(const Eigen::VectorXd& x_next, const Eigen::VectorXd& u, Eigen::VectorXd& x) const;

  // Products with the Jacobian [A B] = [df/dx df/du] that never form it: O(rows * nz).

  /// out (r x nz) = M [A B] for M (r x nx).
  void times_jacobian(const PendulumStep& s, const Eigen::MatrixXd& m, Eigen::MatrixXd& out) const;
  /// out = A dx + B du.
  void apply(const PendulumStep& s, const Eigen::VectorXd& dx, const Eigen::VectorXd& du, Eigen::VectorXd& out) const;
  /// g (nz) += [A B]^T v.
  void add_transposed(const PendulumStep& s, const Eigen::VectorXd& v, Eigen::VectorXd& g) const;
  /// Substitution of x = A^-1 (x' - B u) into [x u]: in place on the columns of M (r x nz) = M T, T = [[A^-1, -A^-1 B],
  /// [0, I]].
  void substitute_inverse(const PendulumStep& s, Eigen::MatrixXd& m) const;
  /// out = A^-1 v.
  void apply_inverse(const PendulumStep& s, const Eigen::VectorXd& v, Eigen::VectorXd& out) const;
  /// Dense [A B] (nx x nz), for tests.
  Eigen::MatrixXd dense_jacobian(const PendulumStep& s) const;

 private:
  Layout layout_;
  Eigen::VectorXd axis_inertia_;
  StiffnessInput input_ = StiffnessInput::mu;
};

}  // namespace mcplan::ddp
