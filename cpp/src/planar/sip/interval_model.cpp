#include "planar/sip/interval_model.hpp"

#include <array>

#include "planar/sip/constraints.hpp"

namespace mcplan::sip {
namespace {

/// Q_ik = int_{-1}^{1} s^i s^k ds
const Eigen::MatrixXd& square_integral(int degree) {
  static const std::array<Eigen::MatrixXd, TaylorGraph::kMaxOrder + 1> all = [] {
    std::array<Eigen::MatrixXd, TaylorGraph::kMaxOrder + 1> out;
    for (int n = 0; n <= TaylorGraph::kMaxOrder; ++n) {
      out[n] = Eigen::MatrixXd::Zero(n + 1, n + 1);
      for (int i = 0; i <= n; ++i)
        for (int k = i % 2; k <= n; k += 2) out[n](i, k) = 2.0 / (i + k + 1);
    }
    return out;
  }();
  return all[degree];
}

}  // namespace

IntervalModel::IntervalModel(const PlanarTask& task, const Options& options, const Layout& layout, int interval,
                             std::shared_ptr<TaylorGraph::Workspace> work, const CloseDiscs* close)
    : motion_(task, options, layout, interval), work_(std::move(work)) {
  std::vector<Limited> limited = constraints_of(motion_, close);
  if (options.dynamics)
    for (TaylorGraph::Node torque : motion_.torques) squared_.push_back({torque, options.torque_weight, false});
  if (options.jerk_weight > 0.0)
    for (TaylorGraph::Node joint : motion_.joints)
      squared_.push_back({motion_.timed(motion_.graph.derivative(joint, 3), 3), options.jerk_weight, true});
  rows_ = std::make_unique<Rows>(motion_.graph, std::move(limited), options);
  f_ = Eigen::VectorXd::Zero(rows_->count());
  J_ = Eigen::MatrixXd::Zero(rows_->count(), local().count());
  gradient_ = Eigen::VectorXd::Zero(local().count());
  H_.resize(local().count(), local().count());
}

TaylorGraph::Workspace& IntervalModel::evaluate(const Parameters& x, bool derivatives) {
  motion_.set_parameters(x, derivatives);
  motion_.graph.evaluate(*work_, derivatives);
  return *work_;
}

void IntervalModel::bring_to(const Parameters& x, Level level) {
  if (level_ >= level && x == x_) return;
  const bool derivatives = level == Level::derivatives;
  evaluate(x, derivatives);
  x_ = x;
  level_ = level;
  if (derivatives)
    rows_->jacobian(*work_, f_, J_);
  else
    rows_->values(*work_, f_);
  const TaylorGraph& graph = motion_.graph;
  const double half = graph.coefficients(*work_, motion_.half_length)[0];
  double sum = 0.0;
  if (derivatives) gradient_.setZero();
  for (const Squared& term : squared_) {
    if (term.weight == 0.0) continue;
    const auto a = graph.coefficients(*work_, term.node);
    const Eigen::MatrixXd& Q = square_integral(graph.order(term.node));
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, TaylorGraph::kMaxOrder + 1, 1> Qa = Q * a;
    sum += term.weight * a.dot(Qa);
    if (!derivatives) continue;
    const auto T = graph.tangents(*work_, term.node);
    const std::vector<int>& columns = graph.columns(term.node);
    for (std::size_t c = 0; c < columns.size(); ++c)
      gradient_[columns[c]] += 2.0 * term.weight * half * Qa.dot(T.col(static_cast<Eigen::Index>(c)));
  }
  cost_ = half * sum;
  if (derivatives) {
    const int own = graph.columns(motion_.half_length)[0];
    gradient_[own] += sum * graph.tangents(*work_, motion_.half_length)(0, 0);
  }
}

const Eigen::VectorXd& IntervalModel::row_values(const Parameters& x) {
  bring_to(x, Level::values);
  return f_;
}

const Eigen::MatrixXd& IntervalModel::row_jacobian(const Parameters& x) {
  bring_to(x, Level::derivatives);
  return J_;
}

double IntervalModel::cost(const Parameters& x) {
  bring_to(x, Level::values);
  return cost_;
}

double IntervalModel::cost_term(const Parameters& x, bool jerk) {
  evaluate(x, false);
  const double half = motion_.graph.coefficients(*work_, motion_.half_length)[0];
  double sum = 0.0;
  for (const Squared& term : squared_) {
    if (term.jerk != jerk) continue;
    const auto a = motion_.graph.coefficients(*work_, term.node);
    sum += half * a.dot(square_integral(motion_.graph.order(term.node)) * a);
  }
  return sum;
}

const Eigen::VectorXd& IntervalModel::cost_gradient(const Parameters& x) {
  bring_to(x, Level::derivatives);
  return gradient_;
}

void IntervalModel::add_row_hessian(const Parameters& x, const Parameters& weights, Eigen::Ref<Eigen::MatrixXd> H) {
  evaluate(x, true);
  motion_.graph.clear_adjoints(*work_);
  rows_->add_adjoints(*work_, weights);
  motion_.graph.hessian(*work_, H_);
  H += H_;
}

void IntervalModel::add_cost_hessian(const Parameters& x, double weight, bool curvature,
                                     Eigen::Ref<Eigen::MatrixXd> H) {
  // h/2 a'Qa: Gauss-Newton part T'(2 h/2 Q)T, curvature of a weighted by 2 h/2 Qa, and the mixed part with h.
  evaluate(x, true);
  const TaylorGraph& graph = motion_.graph;
  const double half = graph.coefficients(*work_, motion_.half_length)[0];
  const double half_rate = graph.tangents(*work_, motion_.half_length)(0, 0);
  const int own = graph.columns(motion_.half_length)[0];
  H_.setZero();
  if (curvature) {
    graph.clear_adjoints(*work_);
    for (const Squared& term : squared_)
      graph.adjoints(*work_, term.node) +=
          2.0 * weight * term.weight * half *
          (square_integral(graph.order(term.node)) * graph.coefficients(*work_, term.node));
    graph.hessian(*work_, H_);
  }
  for (const Squared& term : squared_) {
    if (term.weight == 0.0) continue;
    const double factor = 2.0 * weight * term.weight;
    const auto a = graph.coefficients(*work_, term.node);
    const auto T = graph.tangents(*work_, term.node);
    const std::vector<int>& columns = graph.columns(term.node);
    const Eigen::MatrixXd QT = square_integral(graph.order(term.node)) * T;
    const Eigen::MatrixXd block = factor * half * (T.transpose() * QT);
    // Gauss-Newton squares the derivative of sqrt(h/2) p, which has half of the mixed part and a term of its own.
    const Eigen::VectorXd mixed = (curvature ? 1.0 : 0.5) * factor * half_rate * (QT.transpose() * a);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      for (std::size_t i = 0; i < columns.size(); ++i) H_(columns[i], columns[j]) += block(i, j);
      H_(own, columns[j]) += mixed[j];
      H_(columns[j], own) += mixed[j];
    }
    if (!curvature)
      H_(own, own) +=
          factor * half_rate * half_rate / (4.0 * half) * a.dot(square_integral(graph.order(term.node)) * a);
  }
  H += H_;
}

}  // namespace mcplan::sip
