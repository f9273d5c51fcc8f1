#include "ddp/sole_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ddp/constants.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector2d;

constexpr double kTie = 1e-9;

Vector2d axis_along(double yaw) { return {std::cos(yaw), std::sin(yaw)}; }
Vector2d axis_across(double yaw) { return {-std::sin(yaw), std::cos(yaw)}; }

double extent(const Vector2d& half_size, double yaw, const Vector2d& n) {
  return half_size.x() * std::abs(n.dot(axis_along(yaw))) + half_size.y() * std::abs(n.dot(axis_across(yaw)));
}

}  // namespace

SoleGap sole_gap(const EndLimits& one, double yaw, const EndLimits& other, double other_yaw, const Vector2d& apart) {
  SoleGap best{};
  double widest = -std::numeric_limits<double>::infinity();
  for (const Vector2d& level : {axis_along(yaw), axis_across(yaw), axis_along(other_yaw), axis_across(other_yaw)}) {
    const Vector2d n = level.dot(apart) < 0.0 ? Vector2d(-level) : level;
    const double reach = extent(one.half_size, yaw, n) + extent(other.half_size, other_yaw, n);
    // Soles of a regular walk are as far apart along as across: rounding does not choose between these.
    if (!(n.dot(apart) - reach > widest + kTie)) continue;
    widest = n.dot(apart) - reach;
    best = {n, reach};
  }
  return best;
}

SoleGap sole_gap_at(const Problem& problem, int knot, int l, double yaw, int other, double other_yaw,
                    const Vector2d& apart) {
  const EndLimits &one = problem.limits[l], &beside = problem.limits[other];
  for (const Problem::Across& across : problem.across) {
    if (across.knot != knot || std::minmax(across.l, across.other) != std::minmax(l, other)) continue;
    const Vector2d n = across.l == l ? across.axis : Vector2d(-across.axis);
    return {n, extent(one.half_size, yaw, n) + extent(beside.half_size, other_yaw, n)};
  }
  return sole_gap(one, yaw, beside, other_yaw, apart);
}

double sole_room(const EndLimits& one, const EndLimits& other) {
  const Vector2d apart = (one.nominal - other.nominal).head<2>().cwiseAbs() - one.half_size - other.half_size;
  return std::min(kSoleRoom, kNominalRoom * apart.maxCoeff());
}

bool has_sole(const Problem& problem, int l) {
  const bool foot = problem.robot.end_effectors[problem.active[l]].kind == "foot";
  return foot && problem.limits[l].half_size.minCoeff() > 0.0;
}

}  // namespace mcplan::ddp
