#pragma once

#include <Eigen/Core>

#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// Soles of two feet, seen from above, along the level axis that parts them best.
struct SoleGap {
  Eigen::Vector2d axis;  ///< of unit length, from the other's sole to the one's
  double reach;          ///< how far both soles reach along it from where they stand
};

/// With the level axes n of both soles, `apart` from the other to the one and s(n) how far a sole reaches along n, the
/// axis of the four with the largest  n . apart - s_one(n) - s_other(n).
SoleGap sole_gap(const EndLimits& one, double yaw, const EndLimits& other, double other_yaw,
                 const Eigen::Vector2d& apart);

/// The same at a knot of a motion, or along the axis of a step across (Problem::across).
SoleGap sole_gap_at(const Problem& problem, int knot, int l, double yaw, int other, double other_yaw,
                    const Eigen::Vector2d& apart);

/// Room that soles of feet keep: kSoleRoom, or less if the nominal stance has less.
double sole_room(const EndLimits& one, const EndLimits& other);

/// Whether an end-effector is a foot that stands on a sole.
bool has_sole(const Problem& problem, int l);

}  // namespace mcplan::ddp
