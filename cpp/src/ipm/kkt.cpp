#include "ipm/kkt.hpp"

#include <algorithm>
#include <cmath>

#include "ipm/chunk.hpp"
#include "ipm/order.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxRefinements = 5;
constexpr double kSmallResidual = 1e-9;  // as little as a step of the barrier method needs
constexpr double kNoPivot = 1e-14;       // of an equality, over its size: the rounding errors of nothing
constexpr std::size_t kSparse = 2;       // places for each entry, from which on a block is no dense one
constexpr int kFewRows = 64;             // up to which a product is cheaper without packing its factors

}  // namespace

Kkt::Kkt(const nlp::Problem& problem, const Unknowns& unknowns)
    : problem_(problem), unknowns_(unknowns), n_(unknowns.free_count()), m_(unknowns.equality_count()) {
  pairs_ = structure();
  int widest = 0, longest = 0, weighted = 0, values = 0;
  for (Dense& block : dense_) {
    block.first_value = values;
    values += block.rows * block.width;
    widest = std::max(widest, block.width);
    if (block.rows > kFewRows)
      longest = std::max(longest, block.rows);
    else
      weighted = std::max(weighted, block.rows * block.width);
  }
  for (Dense& block : dense_equalities_) {
    block.first_value = values;
    values += block.rows * block.width;
    widest = std::max(widest, block.width);
  }
  dense_values_ = VectorXd::Zero(values);
  block_ = MatrixXd::Zero(widest, longest);
  product_ = MatrixXd::Zero(widest, widest);
  weighted_ = VectorXd::Zero(weighted);
  gathered_ = VectorXd::Zero(widest);
  slack_weights_ = VectorXd::Zero(unknowns.slack_count());
  slacks_ = slack_weights_;
  bound_weights_ = VectorXd::Zero(n_);
  right_.resize(n_ + m_);
  other_right_.resize(n_ + m_);
  left_a_.resize(n_);
  left_b_.resize(m_);
  set_order(true);
}

void Kkt::set_order(bool sums_ahead) {
  sums_ahead_ = sums_ahead;
  std::vector<std::vector<int>> order = elimination_order(problem_, unknowns_, sums_ahead);
  find_most_negative(order);
  fronts_.emplace(n_ + m_, std::move(order), pairs_);
  const std::vector<int>& places = fronts_->places();
  std::size_t next = 0;
  for (Place& place : hessian_places_) place.to = places[next++];
  for (Place& place : equality_places_) place.to = places[next++];
  for (Dense& block : dense_) {
    block.first_place = static_cast<int>(next);
    next += block.columns * (block.columns + 1) / 2;
  }
}

/// The matrix of the variables and equalities of the first fronts has the Hessian's curvature along what these
/// equalities leave free, later variables held. Where later equalities see none of these variables, all equalities
/// leave it free: more negative pivots than equalities up to there say that the Hessian is not positive.
void Kkt::find_most_negative(const std::vector<std::vector<int>>& order) {
  std::vector<int> group_of(n_ + m_);
  for (std::size_t g = 0; g < order.size(); ++g)
    for (int unknown : order[g]) group_of[unknown] = static_cast<int>(g);
  std::vector<int> open(order.size(), 0);  // changes of how many entries are of a variable before, an equality after
  const auto see = [&](int equality, int variable) {
    const int first = group_of[variable], last = group_of[n_ + equality];
    if (first >= last) return;
    ++open[first];
    --open[last];
  };
  for (const Dense& dense : dense_equalities_)
    for (const Dense::Entry& entry : dense.entries)
      see(dense.targets[entry.to / dense.width], dense.variables[entry.to % dense.width]);
  for (const Term& term : sparse_equalities_) see(term.row, term.column);
  int equalities = 0, crossing = 0;
  most_negative_.clear();
  for (std::size_t g = 0; g < order.size(); ++g) {
    crossing += open[g];
    for (int unknown : order[g]) equalities += unknown >= n_;
    most_negative_.push_back(crossing == 0 ? equalities : m_);
  }
}

std::vector<Fronts::Pair> Kkt::structure() {
  const nlp::Problem& problem = problem_;
  const Unknowns& unknowns = unknowns_;
  std::vector<Fronts::Pair> pairs;
  for (std::size_t i = 0; i < problem.hessian_structure().size(); ++i) {
    const nlp::Entry& entry = problem.hessian_structure()[i];
    const int a = unknowns.index_of[entry.row], b = unknowns.index_of[entry.column];
    if (a < 0 || b < 0) continue;
    hessian_terms_.push_back({static_cast<int>(i), a, b});
    hessian_places_.push_back({static_cast<int>(i), 0});
    pairs.emplace_back(a, b);
  }
  for (std::size_t i = 0; i < problem.jacobian_structure().size(); ++i) {
    const nlp::Entry& entry = problem.jacobian_structure()[i];
    const int column = unknowns.index_of[entry.column];
    if (column < 0) continue;
    if (const int row = unknowns.equality_of[entry.row]; row >= 0) {
      equality_places_.push_back({static_cast<int>(i), 0});
      pairs.emplace_back(column, unknowns.free_count() + row);
    }
  }
  std::vector<int> local(problem.variable_count(), -1);
  for (const nlp::Problem::Block& block : problem.blocks()) {
    if (block.is_cost()) continue;
    Dense equalities = dense_block(block, unknowns.equality_of, unknowns, local);
    const std::size_t filled = equalities.entries.size();
    if (filled * kSparse > static_cast<std::size_t>(equalities.rows * equalities.width))
      dense_equalities_.push_back(std::move(equalities));
    else
      for (const Dense::Entry& entry : equalities.entries)
        sparse_equalities_.push_back({entry.from, equalities.targets[entry.to / equalities.width],
                                      equalities.variables[entry.to % equalities.width]});
    Dense dense = dense_block(block, unknowns.slack_of, unknowns, local);
    if (dense.rows == 0) continue;
    for (int j = 0; j < dense.columns; ++j)
      for (int i = j; i < dense.columns; ++i) pairs.emplace_back(dense.variables[i], dense.variables[j]);
    dense_.push_back(std::move(dense));
  }
  return pairs;
}

/// Of a piece's rows those that are among `target_of`. local: -1 for every variable of the problem, also on return.
Kkt::Dense Kkt::dense_block(const nlp::Problem::Block& block, const std::vector<int>& target_of,
                            const Unknowns& unknowns, std::vector<int>& local) {
  Dense out;
  std::vector<int> local_row(block.piece->rows(), -1), entry_column;
  for (std::size_t i = 0; i < block.jacobian_at.size(); ++i) {
    const int row = block.jacobian_from[i] % block.piece->rows();
    const int variable = block.piece->variables()[block.jacobian_from[i] / block.piece->rows()];
    const int target = target_of[block.first_row + row], column = unknowns.index_of[variable];
    if (target < 0 || column < 0) continue;
    if (local_row[row] < 0) {
      local_row[row] = out.rows++;
      out.targets.push_back(target);
    }
    if (local[variable] < 0) {
      local[variable] = out.columns++;
      out.variables.push_back(column);
    }
    out.entries.push_back({block.jacobian_at[i], local_row[row]});
    entry_column.push_back(local[variable]);
  }
  for (int column : out.variables) local[unknowns.free[column]] = -1;
  out.width = whole_chunks(out.columns);
  out.constant = block.piece->linear();
  for (std::size_t i = 0; i < out.entries.size(); ++i)
    out.entries[i].to = out.entries[i].to * out.width + entry_column[i];
  return out;
}

void Kkt::set_weights(const Eigen::Ref<const VectorXd>& slacks, const Eigen::Ref<const VectorXd>& bounds) {
  slack_weights_ = slacks;
  bound_weights_ = bounds;
}

void Kkt::set_jacobian(const VectorXd& values) {
  jacobian_ = values.data();
  for (const std::vector<Dense>* blocks : {&dense_, &dense_equalities_})
    for (const Dense& dense : *blocks) {
      if (dense.constant && jacobian_set_) continue;
      double* to = dense_values_.data() + dense.first_value;
      for (const Dense::Entry& entry : dense.entries) to[entry.to] = values[entry.from];
    }
  jacobian_set_ = true;
}

/// A' D A of a piece's inequalities.
void Kkt::add_condensed(const Dense& dense) {
  const int rows = dense.rows, columns = dense.columns, width = dense.width;
  const double* A = dense_values_.data() + dense.first_value;
  const int* slacks = dense.targets.data();
  const int* place = fronts_->places().data() + dense.first_place;
  double* values = fronts_->values();
  if (rows <= kFewRows) {
    double* weighted = weighted_.data();
    for (int row = 0; row < rows; ++row)
      for (int from = row * width; from < (row + 1) * width; from += kChunk)
        ChunkAt(weighted + from) = slack_weights_[slacks[row]] * ConstChunkAt(A + from);
    for (int j = 0; j < columns; ++j)
      for (int from = j / kChunk * kChunk; from < columns; from += kChunk) {
        Chunk sum = Chunk::Zero();
        for (int row = 0; row < rows; ++row) sum += weighted[row * width + j] * ConstChunkAt(A + row * width + from);
        const int end = std::min(from + kChunk, columns);
        for (int i = std::max(from, j); i < end; ++i) values[*place++] += sum[i - from];
      }
    return;
  }
  auto weighted = block_.topLeftCorner(columns, rows);
  for (int row = 0; row < rows; ++row)
    weighted.col(row) = std::sqrt(slack_weights_[slacks[row]]) *
                        Eigen::Map<const VectorXd>(A + static_cast<long>(row) * width, columns);
  auto C = product_.topLeftCorner(columns, columns);
  C.setZero();
  C.selfadjointView<Eigen::Lower>().rankUpdate(weighted);
  for (int j = 0; j < columns; ++j)
    for (int i = j; i < columns; ++i) values[*place++] += C(i, j);
}

void Kkt::assemble(double delta, double delta_c) {
  fronts_->set_zero();
  double* values = fronts_->values();
  for (const Place& place : hessian_places_) values[place.to] += hessian_[place.from];
  for (const Place& place : equality_places_) values[place.to] += jacobian_[place.from];
  const std::vector<int>& diagonal = fronts_->diagonal_places();
  for (int i = 0; i < n_; ++i) values[diagonal[i]] += bound_weights_[i] + delta;
  for (int i = 0; i < m_; ++i) values[diagonal[n_ + i]] -= delta_c;
  for (const Dense& dense : dense_) add_condensed(dense);
  if (delta_c > 0.0)
    fronts_->least_pivots().tail(m_).setZero();
  else
    find_least_pivots();
}

/// An equality's pivot is a sum of squares of its coefficients, each over about the variable's diagonal entry.
void Kkt::find_least_pivots() {
  const double* values = fronts_->values();
  const std::vector<int>& diagonal = fronts_->diagonal_places();
  VectorXd& least = fronts_->least_pivots();
  least.tail(m_).setZero();
  for (int i = 0; i < n_; ++i) left_a_[i] = kNoPivot / std::max(1.0, std::abs(values[diagonal[i]]));
  for (const Dense& dense : dense_equalities_) {
    gather(dense, left_a_);
    const double* A = dense_values_.data() + dense.first_value;
    for (int row = 0; row < dense.rows; ++row, A += dense.width) {
      Chunk largest = Chunk::Zero();
      for (int j = 0; j < dense.width; j += kChunk)
        largest = largest.max(ConstChunkAt(A + j).square() * ConstChunkAt(gathered_.data() + j));
      least[n_ + dense.targets[row]] = largest.maxCoeff();
    }
  }
  for (const Term& term : sparse_equalities_) {
    double& of_row = least[n_ + term.row];
    of_row = std::max(of_row, jacobian_[term.from] * jacobian_[term.from] * left_a_[term.column]);
  }
}

Kkt::Factor Kkt::factor(double delta, double delta_c) {
  delta_ = delta;
  delta_c_ = delta_c;
  assemble(delta, delta_c);
  Fronts::Inertia inertia = fronts_->factor(most_negative_);
  if (sums_ahead_ && !inertia.too_many_negative && (inertia.zero > 0 || inertia.negative < m_)) {
    set_order(false);
    assemble(delta, delta_c);
    inertia = fronts_->factor(most_negative_);
  }
  if (inertia.too_many_negative) return Factor::wrong_inertia;
  // Fewer negative pivots than equalities: these say the same twice, and rounding errors stand for what is zero.
  if (inertia.zero > 0 || inertia.negative < m_) return Factor::singular;
  return inertia.negative == m_ ? Factor::good : Factor::wrong_inertia;
}

void Kkt::gather(const Dense& dense, const VectorXd& x) const {
  for (int j = 0; j < dense.columns; ++j) gathered_[j] = x[dense.variables[j]];
  for (int j = dense.columns; j < dense.width; ++j) gathered_[j] = 0.0;
}

/// out = A x, where these rows go.
void Kkt::multiply(const Dense& dense, const VectorXd& x, VectorXd& out) const {
  const int width = dense.width;
  gather(dense, x);
  const double* A = dense_values_.data() + dense.first_value;
  for (int row = 0; row < dense.rows; ++row, A += width) {
    Chunk sum = Chunk::Zero();
    for (int j = 0; j < width; j += kChunk) sum += ConstChunkAt(A + j) * ConstChunkAt(gathered_.data() + j);
    out[dense.targets[row]] = sum.sum();
  }
}

/// out += A' y.
void Kkt::add_transposed(const Dense& dense, const VectorXd& y, VectorXd& out) const {
  const double* A = dense_values_.data() + dense.first_value;
  for (int from = 0; from < dense.columns; from += kChunk) {
    Chunk sum = Chunk::Zero();
    for (int row = 0; row < dense.rows; ++row)
      sum += y[dense.targets[row]] * ConstChunkAt(A + row * dense.width + from);
    const int end = std::min(from + kChunk, dense.columns);
    for (int j = from; j < end; ++j) out[dense.variables[j]] += sum[j - from];
  }
}

void Kkt::multiply_inequalities(const VectorXd& x, VectorXd& out) const {
  out.setZero();  // rows without unknowns, too
  for (const Dense& dense : dense_) multiply(dense, x, out);
}

void Kkt::add_inequalities_transposed(const VectorXd& y, VectorXd& out) const {
  for (const Dense& dense : dense_) add_transposed(dense, y, out);
}

void Kkt::multiply_equalities(const VectorXd& x, VectorXd& out) const {
  out.setZero();
  for (const Dense& dense : dense_equalities_) multiply(dense, x, out);
  for (const Term& term : sparse_equalities_) out[term.row] += jacobian_[term.from] * x[term.column];
}

void Kkt::add_equalities_transposed(const VectorXd& y, VectorXd& out) const {
  for (const Dense& dense : dense_equalities_) add_transposed(dense, y, out);
  for (const Term& term : sparse_equalities_) out[term.column] += jacobian_[term.from] * y[term.row];
}

void Kkt::residual(const VectorXd& a, const VectorXd& b, const VectorXd& dx, const VectorXd& lambda) {
  multiply_equalities(dx, left_b_);
  left_b_ = b - left_b_ + delta_c_ * lambda;
  multiply_inequalities(dx, slacks_);
  slacks_.array() *= slack_weights_.array();
  left_a_.array() = (bound_weights_.array() + delta_) * dx.array();
  for (const Term& term : hessian_terms_) {
    const double value = hessian_[term.from];
    left_a_[term.row] += value * dx[term.column];
    if (term.row != term.column) left_a_[term.column] += value * dx[term.row];
  }
  add_inequalities_transposed(slacks_, left_a_);
  add_equalities_transposed(lambda, left_a_);
  left_a_ = a - left_a_;
}

void Kkt::solve_roughly(const Solution& first_right, const Solution& second_right, Solution& first, Solution& second) {
  right_ << first_right.dx, first_right.lambda;
  other_right_ << second_right.dx, second_right.lambda;
  fronts_->solve(right_, other_right_);
  first.dx = right_.head(n_);
  first.lambda = right_.tail(m_);
  second.dx = other_right_.head(n_);
  second.lambda = other_right_.tail(m_);
}

void Kkt::solve(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  right_ << a, b;
  fronts_->solve(right_);
  dx = right_.head(n_);
  lambda = right_.tail(m_);
  refine(a, b, dx, lambda);
}

void Kkt::refine(const VectorXd& a, const VectorXd& b, VectorXd& dx, VectorXd& lambda) {
  const double largest_a = n_ > 0 ? a.cwiseAbs().maxCoeff() : 0.0, largest_b = m_ > 0 ? b.cwiseAbs().maxCoeff() : 0.0;
  const double size = std::max({largest_a, largest_b, 1e-300});
  double before = nlp::kInfinity;
  for (int i = 0; i <= kMaxRefinements; ++i) {
    residual(a, b, dx, lambda);
    residual_ =
        std::max(n_ > 0 ? left_a_.cwiseAbs().maxCoeff() : 0.0, m_ > 0 ? left_b_.cwiseAbs().maxCoeff() : 0.0) / size;
    if (!(residual_ > kSmallResidual) || !(residual_ < 0.5 * before) || i == kMaxRefinements) return;
    before = residual_;
    right_ << left_a_, left_b_;
    fronts_->solve(right_);
    dx += right_.head(n_);
    lambda += right_.tail(m_);
  }
}

}  // namespace mcplan::ipm
