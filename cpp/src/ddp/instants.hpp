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

  /// g += (d com/dz)' along_com + (d rpy/dz)' along_rpy. The state and input given to Instants::of() must still be
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

/// The instants 0, 1/(n+1), ..., 1 of a phase (n interior points), worked out when the first term asks for one: many
/// phases have none that does. One object serves one thread.
class Instants {
 public:
  /// Be those of this phase from now on. Keeps references to all it is given.
  void of(const Problem& problem, const Pendulum& pendulum, const Eigen::VectorXd& x, const Eigen::VectorXd& u);

  std::size_t size() const { return made().size(); }
  const Instant& operator[](std::size_t i) const { return made()[i]; }
  std::vector<Instant>::const_iterator begin() const { return made().begin(); }
  std::vector<Instant>::const_iterator end() const { return made().end(); }

 private:
  const std::vector<Instant>& made() const {
    if (stale_) make();
    return made_;
  }
  void make() const;

  const Problem* problem_ = nullptr;
  const Pendulum* pendulum_ = nullptr;
  const Eigen::VectorXd *x_ = nullptr, *u_ = nullptr;
  mutable std::vector<Instant> made_;
  mutable bool stale_ = false;
};

}  // namespace mcplan::ddp
