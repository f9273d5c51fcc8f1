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
  std::vector<Eigen::Matrix3Xd> forces_W;    ///< of the points of each control
  int swing = -1;                            ///< foot of its first step
};

Memory memory_of(const State& state, const Horizon& horizon, const Eigen::VectorXd& x);

/// Footholds of an earlier cycle moved by how far the robot has come since, to where the sole fits; left and right are
/// exchanged where its first step had the other foot.
std::vector<Eigen::Vector3d> moved_footholds(const Walker& walker, const State& state, const Footsteps& footsteps,
                                             int first, const Memory& memory);

/// Variables of an earlier cycle of the same layout, left and right exchanged where its first step had the other foot.
/// Horizons count positions from their own start, so that they are taken as they are, but that the CoM rises with the
/// footholds; forces keep their direction in the world, and footholds are where this horizon measures them from.
Eigen::VectorXd remembered_guess(const Walker& walker, const State& state, const Horizon& horizon,
                                 const Memory& memory);

}  // namespace mcplan::rhp
