#pragma once

#include <memory>

#include "mcplan/plan/report.hpp"
#include "mcplan/planar/checker.hpp"
#include "mcplan/planar/plan.hpp"
#include "mcplan/planar/sip/options.hpp"

namespace mcplan::sip {

/// A planar plan and how it was found.
struct Result {
  PlanarPlan plan;
  Report report;  ///< time_s is split in timing_s: "evaluation", "linear_solver", "check", ...; cost_terms by name
  nlp::Solver solver = nlp::Solver::ipopt;  ///< that found it: ipopt or ipm
  int parameters = 0, constraints = 0;      ///< size of the program
  double drift_m = 0.0, drift_rad = 0.0;    ///< largest, at 1 kHz, from exact kinematics
};

/// Whole-body planning of a planar robot through a sequence of contact stances by semi-infinite programming (Lengagne
/// et al., "Generation of dynamic multi-contact motions: 2D case studies", 2010).
///
///     auto planner = mcplan::sip::Planner(task, options);
///     mcplan::sip::Result result = planner.solve();
///
/// Theory: docs/theory/sip.md. Not thread-safe.
class Planner {
 public:
  /// Throws InvalidPlanarTask, InvalidRobot or InvalidOptions.
  Planner(const PlanarTask& task, const Options& options = {});
  ~Planner();
  Planner(Planner&&) noexcept;
  Planner& operator=(Planner&&) noexcept;

  /// From P = 0 (the robot's zero posture throughout), weights of 1, and one second.
  Result solve();

  /// From a plan of the same robot and the same phases; other options (forces, order, tube, durations) may differ.
  /// Throws InvalidPlan where its phases or joints do not fit.
  Result solve(const PlanarPlan& warm_start);

  int parameters() const;   ///< N
  int constraints() const;  ///< rows

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mcplan::sip
