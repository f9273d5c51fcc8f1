#include "ipm/fronts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ipm/pivoting.hpp"
#include "mcplan/base/error.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Block = Eigen::Map<MatrixXd>;
using ConstBlock = Eigen::Map<const MatrixXd>;

/// Up to this size a pivot counts as zero.
constexpr double kLeastPivot = 1e-300;
constexpr long kMaxEntries = std::numeric_limits<int>::max();  // places are ints
constexpr int kPanel = 8;  // columns of what remains that are computed together, from their diagonal on

}  // namespace

Fronts::Fronts(int count, std::vector<std::vector<int>> order, const std::vector<Pair>& pairs) {
  std::vector<int> group_of(count, -1);
  for (std::size_t g = 0; g < order.size(); ++g)
    for (int unknown : order[g]) group_of[unknown] = static_cast<int>(g);
  find_fronts(std::move(order), group_of, pairs);
  long size = 0, scaled = 0, update = 0;
  int largest = 0;
  for (const Front& front : fronts_) {
    const long rest = front.size() - front.own;
    size += static_cast<long>(front.size()) * front.own;
    scaled = std::max(scaled, rest * front.own);
    update = std::max(update, rest * rest);
    largest = std::max(largest, front.size());
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
  scaled_.resize(scaled);
  update_.resize(update);
  own_.resize(largest);
  rest_.resize(largest);
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
    column += front.own;
    offset += static_cast<long>(front.size()) * front.own;
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
    const int n = front.size();
    for (int i = 0; i < n; ++i) local[front.unknowns[i]] = i;
    const auto place = [&](int a, int b) {
      return static_cast<int>(front.offset + static_cast<long>(std::min(a, b)) * n + std::max(a, b));
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

Fronts::Inertia Fronts::factor() {
  Inertia total;
  for (const Front& front : fronts_) {
    const int n = front.size(), m = front.own, rest = n - m;
    Block F(values_.data() + front.offset, n, m);
    int* pivots = pivots_.data() + front.first_column;
    double* off_diagonal = off_diagonal_.data() + front.first_column;
    const PivotCount count = eliminate(F, m, pivots, off_diagonal, kLeastPivot);
    total.positive += count.positive;
    total.negative += count.negative;
    total.zero += count.zero;
    for (int k = 0; k < m && count.zero == 0; k += off_diagonal[k] == 0.0 ? 1 : 2)
      if (off_diagonal[k] == 0.0 && F(k, k) < 0.0 && -F(k, k) < least_pivots_[front.unknowns[pivots[k]]]) ++total.zero;
    if (total.zero > 0) return total;
    if (rest == 0) continue;
    // What remains: F_rr - L D L', its lower triangle.
    Block scaled(scaled_.data(), rest, m);
    const auto L = F.bottomRows(rest);
    for (int k = 0; k < m; ++k) {
      if (off_diagonal[k] != 0.0) {
        scaled.col(k) = F(k, k) * L.col(k) + off_diagonal[k] * L.col(k + 1);
        scaled.col(k + 1) = off_diagonal[k] * L.col(k) + F(k + 1, k + 1) * L.col(k + 1);
        ++k;
      } else {
        scaled.col(k) = F(k, k) * L.col(k);
      }
    }
    Block update(update_.data(), rest, rest);
    for (int j = 0; j < rest; j += kPanel) {
      const int columns = std::min(kPanel, rest - j);
      update.block(j, j, rest - j, columns) =
          scaled.bottomRows(rest - j).lazyProduct(L.middleRows(j, columns).transpose());
    }
    const int* at = updates_.data() + front.first_update;
    for (int j = 0; j < rest; ++j)
      for (int i = j; i < rest; ++i) values_[*at++] -= update(i, j);
  }
  return total;
}

void Fronts::solve(VectorXd& b) const {
  for (const Front& front : fronts_) {
    const int n = front.size(), m = front.own, rest = n - m;
    const ConstBlock F(values_.data() + front.offset, n, m);
    const int* pivots = pivots_.data() + front.first_column;
    for (int i = 0; i < m; ++i) own_[i] = b[front.unknowns[pivots[i]]];
    for (int k = 0; k < m; ++k) own_.segment(k + 1, m - k - 1) -= own_[k] * F.col(k).segment(k + 1, m - k - 1);
    for (int i = 0; i < m; ++i) b[front.unknowns[i]] = own_[i];
    if (rest == 0) continue;
    rest_.head(rest).noalias() = F.bottomRows(rest) * own_.head(m);
    for (int i = 0; i < rest; ++i) b[front.unknowns[m + i]] -= rest_[i];
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int n = front->size(), m = front->own, rest = n - m;
    const ConstBlock F(values_.data() + front->offset, n, m);
    const int* pivots = pivots_.data() + front->first_column;
    const double* off_diagonal = off_diagonal_.data() + front->first_column;
    for (int k = 0; k < m; ++k) {
      const double value = b[front->unknowns[k]];
      if (off_diagonal[k] == 0.0) {
        own_[k] = value / F(k, k);
        continue;
      }
      // A pivot of size two, scaled by its off-diagonal entry so that nothing overflows.
      const double c = off_diagonal[k], next = b[front->unknowns[k + 1]];
      const double p = F(k, k) / c, q = F(k + 1, k + 1) / c, determinant = p * q - 1.0;
      own_[k] = (q * value - next) / (c * determinant);
      own_[k + 1] = (p * next - value) / (c * determinant);
      ++k;
    }
    if (rest > 0) {
      for (int i = 0; i < rest; ++i) rest_[i] = b[front->unknowns[m + i]];
      own_.head(m).noalias() -= F.bottomRows(rest).transpose() * rest_.head(rest);
    }
    for (int k = m - 2; k >= 0; --k) own_[k] -= F.col(k).segment(k + 1, m - k - 1).dot(own_.segment(k + 1, m - k - 1));
    for (int i = 0; i < m; ++i) b[front->unknowns[pivots[i]]] = own_[i];
  }
}

int Fronts::largest_front() const {
  int largest = 0;
  for (const Front& front : fronts_) largest = std::max(largest, front.size());
  return largest;
}

}  // namespace mcplan::ipm
