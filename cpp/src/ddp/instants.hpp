#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/pendulum.hpp"
#include "ddp/problem.hpp"

namespace mcplan::ddp {

/// An instant inside a phase: where the CoM and the base are, and how that depends on z = [x, u]. Few instants have a
/// row that is active, so the derivatives are worked out when the first asks for them.
struct Instant {
  double fraction = 0.0;  ///< of the phase
  Eigen::Vector3d com, rpy;
  Eigen::Vector3d velocity;  ///< of the CoM; set where the robot has joint limits

  /// g += (d com/dz)' along_com + (d rpy/dz)' along_rpy. The state and input given to make_instants() must still be
  /// there.
  void add_along(const Eigen::Vector3d& along_com, const Eigen::Vector3d& along_rpy,
                 Eigen::Ref<Eigen::VectorXd> g) const;

  /// g += (d velocity/dz)' along.
  void add_along_velocity(const Eigen::Vector3d& along, Eigen::Ref<Eigen::VectorXd> g) const;

  const Pendulum* pendulum = nullptr;
  const Eigen::VectorXd *x = nullptr, *u = nullptr;
  mutable PendulumStep step;
  mutable bool stepped = false;

 private:
  void make_step() const;
};

/// Fill `out` with 0, 1/(n+1), ..., 1 of the phase (n interior points). Keeps references to pendulum, x and u.
void make_instants(const Problem& problem, const Pendulum& pendulum, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                   std::vector<Instant>& out);

}  // namespace mcplan::ddp
