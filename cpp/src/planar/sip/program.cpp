#include "planar/sip/program.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan::sip {
namespace {

using nlp::ConstVector;
using nlp::Matrix;
using nlp::Vector;

/// The rows of one interval.
class IntervalRows : public nlp::Piece {
 public:
  IntervalRows(IntervalModel& model, Curvature curvature)
      : Piece("interval", model.local().variables, model.rows().count()), model_(model), curvature_(curvature) {}

  void values(const ConstVector& x, Vector f) const override { f = model_.row_values(x); }
  void jacobian(const ConstVector& x, Matrix J) const override { J = model_.row_jacobian(x); }
  void hessian(const ConstVector& x, const ConstVector& weights, Matrix H) const override {
    if (curvature_ == Curvature::exact) model_.add_row_hessian(x, weights, H);
  }
  bool entries_come_and_go() const override { return model_.rows().entries_come_and_go(); }
  std::string row_name(int row) const override { return model_.rows().name(row); }

 private:
  IntervalModel& model_;
  Curvature curvature_;
};

/// The cost of one interval.
class IntervalCost : public nlp::Piece {
 public:
  IntervalCost(IntervalModel& model, Curvature curvature, double scale)
      : Piece("cost", model.local().variables, 1), model_(model), curvature_(curvature), scale_(scale) {}

  void values(const ConstVector& x, Vector f) const override { f[0] = scale_ * model_.cost(x); }
  void jacobian(const ConstVector& x, Matrix J) const override { J.row(0) = scale_ * model_.cost_gradient(x); }
  void hessian(const ConstVector& x, const ConstVector& weights, Matrix H) const override {
    model_.add_cost_hessian(x, scale_ * weights[0], curvature_ == Curvature::exact, H);
  }
  void gauss_newton_hessian(const ConstVector& x, const ConstVector& weights, Matrix H) const override {
    model_.add_cost_hessian(x, scale_ * weights[0], false, H);
  }

 private:
  IntervalModel& model_;
  Curvature curvature_;
  double scale_;
};

/// factor / 2 |x - anchor|^2
class Proximity : public nlp::Piece {
 public:
  Proximity(std::vector<int> variables, Eigen::VectorXd anchor, double factor)
      : Piece("proximity", std::move(variables), 1), anchor_(std::move(anchor)), factor_(factor) {}

  void values(const ConstVector& x, Vector f) const override { f[0] = 0.5 * factor_ * (x - anchor_).squaredNorm(); }
  void jacobian(const ConstVector& x, Matrix J) const override { J.row(0) = factor_ * (x - anchor_); }
  void hessian(const ConstVector&, const ConstVector& weights, Matrix H) const override {
    H.diagonal().setConstant(weights[0] * factor_);
  }

 private:
  Eigen::VectorXd anchor_;
  double factor_;
};

Range duration_range(const PlanarTask& task, const Options& options, int phase) {
  const PlanarPhase& own = task.phases[phase];
  return {std::max(options.phase_duration_s.min, own.min_duration),
          std::min(options.phase_duration_s.max, own.max_duration)};
}

void add_parameters(nlp::Problem& problem, const PlanarTask& task, const Options& options, const Layout& layout) {
  const int last = layout.intervals - 1;
  for (int i = 0; i < layout.control_points(); ++i)
    problem.add_variables("control_point", layout.splines, -nlp::kInfinity, nlp::kInfinity,
                          {std::max(i - 1, 0), std::min(i + 2, last)});
  const int phases = static_cast<int>(task.phases.size());
  const std::vector<Range> durations = duration_ranges(task, options);
  if (!options.free_durations) {
    problem.add_variables("duration", 1, durations[0].min, durations[0].max, {0, last});
  } else {
    for (int p = 0; p < phases; ++p) {
      const Range& range = durations[p];
      const int first = task.first_interval(p);
      problem.add_variables("duration", 1, range.min, range.max,
                            {std::max(first - 2, 0), std::min(first + task.phases[p].intervals + 1, last)});
    }
  }
  for (int p = 0; p < phases; ++p) {
    const int first = task.first_interval(p);
    if (layout.weights[p] > 0)
      problem.add_variables("log_weight", layout.weights[p], -options.log_weight_max, options.log_weight_max,
                            {first, first + task.phases[p].intervals - 1});
  }
  for (int k = 0; k < layout.intervals; ++k)
    if (layout.forces[k] > 0) problem.add_variables("force", layout.forces[k], -nlp::kInfinity, nlp::kInfinity, {k, k});
}

}  // namespace

Range total_range(const PlanarTask& task, const Options& options) {
  Range out = options.total_duration_s;
  const double intervals = task.interval_count();
  for (const PlanarPhase& phase : task.phases) {
    out.min = std::max(out.min, phase.min_duration * intervals / phase.intervals);
    out.max = std::min(out.max, phase.max_duration * intervals / phase.intervals);
  }
  return out;
}

std::vector<Range> duration_ranges(const PlanarTask& task, const Options& options) {
  if (!options.free_durations) return {total_range(task, options)};
  std::vector<Range> out;
  for (int p = 0; p < static_cast<int>(task.phases.size()); ++p) out.push_back(duration_range(task, options, p));
  return out;
}

Program::Program(const PlanarTask& task, const Options& options, Curvature curvature, double cost_scale,
                 const Eigen::VectorXd& anchor, const CloseDiscs* close, const StopRequest& stop)
    : task_(task), options_(options), layout_(task_, options_) {
  add_parameters(problem_, task_, options_, layout_);
  const auto work = std::make_shared<TaylorGraph::Workspace>();
  for (int k = 0; k < layout_.intervals; ++k) {
    if (stop && stop()) return;
    models_.push_back(std::make_unique<IntervalModel>(task_, options_, layout_, k, work, close));
  }
  const bool weighted = cost_scale > 0.0;
  for (const auto& model : models_) {
    const Rows& rows = model->rows();
    if (rows.count() > 0)
      problem_.add_constraint(std::make_unique<IntervalRows>(*model, curvature), rows.lower(), rows.upper());
    const bool squares = (options_.dynamics && options_.torque_weight > 0.0) || options_.jerk_weight > 0.0;
    if (weighted && squares) problem_.add_cost(std::make_unique<IntervalCost>(*model, curvature, cost_scale));
  }
  if (weighted && options_.duration_weight > 0.0) {
    std::vector<int> durations(layout_.durations);
    for (int i = 0; i < layout_.durations; ++i) durations[i] = layout_.first_duration + i;
    problem_.add_cost(std::make_unique<nlp::LinearPiece>(
        "duration", durations, Eigen::MatrixXd::Constant(1, layout_.durations, cost_scale * options_.duration_weight)));
  }
  if (!weighted) {
    constexpr int kBlock = 9;
    for (int i = 0; i < layout_.parameters; i += kBlock) {
      std::vector<int> variables;
      for (int v = i; v < std::min(i + kBlock, layout_.parameters); ++v) variables.push_back(v);
      const int count = static_cast<int>(variables.size());
      problem_.add_cost(std::make_unique<Proximity>(variables, anchor.segment(i, count), kProximity));
    }
  }
  if (curvature == Curvature::none)
    problem_.finish_for_values();
  else if (!problem_.finish(stop))
    return;
  complete_ = true;
}

double Program::torque_cost(const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (const auto& model : models_) {
    Eigen::VectorXd local(model->local().count());
    for (int i = 0; i < local.size(); ++i) local[i] = x[model->local().variables[i]];
    sum += model->cost_term(local, false);
  }
  return sum;
}

double Program::jerk_cost(const Eigen::VectorXd& x) {
  double sum = 0.0;
  for (const auto& model : models_) {
    Eigen::VectorXd local(model->local().count());
    for (int i = 0; i < local.size(); ++i) local[i] = x[model->local().variables[i]];
    sum += model->cost_term(local, true);
  }
  return sum;
}

double Program::duration(const Eigen::VectorXd& x) const {
  return x.segment(layout_.first_duration, layout_.durations).sum();
}

double Program::cost(const Eigen::VectorXd& x) {
  double sum = options_.duration_weight * duration(x);
  if (options_.torque_weight > 0.0) sum += options_.torque_weight * torque_cost(x);
  if (options_.jerk_weight > 0.0) sum += options_.jerk_weight * jerk_cost(x);
  return sum;
}

Eigen::VectorXd zero_start(const PlanarTask& task, const Options& options, const Layout& layout) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(layout.parameters);
  if (!options.free_durations) {
    const Range range = total_range(task, options);
    x[layout.first_duration] = std::clamp(1.0, range.min, range.max);
    return x;
  }
  for (std::size_t p = 0; p < task.phases.size(); ++p) {
    const Range range = duration_range(task, options, static_cast<int>(p));
    const double ratio = task.phases[p].intervals / static_cast<double>(layout.intervals);
    x[layout.first_duration + static_cast<int>(p)] = std::clamp(ratio, range.min, range.max);
  }
  return x;
}

}  // namespace mcplan::sip
