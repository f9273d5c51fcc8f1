#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "ddp/constants.hpp"
#include "ddp/contact_sequence.hpp"
#include "ddp/cost_terms.hpp"
#include "ddp/instants.hpp"
#include "ddp/pendulum.hpp"
#include "ddp/problem.hpp"
#include "ddp/rows.hpp"
#include "ddp/schedule.hpp"

namespace mcplan::ddp {

/// c + g'd + 1/2 d'Hd in a deviation d.
struct Quadratic {
  double c = 0.0;
  Eigen::VectorXd g;
  Eigen::MatrixXd h;

  /// Make H's lower triangle the mirror image of the upper one, which is what stages are assembled in.
  void mirror() { h.triangularView<Eigen::StrictlyLower>() = h.transpose(); }
};

/// The problem about a trajectory: dynamics to first order, costs to second order (Gauss-Newton), one stage a step.
/// What depends on the contact state is kept apart, as blocks of rows per end-effector and contact, so that any contact
/// sequence can be assembled from it.
class LocalModel {
 public:
  explicit LocalModel(const Problem& problem);

  const Problem& problem() const { return *problem_; }
  const Pendulum& pendulum() const { return pendulum_; }
  int steps() const { return problem_->steps; }

  /// Expand about a trajectory. Invalidates all blocks.
  void expand(const Trajectory& trajectory, const Schedule& schedule);

  /// x_{k+1} = f(x_k, u_k): Jacobian and defect f(x_k, u_k) - x_{k+1}.
  const PendulumStep& dynamics(int k) const { return stages_[k].dynamics; }
  const Eigen::VectorXd& defect(int k) const { return stages_[k].defect; }

  /// Cost of step k that does not depend on the contact state, with the proximal term; over z, at k = N over x. Of H
  /// the upper triangle.
  const Quadratic& base(int k) const { return stages_[k].base; }

  /// Rows of end-effector l of step k with this contact (a surface or kFree). Computed at the first call: make those
  /// that are needed before reading from several threads.
  const Rows& block(int k, int l, int contact);

  /// Rows that stand for the state as a whole: those of a flight, or none. Same caveat.
  const Rows* state_block(int k, const ContactState& state);

  /// Add the rows of a contact state to a quadratic over z (over x at k = N), to H's upper triangle. Several threads
  /// may do so at once where the blocks have been made before: make_blocks().
  void add_contacts(int k, const ContactState& state, Quadratic& q);

  /// Make the blocks of a contact state of step k, before threads read them.
  void make_blocks(int k, const ContactState& state);

 private:
  StepView view(int k) const;

  struct Block {
    Rows rows;
    long made = 0;  ///< the expansion that it belongs to
  };
  struct Stage {
    PendulumStep dynamics;
    Eigen::VectorXd defect;
    Quadratic base;
    Instants instants;
    /// [l][choice], choice 0: free, i + 1: surfaces(l)[i]; made when asked for, since most never are.
    std::vector<std::vector<std::unique_ptr<Block>>> blocks;
    Rows flight;
    bool flight_made = false;
  };

  const Problem* problem_;
  Pendulum pendulum_;
  const Trajectory* trajectory_ = nullptr;
  Schedule schedule_;
  std::vector<Stage> stages_;
  std::vector<std::vector<int>> choice_;  ///< [l][surface]
  long expansion_ = 0;
  Rows base_rows_;
};

/// True (not modelled) cost and defects of a trajectory with a contact sequence.
struct Evaluation {
  double cost = 0.0;
  double defect_sum =
      0.0;  ///< over the knots, vectors by their Euclidean norm: the same wherever the scene is turned to
  double defect_max = 0.0;
  CostTerms terms{};

  /// Exact penalty: cost + rho |defect|.
  double merit() const { return cost + kDefectPenalty * defect_sum; }
};

class Evaluator {
 public:
  explicit Evaluator(const Problem& problem);
  Evaluation operator()(const Trajectory& trajectory, const ContactSequence& sequence, const Schedule& schedule);

 private:
  const Problem* problem_;
  Pendulum pendulum_;
  Rows rows_;
  Instants instants_;
  Eigen::VectorXd next_;
};

}  // namespace mcplan::ddp
