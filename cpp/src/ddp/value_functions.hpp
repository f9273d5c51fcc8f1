#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "ddp/local_model.hpp"
#include "ddp/step_jacobian.hpp"

namespace mcplan::ddp {

/// Backward value functions V_k (cost-to-go, Tazaki eq. 27) and forward ones U_k (cost-so-far, eq. 30) of a local model
/// with a contact sequence. The proximal term is part of the stage cost in both, so min U_k + V_k is the same number
/// for every k (eq. 31).
class ValueFunctions {
 public:
  explicit ValueFunctions(LocalModel& model);

  /// V_k for k = last..0 (last = N: all). V_j for j > last must be up to date. False when a Hessian is not positive
  /// definite.
  bool backward(const ContactSequence& sequence, int last);

  /// U_k for k = first+1..N; U_first must be up to date (U_0 = 0).
  bool forward(const ContactSequence& sequence, int first);

  /// What a step of the backward recursion leaves besides V_k: the feedback du = -R^-T (offset + Y' dx), and the stage
  /// cost of k plus V_{k+1} over z, of H the upper triangle, without the rows of the contact state at k.
  struct Feedback {
    Eigen::MatrixXd factor;  ///< [Y; R], nz x nu: eliminate_last()
    Eigen::VectorXd offset;
    Quadratic without_contacts;
  };

  /// One step of the backward recursion for any contact state: V_k from V_{k+1}. Threads that make the blocks of their
  /// states before (LocalModel::make_blocks) may step at once, each with value functions of its own.
  bool backward_step(int k, const ContactState& state, const Quadratic& next, Quadratic& value,
                     Feedback* feedback = nullptr);

  const Quadratic& V(int k) const { return V_[k]; }
  const Quadratic& U(int k) const { return U_[k]; }

  /// Stage cost of k plus V_{k+1} over z, of H the upper triangle, without the rows of the contact state at k.
  const Quadratic& without_contacts(int k) const { return feedback_[k].without_contacts; }

  /// min over x of U_k + V_k (eq. 31).
  double minimum(int k) const;

  /// Minimum of the model with `changed` instead of `sequence`, for which V and U stand: the backward recursion over
  /// the steps between the first and the last difference, then eq. (31) there. Infinite when a Hessian is not positive
  /// definite.
  double minimum_with(const ContactSequence& changed, const ContactSequence& sequence);

  /// Newton step of the whole trajectory (eqs. 28-29).
  void state_forward(std::vector<Eigen::VectorXd>& dx, std::vector<Eigen::VectorXd>& du);

 private:
  bool solve(Quadratic& z, Quadratic& value, Feedback* feedback);

  LocalModel* model_;
  Pendulum pendulum_;  ///< the model's, with scratch of its own: threads have value functions each
  std::vector<Quadratic> V_, U_;
  std::vector<Feedback> feedback_;
  // Scratch.
  Quadratic q_, from_, to_;
  StepJacobian jacobian_;
  Eigen::MatrixXd m_, mt_;
  Eigen::VectorXd w_, o_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace mcplan::ddp
