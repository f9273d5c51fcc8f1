#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mcplan/nlp/problem.hpp"
#include "mcplan/planar/plan.hpp"
#include "planar/sip/interval_model.hpp"
#include "planar/sip/layout.hpp"

namespace mcplan::sip {

/// Second derivatives that a program offers its solver.
enum class Curvature {
  none,          ///< nor first ones: values alone can be asked for
  exact,         ///< of cost and constraints
  gauss_newton,  ///< of the cost, without that of torques and constraints
};

/// The semi-infinite program of a task, made finite: parameters P, rows interval by interval. A row's parameters are
/// those of its interval (LocalParameters::variables): a band of four control points and an arrow of durations and log
/// weights.
class Program {
 public:
  /// The objective is cost_scale times the cost; with a scale of zero it is a weak pull to `anchor`,
  /// kProximity / 2 |P - anchor|^2, which makes the solution unique where constraints leave room. `close`: discs that
  /// self-collision is about; null: all. `stop` is polled at every interval; where it asks to stop, the program is not
  /// complete() and of no use.
  Program(const PlanarTask& task, const Options& options, Curvature curvature, double cost_scale,
          const Eigen::VectorXd& anchor, const CloseDiscs* close = nullptr, const StopRequest& stop = {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  static constexpr double kProximity = 1e-4;

  bool complete() const { return complete_; }
  const nlp::Problem& problem() const { return problem_; }
  const Layout& layout() const { return layout_; }
  int intervals() const { return static_cast<int>(models_.size()); }
  IntervalModel& model(int interval) { return *models_[interval]; }

  double cost(const Eigen::VectorXd& x);            ///< weighted sum, whatever the objective is
  double torque_cost(const Eigen::VectorXd& x);     ///< integral of squared torques [N^2 m^2 s]
  double jerk_cost(const Eigen::VectorXd& x);       ///< integral of squared joint jerks [rad^2/s^5]
  double duration(const Eigen::VectorXd& x) const;  ///< [s]

 private:
  PlanarTask task_;
  Options options_;
  Layout layout_;
  std::vector<std::unique_ptr<IntervalModel>> models_;
  nlp::Problem problem_;
  bool complete_ = false;
};

/// Bounds of a motion's duration where it has one, which intervals share equally; empty (max < min) where the phases'
/// own limits leave none.
Range total_range(const PlanarTask& task, const Options& options);

/// Bounds of each duration of the program: of every phase, or of the whole motion.
std::vector<Range> duration_ranges(const PlanarTask& task, const Options& options);

/// P = 0, durations that add to one second or to what their bounds allow.
Eigen::VectorXd zero_start(const PlanarTask& task, const Options& options, const Layout& layout);

/// P of a plan: its splines, durations, weights and forces, as far as the layout has them.
/// Throws InvalidPlan where its phases, intervals or joints do not fit.
Eigen::VectorXd parameters_of(const PlanarPlan& plan, const PlanarTask& task, const Options& options,
                              const Layout& layout);

/// The plan of P.
PlanarPlan plan_of(const PlanarTask& task, const Options& options, const Layout& layout, const Eigen::VectorXd& x);

}  // namespace mcplan::sip
