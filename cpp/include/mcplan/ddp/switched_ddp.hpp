#pragma once

#include <memory>

#include "mcplan/ddp/options.hpp"
#include "mcplan/plan/plan.hpp"
#include "mcplan/plan/report.hpp"
#include "mcplan/robot/robot.hpp"
#include "mcplan/scene/scene.hpp"

namespace mcplan::ddp {

/// Contact-sequence search by switched differential dynamic programming (Tazaki, sec. IV).
///
///     auto planner = mcplan::ddp::SwitchedDdp(scene, robot, options);
///     mcplan::PlanResult result = planner.solve();
///
/// Theory: docs/theory/ddp.md. Not thread-safe; use one object per thread.
class SwitchedDdp {
 public:
  /// Throws InvalidScene, InvalidRobot or InvalidOptions.
  SwitchedDdp(const Scene& scene, const Robot& robot, const Options& options = {});
  ~SwitchedDdp();
  SwitchedDdp(SwitchedDdp&&) noexcept;
  SwitchedDdp& operator=(SwitchedDdp&&) noexcept;

  /// Plan from the scene's start to its goal.
  PlanResult solve();

  /// The same, starting from an earlier plan's contact sequence, motion and timing.
  PlanResult solve(const Plan& warm_start);

  /// Plan on from a measured state at time t [s] of an earlier plan: the phase under way and those after it stay as the
  /// first guess, the state at the start is `measured` instead of the scene's.
  PlanResult replan(const Plan& previous, double t, const Knot& measured);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mcplan::ddp
