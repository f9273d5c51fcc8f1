#include <algorithm>
#include <cmath>

#include "checks.hpp"

namespace mcplan::planar {
namespace {

using Eigen::Vector2d;

double determinant(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distance_to_segment(const Vector2d& point, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double ratio = squared > 0.0 ? std::clamp(along.dot(point - from) / squared, 0.0, 1.0) : 0.0;
  return (point - from - ratio * along).norm();
}

const PlanarRobot& robot_of(const Sample& sample) { return sample.plan.task.robot; }

const std::string* end_effector_name(const Sample& sample, int who) {
  return &robot_of(sample).end_effectors[who].name;
}

}  // namespace

/// Position beyond its range, in shares of the range; velocity and torque beyond their limit, in shares of the limit.
void check_joints(const Sample& sample, Findings& findings) {
  const PlanarRobot& robot = robot_of(sample);
  const PlanarState& state = sample.at.state;
  for (int j = 0; j < robot.joint_count(); ++j) {
    const PlanarBody& body = robot.bodies[j + 1];
    const Place place{sample.phase, &body.name, nullptr, sample.time_s};
    const double q = state.configuration.q[j];
    const double beyond = std::max(body.position_min - q, q - body.position_max);
    const double range = body.position_max - body.position_min;
    // A joint with one limit alone has no range: there a radian is the measure.
    if (!std::isinf(beyond)) findings.offer(Constraint::position, beyond / (std::isinf(range) ? 1.0 : range), place);
    if (!std::isinf(body.velocity_max))
      findings.offer(Constraint::velocity, std::abs(state.configuration.velocity[j]) / body.velocity_max - 1.0, place);
    if (!std::isinf(body.torque_max))
      findings.offer(Constraint::torque, std::abs(state.torque[j]) / body.torque_max - 1.0, place);
  }
}

/// Distance and angle of every contact from where it should be.
void check_drift(const Sample& sample, Findings& findings) {
  const PlanarPhase& phase = sample.plan.task.phases[sample.phase];
  for (std::size_t i = 0; i < phase.contacts.size(); ++i) {
    const Eigen::Vector3d& error = sample.at.state.contact_error[i];
    const Place place{sample.phase, end_effector_name(sample, phase.contacts[i].end_effector), nullptr, sample.time_s};
    findings.offer(Constraint::drift, error.head<2>().norm(), place);
    findings.offer(Constraint::drift_angle, std::abs(error[2]), place);
  }
}

/// m (a - g) minus the sum of all forces, and the moment that is left over about the base's origin.
void check_balance(const Sample& sample, Findings& findings) {
  const Eigen::Vector3d& left = sample.at.state.base_residual;
  const Place place{sample.phase, nullptr, nullptr, sample.time_s};
  findings.offer(Constraint::balance, left.head<2>().norm(), place);
  findings.offer(Constraint::moment, std::abs(left[2]), place);
}

/// |f_t| <= mu f_n and f_n >= 0 at every point, in shares of the robot's weight.
void check_forces(const Sample& sample, Findings& findings) {
  const PlanarTask& task = sample.plan.task;
  const double weight = task.robot.mass() * task.robot.gravity;
  for (const PlanarPointForce& force : sample.at.state.forces) {
    const Place place{sample.phase, end_effector_name(sample, force.end_effector), nullptr, sample.time_s};
    const double beyond = std::abs(force.tangential) - task.surfaces[force.surface].friction * force.normal;
    findings.offer(Constraint::friction, beyond / weight, place);
    findings.offer(Constraint::pull, -force.normal / weight, place);
  }
}

/// Distance of the nearest of a's two ends from b and of b's two ends from a, unless they cross.
double segment_distance(const Vector2d& a0, const Vector2d& a1, const Vector2d& b0, const Vector2d& b1) {
  const double from_a0 = determinant(b1 - b0, a0 - b0), from_a1 = determinant(b1 - b0, a1 - b0);
  const double from_b0 = determinant(a1 - a0, b0 - a0), from_b1 = determinant(a1 - a0, b1 - a0);
  if (from_a0 * from_a1 < 0.0 && from_b0 * from_b1 < 0.0) return 0.0;
  return std::min({distance_to_segment(a0, b0, b1), distance_to_segment(a1, b0, b1), distance_to_segment(b0, a0, a1),
                   distance_to_segment(b1, a0, a1)});
}

/// r_a + r_b - distance of the capsules' segments.
void check_collision(const Sample& sample, Findings& findings) {
  const PlanarRobot& robot = robot_of(sample);
  for (const auto& [first, second] : robot.collision_pairs)
    for (const Capsule& a : robot.bodies[first].capsules)
      for (const Capsule& b : robot.bodies[second].capsules) {
        const auto on = [&](int body, const Vector2d& point_B) {
          return planar_point(sample.at.frames[body], point_B).position_W;
        };
        const double distance =
            segment_distance(on(first, a.from_B), on(first, a.to_B), on(second, b.from_B), on(second, b.to_B));
        findings.offer(Constraint::collision, a.radius + b.radius - distance,
                       {sample.phase, &robot.bodies[first].name, &robot.bodies[second].name, sample.time_s});
      }
}

}  // namespace mcplan::planar
