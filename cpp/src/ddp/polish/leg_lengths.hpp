#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/polish/motion.hpp"
#include "ddp/polish/stage_costs.hpp"

namespace mcplan::ddp::polish {

/// Legs that stand are no longer than their links allow, at the instants of every phase:
///
///     |hip - ankle| <= leg_max,    ankle = p_l + S ankle_S,
///
/// the hip that of ddp/hip.hpp, ankle_S of LimbLimits, S the frame of the sole. The checker's constraint "reach" asks
/// for the same. Not in the paper.
class LegLengths {
 public:
  explicit LegLengths(const FixedSequence& fixed);

  /// A row: which contact of the phase, and at which instant.
  struct Row {
    int contact, instant;
  };
  const std::vector<Row>& rows(int k) const { return phases_[k].rows; }

  /// How far inside of its limit a row is planned: nothing at knots.
  double room(const Row& row) const;

  /// r of the rows of a phase, from `row` on, which is left behind them.
  void values(const Motion& motion, int k, int row, Eigen::ArrayXd& r) const;

  /// Add y_r a_r and D_r a_r a_r' of the rows of a phase, which begin at `row`; `lifted` says how CoM and angles move
  /// at the instants after the first, six rows each.
  void add(const Motion& motion, int k, const Eigen::MatrixXd& lifted, int row, const Eigen::ArrayXd& y,
           const Eigen::ArrayXd& d, StageModel& model);

  /// a_r . dz, where add() has been asked last.
  void along(int k, const Eigen::VectorXd& dz, int row, Eigen::ArrayXd& out) const;

  /// Length of a leg at a state less its most, and the rate at which it changes if the CoM and the base go on as they
  /// do.
  struct AtStart {
    double value, rate;
  };
  AtStart at_start(const Motion& motion, int l, const Eigen::Vector3d& spin) const;

 private:
  struct OfPhase {
    std::vector<Row> rows;
    Eigen::MatrixXd by;        ///< gradients over z, a column a row
    Eigen::MatrixXd weighted;  ///< the same times D
  };
  struct Leg;
  Leg leg(const Motion& motion, int k, const Row& row) const;

  const FixedSequence* fixed_;
  std::vector<OfPhase> phases_;
};

}  // namespace mcplan::ddp::polish
