#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mcplan/base/logging.hpp"
#include "mcplan/nlp/piece.hpp"

namespace mcplan::nlp {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The stages (instants of the horizon) at which a variable is in use. A state or an input has one; what lasts, such as
/// a phase's duration or a foothold, has several, and is a state of each of them to a solver that goes stage by stage.
struct Stages {
  int first = 0, last = 0;
};

/// Entry of a sparse matrix.
struct Entry {
  int row = 0, column = 0;
};

/// Sparse nonlinear program
///
///     min sum_j f_j(x)    s.t.  lower <= g_i(x) <= upper,  x_lower <= x <= x_upper
///
/// put together from pieces, in the order in which they are added. Knows no solver.
class Problem {
 public:
  /// Returns the index of the first of `count` new variables. The name serves messages: "force[3] at stage 7".
  int add_variables(const std::string& name, int count, double lower, double upper, Stages stages);
  void set_bounds(int variable, double lower, double upper);

  void add_constraint(std::unique_ptr<Piece> piece, Eigen::VectorXd lower, Eigen::VectorXd upper);
  void add_constraint(std::unique_ptr<Piece> piece, double lower, double upper);  ///< the same for every row
  void add_equality(std::unique_ptr<Piece> piece) { add_constraint(std::move(piece), 0.0, 0.0); }

  /// Every row of the piece is added to the cost.
  void add_cost(std::unique_ptr<Piece> piece);

  /// Find the sparse structure; to be called once, before anything below. Entries that are zero at three random points
  /// are taken to be zero everywhere: a piece with branches in which other entries appear must say so.
  /// `stop` is polled at every piece; where it asks to stop, false is returned, and the problem is of no use.
  bool finish(const StopRequest& stop = {});

  /// Instead of finish(), which evaluates derivatives: values of costs and rows alone can be asked for then.
  void finish_for_values();

  int variable_count() const { return static_cast<int>(lower_.size()); }
  int row_count() const { return row_count_; }
  int equality_count() const;
  const std::vector<double>& variable_lower() const { return lower_; }
  const std::vector<double>& variable_upper() const { return upper_; }
  const std::vector<double>& row_lower() const { return row_lower_; }
  const std::vector<double>& row_upper() const { return row_upper_; }
  const std::vector<Entry>& jacobian_structure() const { return jacobian_; }
  const std::vector<Entry>& hessian_structure() const { return hessian_; }  ///< lower triangle

  double cost(const ConstVector& x) const;
  void gradient(const ConstVector& x, Vector out) const;
  void rows(const ConstVector& x, Vector out) const;
  void jacobian(const ConstVector& x, Vector values) const;  ///< in the order of jacobian_structure()

  /// cost_factor * Hessian of the cost + sum_i multipliers_i * Hessian of row i, in the order of hessian_structure().
  void hessian(const ConstVector& x, double cost_factor, const ConstVector& multipliers, Vector values) const;
  void gauss_newton_hessian(const ConstVector& x, Vector values) const;  ///< of the cost

  /// Largest violation of a bound or a row.
  struct Worst {
    std::string name;  ///< e.g. "friction[2] of stage 7"
    double value = 0.0;
  };
  Worst worst_violation(const ConstVector& x) const;

  /// The first piece with a value or derivative that is not finite at x, e.g. "cost acceleration at stage 3"; or "".
  std::string first_not_finite(const ConstVector& x) const;

  std::string variable_name(int variable) const;  ///< "com[2] at stage 7"
  std::string row_name(int row) const;            ///< "momentum_rate[0] at stage 7"
  Stages variable_stages(int variable) const { return stages_[variable]; }

  /// The stage of the piece's states and inputs, or the two neighbours that a transition joins; what lasts is in use
  /// there and does not count.
  Stages piece_stages(const Piece& piece) const;

  struct Block {
    std::unique_ptr<Piece> piece;
    int first_row = -1;  ///< -1: a cost
    bool is_cost() const { return first_row < 0; }
    std::vector<int> jacobian_at, jacobian_from;  ///< place among the values, place in the dense block
    std::vector<int> hessian_at, hessian_from;
  };
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  std::string piece_name(const Block& block) const;
  ConstVector gather(const Block& block, const ConstVector& x) const;  ///< the piece's variables, in x_
  Eigen::Map<Eigen::MatrixXd> zeroed(int rows, int columns,
                                     const std::vector<int>& entries) const;  ///< a dense block, in buffer_

  struct Group {
    std::string name;
    int first = 0;
  };
  std::vector<Group> groups_;
  std::vector<double> lower_, upper_, row_lower_, row_upper_;
  std::vector<Stages> stages_;
  std::vector<Block> blocks_;
  std::vector<Entry> jacobian_, hessian_;
  int row_count_ = 0;
  mutable Eigen::VectorXd x_, f_, weights_, buffer_;  ///< workspace of the evaluations
  Eigen::VectorXd linear_jacobian_;                   ///< values of the linear pieces, zero elsewhere
};

}  // namespace mcplan::nlp
