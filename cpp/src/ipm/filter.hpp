#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mcplan::ipm {

/// Pairs of violation and barrier cost that no later point may be worse than in both (A. Wächter, L. T. Biegler: On the
/// implementation of an interior-point filter line-search algorithm, 2006, section 2.3).
class Filter {
 public:
  explicit Filter(double max_violation) : max_violation_(max_violation) { entries_.reserve(kRoom); }

  void clear() { entries_.clear(); }

  bool accepts(double violation, double cost) const {
    if (!(violation <= max_violation_) || !std::isfinite(cost)) return false;
    for (const auto& [v, c] : entries_)
      if (violation >= v && cost >= c) return false;
    return true;
  }

  /// From now on a point has to be better than this one by a margin in one of the two.
  void add(double violation, double cost) {
    entries_.emplace_back((1.0 - kMargin) * violation, cost - kMargin * violation);
  }

  static constexpr double kMargin = 1e-5;
  static constexpr int kRoom = 400;  ///< entries before the first allocation

 private:
  double max_violation_;
  std::vector<std::pair<double, double>> entries_;
};

}  // namespace mcplan::ipm
