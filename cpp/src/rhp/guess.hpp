#pragma once

#include <Eigen/Core>
#include <vector>

#include "rhp/horizon.hpp"
#include "rhp/walker.hpp"

namespace mcplan::rhp {

/// A foothold for each step: 0.25 m ahead of the stance foot on the swing foot's own line, moved to where the sole fits
/// on the step's surface.
std::vector<Eigen::Vector3d> nominal_footholds(const Walker& walker, const State& state, const Footsteps& footsteps,
                                               int first, int steps);

/// First guess without a past: the CoM goes straight from one stance to the next, the points in contact share the
/// weight, durations in the middle of their ranges.
Eigen::VectorXd nominal_guess(const Walker& walker, const State& state, const Horizon& horizon);

/// Solution of an earlier cycle.
struct Memory {
  State state;  ///< at its start
  Eigen::VectorXd x;
  std::vector<Eigen::Vector3d> footholds_W;  ///< that it found
  int swing = -1;                            ///< foot of its first step
};

/// Footholds of an earlier cycle moved by how far the robot has come since, to where the sole fits.
std::vector<Eigen::Vector3d> moved_footholds(const Walker& walker, const State& state, const Footsteps& footsteps,
                                             int first, const Memory& memory);

/// Variables of an earlier cycle of the same layout, in which the first step had the same foot; horizons count
/// positions from their own start, so that CoM and forces are taken as they are, and footholds are where this horizon
/// measures them from.
Eigen::VectorXd remembered_guess(const State& state, const Horizon& horizon, const Memory& memory);

}  // namespace mcplan::rhp
