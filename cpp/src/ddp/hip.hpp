#pragma once

#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// Where the hip of a leg is at an instant. Legs are heavy, so it moves against the CoM with all of them:
///
///     hip = p + R hip_B + shift sum_m (p_m - p - R nominal_m),
///
/// hip_B and shift of LimbLimits, m the end-effectors that have such limits (docs/theory/ddp.md, "Joint limits").
/// Non-dimensional.
struct Hip {
  /// `fraction` of the phase, at whose begin the state is x; those that swing go straight by the strides of the input,
  /// which is null where there is none.
  Hip(const Problem& problem, const LimbLimits& limb, const Eigen::Vector3d& com, const Eigen::Matrix3d& rotation_WB,
      const Eigen::VectorXd& x, const Eigen::VectorXd* u, double fraction)
      : own_B(limb.hip_B - limb.hip_shift * problem.jointed.nominal_sum),
        by_com(1.0 - limb.hip_shift * static_cast<double>(problem.jointed.ends.size())),
        place_W(by_com * com + rotation_WB * own_B) {
    for (int m : problem.jointed.ends) {
      place_W += limb.hip_shift * x.segment<3>(problem.layout.end(m));
      if (u) place_W += limb.hip_shift * fraction * u->segment<3>(problem.layout.stride(m));
    }
  }

  Eigen::Vector3d own_B;  ///< what turns with the base
  double by_com;          ///< by which it moves with the CoM
  Eigen::Vector3d place_W;
};

}  // namespace mcplan::ddp
