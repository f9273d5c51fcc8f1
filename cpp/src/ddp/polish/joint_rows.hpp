#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/leg_joints.hpp"
#include "ddp/polish/motion.hpp"
#include "ddp/polish/stage_costs.hpp"

namespace mcplan::ddp::polish {

/// Torques of legs that stand, and speeds of their knees, at the instants of every phase: LegJoints as signed rows,
/// value - limit <= 0 and -value - limit <= 0. There are none unless joints are held (Tuning::hold_joints): most plans
/// ask no more of them than there is. Lengths of legs are those of LegLengths.
class JointRows {
 public:
  JointRows(const FixedSequence& fixed, const Pendulum& pendulum, bool hold);

  int count(int k) const { return 2 * static_cast<int>(phases_[k].pairs.size()); }

  /// r of the rows of a phase, from `row` on.
  void values(const Motion& motion, int k, int row, Eigen::ArrayXd& r) const;

  /// Add y_r a_r and D_r a_r a_r' of the rows of a phase, which begin at `row`; `lifted` says how CoM and angles move
  /// at the instants after the first, six rows each.
  void add(const Motion& motion, int k, const Eigen::MatrixXd& lifted, int row, const Eigen::ArrayXd& y,
           const Eigen::ArrayXd& d, StageModel& model);

  /// a_r . dz, where add() has been asked last.
  void along(int k, const Eigen::VectorXd& dz, int row, Eigen::ArrayXd& out) const;

 private:
  /// Both signs of a limit of a contact of the phase at an instant.
  struct Pair {
    int contact, instant;
    LegJoints::Row limit;
  };
  struct OfPhase {
    std::vector<Pair> pairs;
    Eigen::MatrixXd by;        ///< gradients over z, a column a row
    Eigen::MatrixXd weighted;  ///< the same times D
  };
  /// Where the pairs of one contact at one instant begin, and where they end.
  template <class Visit>
  void each_leg(const Motion& motion, int k, Visit&& visit) const;
  void add_velocity(const Motion& motion, int k, int instant, const Eigen::Vector3d& along,
                    Eigen::Ref<Eigen::VectorXd> g) const;
  void lift(const Motion& motion, int k, const Pair& pair, const StandingLeg& leg, const LegJoints::Slopes& by,
            const Eigen::MatrixXd& lifted, Eigen::Ref<Eigen::VectorXd> g) const;

  const FixedSequence* fixed_;
  const Pendulum* pendulum_;
  std::vector<OfPhase> phases_;
};

}  // namespace mcplan::ddp::polish
