#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/pendulum.hpp"
#include "ddp/polish/base_course.hpp"
#include "ddp/polish/fixed_sequence.hpp"

namespace mcplan::ddp::polish {

/// Where the body is at an instant: CoM and base, and the axes about which its angles turn it.
struct BodyPose {
  Eigen::Vector3d com, rpy;
  Eigen::Matrix3d rotation;  ///< R_WB
  Eigen::Matrix3d axes_W;    ///< column i: the axis in the world about which rpy_i turns

  void set(const Eigen::Vector3d& com_W, const Eigen::Vector3d& angles);

  /// d(R' v) / d(rpy), a column an angle.
  Eigen::Matrix3d turned(const Eigen::Vector3d& v) const;
};

/// A motion and all that the solver asks of it, worked out once: the dynamics to first order at the end of every phase
/// and, of the CoM, at the instants inside, where the body is then, and what is missing between the phases.
class Motion {
 public:
  explicit Motion(const FixedSequence& fixed);

  Trajectory trajectory;

  /// Work out everything anew. False when a number is not finite.
  bool evaluate(const Pendulum& pendulum);

  int instants() const { return instants_; }  ///< of a phase, with its two ends
  const PendulumStep& end(int k) const { return phases_[k].end; }
  /// The CoM's part alone, i = 1..instants() - 2.
  const PendulumStep& inside(int k, int i) const { return phases_[k].inside[i - 1]; }
  const BaseCourse& base(int k) const { return phases_[k].base; }
  const BodyPose& pose(int k, int i) const { return phases_[k].poses[i]; }
  const BodyPose& knot(int k) const { return knots_[k]; }
  const Eigen::VectorXd& defect(int k) const { return phases_[k].defect; }  ///< f(x_k, u_k) - x_{k+1}
  double defect_sum() const { return defect_sum_; }
  double defect_max() const { return defect_max_; }

 private:
  struct OfPhase {
    PendulumStep end;
    std::vector<PendulumStep> inside;
    BaseCourse base;
    std::vector<BodyPose> poses;
    Eigen::VectorXd defect;
  };
  const FixedSequence* fixed_;
  int instants_;
  std::vector<OfPhase> phases_;
  std::vector<BodyPose> knots_;
  double defect_sum_ = 0.0, defect_max_ = 0.0;
};

}  // namespace mcplan::ddp::polish
