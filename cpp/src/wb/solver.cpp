#include "mcplan/wb/solver.hpp"

#include <algorithm>
#include <utility>

#include "ipm/barrier.hpp"
#include "mcplan/base/error.hpp"
#include "wb/oracle.hpp"
#include "wb/system.hpp"

namespace mcplan::wb {
namespace {

using Eigen::VectorXd;

constexpr double kElasticStart = 1e-3;  // beyond what a row is exceeded by at the start

ipm::Point point_at(const Layout& layout, const VectorXd& x) {
  ipm::Point out;
  out.t = VectorXd::Zero(layout.variables + layout.rows);
  out.t.head(layout.variables) = x;
  out.equalities = VectorXd::Zero(layout.equalities);
  out.inequalities = VectorXd::Zero(layout.rows);
  return out;
}

nlp::SolverOptions kernel_options(const Options& options) {
  nlp::SolverOptions out;
  out.tolerance = options.tolerance;
  out.constraint_tolerance = options.constraint_tolerance;
  out.max_iterations = options.max_iterations;
  out.initial_barrier = options.initial_barrier;
  out.adaptive_barrier = true;
  out.kernel.cost_tolerance = options.cost_tolerance;
  out.logger = options.logger;
  return out;
}

}  // namespace

void Dynamics::resize(int nodes, int velocities, int end_effectors) {
  for (Rows* rows : {&q, &v, &a, &tau}) *rows = Rows::Zero(nodes, velocities);
  wrenches_S = Rows::Zero(nodes, 6 * end_effectors);
  for (Rows* rows : {&dq, &dv, &da}) *rows = Rows::Zero(static_cast<Eigen::Index>(nodes) * velocities, velocities);
}

struct Solver::Parts {
  Parts(Problem given, Dynamics::Callback callback)
      : problem(std::move(given)),
        layout(problem),
        assembly(problem, layout, dynamics, std::move(callback)),
        products(problem, layout, assembly),
        unknowns(unknowns_of(problem, layout)) {}

  Problem problem;
  Layout layout;
  Dynamics dynamics;
  Assembly assembly;
  Products products;
  ipm::Unknowns unknowns;
};

Solver::Solver(Problem problem, Dynamics::Callback callback) {
  problem.validate();
  parts_ = std::make_unique<Parts>(std::move(problem), std::move(callback));
}

Solver::~Solver() = default;

const Problem& Solver::problem() const { return parts_->problem; }
Dynamics& Solver::dynamics() { return parts_->dynamics; }
int Solver::variables() const { return parts_->layout.variables; }
int Solver::equalities() const { return parts_->layout.equalities; }
int Solver::rows() const { return parts_->layout.rows; }

Dynamics::Rows Solver::coefficients(const VectorXd& x) const {
  const Layout& layout = parts_->layout;
  return Eigen::Map<const Dynamics::Rows>(x.data(), layout.nodes + 2, layout.velocities);
}

/// Forces along the edges of a pyramid to the force at its point, and back: equal parts of the normal force, and of the
/// edges that lie towards the tangential one more.
Dynamics::Rows Solver::forces(const VectorXd& x) const {
  const Parts& p = *parts_;
  int points = 0;
  std::vector<int> first;
  for (const EndEffector& end : p.problem.end_effectors) {
    first.push_back(points);
    points += static_cast<int>(end.points_S.cols());
  }
  Dynamics::Rows out = Dynamics::Rows::Zero(p.layout.nodes, 3 * points);
  for (int k = 0; k < p.layout.nodes; ++k) {
    int at = p.layout.node[k].first_force;
    for (const Contact& contact : p.problem.nodes[k].contacts) {
      if (!contact.carries) continue;
      const double mu = contact.friction, weight = p.problem.weight_N;
      for (Eigen::Index i = 0; i < p.problem.end_effectors[contact.end_effector].points_S.cols(); ++i, at += kEdges) {
        const int column = 3 * (first[contact.end_effector] + static_cast<int>(i));
        out(k, column) = weight * mu * (x[at] - x[at + 2]);
        out(k, column + 1) = weight * mu * (x[at + 1] - x[at + 3]);
        out(k, column + 2) = weight * x.segment<kEdges>(at).sum();
      }
    }
  }
  return out;
}

VectorXd Solver::unknowns(const Dynamics::Rows& coefficients, const Dynamics::Rows& forces_S) {
  Parts& p = *parts_;
  VectorXd x = VectorXd::Zero(p.layout.variables);
  x.head(p.layout.coefficients) = Eigen::Map<const VectorXd>(coefficients.data(), coefficients.size());
  std::vector<int> first;
  int points = 0;
  for (const EndEffector& end : p.problem.end_effectors) {
    first.push_back(points);
    points += static_cast<int>(end.points_S.cols());
  }
  for (int k = 0; k < p.layout.nodes; ++k) {
    int at = p.layout.node[k].first_force;
    for (const Contact& contact : p.problem.nodes[k].contacts) {
      if (!contact.carries) continue;
      for (Eigen::Index i = 0; i < p.problem.end_effectors[contact.end_effector].points_S.cols(); ++i, at += kEdges) {
        const auto f = forces_S.row(k).segment<3>(3 * (first[contact.end_effector] + static_cast<int>(i)));
        const double quarter = 0.25 * std::max(0.0, f[2]) / p.problem.weight_N;
        const double scale = 0.5 / (contact.friction * p.problem.weight_N);
        x[at] = quarter + scale * f[0];
        x[at + 1] = quarter + scale * f[1];
        x[at + 2] = quarter - scale * f[0];
        x[at + 3] = quarter - scale * f[1];
        for (int e = 0; e < kEdges; ++e) x[at + e] = std::max(x[at + e], 0.0);
      }
    }
  }
  const VectorXd rows = values(x).inequalities;
  const int n = p.layout.variables;
  for (int k = 0; k < p.layout.nodes; ++k) {
    const NodeLayout& at = p.layout.node[k];
    for (int i = 0; i < p.layout.elastic_count(k); ++i) {
      const int row = at.first_row + p.layout.joints + i;
      x[at.first_elastic + 2 * i] = std::max(0.0, p.unknowns.lower[n + row] - rows[row]) + kElasticStart;
      x[at.first_elastic + 2 * i + 1] = std::max(0.0, rows[row] - p.unknowns.upper[n + row]) + kElasticStart;
    }
  }
  return x;
}

Solver::Values Solver::values(const VectorXd& x) {
  Parts& p = *parts_;
  const Options options;
  const Deadline deadline;
  Oracle oracle(p.problem, p.layout, p.assembly, p.products, p.unknowns, options, deadline);
  ipm::Point point = point_at(p.layout, x);
  oracle.evaluate(point);
  return {point.cost, point.equalities, point.inequalities};
}

Solver::Slopes Solver::slopes(const VectorXd& x, const VectorXd& step) {
  Parts& p = *parts_;
  const Options options;
  const Deadline deadline;
  Oracle oracle(p.problem, p.layout, p.assembly, p.products, p.unknowns, options, deadline);
  System system(p.layout, p.assembly, p.products);
  const ipm::Point point = point_at(p.layout, x);
  VectorXd gradient = VectorXd::Zero(p.layout.variables);
  oracle.derivatives(point, gradient, system);
  Slopes out{gradient.dot(step), VectorXd::Zero(p.layout.equalities), VectorXd::Zero(p.layout.rows)};
  system.multiply_inequalities(step, out.inequalities);
  NodeVector y;
  for (int k = 0; k < p.layout.nodes; ++k) {
    y = p.products.make(k);
    p.products.image(k, step, y);
    p.products.to_equalities(k, y, out.equalities);
  }
  return out;
}

Dynamics::Rows Solver::usage(const VectorXd& x) {
  Parts& p = *parts_;
  VectorXd bare = x;
  bare.tail(2 * p.layout.elastic_rows).setZero();
  const VectorXd rows = values(bare).inequalities;
  int widest = 0;
  for (int k = 0; k < p.layout.nodes; ++k) widest = std::max(widest, p.layout.limit_count(k));
  Dynamics::Rows out = Dynamics::Rows::Constant(p.layout.nodes, widest, -nlp::kInfinity);
  const int n = p.layout.variables, joints = p.layout.joints;
  for (int k = 0; k < p.layout.nodes; ++k)
    for (int i = 0; i < p.layout.limit_count(k); ++i) {
      const int row = p.layout.node[k].first_row + i;
      const double beyond = std::max(p.unknowns.lower[n + row] - rows[row], rows[row] - p.unknowns.upper[n + row]);
      if (i < joints)
        out(k, i) = beyond;
      else if (i < 3 * joints)
        out(k, i) = std::abs(rows[row]);
      else
        out(k, i) = Assembly::kDistanceScale * beyond;
    }
  return out;
}

Solution Solver::solve(const VectorXd& start, const Options& options) {
  Parts& p = *parts_;
  const Deadline deadline(options.time_limit_s);
  const nlp::SolverOptions kernel = kernel_options(options);
  Oracle oracle(p.problem, p.layout, p.assembly, p.products, p.unknowns, options, deadline);
  System system(p.layout, p.assembly, p.products);
  ipm::Barrier barrier(p.unknowns, kernel, oracle, system);
  ipm::Barrier::Duals duals;  // what a unit of each elastic variable costs is what its bound pushes back with
  duals.equalities = VectorXd::Zero(p.layout.equalities);
  duals.lower = duals.upper = VectorXd::Zero(p.layout.variables + p.layout.rows);
  for (int k = 0; k < p.layout.nodes; ++k)
    duals.lower.segment(p.layout.node[k].first_elastic, 2 * p.layout.elastic_count(k))
        .setConstant(p.layout.weight[k] * p.problem.weights.elastic);
  Solution out;
  ipm::Point point = point_at(p.layout, start);
  try {
    const ipm::Barrier::Ending ending = barrier.run(point, options.max_iterations, &duals);
    out.outcome = ending.outcome;
    out.message = ending.message;
  } catch (const ipm::Halt& halt) {
    out.outcome = halt.outcome;
    out.message = halt.message;
  }
  out.iterations = oracle.iterations();
  out.evaluation_s = oracle.evaluation_s();
  out.linear_solver_s = barrier.linear_solver_s();
  const bool converged = out.outcome == nlp::Outcome::converged;
  out.x = converged ? VectorXd(point.t.head(p.layout.variables)) : oracle.best_x();
  if (out.x.size() == 0) out.x = start;
  ipm::Point end = point_at(p.layout, out.x);
  try {
    Oracle(p.problem, p.layout, p.assembly, p.products, p.unknowns, Options(), Deadline()).evaluate(end);
    out.violation = oracle.violation(end);
  } catch (const ipm::Halt&) {
    out.violation = nlp::kInfinity;
  }
  for (int k = 0; k < p.layout.nodes; ++k)
    out.penalty += p.layout.weight[k] * p.problem.weights.elastic *
                   out.x.segment(p.layout.node[k].first_elastic, 2 * p.layout.elastic_count(k)).sum();
  out.cost = end.cost - out.penalty;
  out.time_s = deadline.elapsed_s();
  return out;
}

}  // namespace mcplan::wb
