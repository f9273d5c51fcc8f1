#include <algorithm>

#include "ddp/polish/limits.hpp"
#include "ddp/sole_gap.hpp"

/// Soles of feet that stand beside each other do not overlap: the rows of the cost term "soles", where a foot touches
/// down; headings and axis are given, and follow the iterates.
namespace mcplan::ddp::polish {

/// A foot that touches down at knot k beside each that stands there by then, or leaves the ground at that instant.
void Limits::make_sole_pairs(int k) {
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const std::vector<Touchdown>& all = fixed_->touchdowns();
  const auto stands = [&](int l) {
    return fixed_->contacts()[k][l] != kFree || (k > 0 && fixed_->contacts()[k - 1][l] != kFree);
  };
  const auto lands = [&](int l) {
    return std::any_of(all.begin(), all.end(), [&](const Touchdown& t) { return t.knot == k && t.l == l; });
  };
  for (const Touchdown& t : all) {
    if (t.knot != k || !has_sole(problem, t.l)) continue;
    for (int other = 0; other < at.end_effector_count(); ++other) {
      if (other == t.l || !has_sole(problem, other) || !stands(other)) continue;
      if (other > t.l && lands(other)) continue;  // once
      const double room = sole_room(problem.limits[t.l], problem.limits[other]);
      if (!(room > 0.0)) continue;
      Linear& row = linear(k, tuning_.limit_weight, false);
      for (const int l : {t.l, other})
        for (int j = 0; j < 2; ++j) row.touch(at.end(l) + j, 0.0);
      pairs_.push_back({k, static_cast<int>(phases_[k].linear.size()) - 1, t.l, other, room});
    }
  }
}

void Limits::part_soles(const Trajectory& trajectory) {
  const Problem& problem = fixed_->problem();
  for (const SolePair& pair : pairs_) {
    const auto place = [&](int l) { return trajectory.x[pair.k].segment<2>(problem.layout.end(l)); };
    const Eigen::Vector2d apart = place(pair.l) - place(pair.other);
    const double yaw = trajectory.knot_yaw[pair.k][pair.l], other_yaw = trajectory.knot_yaw[pair.k][pair.other];
    const SoleGap gap = sole_gap_at(problem, pair.k, pair.l, yaw, pair.other, other_yaw, apart);
    Linear& row = phases_[pair.k].linear[pair.linear];
    row.offset = pair.room + gap.reach;
    for (int j = 0; j < 2; ++j) {
      row.factor[j] = -gap.axis[j];
      row.factor[2 + j] = gap.axis[j];
    }
  }
}

}  // namespace mcplan::ddp::polish
