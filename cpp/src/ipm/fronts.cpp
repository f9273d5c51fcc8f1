#include "ipm/fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ipm/chunk.hpp"
#include "ipm/pivoting.hpp"
#include "mcplan/base/error.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Block = Eigen::Map<MatrixXd, 0, Eigen::OuterStride<>>;

/// Up to this size a pivot counts as zero.
constexpr double kLeastPivot = 1e-300;
constexpr long kMaxEntries = std::numeric_limits<int>::max();  // places are ints

/// Rows x Columns of W, from column j on: W(:, j) -= sum over k < end of W(:, k) L(j, k).
template <int Rows, int Columns>
void subtract_products(double* W, int width, const double* L, int stride, int j, int end) {
  Eigen::Array<double, Rows, 1> sums[Columns];
  for (int c = 0; c < Columns; ++c) sums[c] = Eigen::Map<Eigen::Array<double, Rows, 1>>(W + (j + c) * width);
  for (int k = 0; k < end; ++k) {
    const Eigen::Array<double, Rows, 1> left = Eigen::Map<const Eigen::Array<double, Rows, 1>>(W + k * width);
    const double* factors = L + static_cast<long>(k) * stride + j;
    for (int c = 0; c < Columns; ++c) sums[c] -= factors[c] * left;
  }
  for (int c = 0; c < Columns; ++c) Eigen::Map<Eigen::Array<double, Rows, 1>>(W + (j + c) * width) = sums[c];
}

/// Some rows of W become W L^-T, with the unit triangle L of m columns.
template <int Rows>
void solve_rows(double* W, int width, const double* L, int stride, int m) {
  int j = 0;
  for (; j + kChunk <= m; j += kChunk) {
    subtract_products<Rows, kChunk>(W, width, L, stride, j, j);
    for (int c = 1; c < kChunk; ++c)
      for (int k = 0; k < c; ++k)
        Eigen::Map<Eigen::Array<double, Rows, 1>>(W + (j + c) * width) -=
            L[static_cast<long>(j + k) * stride + j + c] *
            Eigen::Map<const Eigen::Array<double, Rows, 1>>(W + (j + k) * width);
  }
  for (; j < m; ++j) subtract_products<Rows, 1>(W, width, L, stride, j, j);
}

/// out = a block of Rows x kChunk of W R', sums over m columns.
template <int Rows>
void block_of_product(const double* W, int width, const double* R, int stride, int m, double* out, int out_stride) {
  Eigen::Array<double, Rows, 1> sums[kChunk];
  for (int c = 0; c < kChunk; ++c) sums[c].setZero();
  for (int k = 0; k < m; ++k) {
    const Eigen::Array<double, Rows, 1> left =
        Eigen::Map<const Eigen::Array<double, Rows, 1>>(W + static_cast<long>(k) * width);
    const double* right = R + static_cast<long>(k) * stride;
    for (int c = 0; c < kChunk; ++c) sums[c] += right[c] * left;
  }
  for (int c = 0; c < kChunk; ++c)
    Eigen::Map<Eigen::Array<double, Rows, 1>>(out + static_cast<long>(c) * out_stride) = sums[c];
}

}  // namespace

Fronts::Fronts(int count, std::vector<std::vector<int>> order, const std::vector<Pair>& pairs) {
  std::vector<int> group_of(count, -1);
  for (std::size_t g = 0; g < order.size(); ++g)
    for (int unknown : order[g]) group_of[unknown] = static_cast<int>(g);
  find_fronts(std::move(order), group_of, pairs);
  long size = 0, scaled = 0, update = 0;
  int largest = 0, own = 0;
  for (const Front& front : fronts_) {
    const long rest = front.stride - front.own;
    size += static_cast<long>(front.stride) * front.own;
    scaled = std::max(scaled, rest * front.own);
    update = std::max(update, rest * rest);
    largest = std::max(largest, front.size());
    own = std::max(own, whole_chunks(front.own));
    longest_ = std::max(longest_, front.stride);
  }
  if (size > kMaxEntries)
    throw InvalidInput("problem",
                       "must have a factor of at most " + std::to_string(kMaxEntries) +
                           " entries: fewer "
                           "variables and equalities at one stage",
                       std::to_string(size) + " entries, " + std::to_string(largest) + " unknowns at one of them");
  find_places(group_of, pairs);
  values_ = VectorXd::Zero(size);
  pivots_.resize(count);
  off_diagonal_.assign(count, 0.0);
  least_pivots_ = VectorXd::Zero(count);
  own_ = VectorXd::Zero(static_cast<long>(own) * own);
  scaled_.resize(scaled);
  update_.resize(update);
  work_ = VectorXd::Zero(2 * longest_);
}

void Fronts::find_fronts(std::vector<std::vector<int>> order, const std::vector<int>& group_of,
                         const std::vector<Pair>& pairs) {
  std::vector<int> position(group_of.size(), -1);
  int next = 0;
  for (const std::vector<int>& group : order)
    for (int unknown : group) position[unknown] = next++;
  // The later one of each pair belongs to the front of the earlier one.
  std::vector<std::vector<int>> later(order.size());
  for (const Pair& pair : pairs) {
    const int a = group_of[pair.first], b = group_of[pair.second];
    if (a < b) later[a].push_back(pair.second);
    if (b < a) later[b].push_back(pair.first);
  }
  long offset = 0;
  int column = 0;
  for (std::size_t g = 0; g < order.size(); ++g) {
    std::vector<int>& rest = later[g];
    std::sort(rest.begin(), rest.end(), [&](int a, int b) { return position[a] < position[b]; });
    rest.erase(std::unique(rest.begin(), rest.end()), rest.end());
    Front front;
    front.own = static_cast<int>(order[g].size());
    front.unknowns = std::move(order[g]);
    front.unknowns.insert(front.unknowns.end(), rest.begin(), rest.end());
    front.first_column = column;
    front.offset = offset;
    front.stride = front.own + whole_chunks(front.rest());
    column += front.own;
    offset += static_cast<long>(front.stride) * front.own;
    // What is left of this front couples its other unknowns with each other.
    if (!rest.empty()) {
      const int parent = group_of[rest.front()];
      for (int unknown : rest)
        if (group_of[unknown] != parent) later[parent].push_back(unknown);
    }
    fronts_.push_back(std::move(front));
  }
}

void Fronts::find_places(const std::vector<int>& group_of, const std::vector<Pair>& pairs) {
  // Front by front, so that `local` is filled once for each: the pairs that lie in it, and those of fronts before it.
  std::vector<std::vector<int>> pairs_of(fronts_.size());
  for (std::size_t p = 0; p < pairs.size(); ++p)
    pairs_of[std::min(group_of[pairs[p].first], group_of[pairs[p].second])].push_back(static_cast<int>(p));
  std::vector<std::vector<int>> before(fronts_.size());
  for (std::size_t g = 0; g < fronts_.size(); ++g) {
    Front& front = fronts_[g];
    const int rest = front.size() - front.own;
    front.first_update = static_cast<long>(updates_.size());
    updates_.resize(updates_.size() + static_cast<std::size_t>(rest) * (rest + 1) / 2);
    int last = -1;
    for (int i = front.own; i < front.size(); ++i) {
      const int owner = group_of[front.unknowns[i]];
      if (owner != last) before[owner].push_back(static_cast<int>(g));
      last = owner;
    }
  }
  places_.resize(pairs.size());
  diagonal_.resize(group_of.size());
  std::vector<int> local(group_of.size(), -1);
  for (std::size_t g = 0; g < fronts_.size(); ++g) {
    const Front& front = fronts_[g];
    for (int i = 0; i < front.size(); ++i) local[front.unknowns[i]] = i;
    const auto place = [&](int a, int b) {
      return static_cast<int>(front.offset + static_cast<long>(std::min(a, b)) * front.stride + std::max(a, b));
    };
    for (int i = 0; i < front.own; ++i) diagonal_[front.unknowns[i]] = place(i, i);
    for (int p : pairs_of[g]) places_[p] = place(local[pairs[p].first], local[pairs[p].second]);
    for (int earlier : before[g]) {
      const Front& from = fronts_[earlier];
      int* at = updates_.data() + from.first_update;
      for (int j = from.own; j < from.size(); ++j)
        for (int i = j; i < from.size(); ++i, ++at)
          if (group_of[from.unknowns[j]] == static_cast<int>(g))
            *at = place(local[from.unknowns[i]], local[from.unknowns[j]]);
    }
  }
}

Fronts::Inertia Fronts::factor(const std::vector<int>& most_negative) {
  Inertia total;
  for (std::size_t g = 0; g < fronts_.size(); ++g) {
    const Front& front = fronts_[g];
    const int m = front.own;
    Block own(values_.data() + front.offset, m, m, Eigen::OuterStride<>(front.stride));
    int* pivots = pivots_.data() + front.first_column;
    double* off_diagonal = off_diagonal_.data() + front.first_column;
    const PivotCount count = eliminate_own(own, pivots, off_diagonal);
    total.positive += count.positive;
    total.negative += count.negative;
    total.zero += count.zero;
    for (int k = 0; k < m && count.zero == 0; k += off_diagonal[k] == 0.0 ? 1 : 2)
      if (off_diagonal[k] == 0.0 && own(k, k) < 0.0 && -own(k, k) < least_pivots_[front.unknowns[pivots[k]]])
        ++total.zero;
    total.too_many_negative = !most_negative.empty() && total.negative > most_negative[g];
    if (total.zero > 0 || total.too_many_negative) return total;
    if (front.rest() == 0) continue;
    eliminate_rest(front);
    subtract_update(front);
  }
  return total;
}

/// In a copy whose columns are whole chunks, if they are not.
PivotCount Fronts::eliminate_own(Eigen::Ref<MatrixXd> own, int* pivots, double* off_diagonal) {
  const int m = static_cast<int>(own.rows()), padded = whole_chunks(m);
  if (padded == m) return eliminate(own, m, pivots, off_diagonal, kLeastPivot);
  Block copy(own_.data(), padded, m, Eigen::OuterStride<>(padded));
  for (int k = 0; k < m; ++k) {
    std::copy_n(&own(k, k), m - k, &copy(k, k));
    std::fill_n(&copy(m - 1, k) + 1, padded - m, 0.0);
  }
  const PivotCount count = eliminate(copy, m, pivots, off_diagonal, kLeastPivot);
  for (int k = 0; k < m; ++k) std::copy_n(&copy(k, k), m - k, &own(k, k));
  return count;
}

/// The rows below a front's own ones: of L D into scaled_, of L in place, once its own block is factorised.
void Fronts::eliminate_rest(const Front& front) {
  const int m = front.own, width = front.stride - m, stride = front.stride;
  double* F = values_.data() + front.offset;
  double* W = scaled_.data();
  const int* pivots = pivots_.data() + front.first_column;
  const double* off_diagonal = off_diagonal_.data() + front.first_column;
  for (int k = 0; k < m; ++k)
    for (int i = 0; i < width; i += kChunk)
      ChunkAt(W + k * width + i) = ConstChunkAt(F + static_cast<long>(pivots[k]) * stride + m + i);
  int row = 0;
  for (; row + 2 * kChunk <= width; row += 2 * kChunk) solve_rows<2 * kChunk>(W + row, width, F, stride, m);
  for (; row < width; row += kChunk) solve_rows<kChunk>(W + row, width, F, stride, m);
  for (int k = 0; k < m; ++k) {
    double* to = F + static_cast<long>(k) * stride + m;
    const double pivot = F[static_cast<long>(k) * stride + k];
    if (off_diagonal[k] == 0.0) {
      const double inverse = 1.0 / pivot;
      for (int i = 0; i < width; i += kChunk) ChunkAt(to + i) = inverse * ConstChunkAt(W + k * width + i);
      continue;
    }
    // A pivot of size two, scaled by its off-diagonal entry so that nothing overflows.
    const double c = off_diagonal[k], p = pivot / c, q = F[static_cast<long>(k + 1) * stride + k + 1] / c;
    const double scale = 1.0 / (c * (p * q - 1.0));
    for (int i = 0; i < width; i += kChunk) {
      const Chunk a = ConstChunkAt(W + k * width + i), b = ConstChunkAt(W + (k + 1) * width + i);
      ChunkAt(to + i) = scale * (q * a - b);
      ChunkAt(to + stride + i) = scale * (p * b - a);
    }
    ++k;
  }
}

/// What remains, F_rr - L D L': its lower triangle, from the columns of the groups whose unknowns they are.
void Fronts::subtract_update(const Front& front) {
  const int m = front.own, rest = front.rest(), width = front.stride - m;
  const double* L = values_.data() + front.offset + m;
  for (int j = 0; j < width; j += kChunk) {
    int i = j;
    for (; i + 2 * kChunk <= width; i += 2 * kChunk)
      block_of_product<2 * kChunk>(scaled_.data() + i, width, L + j, front.stride, m, update_.data() + j * width + i,
                                   width);
    for (; i < width; i += kChunk)
      block_of_product<kChunk>(scaled_.data() + i, width, L + j, front.stride, m, update_.data() + j * width + i,
                               width);
  }
  const int* at = updates_.data() + front.first_update;
  for (int j = 0; j < rest; ++j) {
    const double* column = update_.data() + j * width;
    for (int i = j; i < rest; ++i) values_[*at++] -= column[i];
  }
}

void Fronts::solve(VectorXd& b) const { solve_all<1>({b.data()}); }

void Fronts::solve(VectorXd& a, VectorXd& b) const { solve_all<2>({a.data(), b.data()}); }

template <int Count>
void Fronts::solve_all(const std::array<double*, Count>& b) const {
  std::array<double*, Count> work;
  for (int c = 0; c < Count; ++c) work[c] = work_.data() + c * longest_;
  solve_forward<Count>(b, work);
  solve_backward<Count>(b, work);
}

/// With L, from the first front to the last.
template <int Count>
void Fronts::solve_forward(const std::array<double*, Count>& b, const std::array<double*, Count>& y) const {
  for (const Front& front : fronts_) {
    const int m = front.own, rest = front.rest(), stride = front.stride;
    const double* F = values_.data() + front.offset;
    const int* pivots = pivots_.data() + front.first_column;
    const int* unknowns = front.unknowns.data();
    for (int c = 0; c < Count; ++c)
      for (int i = 0; i < m; ++i) y[c][i] = b[c][unknowns[pivots[i]]];
    for (int k = 0; k < m; ++k) {
      const double* column = F + static_cast<long>(k) * stride;
      for (int c = 0; c < Count; ++c) {
        const double value = y[c][k];
        double* out = y[c];
        int i = k + 1;
        for (; i + kChunk <= m; i += kChunk) ChunkAt(out + i) -= value * ConstChunkAt(column + i);
        for (; i < m; ++i) out[i] -= value * column[i];
      }
    }
    for (int i = m; i < stride; i += kChunk) {
      std::array<Chunk, Count> sums;
      for (Chunk& sum : sums) sum.setZero();
      for (int k = 0; k < m; ++k) {
        const Chunk column = ConstChunkAt(F + static_cast<long>(k) * stride + i);
        for (int c = 0; c < Count; ++c) sums[c] -= y[c][k] * column;
      }
      for (int c = 0; c < Count; ++c) ChunkAt(y[c] + i) = sums[c];
    }
    for (int c = 0; c < Count; ++c) {
      for (int i = 0; i < m; ++i) b[c][unknowns[i]] = y[c][i];
      for (int i = 0; i < rest; ++i) b[c][unknowns[m + i]] += y[c][m + i];
    }
  }
}

/// With D and L', from the last front to the first.
template <int Count>
void Fronts::solve_backward(const std::array<double*, Count>& b, const std::array<double*, Count>& y) const {
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int m = front->own, rest = front->rest(), stride = front->stride;
    const double* F = values_.data() + front->offset;
    const int* pivots = pivots_.data() + front->first_column;
    const int* unknowns = front->unknowns.data();
    const double* off_diagonal = off_diagonal_.data() + front->first_column;
    for (int c = 0; c < Count; ++c) {
      for (int i = 0; i < rest; ++i) y[c][m + i] = b[c][unknowns[m + i]];
      for (int i = m + rest; i < stride; ++i) y[c][i] = 0.0;
    }
    for (int k = 0; k < m; ++k) {
      const double pivot = F[static_cast<long>(k) * stride + k];
      if (off_diagonal[k] == 0.0) {
        for (int c = 0; c < Count; ++c) y[c][k] = b[c][unknowns[k]] / pivot;
        continue;
      }
      // A pivot of size two, as in eliminate_rest().
      const double o = off_diagonal[k], p = pivot / o, q = F[static_cast<long>(k + 1) * stride + k + 1] / o;
      for (int c = 0; c < Count; ++c) {
        const double value = b[c][unknowns[k]], next = b[c][unknowns[k + 1]];
        y[c][k] = (q * value - next) / (o * (p * q - 1.0));
        y[c][k + 1] = (p * next - value) / (o * (p * q - 1.0));
      }
      ++k;
    }
    for (int k = m - 1; k >= 0; --k) {
      const double* column = F + static_cast<long>(k) * stride;
      std::array<Chunk, Count> sums;
      for (Chunk& sum : sums) sum.setZero();
      int i = stride;
      for (; i - kChunk > k; i -= kChunk)
        for (int c = 0; c < Count; ++c) sums[c] += ConstChunkAt(column + i - kChunk) * ConstChunkAt(y[c] + i - kChunk);
      for (int c = 0; c < Count; ++c) {
        double sum = sums[c].sum();
        for (int j = k + 1; j < i; ++j) sum += column[j] * y[c][j];
        y[c][k] -= sum;
      }
    }
    for (int c = 0; c < Count; ++c)
      for (int i = 0; i < m; ++i) b[c][unknowns[pivots[i]]] = y[c][i];
  }
}

int Fronts::largest_front() const {
  int largest = 0;
  for (const Front& front : fronts_) largest = std::max(largest, front.size());
  return largest;
}

}  // namespace mcplan::ipm
