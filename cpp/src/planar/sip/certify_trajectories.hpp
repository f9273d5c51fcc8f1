#pragma once

#include <array>
#include <limits>
#include <vector>

#include "mcplan/planar/plan.hpp"
#include "planar/sip/taylor_model.hpp"

/// What the files certify*.cpp share: the plan as polynomials whose coefficients are known up to a bound.
namespace mcplan::sip::proof {

inline constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A quantity and its derivatives in time, over one interval or a piece of it.
struct Trajectory {
  UncertainPolynomial position, velocity, acceleration;

  Trajectory restricted(double middle, double half_width) const;
};

/// One interval of a plan. Angles of bodies in the world are sums of joint angles, so exact cubics like these.
struct Trajectories {
  int interval = 0, phase = 0;
  double begin_s = 0.0, length_s = 0.0;
  std::vector<Trajectory> joints;  ///< [rad], [rad/s], [rad/s^2]
  std::vector<Trajectory> bodies;  ///< angles in the world
  std::array<Trajectory, 2> base;  ///< x, y [m], where the plan gives them
  bool base_given = false;

  Trajectories restricted(double middle, double half_width) const;
};

Trajectories trajectories(const PlanarPlan& plan, int interval);

}  // namespace mcplan::sip::proof
