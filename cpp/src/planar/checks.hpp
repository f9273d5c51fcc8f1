#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "evaluation.hpp"
#include "mcplan/planar/checker.hpp"

/// What the files check_*.cpp share. One constraint is one small function with its equation; it offers what
/// it measures to PlanarFindings, which keep the worst of each.
namespace mcplan::planar {

using Constraint = PlanarConstraint;

/// Where something was measured. Names are those of joints (their bodies) or end-effectors; a collision has two.
struct Place {
  int phase = -1;
  const std::string* who = nullptr;
  const std::string* other = nullptr;
  double time_s = 0.0;
};

class Findings {
 public:
  explicit Findings(const PlanarTolerances& tolerances);

  /// Keep this measurement if it is the worst of its constraint. Not a number counts as the largest number.
  void offer(Constraint constraint, double value, const Place& place);

  /// Time of the earliest measurement beyond its tolerance; infinite: there is none.
  double kept_until_s() const { return kept_until_s_; }

  /// Something is beyond its tolerance from that time on, of which the worst alone is offered.
  void note_beyond(double time_s) { kept_until_s_ = std::min(kept_until_s_, time_s); }

  /// The first `count` constraints, in the order of the enumeration.
  std::vector<Violation> violations(int count) const;

 private:
  struct Worst {
    double value = 0.0;
    Place place;
    bool measured = false;
  };
  std::array<Worst, kPlanarConstraints> worst_;
  std::array<PlanarConstraintInfo, kPlanarConstraints> table_;
  double kept_until_s_ = std::numeric_limits<double>::infinity();
};

/// An instant of a plan, evaluated.
struct Sample {
  const PlanarPlan& plan;
  const Evaluation& at;
  int phase = 0, interval_of_phase = 0;
  bool begin = false;  ///< of the interval
  double time_s = 0.0;
};

// Of the whole plan; the first two say whether anything else can be evaluated.
bool check_finite(const PlanarPlan& plan, Findings& findings);
bool check_phase_duration(const PlanarPlan& plan, Findings& findings);
void check_continuity(const std::vector<IntervalSplines>& splines, const PlanarRobot& robot, Findings& findings);
void check_rest(const std::vector<IntervalSplines>& splines, const PlanarRobot& robot, Findings& findings);
void check_poses(const PlanarPlan& plan, Findings& findings);

// Of one instant.
void check_joints(const Sample& sample, Findings& findings);
void check_drift(const Sample& sample, Findings& findings);
void check_balance(const Sample& sample, Findings& findings);
void check_forces(const Sample& sample, Findings& findings);
void check_middle_heights(const Sample& sample, Findings& findings);
void check_collision(const Sample& sample, Findings& findings);

/// How deep every swinging end-effector goes into the solid of every surface, over the instants that it looked at.
class SolidDepths {
 public:
  /// `tolerance` [m]: beyond which it remembers since when.
  explicit SolidDepths(double tolerance = std::numeric_limits<double>::infinity()) : tolerance_(tolerance) {}

  void look(const Sample& sample);
  std::vector<SolidDepth> all(const PlanarTask& task) const;

  /// When a pair that the task keeps clear of each other was first beyond the tolerance [s]; infinite: never.
  double beyond_since_s(const PlanarTask& task) const;

 private:
  double tolerance_;
  std::vector<SolidDepth> worst_;
  std::vector<double> beyond_since_s_;  ///< like worst_
};
void check_solids(const PlanarTask& task, const SolidDepths& depths, Findings& findings);

/// Distance of two segments [m], 0 where they cross.
double segment_distance(const Eigen::Vector2d& a0, const Eigen::Vector2d& a1, const Eigen::Vector2d& b0,
                        const Eigen::Vector2d& b1);

}  // namespace mcplan::planar
