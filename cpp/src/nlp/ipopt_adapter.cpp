#include "nlp/ipopt_adapter.hpp"

#include <IpTimingStatistics.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "nlp/ipopt_fork_gate.hpp"

namespace mcplan::nlp {
namespace {

using Eigen::VectorXd;
using Ipopt::Index;
using Ipopt::Number;

/// Thrown through Ipopt, which hands it to nobody but ends at once: `false` from an evaluation would only shorten the
/// step, fifty times over. The reason stands in the adapter.
struct Halt {};

double largest_violation(const double* values, const std::vector<double>& lower, const std::vector<double>& upper) {
  double worst = 0.0;
  for (std::size_t i = 0; i < lower.size(); ++i)
    worst = std::max(worst, std::max(lower[i] - values[i], values[i] - upper[i]));
  return worst;
}

bool structure(const std::vector<Entry>& entries, Index* rows, Index* columns) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    rows[i] = entries[i].row;
    columns[i] = entries[i].column;
  }
  return true;
}

}  // namespace

IpoptAdapter::IpoptAdapter(const Problem& problem, const VectorXd& x0, const SolverOptions& options,
                           const Deadline& deadline)
    : problem_(problem), options_(options), deadline_(deadline), x0_(x0) {
  best_.x = x0;
  last_x_ = x0;
  multipliers_ = VectorXd::Zero(problem.row_count());
}

void IpoptAdapter::begin() {
  if (!deadline_.limited()) return;
  left_s_ = deadline_.remaining_s();
  reserve();
}

bool IpoptAdapter::get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian, IndexStyleEnum& style) {
  n = problem_.variable_count();
  m = problem_.row_count();
  jacobian = static_cast<Index>(problem_.jacobian_structure().size());
  hessian = static_cast<Index>(problem_.hessian_structure().size());
  style = C_STYLE;
  return true;
}

bool IpoptAdapter::get_bounds_info(Index, Number* x_lower, Number* x_upper, Index, Number* g_lower, Number* g_upper) {
  std::copy(problem_.variable_lower().begin(), problem_.variable_lower().end(), x_lower);
  std::copy(problem_.variable_upper().begin(), problem_.variable_upper().end(), x_upper);
  std::copy(problem_.row_lower().begin(), problem_.row_lower().end(), g_lower);
  std::copy(problem_.row_upper().begin(), problem_.row_upper().end(), g_upper);
  return true;
}

bool IpoptAdapter::get_starting_point(Index n, bool init_x, Number* x, bool init_z, Number*, Number*, Index,
                                      bool init_lambda, Number*) {
  if (init_x) std::copy(x0_.data(), x0_.data() + n, x);
  return !init_z && !init_lambda;
}

template <class Function>
bool IpoptAdapter::evaluate(Index n, const Number* x, bool new_x, Number* out, Index size, const Function& function) {
  if (new_x) cost_known_ = rows_known_ = false;
  if (deadline_.limited() && deadline_.remaining_s() <= reserved_s_) halt(Reason::time);
  const double start_s = deadline_.now_s();
  const Eigen::Map<const VectorXd> at(x, n);
  Eigen::Map<VectorXd> values(out, size);
  try {
    const ForkGate::Opening opening;
    function(at, values);
    if (!values.allFinite() && options_.stop && options_.stop()) {
      reason_ = Reason::stop;
    } else if (!values.allFinite()) {
      not_finite_ = problem_.first_not_finite(at);
      if (not_finite_.empty()) not_finite_ = "a sum of pieces";
      reason_ = Reason::not_finite;
    }
  } catch (...) {
    halt_with_exception();
  }
  evaluation_s_ += deadline_.now_s() - start_s;
  if (reason_ != Reason::none) throw Halt();
  return true;
}

bool IpoptAdapter::eval_f(Index n, const Number* x, bool new_x, Number& cost) {
  evaluate(n, x, new_x, &cost, 1, [&](const ConstVector& at, Vector out) { out[0] = problem_.cost(at); });
  cost_ = cost;
  cost_known_ = true;
  consider(n, x);
  return true;
}

bool IpoptAdapter::eval_grad_f(Index n, const Number* x, bool new_x, Number* gradient) {
  return evaluate(n, x, new_x, gradient, n, [&](const ConstVector& at, Vector out) { problem_.gradient(at, out); });
}

bool IpoptAdapter::eval_g(Index n, const Number* x, bool new_x, Index m, Number* g) {
  evaluate(n, x, new_x, g, m, [&](const ConstVector& at, Vector out) { problem_.rows(at, out); });
  row_violation_ = largest_violation(g, problem_.row_lower(), problem_.row_upper());
  rows_known_ = true;
  consider(n, x);
  return true;
}

bool IpoptAdapter::eval_jac_g(Index n, const Number* x, bool new_x, Index, Index entries, Index* rows, Index* columns,
                              Number* values) {
  if (!values) return structure(problem_.jacobian_structure(), rows, columns);
  return evaluate(n, x, new_x, values, entries, [&](const ConstVector& at, Vector out) { problem_.jacobian(at, out); });
}

bool IpoptAdapter::eval_h(Index n, const Number* x, bool new_x, Number cost_factor, Index m, const Number* multipliers,
                          bool, Index entries, Index* rows, Index* columns, Number* values) {
  if (!values) return structure(problem_.hessian_structure(), rows, columns);
  const Eigen::Map<const VectorXd> weights(multipliers, m);
  return evaluate(n, x, new_x, values, entries,
                  [&](const ConstVector& at, Vector out) { problem_.hessian(at, cost_factor, weights, out); });
}

bool IpoptAdapter::intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number cost, Number violation,
                                         Number dual_violation, Number barrier, Number step, Number regularization,
                                         Number alpha_du, Number alpha_pr, Index trials, const Ipopt::IpoptData* data,
                                         Ipopt::IpoptCalculatedQuantities*) {
  const bool restoration = mode == Ipopt::RestorationPhaseMode;
  iterations_ = iteration;
  clock_linear_solver(data, restoration);
  try {
    const ForkGate::Opening opening;
    reserve();
    if (options_.logger) {
      char line[160];
      if (!header_written_)
        options_.logger(LogLevel::info,
                        "iter      cost      inf_pr   inf_du lg(mu)  ||d||  lg(rg) alpha_du alpha_pr  ls");
      header_written_ = true;
      char lg_regularization[8] = "    -";
      if (regularization > 0.0)
        std::snprintf(lg_regularization, sizeof lg_regularization, "%5.1f", std::log10(regularization));
      std::snprintf(line, sizeof line, "%4d%c %12.6e %8.2e %8.2e %5.1f %8.2e %s %8.2e %8.2e %3d", iteration,
                    restoration ? 'r' : ' ', cost, violation, dual_violation, std::log10(barrier), step,
                    lg_regularization, alpha_du, alpha_pr, trials);
      options_.logger(LogLevel::info, line);
    }
    if (options_.stop && options_.stop()) reason_ = Reason::stop;
  } catch (...) {
    halt_with_exception();
  }
  if (reason_ == Reason::none && out_of_time()) reason_ = Reason::time;
  return reason_ == Reason::none;
}

void IpoptAdapter::finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*, const Number*,
                                     Index m, const Number*, const Number* multipliers, Number,
                                     const Ipopt::IpoptData* data, Ipopt::IpoptCalculatedQuantities*) {
  last_x_ = Eigen::Map<const VectorXd>(x, n);
  if (m > 0) multipliers_ = Eigen::Map<const VectorXd>(multipliers, m);
  if (data) clock_linear_solver(data, false);
}

void IpoptAdapter::rethrow() const {
  if (thrown_) std::rethrow_exception(thrown_);
}

bool IpoptAdapter::out_of_time() {
  if (!deadline_.limited()) return false;
  const double left_s = deadline_.remaining_s(), took_s = left_s_ - left_s;
  const double expected_s = std::max(took_s, before_s_);
  if (start_s_ == 0.0) start_s_ = took_s;
  before_s_ = took_s;
  left_s_ = left_s;
  return left_s <= reserved_s_ + expected_s;
}

void IpoptAdapter::reserve() {
  if (deadline_.limited() && options_.finishing_s)
    reserved_s_ = std::min(options_.finishing_s(best_.x), 0.5 * options_.time_limit_s);
}

void IpoptAdapter::halt(Reason reason) {
  reason_ = reason;
  throw Halt();
}

void IpoptAdapter::halt_with_exception() {
  thrown_ = std::current_exception();
  halt(Reason::exception);
}

void IpoptAdapter::consider(Index n, const Number* x) {
  if (!rows_known_ && problem_.row_count() > 0) return;
  const double violation = std::max(rows_known_ ? row_violation_ : 0.0,
                                    largest_violation(x, problem_.variable_lower(), problem_.variable_upper()));
  const double enough = options_.constraint_tolerance;
  const bool better = violation <= enough ? cost_known_ && (best_.violation > enough || cost_ < best_.cost)
                                          : violation < best_.violation;
  if (!better) return;
  best_.x = Eigen::Map<const VectorXd>(x, n);
  best_.violation = violation;
  best_.cost = cost_;
}

void IpoptAdapter::clock_linear_solver(const Ipopt::IpoptData* data, bool restoration) {
  // Ipopt 3.11 has no reading access.
  Ipopt::TimingStatistics& timing = const_cast<Ipopt::IpoptData*>(data)->TimingStats();
  // Around all that MUMPS does: with it the clocks of the single parts leave the factorisation out.
  const double total = timing.StdAugSystemSolverMultiSolve().TotalWallclockTime();
  if (!restoration) {
    regular_s_ = total;
    return;
  }
  if (total < restoration_s_) restorations_s_ += restoration_s_;
  restoration_s_ = total;
}

}  // namespace mcplan::nlp
