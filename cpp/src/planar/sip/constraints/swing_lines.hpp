#pragma once

#include <Eigen/Core>
#include <vector>

#include "mcplan/planar/task.hpp"

namespace mcplan::sip {

/// A line in front of which the points of a swinging end-effector stay over an interval.
struct SwingLine {
  int end_effector = 0;
  Eigen::Vector2d point_W = Eigen::Vector2d::Zero(), normal_W = Eigen::Vector2d::UnitY();
};

/// The lines that keep the swinging end-effectors of an interval outside of all solids, beside those that the task
/// names. A surface without ends is its own line. The solid behind one with ends is a strip, out of which an
/// end-effector may be in front, or beside either end: which of these in which interval is chosen along the straight
/// way from the contact that it leaves to the one that it comes to, with as little of it inside as possible. Between
/// the two ends of a strip lies an interval in front of it, because both lines hold at the instant between intervals.
///
/// Solids that another line of the interval keeps away anyway have none of their own. None either for surfaces with
/// ends where an end-effector is never in contact and nothing is known of its way: there the checker has the last word.
std::vector<SwingLine> swing_lines(const PlanarTask& task, int phase, int interval_of_phase);

}  // namespace mcplan::sip
