#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "check_internal.hpp"

namespace mcplan::checks {

/// Straight limbs, legs that bend and the trunk in solids.
class Limbs {
 public:
  void look(const Problem& problem, const Sample& sample, Findings& findings);

  /// The worst place of a limb in each surface's solid, longest first: what is less than a violation, too.
  std::vector<Violation> warnings(const Problem& problem) const;

 private:
  struct Worst {
    double length = 0.0;  ///< [m]
    Place place;
  };
  static constexpr double kMove = 0.25;     ///< [m] of the CoM, before surfaces are looked for again
  static constexpr double kBent = 0.1;      ///< [m] by which a limb bends, and ...
  static constexpr double kInside = 0.15;   ///< [m] ... of which it may be in a solid, of a robot of human size
  static constexpr double kEvery_s = 0.01;  ///< instants that are looked at, for a robot of human size

  /// All points within `radius` of a line.
  struct Capsule {
    Eigen::Vector3d from_W, along_W;
    double radius;
  };
  void look_around(const Problem& problem, const Eigen::Vector3d& com_W);
  void check_trunk(const Problem& problem, const Sample& sample, Findings& findings) const;
  void check_legs(const Problem& problem, const Sample& sample, Findings& findings) const;
  void offer_capsule(const Problem& problem, const Capsule& capsule, int but, StateLimit limit, const Place& place,
                     Findings& findings) const;

  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of the problem's solids
  std::vector<int> near_;                   ///< surfaces whose solids limbs can be in
  std::vector<Worst> worst_;                ///< per surface
  Eigen::Vector3d looked_at_W_;             ///< where the CoM was
  double next_s_ = 0.0;
};

}  // namespace mcplan::checks
