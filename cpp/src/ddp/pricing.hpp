#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "ddp/contact_sequence.hpp"
#include "ddp/local_model.hpp"
#include "ddp/value_functions.hpp"

namespace mcplan::ddp {

/// A contact sequence that differs from the present one at one step, and what it would cost.
struct Neighbour {
  int step = -1;
  ContactState state;
  double cost = 0.0;  ///< minimum of the local model with this sequence
};

/// Prices contact states of one step by their low rank. All else held, the cost of step k without its contact rows plus
/// U_k plus V_{k+1} is one quadratic W over z = [x_k, u_k]; a contact state adds rows e + R'z with precisions D, so
/// with the posterior mean m and covariance S = W^-1
///
///     J = J_0 + 1/2 y' (D^-1 + P)^-1 y,    y = e + R'm,    P = R'S R    (r x r, r = 8..30)
///
/// instead of a Riccati step and a minimisation per candidate (the paper's MINCOST, sec. IV-B). Only adding rows, never
/// removing stiff ones, keeps the digits.
class StepPricing {
 public:
  /// Factor W of step k and project every row that the candidates need. False when W is not positive definite.
  bool prepare(LocalModel& model, const ValueFunctions& values, int k, const std::vector<ContactState>& candidates);

  /// Minimum of the local model with `state` at the prepared step; one of the candidates.
  double price(const ContactState& state);

 private:
  struct Span {
    int end, contact, first, count;
  };
  /// A row of some contact: of one input alone (most are), or with a gradient of its own.
  struct Row {
    int input;    ///< offset in u, or -1
    int general;  ///< column of rows_, or -1
    double value, inverse_precision;
  };
  void add_row(const Rows& block, int r);
  double covariance(const Row& a, const Row& b) const;

  const Problem* problem_ = nullptr;
  std::vector<Span> spans_;
  std::vector<Row> table_;
  int general_count_ = 0;
  Eigen::MatrixXd w_, rows_, gram_, cross_, input_factor_, input_covariance_, small_;
  Eigen::VectorXd mean_, input_mean_, y_;
  Eigen::LLT<Eigen::MatrixXd> factor_, small_factor_;
  std::vector<int> picked_;
  double base_cost_ = 0.0;
};

/// Prices all neighbours of a sequence (Tazaki, Algorithm 2, lines 5-9).
class Pricing {
 public:
  explicit Pricing(int threads) : steps_(threads > 1 ? threads : 1) {}

  /// Every neighbour with its price, in the order of step and enumeration (independent of the thread count).
  const std::vector<Neighbour>& all(LocalModel& model, const ValueFunctions& values, const ContactSequence& sequence);

  double time_prepare_s = 0.0, time_price_s = 0.0;  ///< summed over threads, for reports
  int parallel_loops = 0;                           ///< calls of all() that were shared out over threads

 private:
  std::vector<StepPricing> steps_;  ///< one a thread
  std::vector<Neighbour> neighbours_;
};

/// The first of the cheapest, or null when there are none.
const Neighbour* cheapest(const std::vector<Neighbour>& neighbours);

}  // namespace mcplan::ddp
