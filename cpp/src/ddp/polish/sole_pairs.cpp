#include <algorithm>
#include <cmath>
#include <limits>

#include "ddp/constants.hpp"
#include "ddp/polish/limits.hpp"

/// Soles of feet that stand beside each other do not overlap. With the level axes n of both soles, p and q where they
/// stand and s_p(n), s_q(n) how far they reach along n from there,
///     room + s_p(n) + s_q(n) - n . (p - q) <= 0
/// for the axis, of the four, that parts them best; headings and axis are given, and follow the iterates. Turns on the
/// spot bring heels together else: the reach boxes keep the middles of the soles apart, whichever way they point.
namespace mcplan::ddp::polish {
namespace {

using Eigen::Vector2d;

Vector2d axis_along(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }
Vector2d axis_across(double yaw) { return {-std::sin(yaw), std::cos(yaw)}; }

double extent(const Vector2d& half_size, double yaw, const Vector2d& n) {
  return half_size.x() * std::abs(n.dot(axis_along(yaw))) + half_size.y() * std::abs(n.dot(axis_across(yaw)));
}

/// Room between two soles in the nominal stance, or kSoleRoom if that is less.
double room_between(const Problem& problem, int l, int other) {
  const EndLimits &one = problem.limits[l], &two = problem.limits[other];
  const Vector2d apart = (one.nominal - two.nominal).head<2>().cwiseAbs() - one.half_size - two.half_size;
  return std::min(kSoleRoom, kNominalRoom * apart.maxCoeff());
}

}  // namespace

/// A foot that touches down at knot k beside each that stands there by then.
void Limits::make_sole_pairs(int k) {
  const Problem& problem = fixed_->problem();
  const Layout& at = problem.layout;
  const auto is_sole = [&](int l) {
    const bool foot = problem.robot.end_effectors[problem.active[l]].kind == "foot";
    return foot && problem.limits[l].half_size.minCoeff() > 0.0;
  };
  const std::vector<Touchdown>& all = fixed_->touchdowns();
  const auto lands = [&](int l) {
    return std::any_of(all.begin(), all.end(), [&](const Touchdown& t) { return t.knot == k && t.l == l; });
  };
  for (const Touchdown& t : all) {
    if (t.knot != k || !is_sole(t.l)) continue;
    for (int other = 0; other < at.end_effector_count(); ++other) {
      if (other == t.l || !is_sole(other) || fixed_->contacts()[k][other] == kFree) continue;
      if (other > t.l && lands(other)) continue;  // once
      const double room = room_between(problem, t.l, other);
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
    const Vector2d apart = place(pair.l) - place(pair.other);
    const double yaw = trajectory.sole_yaw[pair.k][pair.l], other_yaw = trajectory.sole_yaw[pair.k][pair.other];
    Linear& row = phases_[pair.k].linear[pair.linear];
    double widest = -std::numeric_limits<double>::infinity();
    for (const Vector2d& level : {axis_along(yaw), axis_across(yaw), axis_along(other_yaw), axis_across(other_yaw)}) {
      const Vector2d n = level.dot(apart) < 0.0 ? Vector2d(-level) : level;
      const double reach =
          extent(problem.limits[pair.l].half_size, yaw, n) + extent(problem.limits[pair.other].half_size, other_yaw, n);
      if (!(n.dot(apart) - reach > widest)) continue;
      widest = n.dot(apart) - reach;
      row.offset = pair.room + reach;
      for (int j = 0; j < 2; ++j) {
        row.factor[j] = -n[j];
        row.factor[2 + j] = n[j];
      }
    }
  }
}

}  // namespace mcplan::ddp::polish
