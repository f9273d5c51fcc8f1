#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/contact_sequence.hpp"

/// What a phase of a swing has to know of the others: the arc of a foot goes from lift-off to touch-down, however many
/// phases lie between them.
namespace mcplan::ddp {

class Problem;
struct Trajectory;

/// A phase as a part of a swing, non-dimensional. Like the headings of soles this is given and follows the iterates, so
/// that rows about a phase depend on its own state and input alone.
struct SwingArc {
  bool known = false;                ///< false: the phase is taken for a whole swing
  double before = 0.0, after = 0.0;  ///< durations from lift-off to the phase's start, from its end to touch-down
  double duration = 0.0;             ///< of the phase itself where this was set
  /// Of the phases just before and after: strides and durations; these are 0 where the foot lifts off or touches down.
  Eigen::Vector3d stride_before = Eigen::Vector3d::Zero(), stride_after = Eigen::Vector3d::Zero();
  double duration_before = 0.0, duration_after = 0.0;
  /// Of the surfaces that the swing leaves and reaches.
  Eigen::Vector3d lift_normal = Eigen::Vector3d::UnitZ(), land_normal = Eigen::Vector3d::UnitZ();
};

/// By step and end-effector.
using SwingArcs = std::vector<std::vector<SwingArc>>;

/// Set the arcs of a trajectory with this sequence.
void set_swing_arcs(const Problem& problem, const ContactSequence& sequence, Trajectory& trajectory);

/// Where a foot is at a fraction of a phase on the way that its plan takes, without the lift: a quintic between the
/// knots, at rest where contacts begin and end, else with the mean velocity between the neighbouring knots. Linear in
/// the place and stride of the phase.
struct OnArc {
  Eigen::Vector3d place;
  double by_stride = 0.0;               ///< d place / d stride, times the identity
  Eigen::Vector3d by_duration;          ///< d place / d duration
  double s = 0.0, s_by_duration = 0.0;  ///< share of the swing's time that has passed
};
OnArc on_arc(const SwingArc& arc, double fraction, const Eigen::Vector3d& from, const Eigen::Vector3d& stride,
             double duration);

}  // namespace mcplan::ddp
