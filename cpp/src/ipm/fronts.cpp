#include "ipm/fronts.hpp"

#include <algorithm>
#include <cmath>

#include "ipm/pivoting.hpp"

namespace mcplan::ipm {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Block = Eigen::Map<MatrixXd>;
using ConstBlock = Eigen::Map<const MatrixXd>;

/// Up to this size a pivot counts as zero.
constexpr double kLeastPivot = 1e-300;

}  // namespace

Fronts::Fronts(int count, std::vector<std::vector<int>> order, const std::vector<Pair>& pairs) {
  std::vector<int> group_of(count, -1);
  for (std::size_t g = 0; g < order.size(); ++g)
    for (int unknown : order[g]) group_of[unknown] = static_cast<int>(g);
  find_fronts(std::move(order), group_of, pairs);
  find_places(group_of, pairs);
  long size = 0;
  int largest = 0;
  for (Front& front : fronts_) {
    size += static_cast<long>(front.size()) * front.size();
    largest = std::max(largest, front.size());
  }
  values_ = VectorXd::Zero(size);
  pivots_.resize(count);
  off_diagonal_.assign(count, 0.0);
  scaled_.resize(largest, largest);
  own_.resize(largest);
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
    offset += static_cast<long>(front.size()) * front.size();
    if (!rest.empty()) {
      front.parent = group_of[rest.front()];
      std::vector<int>& handed_on = later[front.parent];
      for (int unknown : rest)
        if (group_of[unknown] != front.parent) handed_on.push_back(unknown);
    }
    fronts_.push_back(std::move(front));
  }
}

void Fronts::find_places(const std::vector<int>& group_of, const std::vector<Pair>& pairs) {
  std::vector<int> local(group_of.size(), -1);
  for (Front& front : fronts_) {
    if (front.parent < 0) continue;
    const Front& parent = fronts_[front.parent];
    for (int i = 0; i < parent.size(); ++i) local[parent.unknowns[i]] = i;
    for (int i = front.own; i < front.size(); ++i) front.in_parent.push_back(local[front.unknowns[i]]);
  }
  // Front by front, so that `local` is filled once for each.
  std::vector<std::vector<int>> pairs_of(fronts_.size());
  for (std::size_t p = 0; p < pairs.size(); ++p)
    pairs_of[std::min(group_of[pairs[p].first], group_of[pairs[p].second])].push_back(static_cast<int>(p));
  places_.resize(pairs.size());
  diagonal_.resize(group_of.size());
  for (std::size_t g = 0; g < fronts_.size(); ++g) {
    const Front& front = fronts_[g];
    const int n = front.size();
    for (int i = 0; i < n; ++i) local[front.unknowns[i]] = i;
    const auto place = [&](int a, int b) {
      return static_cast<int>(front.offset + static_cast<long>(std::min(a, b)) * n + std::max(a, b));
    };
    for (int i = 0; i < front.own; ++i) diagonal_[front.unknowns[i]] = place(i, i);
    for (int p : pairs_of[g]) places_[p] = place(local[pairs[p].first], local[pairs[p].second]);
  }
}

Fronts::Inertia Fronts::factor() {
  Inertia total;
  for (const Front& front : fronts_) {
    const int n = front.size(), m = front.own, rest = n - m;
    Block F(values_.data() + front.offset, n, n);
    int* pivots = pivots_.data() + front.first_column;
    double* off_diagonal = off_diagonal_.data() + front.first_column;
    const PivotCount count = eliminate(F, m, pivots, off_diagonal, kLeastPivot);
    total.positive += count.positive;
    total.negative += count.negative;
    total.zero += count.zero;
    if (count.zero > 0) return total;
    if (rest == 0) continue;
    // What remains: F_rr - L D L', its lower triangle.
    auto scaled = scaled_.topLeftCorner(rest, m);
    const auto L = F.bottomLeftCorner(rest, m);
    for (int k = 0; k < m; ++k) {
      if (off_diagonal[k] != 0.0) {
        scaled.col(k) = F(k, k) * L.col(k) + off_diagonal[k] * L.col(k + 1);
        scaled.col(k + 1) = off_diagonal[k] * L.col(k) + F(k + 1, k + 1) * L.col(k + 1);
        ++k;
      } else {
        scaled.col(k) = F(k, k) * L.col(k);
      }
    }
    // Small blocks, of which both triangles cost less than the set-up of a product of one.
    F.bottomRightCorner(rest, rest).noalias() -= scaled.lazyProduct(L.transpose());
    add_to_parent(front);
  }
  return total;
}

void Fronts::add_to_parent(const Front& front) {
  const Front& parent = fronts_[front.parent];
  const int n = front.size(), m = front.own, rest = n - m, size = parent.size();
  const double* from = values_.data() + front.offset + static_cast<long>(m) * n + m;
  double* to = values_.data() + parent.offset;
  // Unknowns stand in the same order in both fronts where neither is the parent's own, and may not otherwise.
  for (int j = 0; j < rest; ++j, from += n) {
    const int column = front.in_parent[j];
    for (int i = j; i < rest; ++i) {
      const int row = front.in_parent[i];
      to[static_cast<long>(std::min(row, column)) * size + std::max(row, column)] += from[i];
    }
  }
}

void Fronts::solve(VectorXd& b) const {
  for (const Front& front : fronts_) {
    const int n = front.size(), m = front.own;
    const ConstBlock F(values_.data() + front.offset, n, n);
    const int* pivots = pivots_.data() + front.first_column;
    for (int i = 0; i < m; ++i) own_[i] = b[front.unknowns[pivots[i]]];
    for (int k = 0; k < m; ++k) own_.segment(k + 1, m - k - 1) -= own_[k] * F.col(k).segment(k + 1, m - k - 1);
    for (int i = 0; i < m; ++i) b[front.unknowns[i]] = own_[i];
    for (int k = 0; k < m; ++k)
      for (int i = m; i < n; ++i) b[front.unknowns[i]] -= F(i, k) * own_[k];
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int n = front->size(), m = front->own;
    const ConstBlock F(values_.data() + front->offset, n, n);
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
    for (int k = m - 1; k >= 0; --k) {
      double sum = own_[k] - F.col(k).segment(k + 1, m - k - 1).dot(own_.segment(k + 1, m - k - 1));
      for (int i = m; i < n; ++i) sum -= F(i, k) * b[front->unknowns[i]];
      own_[k] = sum;
    }
    for (int i = 0; i < m; ++i) b[front->unknowns[pivots[i]]] = own_[i];
  }
}

int Fronts::largest_front() const {
  int largest = 0;
  for (const Front& front : fronts_) largest = std::max(largest, front.size());
  return largest;
}

}  // namespace mcplan::ipm
