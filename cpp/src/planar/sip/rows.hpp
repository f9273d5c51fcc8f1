#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mcplan/planar/sip/options.hpp"
#include "planar/sip/taylor_graph.hpp"

namespace mcplan::sip {

/// One polynomial of an interval and the limits within which it is kept.
struct Limited {
  enum class When {
    always,        ///< over the whole interval, as options.continuous says
    coefficients,  ///< the coefficients 0..highest themselves
    instant,       ///< at s = at
  };

  std::string name;  ///< e.g. "torque of left_knee"
  TaylorGraph::Node node = -1;
  double lower = 0.0, upper = 0.0;  ///< in the polynomial's unit
  double scale = 1.0;               ///< rows are scale * polynomial, so that they are of order one
  When when = When::always;
  int highest = 0;
  double at = 0.0;
};

/// The rows of a nonlinear program that keep polynomials within limits. All are linear in the coefficients a:
///
///     Bernstein hull     M a           n + 1 rows; sufficient at every instant, smooth
///     extrema            V(s*) a       a row for each finite limit, at the place s* of the largest or smallest value;
///                                      its derivative is that of the value at a fixed s* (envelope theorem)
///     time grid          V(s_i) a      a row for each instant
///     coefficients       a_0..a_k
class Rows {
 public:
  Rows(const TaylorGraph& graph, std::vector<Limited> limited, const Options& options);

  int count() const { return static_cast<int>(lower_.size()); }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  const std::string& name(int row) const { return limited_[owner_[row]].name; }
  bool entries_come_and_go() const { return extremum_; }

  void values(const TaylorGraph::Workspace& work, Eigen::Ref<Eigen::VectorXd> f) const;

  /// f and df/dx (count x parameters of the graph); J must be zero on entry where it has no entries.
  void jacobian(const TaylorGraph::Workspace& work, Eigen::Ref<Eigen::VectorXd> f, Eigen::Ref<Eigen::MatrixXd> J) const;

  /// Adds weights' f to the adjoints.
  void add_adjoints(TaylorGraph::Workspace& work, const Eigen::Ref<const Eigen::VectorXd>& weights) const;

 private:
  /// The matrix of entry i at the polynomial's present coefficients.
  const Eigen::MatrixXd& matrix(int i, const TaylorGraph::Workspace& work) const;

  const TaylorGraph& graph_;
  std::vector<Limited> limited_;
  std::vector<int> first_row_, owner_;
  std::vector<Eigen::MatrixXd> matrices_;  ///< scaled; empty where it depends on the coefficients
  mutable Eigen::MatrixXd moving_, product_;
  Eigen::VectorXd lower_, upper_;
  bool extremum_ = false;
};

/// Powers 1, s, ..., s^degree.
Eigen::RowVectorXd powers(double s, int degree);

}  // namespace mcplan::sip
