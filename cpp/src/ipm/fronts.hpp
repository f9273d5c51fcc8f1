#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "ipm/pivoting.hpp"

namespace mcplan::ipm {

/// Factorisation P' L D L' P of a sparse symmetric matrix, unknowns group by group in a given order.
///
/// Each group has a front: the dense columns of its own unknowns, with rows for those that come later and share an
/// entry with them, directly or through groups before. Its own are eliminated with pivots of size one and two (Bunch,
/// Kaufman), chosen among them; what is left is subtracted from the columns of the groups whose unknowns they are.
/// Groups that are the stages of a horizon from its end to its begin make it a Riccati recursion, where what is handed
/// on is the cost-to-go; groups of a band whose arrow comes last make it the Cholesky factorisation of a band with an
/// arrow.
class Fronts {
 public:
  using Pair = std::pair<int, int>;

  /// order: the unknowns 0 ... count-1, group by group; pairs: entries that may be other than zero, in any order and
  /// triangle, repetitions allowed. What is on the diagonal need not be named.
  Fronts(int count, std::vector<std::vector<int>> order, const std::vector<Pair>& pairs);

  /// Where an entry of the matrix lies in values(); pairs as given, in the same order.
  const std::vector<int>& places() const { return places_; }
  const std::vector<int>& diagonal_places() const { return diagonal_; }

  void set_zero() { values_.setZero(); }
  double* values() { return values_.data(); }

  /// Up to which size a negative pivot of each unknown counts as zero: rounding errors of equalities that say the same.
  Eigen::VectorXd& least_pivots() { return least_pivots_; }

  /// Inertia of the matrix; zero: pivots too small to divide by.
  struct Inertia {
    int positive = 0, negative = 0, zero = 0;
    bool too_many_negative = false;  ///< more than may be, and counted no further
  };

  /// Factorise what is in values(), which is overwritten. most_negative: how many pivots may be negative up to each
  /// front; empty: any number.
  Inertia factor(const std::vector<int>& most_negative = {});

  /// Replace b by the solution.
  void solve(Eigen::VectorXd& b) const;

  /// The same of two right sides, which share the reading of the factor.
  void solve(Eigen::VectorXd& a, Eigen::VectorXd& b) const;

  int largest_front() const;
  long entries() const { return values_.size(); }

 private:
  struct Front {
    int own = 0;
    int first_column = 0;       ///< of this front's own unknowns, among all
    long offset = 0;            ///< of its own columns in values_
    long first_update = 0;      ///< of its places among updates_
    int stride = 0;             ///< from column to column: rows beyond size() are zero, so that chunks need no tails
    std::vector<int> unknowns;  ///< own ones first
    int size() const { return static_cast<int>(unknowns.size()); }
    int rest() const { return size() - own; }
  };

  void find_fronts(std::vector<std::vector<int>> order, const std::vector<int>& group_of,
                   const std::vector<Pair>& pairs);
  void find_places(const std::vector<int>& group_of, const std::vector<Pair>& pairs);
  PivotCount eliminate_own(Eigen::Ref<Eigen::MatrixXd> own, int* pivots, double* off_diagonal);
  void eliminate_rest(const Front& front);
  void subtract_update(const Front& front);
  template <int Count>
  void solve_all(const std::array<double*, Count>& b) const;
  template <int Count>
  void solve_forward(const std::array<double*, Count>& b, const std::array<double*, Count>& y) const;
  template <int Count>
  void solve_backward(const std::array<double*, Count>& b, const std::array<double*, Count>& y) const;

  std::vector<Front> fronts_;
  int longest_ = 0;  ///< column of a front
  std::vector<int> places_, diagonal_;
  std::vector<int> updates_;  ///< of the lower triangle of what remains of each front, column by column: its places
  Eigen::VectorXd values_;
  std::vector<int> pivots_;           ///< of every own unknown: its place within the front before pivoting
  std::vector<double> off_diagonal_;  ///< of D; other than zero at the first of two
  Eigen::VectorXd least_pivots_;
  Eigen::VectorXd own_;              ///< of one front: its own block
  Eigen::VectorXd scaled_, update_;  ///< of one front: rows of L D below its own ones, and what they leave, L D L'
  mutable Eigen::VectorXd work_;     ///< of one front, for each right side
};

}  // namespace mcplan::ipm
