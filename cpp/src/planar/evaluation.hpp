#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/planar/plan.hpp"

/// What PlanarPlan::at and the checker share: everything of a plan that is constant over an interval or a phase is
/// made once, the rest at each instant.
namespace mcplan::planar {

/// Throws InvalidPlan where a plan's arrays do not fit together, InvalidPlanarTask where its task names what is not
/// there: what an evaluation needs not to read beyond an array. Says nothing of the numbers.
void require_shape(const PlanarPlan& plan);

/// Polynomials of s = -1..1 over one interval: a row for each joint, a column for each power.
struct IntervalSplines {
  int interval = 0, phase = 0;
  double length = 0.0;                              ///< [s]
  Eigen::Matrix<double, Eigen::Dynamic, 4> joints;  ///< [rad]
  Eigen::Matrix<double, Eigen::Dynamic, 4> base;    ///< x, y [m], angle [rad]; no rows: computed
};
IntervalSplines interval_splines(const PlanarPlan& plan, int interval, const std::vector<double>& lengths);

}  // namespace mcplan::planar

namespace mcplan::planar_laws {

/// From what has to be given, [m (a - g); moment about the moment point], to the forces that give it.
struct Gain {
  Eigen::Vector2d moment_point_W = Eigen::Vector2d::Zero();
  Eigen::MatrixXd gain;  ///< (2 points) x 3; empty under laws whose forces do not follow from the motion
};

struct Instant {
  const PlanarPlan& plan;
  const planar::IntervalSplines& splines;
  const Gain& gain;
  const std::vector<PlanarMotionOfFrame>& frames;  ///< of the bodies
  double s = 0.0;                                  ///< -1..1 over the interval
};

}  // namespace mcplan::planar_laws

namespace mcplan::planar {

/// Position, velocity and acceleration at s of polynomials that stand in rows.
void at_polynomials(const Eigen::Matrix<double, Eigen::Dynamic, 4>& rows, double length, double s,
                    Eigen::Ref<Eigen::VectorXd> position, Eigen::Ref<Eigen::VectorXd> velocity,
                    Eigen::Ref<Eigen::VectorXd> acceleration);

/// The constant gain of a phase, which its force law gives.
using PhaseGain = planar_laws::Gain;
PhaseGain phase_gain(const PlanarPlan& plan, int phase);

/// Everything at s of an interval but time; also the frames of all bodies. Keeps its memory from call to call.
class Evaluation {
 public:
  explicit Evaluation(const PlanarPlan& plan) : plan_(plan) {}

  void at(const IntervalSplines& splines, const PhaseGain& gain, double s);

  PlanarState state;
  std::vector<PlanarMotionOfFrame> frames;  ///< of the bodies
  std::vector<PlanarMotionOfFrame> soles;   ///< of the phase's contacts

 private:
  void compute_base(const PlanarPhase& phase);
  void compute_contacts(const PlanarPhase& phase);
  void compute_forces(const IntervalSplines& splines, const PhaseGain& gain, double s);
  void compute_torques();
  void compute_momentum();

  const PlanarPlan& plan_;
  std::vector<PlanarForce> forces_;
  Eigen::VectorXd components_;  ///< tangential and normal, point by point
};

}  // namespace mcplan::planar
