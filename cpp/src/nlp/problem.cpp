#include "mcplan/nlp/problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mcplan::nlp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A fixed sequence of numbers in [0.5, 1.5) with changing signs: points at which no entry vanishes by accident.
class Probe {
 public:
  double next() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    const double unit = static_cast<double>(state_ >> 11) * 0x1.0p-53;
    return (state_ >> 10) % 2 == 0 ? 0.5 + unit : -0.5 - unit;
  }

 private:
  std::uint64_t state_ = 20211119;
};

/// Places (column-major) of the dense block that are not zero at some of three points.
struct Pattern {
  std::vector<int> jacobian, hessian;
};

Pattern probe(const Piece& piece) {
  constexpr int kPoints = 3;
  const int n = piece.size(), m = piece.rows();
  const int curved = piece.linear() ? 0 : n;  // variables with second derivatives
  MatrixXd jacobian = MatrixXd::Zero(m, n), hessian = MatrixXd::Zero(curved, curved);
  if (piece.entries_come_and_go()) {
    jacobian.setOnes();
    hessian.setOnes();
  }
  Probe random;
  VectorXd x(n), weights(m);
  const int points = piece.linear() ? 1 : kPoints;  // the Jacobian of a linear piece is the same everywhere
  // A number that is not finite (a root, a logarithm) is an entry all the same.
  const auto mark = [](const MatrixXd& values, MatrixXd& entries) {
    for (Eigen::Index i = 0; i < values.size(); ++i)
      if (!(values.data()[i] == 0.0)) entries.data()[i] = 1.0;
  };
  MatrixXd J(m, n), H(hessian.rows(), hessian.cols());
  for (int trial = 0; trial < points; ++trial) {
    for (double& value : x) value = random.next();
    for (double& value : weights) value = random.next();
    J.setZero();
    piece.jacobian(x, J);
    mark(J, jacobian);
    if (piece.linear()) continue;
    H.setZero();
    piece.hessian(x, weights, H);
    mark(H, hessian);
  }
  Pattern out;
  for (int i = 0; i < m * n; ++i)
    if (jacobian.data()[i] != 0.0) out.jacobian.push_back(i);
  for (int column = 0; column < curved; ++column)
    for (int row = column; row < curved; ++row)
      if (hessian(row, column) != 0.0) out.hessian.push_back(column * n + row);
  return out;
}

/// Entries of a sparse matrix in the order of first mention, without repetition.
class Places {
 public:
  explicit Places(std::vector<Entry>& entries) : entries_(entries) {}

  int of(int row, int column) {
    if (2 * (entries_.size() + 1) > slots_.size()) grow();
    int& slot = find(row, column);
    if (slot < 0) {
      slot = static_cast<int>(entries_.size());
      entries_.push_back({row, column});
    }
    return slot;
  }

 private:
  /// Where the entry is, or where it would be: open addressing in a table of a power of two.
  int& find(int row, int column) {
    const std::uint64_t key = (static_cast<std::uint64_t>(row) << 32) | static_cast<std::uint32_t>(column);
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = key * 0x9E3779B97F4A7C15ULL >> shift_;  // the highest bits, on which row and column both tell
    while (slots_[at] >= 0 && (entries_[slots_[at]].row != row || entries_[slots_[at]].column != column))
      at = (at + 1) & mask;
    return slots_[at];
  }
  void grow() {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), -1);
    shift_ = slots_.size() == 64 ? 58 : shift_ - 1;
    for (std::size_t i = 0; i < entries_.size(); ++i) find(entries_[i].row, entries_[i].column) = static_cast<int>(i);
  }

  std::vector<Entry>& entries_;
  std::vector<int> slots_;  ///< index of an entry, or -1; a power of two, 2^(64 - shift_)
  int shift_ = 0;
};

double violation(double value, double lower, double upper) { return std::max({lower - value, value - upper, 0.0}); }

}  // namespace

int Problem::add_variables(const std::string& name, int count, double lower, double upper, Stages stages) {
  const int first = variable_count();
  groups_.push_back({name, first});
  lower_.insert(lower_.end(), count, lower);
  upper_.insert(upper_.end(), count, upper);
  stages_.insert(stages_.end(), count, stages);
  return first;
}

void Problem::set_bounds(int variable, double lower, double upper) {
  lower_[variable] = lower;
  upper_[variable] = upper;
}

void Problem::add_constraint(std::unique_ptr<Piece> piece, VectorXd lower, VectorXd upper) {
  Block block;
  block.first_row = row_count_;
  row_count_ += piece->rows();
  row_lower_.insert(row_lower_.end(), lower.data(), lower.data() + lower.size());
  row_upper_.insert(row_upper_.end(), upper.data(), upper.data() + upper.size());
  block.piece = std::move(piece);
  blocks_.push_back(std::move(block));
}

void Problem::add_constraint(std::unique_ptr<Piece> piece, double lower, double upper) {
  const int rows = piece->rows();
  add_constraint(std::move(piece), VectorXd::Constant(rows, lower), VectorXd::Constant(rows, upper));
}

void Problem::add_cost(std::unique_ptr<Piece> piece) {
  Block block;
  block.piece = std::move(piece);
  blocks_.push_back(std::move(block));
}

void Problem::finish_for_values() {
  int max_variables = 0, max_rows = 0;
  for (const Block& block : blocks_) {
    max_variables = std::max(max_variables, block.piece->size());
    max_rows = std::max(max_rows, block.piece->rows());
  }
  x_.resize(max_variables);
  f_.resize(max_rows);
}

bool Problem::finish(const StopRequest& stop) {
  jacobian_.clear();
  hessian_.clear();
  Places hessian(hessian_);
  for (Block& block : blocks_) {
    if (stop && stop()) return false;
    const Piece& piece = *block.piece;
    const std::vector<int>& variables = piece.variables();
    const Pattern pattern = probe(piece);
    block.jacobian_from = pattern.jacobian;
    block.hessian_from = pattern.hessian;
    block.jacobian_at.clear();
    block.hessian_at.clear();
    for (int at : pattern.jacobian) {
      const int row = at % piece.rows(), column = variables[at / piece.rows()];
      // A cost's derivatives go into the dense gradient; of other entries none is mentioned twice, since each block has
      // rows of its own and no variable twice.
      block.jacobian_at.push_back(block.is_cost() ? column : static_cast<int>(jacobian_.size()));
      if (!block.is_cost()) jacobian_.push_back({block.first_row + row, column});
    }
    for (int at : pattern.hessian) {
      const int a = variables[at % piece.size()], b = variables[at / piece.size()];
      block.hessian_at.push_back(hessian.of(std::max(a, b), std::min(a, b)));
    }
  }
  finish_for_values();
  weights_.resize(f_.size());
  buffer_ = VectorXd::Zero(std::max(x_.size(), f_.size()) * x_.size());

  linear_jacobian_ = VectorXd::Zero(static_cast<int>(jacobian_.size()));
  for (const Block& block : blocks_) {
    if (block.is_cost() || !block.piece->linear()) continue;
    MatrixXd J = MatrixXd::Zero(block.piece->rows(), block.piece->size());
    block.piece->jacobian(VectorXd::Zero(block.piece->size()), J);
    for (std::size_t i = 0; i < block.jacobian_at.size(); ++i)
      linear_jacobian_[block.jacobian_at[i]] += J.data()[block.jacobian_from[i]];
  }
  return true;
}

int Problem::equality_count() const {
  int count = 0;
  for (int i = 0; i < row_count_; ++i) count += row_lower_[i] == row_upper_[i];
  return count;
}

ConstVector Problem::gather(const Block& block, const ConstVector& x) const {
  const std::vector<int>& variables = block.piece->variables();
  for (std::size_t i = 0; i < variables.size(); ++i) x_[i] = x[variables[i]];
  return x_.head(variables.size());
}

Eigen::Map<MatrixXd> Problem::zeroed(int rows, int columns, const std::vector<int>& entries) const {
  // Of a block of thousands of entries some hundred are ever looked at, often close together.
  constexpr std::size_t kClose = 4;
  const std::size_t span = entries.empty() ? 0 : entries.back() - entries.front() + 1;
  if (span <= kClose * entries.size())
    std::fill_n(buffer_.data() + (entries.empty() ? 0 : entries.front()), span, 0.0);
  else
    for (int entry : entries) buffer_[entry] = 0.0;
  return {buffer_.data(), rows, columns};
}

double Problem::cost(const ConstVector& x) const {
  double total = 0.0;
  for (const Block& block : blocks_) {
    if (!block.is_cost()) continue;
    block.piece->values(gather(block, x), f_.head(block.piece->rows()));
    total += f_.head(block.piece->rows()).sum();
  }
  return total;
}

void Problem::gradient(const ConstVector& x, Vector out) const {
  out.setZero();
  for (const Block& block : blocks_) {
    if (!block.is_cost()) continue;
    auto J = zeroed(block.piece->rows(), block.piece->size(), block.jacobian_from);
    block.piece->jacobian(gather(block, x), J);
    for (std::size_t i = 0; i < block.jacobian_at.size(); ++i)
      out[block.jacobian_at[i]] += J.data()[block.jacobian_from[i]];
  }
}

void Problem::rows(const ConstVector& x, Vector out) const {
  for (const Block& block : blocks_)
    if (!block.is_cost()) block.piece->values(gather(block, x), out.segment(block.first_row, block.piece->rows()));
}

void Problem::jacobian(const ConstVector& x, Vector values) const {
  values = linear_jacobian_;
  for (const Block& block : blocks_) {
    if (block.is_cost() || block.piece->linear() || block.jacobian_at.empty()) continue;
    auto J = zeroed(block.piece->rows(), block.piece->size(), block.jacobian_from);
    block.piece->jacobian(gather(block, x), J);
    double* to = values.data() + block.jacobian_at.front();  // a block's entries follow one another
    for (int from : block.jacobian_from) *to++ = J.data()[from];
  }
}

void Problem::hessian(const ConstVector& x, double cost_factor, const ConstVector& multipliers, Vector values) const {
  values.setZero();
  for (const Block& block : blocks_) {
    const int n = block.piece->size(), m = block.piece->rows();
    if (block.hessian_at.empty()) continue;
    if (block.is_cost())
      weights_.head(m).setConstant(cost_factor);
    else
      weights_.head(m) = multipliers.segment(block.first_row, m);
    auto H = zeroed(n, n, block.hessian_from);
    block.piece->hessian(gather(block, x), weights_.head(m), H);
    for (std::size_t i = 0; i < block.hessian_at.size(); ++i)
      values[block.hessian_at[i]] += H.data()[block.hessian_from[i]];
  }
}

void Problem::gauss_newton_hessian(const ConstVector& x, Vector values) const {
  values.setZero();
  for (const Block& block : blocks_) {
    const int n = block.piece->size(), m = block.piece->rows();
    if (block.hessian_at.empty() || !block.is_cost()) continue;
    weights_.head(m).setOnes();
    auto H = zeroed(n, n, block.hessian_from);
    block.piece->gauss_newton_hessian(gather(block, x), weights_.head(m), H);
    for (std::size_t i = 0; i < block.hessian_at.size(); ++i)
      values[block.hessian_at[i]] += H.data()[block.hessian_from[i]];
  }
}

Problem::Worst Problem::worst_violation(const ConstVector& x) const {
  Worst worst;
  for (int i = 0; i < variable_count(); ++i) {
    const double amount = violation(x[i], lower_[i], upper_[i]);
    if (amount > worst.value) worst = {variable_name(i), amount};
  }
  VectorXd values(row_count_);
  rows(x, values);
  int row = -1;
  for (int i = 0; i < row_count_; ++i) {
    const double amount = violation(values[i], row_lower_[i], row_upper_[i]);
    if (amount <= worst.value) continue;
    worst.value = amount;
    row = i;
    if (std::isnan(amount)) break;  // nothing is worse
  }
  if (row >= 0) worst.name = row_name(row);
  return worst;
}

std::string Problem::first_not_finite(const ConstVector& x) const {
  for (const Block& block : blocks_) {
    const Piece& piece = *block.piece;
    const VectorXd local = gather(block, x);
    VectorXd values(piece.rows());
    MatrixXd J = MatrixXd::Zero(piece.rows(), piece.size()), H = MatrixXd::Zero(piece.size(), piece.size());
    piece.values(local, values);
    piece.jacobian(local, J);
    piece.hessian(local, VectorXd::Ones(piece.rows()), H);
    if (values.allFinite() && J.allFinite() && H.allFinite()) continue;
    return (block.is_cost() ? "cost " : "constraint ") + piece_name(block);
  }
  return "";
}

std::string Problem::variable_name(int variable) const {
  const auto after =
      std::upper_bound(groups_.begin(), groups_.end(), variable, [](int v, const Group& g) { return v < g.first; });
  const Group& group = *(after - 1);
  const bool alone = (after == groups_.end() ? variable_count() : after->first) == group.first + 1;
  return group.name + (alone ? "" : "[" + std::to_string(variable - group.first) + "]") + " at stage " +
         std::to_string(stages_[variable].first);
}

std::string Problem::row_name(int row) const {
  for (const Block& block : blocks_) {
    if (block.is_cost() || row < block.first_row || row >= block.first_row + block.piece->rows()) continue;
    const std::string name = block.piece->row_name(row - block.first_row);
    return name + " at stage " + std::to_string(piece_stages(*block.piece).last);
  }
  return "row " + std::to_string(row);
}

std::string Problem::piece_name(const Block& block) const {
  return block.piece->name() + " at stage " + std::to_string(piece_stages(*block.piece).last);
}

Stages Problem::piece_stages(const Piece& piece) const {
  int first = -1, last = -1, alive = 0;
  for (int variable : piece.variables()) {
    const Stages& at = stages_[variable];
    alive = std::max(alive, at.first);
    if (at.first != at.last) continue;
    first = first < 0 ? at.first : std::min(first, at.first);
    last = std::max(last, at.last);
  }
  return first < 0 ? Stages{alive, alive} : Stages{first, last};
}

}  // namespace mcplan::nlp
