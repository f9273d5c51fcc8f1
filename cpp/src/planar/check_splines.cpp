#include <cmath>
#include <limits>
#include <variant>

#include "checks.hpp"

namespace mcplan::planar {
namespace {

using Eigen::VectorXd;

/// Joints and base at one end of an interval, in radians and metres: q, q' h, q'' h^2, which compare with each other
/// whatever the interval's length h.
struct End {
  explicit End(const IntervalSplines& splines, double s)
      : position(rows_of(splines)), velocity(position.size()), acceleration(position.size()) {
    const Eigen::Index joints = splines.joints.rows(), base = splines.base.rows();
    at_polynomials(splines.joints, splines.length, s, position.head(joints), velocity.head(joints),
                   acceleration.head(joints));
    if (base > 0)
      at_polynomials(splines.base, splines.length, s, position.tail(base), velocity.tail(base),
                     acceleration.tail(base));
  }

  static Eigen::Index rows_of(const IntervalSplines& splines) { return splines.joints.rows() + splines.base.rows(); }

  VectorXd position, velocity, acceleration;
};

/// Joint rows come before those of the base.
const std::string* name_of(const PlanarRobot& robot, Eigen::Index row) {
  return &robot.bodies[row < robot.joint_count() ? row + 1 : 0].name;
}

/// Calls use(numbers, phase) for what a force law reads.
template <class Use>
void for_each_force_number(planar_laws::LeastNorm /*law*/, const PlanarPlan& plan, const Use& use) {
  for (std::size_t k = 0; k < plan.weights.size(); ++k) use(plan.weights[k], static_cast<int>(k));
}
template <class Use>
void for_each_force_number(planar_laws::Polynomial /*law*/, const PlanarPlan& plan, const Use& use) {
  for (std::size_t i = 0; i < plan.force_polynomials.size(); ++i)
    use(plan.force_polynomials[i], plan.task.phase_of(static_cast<int>(i)));
}

}  // namespace

/// Every number is finite; the value counts those that are not.
bool check_finite(const PlanarPlan& plan, Findings& findings) {
  bool all = true;
  const auto offer = [&](const auto& array, int phase) {
    const auto bad = array.size() - array.array().isFinite().count();
    all = all && bad == 0;
    findings.offer(Constraint::finite, static_cast<double>(bad), {phase, nullptr, nullptr, 0.0});
  };
  offer(plan.control_points, -1);
  offer(plan.base_control_points, -1);
  for (std::size_t k = 0; k < plan.durations.size(); ++k)
    offer(Eigen::Matrix<double, 1, 1>(plan.durations[k]), static_cast<int>(k));
  std::visit([&](auto law) { for_each_force_number(law, plan, offer); }, plan.force_law);
  return all;
}

/// d_k > 0, where a microsecond counts as nothing.
bool check_phase_duration(const PlanarPlan& plan, Findings& findings) {
  constexpr double kShortest = 1e-6;
  bool all = true;
  for (std::size_t k = 0; k < plan.durations.size(); ++k) {
    const double missing = kShortest - plan.durations[k];
    all = all && missing <= 0.0;
    findings.offer(Constraint::phase_duration, missing, {static_cast<int>(k), nullptr, nullptr, 0.0});
  }
  return all;
}

/// q, q' h and q'' h^2 (h: the shorter interval) of one interval's end and of the next one's begin, relative to their
/// size where that exceeds one.
void check_continuity(const std::vector<IntervalSplines>& splines, const PlanarRobot& robot, Findings& findings) {
  double time_s = 0.0;
  for (std::size_t k = 0; k + 1 < splines.size(); ++k) {
    time_s += splines[k].length;
    const End before(splines[k], 1.0), after(splines[k + 1], -1.0);
    const double h = std::min(splines[k].length, splines[k + 1].length);
    for (Eigen::Index j = 0; j < before.position.size(); ++j) {
      double jump = 0.0, size = 1.0;
      const auto compare = [&](double a, double b, double scale) {
        const double difference = scale * std::abs(a - b);
        // Where a spline overflows the difference is no number, which std::max would pass over.
        jump = std::isfinite(difference) ? std::max(jump, difference) : std::numeric_limits<double>::infinity();
        size = std::max(size, scale * std::abs(a));
      };
      compare(before.position[j], after.position[j], 1.0);
      compare(before.velocity[j], after.velocity[j], h);
      compare(before.acceleration[j], after.acceleration[j], h * h);
      findings.offer(Constraint::continuity, jump / size, {splines[k + 1].phase, name_of(robot, j), nullptr, time_s});
    }
  }
}

/// |q'| h and |q''| h^2 at both ends of the motion.
void check_rest(const std::vector<IntervalSplines>& splines, const PlanarRobot& robot, Findings& findings) {
  double end_s = 0.0;
  for (const IntervalSplines& interval : splines) end_s += interval.length;
  const auto offer = [&](const IntervalSplines& interval, double s, double time_s) {
    const End end(interval, s);
    const double h = interval.length;
    for (Eigen::Index j = 0; j < end.position.size(); ++j)
      findings.offer(Constraint::rest, std::max(h * std::abs(end.velocity[j]), h * h * std::abs(end.acceleration[j])),
                     {interval.phase, name_of(robot, j), nullptr, time_s});
  };
  offer(splines.front(), -1.0, 0.0);
  offer(splines.back(), 1.0, end_s);
}

/// min <= x, y, angle of the body <= max at the given fraction of the phase.
void check_poses(const PlanarPlan& plan, Findings& findings) {
  const std::vector<double> starts = plan.knot_times();
  for (std::size_t k = 0; k < plan.task.phases.size(); ++k)
    for (const PlanarPose& pose : plan.task.phases[k].poses) {
      const double since_start = pose.fraction * plan.durations[k];
      const PlanarState state = plan.at_phase(static_cast<int>(k), since_start);
      const PlanarMotionOfFrame frame = planar_kinematics(plan.task.robot, state.configuration)[pose.body];
      const Eigen::Vector3d place(frame.position_W.x(), frame.position_W.y(), frame.angle);
      const double beyond = std::max((pose.min - place).maxCoeff(), (place - pose.max).maxCoeff());
      if (beyond > -std::numeric_limits<double>::infinity())
        findings.offer(
            Constraint::pose, beyond,
            {static_cast<int>(k), &plan.task.robot.bodies[pose.body].name, nullptr, starts[k] + since_start});
    }
}

}  // namespace mcplan::planar
