#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "planar/sip/constraints.hpp"
#include "planar/sip/interval_motion.hpp"
#include "planar/sip/rows.hpp"

namespace mcplan::sip {

/// Constraints and cost of one interval as functions of the parameters that it touches.
///
/// Cost of an interval of length h:  sum_w weight_w h/2 int_{-1}^{1} p_w(s)^2 ds,  p_w the torques and the jerks of
/// joints (the integral of a polynomial's square, exact for the polynomials). Values and first derivatives of the last
/// point asked for are kept, because a solver asks for cost, gradient, rows and Jacobian one after the other.
class IntervalModel {
 public:
  IntervalModel(const PlanarTask& task, const Options& options, const Layout& layout, int interval,
                std::shared_ptr<TaylorGraph::Workspace> work, const CloseDiscs* close = nullptr);
  IntervalModel(const IntervalModel&) = delete;
  IntervalModel& operator=(const IntervalModel&) = delete;

  const LocalParameters& local() const { return motion_.local; }
  const Rows& rows() const { return *rows_; }

  using Parameters = Eigen::Ref<const Eigen::VectorXd>;

  const Eigen::VectorXd& row_values(const Parameters& x);
  const Eigen::MatrixXd& row_jacobian(const Parameters& x);
  void add_row_hessian(const Parameters& x, const Parameters& weights, Eigen::Ref<Eigen::MatrixXd> H);

  double cost(const Parameters& x);
  double cost_term(const Parameters& x, bool jerk);  ///< integral of squared torques or jerks, without its weight
  const Eigen::VectorXd& cost_gradient(const Parameters& x);

  /// Second derivatives of the cost; without `curvature` of torques and jerks only the Gauss-Newton part, which is
  /// positive semidefinite.
  void add_cost_hessian(const Parameters& x, double weight, bool curvature, Eigen::Ref<Eigen::MatrixXd> H);

  IntervalMotion& motion() { return motion_; }
  TaylorGraph::Workspace& evaluate(const Parameters& x, bool derivatives);

 private:
  struct Squared {
    TaylorGraph::Node node;
    double weight;
    bool jerk;
  };
  enum class Level { nothing, values, derivatives };

  void bring_to(const Parameters& x, Level level);

  IntervalMotion motion_;
  std::shared_ptr<TaylorGraph::Workspace> work_;
  std::unique_ptr<Rows> rows_;
  std::vector<Squared> squared_;

  Level level_ = Level::nothing;
  Eigen::VectorXd x_;
  Eigen::VectorXd f_, gradient_;
  Eigen::MatrixXd J_, H_;
  double cost_ = 0.0;
};

}  // namespace mcplan::sip
