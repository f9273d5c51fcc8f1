#pragma once

#include <Eigen/Core>

#include "ddp/polish/fixed_sequence.hpp"

namespace mcplan::ddp::polish {

/// An instant of a phase, and how CoM and angles of the base move there: `lifted` has six rows for each instant after
/// the first, by Phase::moving.
struct Lifted {
  const FixedSequence& fixed;
  int k, instant;
  const Eigen::MatrixXd& lifted;
};

/// g (over z) += what a row's derivatives by CoM and angles at the instant come to.
void add_by_pose(const Lifted& at, const Eigen::Matrix<double, 6, 1>& by_pose, Eigen::Ref<Eigen::VectorXd> g);

/// g += what a row's derivative by the places of all legs together comes to, `fraction` of the phase after its begin:
/// hips move with them (ddp/hip.hpp).
void add_by_legs(const FixedSequence& fixed, int k, double fraction, const Eigen::Vector3d& by_legs,
                 Eigen::Ref<Eigen::VectorXd> g);

}  // namespace mcplan::ddp::polish
