#include "wb/oracle.hpp"

#include <algorithm>
#include <cmath>

namespace mcplan::wb {

using Eigen::VectorXd;

ipm::Unknowns unknowns_of(const Problem& problem, const Layout& layout) {
  VectorXd lower = VectorXd::Constant(layout.variables + layout.rows, -nlp::kInfinity);
  VectorXd upper = VectorXd::Constant(layout.variables + layout.rows, nlp::kInfinity);
  lower.segment(layout.coefficients, layout.variables - layout.coefficients).setZero();
  const int joints = layout.joints;
  for (int k = 0; k < layout.nodes; ++k) {
    const NodeLayout& at = layout.node[k];
    int force = at.first_force;
    for (const Contact& contact : problem.nodes[k].contacts) {
      if (!contact.carries) continue;
      const EndEffector& end = problem.end_effectors[contact.end_effector];
      const int edges = kEdges * static_cast<int>(end.points_S.cols());
      if (end.is_point()) lower.segment(force, edges).setConstant(problem.point_load_min / kEdges);
      force += edges;
    }
    int row = layout.variables + at.first_row;
    for (int i = 0; i < joints; ++i, ++row) {  // rows of positions are off the posture
      const Link& link = problem.links[6 + i];
      const double width = link.position_max - link.position_min;
      const double margin = std::min(problem.position_margin, 0.1 * width);
      lower[row] = link.position_min + margin - problem.posture[i];
      upper[row] = link.position_max - margin - problem.posture[i];
    }
    lower.segment(row, 2 * joints).setConstant(-problem.limit_ratio);
    upper.segment(row, 2 * joints).setConstant(problem.limit_ratio);
    row += 2 * joints;
    for (const Swing& swing : problem.nodes[k].swings) {
      if (!swing.in_tube) continue;
      for (Eigen::Index p = 0; p < problem.end_effectors[swing.end_effector].points_S.cols(); ++p, row += 3) {
        lower.segment<3>(row) = swing.tube_min_W / Assembly::kDistanceScale;
        upper.segment<3>(row) = swing.tube_max_W / Assembly::kDistanceScale;
      }
    }
    lower.segment(row, at.pairs).setZero();
    row += at.pairs;
    for (const Contact& contact : problem.nodes[k].contacts)  // rows are off the plan's
      if (contact.limited()) upper[row++] = (contact.load_max - contact.wrench_S[2]) / problem.weight_N;
  }
  return ipm::Unknowns(layout.variables, layout.equalities, std::move(lower), std::move(upper));
}

Oracle::Oracle(const Problem& problem, const Layout& layout, Assembly& assembly, Products& products,
               const ipm::Unknowns& unknowns, const Options& options, const Deadline& deadline)
    : problem_(problem),
      layout_(layout),
      assembly_(assembly),
      products_(products),
      unknowns_(unknowns),
      options_(options),
      deadline_(deadline),
      best_violation_(nlp::kInfinity),
      best_cost_(nlp::kInfinity) {
  for (int k = 0; k < layout.nodes; ++k) vectors_.push_back(products.make(k));
  x_.resize(layout.variables);
}

void Oracle::begin_iteration() {
  if (options_.stop && options_.stop()) throw ipm::Halt{nlp::Outcome::interrupted, "stopped by the caller"};
  if (deadline_.passed()) throw ipm::Halt{nlp::Outcome::time_limit, "reached time_limit_s"};
  ++iterations_;
}

void Oracle::assemble(const VectorXd& t, bool derivatives) {
  if (deadline_.passed()) throw ipm::Halt{nlp::Outcome::time_limit, "reached time_limit_s"};
  const double start_s = deadline_.now_s();
  x_ = t.head(layout_.variables);
  assembly_.evaluate(x_, derivatives);
  evaluation_s_ += deadline_.now_s() - start_s;
  if (options_.stop && options_.stop()) throw ipm::Halt{nlp::Outcome::interrupted, "stopped by the caller"};
}

void Oracle::evaluate(ipm::Point& point) {
  assemble(point.t, false);
  double cost = 0.0;
  for (int k = 0; k < layout_.nodes; ++k) {
    const NodeLayout& at = layout_.node[k];
    NodeVector& y = vectors_[k];
    products_.values(k, x_, y);
    products_.to_equalities(k, y, point.equalities);
    products_.to_inequalities(k, y, point.inequalities);
    const NodeVector& W = products_.cost_weights(k);
    const auto half_square = [](const VectorXd& weights, const VectorXd& values) {
      return 0.5 * (weights.array() * values.array().square()).sum();
    };
    cost += half_square(W.q, y.q) + half_square(W.v, y.v) + half_square(W.a, y.a) + half_square(W.moving, y.moving) +
            half_square(W.placed, y.placed) + half_square(W.wrench, y.wrench) + half_square(W.force, y.force);
    const auto elastic = x_.segment(at.first_elastic, 2 * layout_.elastic_count(k));
    cost += layout_.weight[k] * problem_.weights.elastic * elastic.sum();
    for (int i = 0; i < layout_.elastic_count(k); ++i)
      point.inequalities[at.first_row + layout_.joints + i] += elastic[2 * i] - elastic[2 * i + 1];
  }
  point.cost = cost;
  if (!std::isfinite(cost) || !point.equalities.allFinite() || !point.inequalities.allFinite())
    throw ipm::Halt{nlp::Outcome::numerical_failure, "a value was not finite"};
  const double violated = violation(point), enough = options_.constraint_tolerance;
  const bool better =
      violated <= enough ? best_violation_ > enough || point.cost < best_cost_ : violated < best_violation_;
  if (!better) return;
  best_x_ = x_;
  best_violation_ = violated;
  best_cost_ = cost;
}

void Oracle::derivatives(const ipm::Point& point, VectorXd& gradient, ipm::LinearSystem&) {
  assemble(point.t, true);
  gradient.setZero();
  for (int k = 0; k < layout_.nodes; ++k) {
    NodeVector& y = vectors_[k];
    products_.values(k, x_, y);
    const NodeVector& W = products_.cost_weights(k);
    y.q.array() *= W.q.array();
    y.v.array() *= W.v.array();
    y.a.array() *= W.a.array();
    y.moving.array() *= W.moving.array();
    y.placed.array() *= W.placed.array();
    y.wrench.array() *= W.wrench.array();
    y.force.array() *= W.force.array();
    products_.add_transposed(k, y, gradient);
    gradient.segment(layout_.node[k].first_elastic, 2 * layout_.elastic_count(k)).array() +=
        layout_.weight[k] * problem_.weights.elastic;
  }
}

double Oracle::violation(const ipm::Point& point) const {
  double worst = point.equalities.size() > 0 ? point.equalities.cwiseAbs().maxCoeff() : 0.0;
  const int n = layout_.variables;
  for (int i = 0; i < layout_.rows; ++i)
    worst = std::max(
        {worst, unknowns_.lower[n + i] - point.inequalities[i], point.inequalities[i] - unknowns_.upper[n + i]});
  return worst;
}

}  // namespace mcplan::wb
