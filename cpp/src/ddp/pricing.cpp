#include "ddp/pricing.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/over_steps.hpp"

namespace mcplan::ddp {
namespace {

/// In place of an end-effector: the rows of the state as a whole.
constexpr int kWholeState = -1;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

bool StepPricing::prepare(LocalModel& model, const ValueFunctions& values, int k,
                          const std::vector<ContactState>& candidates) {
  const Layout& at = model.problem().layout;
  problem_ = &model.problem();
  const int nx = at.nx(), nz = at.nz();
  spans_.clear();
  int total = 0;
  const Rows* whole = nullptr;
  for (const ContactState& state : candidates) {
    if (!whole && (whole = model.state_block(k, state))) {
      spans_.push_back({kWholeState, kFree, total, whole->count()});
      total += whole->count();
    }
    for (int l = 0; l < at.end_effector_count(); ++l) {
      const bool known =
          std::any_of(spans_.begin(), spans_.end(), [&](const Span& s) { return s.end == l && s.contact == state[l]; });
      if (known) continue;
      const int count = model.block(k, l, state[l]).count();
      spans_.push_back({l, state[l], total, count});
      total += count;
    }
  }

  const Quadratic& q = values.without_contacts(k);
  w_ = q.h.transpose();  // of which the factorisation reads the lower triangle
  w_.topLeftCorner(nx, nx) += values.U(k).h;
  factor_.compute(w_);
  if (factor_.info() != Eigen::Success) return false;
  mean_ = q.g;
  mean_.head(nx) += values.U(k).g;
  factor_.matrixL().solveInPlace(mean_);
  base_cost_ = q.c + values.U(k).c - 0.5 * mean_.squaredNorm();

  // Rows of one input alone, most of them, need no solve of their own: with W = L L', their columns of L^-1 are those
  // of the inverse of L's last block.
  const int nu = at.nu();
  input_factor_.setIdentity(nu, nu);
  factor_.matrixLLT().bottomRightCorner(nu, nu).triangularView<Eigen::Lower>().solveInPlace(input_factor_);
  input_covariance_.noalias() = input_factor_.transpose() * input_factor_;
  input_mean_.noalias() = input_factor_.transpose() * mean_.tail(nu);

  table_.clear();
  general_count_ = 0;
  if (rows_.rows() != nz || rows_.cols() < total) rows_.resize(nz, std::max(total, 1));
  for (const Span& span : spans_) {
    const Rows& block = span.end == kWholeState ? *whole : model.block(k, span.end, span.contact);
    for (int r = 0; r < span.count; ++r) add_row(block, r);
  }
  auto general = rows_.leftCols(general_count_);
  factor_.matrixL().solveInPlace(general);
  gram_.resize(general_count_, general_count_);
  gram_.noalias() = general.transpose() * general;
  cross_.resize(general_count_, nu);
  cross_.noalias() = general.bottomRows(nu).transpose() * input_factor_;
  for (Row& row : table_) row.value -= row.input >= 0 ? input_mean_[row.input] : general.col(row.general).dot(mean_);
  return true;
}

void StepPricing::add_row(const Rows& block, int r) {
  const int nx = problem_->layout.nx();
  Row row{-1, -1, block.value(r), 1.0 / block.precision(r)};
  if (block.single(r) >= nx) {
    row.input = block.single(r) - nx;
  } else {
    row.general = general_count_;
    rows_.col(general_count_++) = block.gradient(r);
  }
  table_.push_back(row);
}

double StepPricing::covariance(const Row& a, const Row& b) const {
  if (a.input >= 0) return b.input >= 0 ? input_covariance_(a.input, b.input) : cross_(b.general, a.input);
  return b.input >= 0 ? cross_(a.general, b.input) : gram_(a.general, b.general);
}

double StepPricing::price(const ContactState& state) {
  picked_.clear();
  for (const Span& span : spans_)
    if (span.end == kWholeState ? in_flight(state) : state[span.end] == span.contact)
      for (int r = 0; r < span.count; ++r) picked_.push_back(span.first + r);
  const int n = static_cast<int>(picked_.size());
  small_.resize(n, n);
  y_.resize(n);
  for (int j = 0; j < n; ++j) {
    const Row& row = table_[picked_[j]];
    y_[j] = row.value;
    for (int i = j; i < n; ++i) small_(i, j) = covariance(table_[picked_[i]], row);
    small_(j, j) += row.inverse_precision;
  }
  small_factor_.compute(small_);
  small_factor_.matrixL().solveInPlace(y_);
  return base_cost_ + state_cost(*problem_, state) + 0.5 * y_.squaredNorm();
}

const std::vector<Neighbour>& Pricing::all(LocalModel& model, const ValueFunctions& values,
                                           const ContactSequence& sequence) {
  neighbours_.clear();
  const int n = model.steps();
  std::vector<std::pair<std::size_t, std::size_t>> range(n);
  std::vector<std::vector<ContactState>> candidates(n);
  for (int k = 1; k < n; ++k) {
    candidates[k] = model.problem().rules.neighbours(sequence, k);
    range[k] = {neighbours_.size(), neighbours_.size() + candidates[k].size()};
    for (const ContactState& state : candidates[k]) {
      neighbours_.push_back({k, state, std::numeric_limits<double>::infinity()});
      model.make_blocks(k, state);
    }
  }
  // Times of each thread.
  std::vector<double> preparing_s(steps_.size(), 0.0), pricing_s(steps_.size(), 0.0);
  const auto one_step = [&](int k, int thread) {
    if (candidates[k].empty()) return;
    StepPricing& pricing = steps_[thread];
    const auto start = std::chrono::steady_clock::now();
    const bool ok = pricing.prepare(model, values, k, candidates[k]);
    const double prepared = seconds_since(start);
    if (ok)
      for (std::size_t i = range[k].first; i < range[k].second; ++i)
        neighbours_[i].cost = pricing.price(neighbours_[i].state);
    preparing_s[thread] += prepared;
    pricing_s[thread] += seconds_since(start) - prepared;
  };
  const bool worth = neighbours_.size() >= kWorthThreads;
  parallel_loops += over_steps(n, static_cast<int>(steps_.size()), worth, one_step);
  for (double each_s : preparing_s) time_prepare_s += each_s;
  for (double each_s : pricing_s) time_price_s += each_s;
  return neighbours_;
}

const Neighbour* cheapest(const std::vector<Neighbour>& neighbours) {
  const Neighbour* best = nullptr;
  for (const Neighbour& n : neighbours)
    if (!best || clearly_less(n.cost, best->cost)) best = &n;
  return best;
}

}  // namespace mcplan::ddp
