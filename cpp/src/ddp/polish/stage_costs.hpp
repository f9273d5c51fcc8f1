#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/cost_terms.hpp"
#include "ddp/polish/fixed_sequence.hpp"
#include "ddp/polish/motion.hpp"

namespace mcplan::ddp::polish {

/// A quadratic g'd + 1/2 d'Hd over the variables z of a knot.
struct StageModel {
  Eigen::VectorXd g;
  Eigen::MatrixXd h;
};

/// What is weighed and not held: distances to the reference and sizes of inputs (the term "task", durations), both
/// diagonal; footholds on their planes, by a large weight where they are chosen; and every term that limits.hpp does
/// not know, such as "keep_out", as the sum of squares that it writes.
class StageCosts {
 public:
  StageCosts(const FixedSequence& fixed, const Pendulum& pendulum, const Tuning& tuning);

  /// Their sum, with the constants of the contact sequence, so that it compares with Evaluation::cost.
  double value(const Motion& motion);

  /// The part of it that depends on the contact sequence alone.
  double constant() const { return constant_; }

  /// Add those of knot k, to second order (Gauss-Newton).
  void add(const Motion& motion, int k, StageModel& model);

  /// Slope of value() along a step of the variables, where add() has been asked for every knot last.
  double slope(const std::vector<Eigen::VectorXd>& dz) const;

 private:
  struct Diagonal {
    Eigen::VectorXd weight, target;  ///< 1/2 weight (z - target)^2, squares of the weights of the terms
  };
  struct Plane {
    int first, count;       ///< columns of z
    Eigen::Vector3d along;  ///< factors of these columns
    double offset, weight;  ///< 1/2 weight (along . z + offset)^2
  };
  double variable(const Motion& motion, int k, int column) const;
  double distance(const Motion& motion, int k, const Plane& plane) const;
  Rows& other_rows(const Motion& motion, int k, bool with_gradient);

  const FixedSequence* fixed_;
  const Pendulum* pendulum_;
  Schedule schedule_;
  double constant_ = 0.0;
  std::vector<Diagonal> diagonal_;
  std::vector<std::vector<Plane>> planes_;
  std::vector<Eigen::VectorXd> gradient_;  ///< by knot, of add()
  std::vector<std::vector<int>> columns_;  ///< by knot and entry of [x, u]: its column of z, or -1
  std::vector<const CostTerm*> of_step_, of_free_, of_contact_, of_flight_;
  Rows values_, gradients_;
  Instants instants_;
};

}  // namespace mcplan::ddp::polish
