#pragma once

#include <Eigen/Core>

#include "base/base_rotation.hpp"
#include "mcplan/plan/plan.hpp"

/// How an end-effector swings: lifted off the straight way between two contacts, and held in its reach box.
namespace mcplan {

/// A swing of which the phase is a part.
struct ActiveSwing {
  const Swing* swing = nullptr;
  double before_s = 0.0, total_s = 0.0;      ///< from its first knot to the phase's start, to touch-down
  Eigen::Vector3d reach_min_B, reach_max_B;  ///< what the path is held in: the usual reach, both ends of the swing
  /// Band [m] inside of the lower and upper sides in which the path bends, at lift-off, at touch-down and half way.
  Eigen::Vector3d lift_bands_B[2], land_bands_B[2], middle_band_B;
  /// A face n' x <= max that cuts the box, and its bands.
  struct Cut {
    Eigen::Vector3d normal_B;
    double max, lift_band, land_band, middle_band;
  };
  int cut_count = 0;
  Cut cuts[kReachCuts];
};

/// The swing as a phase sees it.
ActiveSwing active_swing(const Plan& plan, const Swing& swing, int phase);

/// Take the bands away: the path then runs to the box's sides and along them, with corners. Heights of swings are
/// chosen for this path, so that they do not depend on how the other one bends.
void straighten(ActiveSwing& active);

/// Moves an end-effector [m, m/s, world] from where the knots have it, `since_start` [s] in the phase, onto the swing's
/// path; `state` has the CoM and the base with their rates, trig and r_WB are of the
/// base's angles.
void put_on_path(const ActiveSwing& active, double since_start, const PlanState& state, const RpyTrig& trig,
                 const Eigen::Matrix3d& r_WB, EndEffectorState& end);

}  // namespace mcplan
