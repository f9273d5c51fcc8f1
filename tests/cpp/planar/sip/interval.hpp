#pragma once

#include <Eigen/Core>

#include "mcplan/planar/plan.hpp"
#include "mcplan/planar/robot.hpp"
#include "planar/sip/interval_motion.hpp"
#include "planar/sip/polynomial.hpp"
#include "planar/sip/program.hpp"
#include "planar/sip/rows.hpp"
#include "tasks.hpp"

/// One interval of a task at parameters P, as Taylor polynomials and as the exact plan says.
struct IntervalAt {
  IntervalAt(const mcplan::PlanarTask& of, const mcplan::sip::Options& with, int k, const Eigen::VectorXd& P)
      : task(of),
        options(with),
        layout(task, options),
        x(P),
        plan(plan_of(task, options, layout, x)),
        motion(task, options, layout, k) {}
  IntervalAt(const IntervalAt&) = delete;
  IntervalAt& operator=(const IntervalAt&) = delete;

  /// Coefficients of all nodes, those that were added since too.
  void evaluate() {
    Eigen::VectorXd local(motion.local.count());
    for (int i = 0; i < local.size(); ++i) local[i] = x[motion.local.variables[i]];
    motion.set_parameters(local, true);
    motion.graph.evaluate(work, true);
  }

  double at(mcplan::sip::TaylorGraph::Node node, double s) const {
    return mcplan::sip::evaluate(motion.graph.coefficients(work, node), s);
  }
  Eigen::Vector2d at_W(const mcplan::sip::IntervalMotion::Point& point, double s) const {
    return Eigen::Vector2d(at(point.x, s), at(point.y, s)) + motion.origin_W;
  }

  /// The plan's state at s = -1..1; at the ends inside the interval, whatever rounding says, since forces may jump.
  mcplan::PlanarState exact(double s) const {
    s *= 1.0 - 1e-12;
    const int phase = motion.local.phase;
    const double length = plan.durations[phase] / task.phases[phase].intervals;
    return plan.at_phase(phase, (motion.local.interval - task.first_interval(phase) + 0.5 * (s + 1.0)) * length);
  }
  std::vector<mcplan::PlanarMotionOfFrame> frames(double s) const {
    return mcplan::planar_kinematics(task.robot, exact(s).configuration);
  }

  const mcplan::PlanarTask task;
  const mcplan::sip::Options options;
  const mcplan::sip::Layout layout;
  const Eigen::VectorXd x;
  const mcplan::PlanarPlan plan;
  mcplan::sip::IntervalMotion motion;
  mcplan::sip::TaylorGraph::Workspace work;
};

/// The same at random parameters.
inline Eigen::VectorXd random_parameters(const mcplan::PlanarTask& task, const mcplan::sip::Options& options,
                                         unsigned seed) {
  return planar_tasks::random_parameters(task, mcplan::sip::Layout(task, options), seed);
}

/// Places all over an interval.
inline const std::vector<double> kPlaces{-1.0, -0.7, -0.35, 0.0, 0.2, 0.6, 1.0};
