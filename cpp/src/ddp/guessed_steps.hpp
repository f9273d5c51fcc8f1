#pragma once

#include <Eigen/Core>
#include <vector>

#include "ddp/problem.hpp"

/// Footsteps over the ground, for a first guess of where it asks for other steps than even ones: onto a block and down
/// again, over a curb, on stones. Those of ddp/replan are of few footholds, and know no solids between them. Theory:
/// docs/theory/ddp.md, "1. First guesses".
namespace mcplan::ddp {

/// One end-effector goes to a place on a surface.
struct GuessedStep {
  int l = 0, surface = -1;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double share = 0.0;  ///< of the way of the reference up to there
};

struct GuessedSteps {
  std::vector<GuessedStep> steps;
  double price = 0.0;  ///< of all of them; it is no cost of a motion
  bool even = true;    ///< on one surface, and no swing is lifted over anything

  bool empty() const { return steps.empty(); }
  /// Phases that they take: a swing and a phase of full support each, and two to come to rest.
  int phases() const { return 2 * static_cast<int>(steps.size()) + 2; }
  /// The share of the way that the middle of the feet has behind it at each knot of so many phases, see Course.
  std::vector<double> progress(int in_phases) const;
};

/// The cheapest footsteps, left and right in turn, from where the problem starts to its goal: a shortest path over a
/// lattice of footholds beside the course. Every foothold has its margins, every step is within what both reach boxes
/// leave, every swing can be lifted over the solids between; with a smaller `stride_ratio` long steps cost more. Empty
/// where there are none, or too many to look at, for robots that do not walk on two feet, and once `stop` says so.
GuessedSteps guessed_steps(const Problem& problem, double stride_ratio = 1.0, const StopRequest& stop = nullptr);

/// The contact sequence of these footsteps; empty where the problem has too few phases or a rule is broken.
ContactSequence sequence_of(const Problem& problem, const GuessedSteps& guess);

/// The first guess with this sequence, with its footholds where these footsteps are and the CoM above their middle.
Trajectory guess_of(const Problem& problem, const ContactSequence& sequence, const GuessedSteps& guess,
                    const Tuning& tuning);

}  // namespace mcplan::ddp
