// Parameters of a program and plans, one made into the other.
#include <Eigen/LU>
#include <cmath>
#include <variant>

#include "planar/sip/program.hpp"
#include "planar/sip/rows.hpp"

namespace mcplan::sip {
namespace {

void require_same_task(const PlanarPlan& plan, const PlanarTask& task) {
  const auto fail = [](const std::string& field, const std::string& rule, int got) {
    throw InvalidPlan("warm_start." + field, rule, text(got));
  };
  const int joints = task.robot.joint_count(), phases = static_cast<int>(task.phases.size());
  if (plan.task.robot.joint_count() != joints)
    fail("task.robot", "needs " + std::to_string(joints) + " joints", plan.task.robot.joint_count());
  if (static_cast<int>(plan.task.phases.size()) != phases)
    fail("task.phases", "needs " + std::to_string(phases) + " phases", static_cast<int>(plan.task.phases.size()));
  for (int p = 0; p < phases; ++p) {
    const PlanarPhase &theirs = plan.task.phases[p], &ours = task.phases[p];
    const std::string field = "task.phases[" + std::to_string(p) + "]";
    if (theirs.intervals != ours.intervals)
      fail(field + ".intervals", "must be " + std::to_string(ours.intervals), theirs.intervals);
    if (theirs.contacts.size() != ours.contacts.size())
      fail(field + ".contacts", "needs " + std::to_string(ours.contacts.size()) + " contacts",
           static_cast<int>(theirs.contacts.size()));
    for (std::size_t i = 0; i < ours.contacts.size(); ++i) {
      const int end = ours.contacts[i].end_effector;
      const std::string contact = field + ".contacts[" + std::to_string(i) + "]";
      if (theirs.contacts[i].end_effector != end)
        fail(contact, "must be of end-effector " + std::to_string(end), theirs.contacts[i].end_effector);
      const std::size_t points = task.robot.end_effectors[end].points.size();
      const std::size_t other = plan.task.robot.end_effectors[end].points.size();
      if (other != points) fail(contact, "needs " + std::to_string(points) + " points", static_cast<int>(other));
    }
  }
}

/// Numbers of the contact to which each point of a phase belongs.
std::vector<int> contact_of_points(const PlanarTask& task, int phase) {
  std::vector<int> out;
  const auto& contacts = task.phases[phase].contacts;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    out.insert(out.end(), task.robot.end_effectors[contacts[i].end_effector].points.size(), static_cast<int>(i));
  return out;
}

/// Log weights of a phase: all the same under a law that has no weights.
template <class Law>
Eigen::VectorXd log_weights_of(Law /*law*/, const PlanarPlan& /*plan*/, const PlanarTask& /*task*/,
                               const Options& /*options*/, int /*phase*/, int count) {
  return Eigen::VectorXd::Zero(count);
}

/// From the plan's weights of the points, relative to the first one.
Eigen::VectorXd log_weights_of(planar_laws::LeastNorm /*law*/, const PlanarPlan& plan, const PlanarTask& task,
                               const Options& options, int phase, int count) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
  const Eigen::VectorXd logs = plan.weights[phase].array().log();
  if (options.forces == Forces::per_point) {
    out = logs.tail(count).array() - logs[0];
  } else {  // of each contact the mean over its points
    const std::vector<int> contact = contact_of_points(task, phase);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(count + 1), points = Eigen::VectorXd::Zero(count + 1);
    for (std::size_t v = 0; v < contact.size(); ++v) {
      sum[contact[v]] += logs[static_cast<Eigen::Index>(v)];
      points[contact[v]] += 1.0;
    }
    sum = sum.cwiseQuotient(points);
    out = sum.tail(count).array() - sum[0];
  }
  return out.cwiseMax(-options.log_weight_max).cwiseMin(options.log_weight_max);
}

/// Cubic through the plan's forces at four instants of an interval: (tangential, normal) point by point, 4 x 2 points.
template <class Law>
Eigen::MatrixXd forces_of(Law /*law*/, const PlanarPlan& plan, int interval) {
  const int phase = plan.task.phase_of(interval);
  const double length = plan.durations[phase] / plan.task.phases[phase].intervals;
  const double begin = (interval - plan.task.first_interval(phase)) * length;
  Eigen::Matrix4d at;
  Eigen::MatrixXd forces;
  for (int i = 0; i < 4; ++i) {
    const double s = -1.0 + 2.0 * i / 3.0;
    at.row(i) = powers(s, 3);
    const PlanarState state = plan.at_phase(phase, begin + 0.5 * (s + 1.0) * length);
    if (forces.size() == 0) forces.resize(4, 2 * static_cast<int>(state.forces.size()));
    for (std::size_t v = 0; v < state.forces.size(); ++v) {
      forces(i, 2 * static_cast<int>(v)) = state.forces[v].tangential;
      forces(i, 2 * static_cast<int>(v) + 1) = state.forces[v].normal;
    }
  }
  return at.inverse() * forces;
}

/// The plan's own.
Eigen::MatrixXd forces_of(planar_laws::Polynomial /*law*/, const PlanarPlan& plan, int interval) {
  return plan.force_polynomials[interval];
}

}  // namespace

Eigen::VectorXd parameters_of(const PlanarPlan& plan, const PlanarTask& task, const Options& options,
                              const Layout& layout) {
  plan.validate();
  require_same_task(plan, task);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(layout.parameters);
  const int joints = task.robot.joint_count();
  // Full control points 2 .. intervals are the free ones.
  for (int i = 0; i < layout.control_points(); ++i)
    x.segment(layout.control_point(0, i), joints) = plan.control_points.col(i + 2);
  if (layout.splines > joints) {
    std::vector<double> lengths = plan.interval_lengths();
    double time = 0.0;
    for (int i = 0; i < layout.control_points(); ++i) {
      time += lengths[i];  // a control point belongs to the knot in the middle of its spline
      if (plan.base_control_points.size() > 0)
        x.segment<3>(layout.control_point(joints, i)) = plan.base_control_points.col(i + 2);
      else
        x.segment<3>(layout.control_point(joints, i)) = plan.at(std::min(time, plan.duration())).configuration.base;
    }
  }
  for (std::size_t p = 0; p < plan.durations.size(); ++p)
    x[layout.duration_of_phase(static_cast<int>(p))] += plan.durations[p];
  for (std::size_t p = 0; p < layout.weights.size(); ++p)
    if (layout.weights[p] > 0)
      x.segment(layout.first_weight[p], layout.weights[p]) = std::visit(
          [&](auto law) { return log_weights_of(law, plan, task, options, static_cast<int>(p), layout.weights[p]); },
          plan.force_law);
  for (int k = 0; k < layout.intervals; ++k) {
    if (layout.forces[k] == 0) continue;
    const Eigen::MatrixXd forces = std::visit([&](auto law) { return forces_of(law, plan, k); }, plan.force_law);
    for (int c = 0; c < forces.cols(); ++c) x.segment<4>(layout.first_force[k] + 4 * c) = forces.col(c);
  }
  return x;
}

PlanarPlan plan_of(const PlanarTask& task, const Options& options, const Layout& layout, const Eigen::VectorXd& x) {
  PlanarPlan plan;
  plan.task = task;
  plan.planner = "sip";
  const int joints = task.robot.joint_count();
  for (std::size_t p = 0; p < task.phases.size(); ++p) {
    const double ratio = layout.durations == 1 ? task.phases[p].intervals / static_cast<double>(layout.intervals) : 1.0;
    plan.durations.push_back(ratio * x[layout.duration_of_phase(static_cast<int>(p))]);
  }
  plan.control_points.resize(joints, layout.intervals + 3);
  if (layout.splines > joints) plan.base_control_points.resize(3, layout.intervals + 3);
  for (int i = 0; i < layout.intervals + 3; ++i) {
    const int at = layout.control_point(0, layout.free_of(i));
    plan.control_points.col(i) = x.segment(at, joints);
    if (layout.splines > joints) plan.base_control_points.col(i) = x.segment<3>(at + joints);
  }
  if (options.dynamics && options.forces == Forces::parameters) {
    plan.force_law = planar_laws::Polynomial();
    for (int k = 0; k < layout.intervals; ++k)
      plan.force_polynomials.push_back(
          Eigen::Map<const Eigen::MatrixXd>(x.data() + layout.first_force[k], 4, layout.forces[k] / 4));
    return plan;
  }
  for (std::size_t p = 0; p < task.phases.size(); ++p) {
    const std::vector<int> contact = contact_of_points(task, static_cast<int>(p));
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(contact.size()));
    for (std::size_t v = 0; v < contact.size() && layout.weights[p] > 0; ++v) {
      const int parameter = (options.forces == Forces::per_body ? contact[v] : static_cast<int>(v)) - 1;
      if (parameter >= 0) weights[static_cast<Eigen::Index>(v)] = std::exp(x[layout.first_weight[p] + parameter]);
    }
    plan.weights.push_back(weights);
  }
  return plan;
}

}  // namespace mcplan::sip
