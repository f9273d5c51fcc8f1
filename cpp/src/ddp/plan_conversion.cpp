#include "ddp/plan_conversion.hpp"

#include <algorithm>
#include <cmath>

#include "base/base_rotation.hpp"
#include "ddp/constants.hpp"
#include "mcplan/base/rotation.hpp"
#include "plan/swings.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

Knot make_knot(const Problem& problem, const VectorXd& x) {
  const Layout& at = problem.layout;
  const Units& units = problem.units;
  Knot knot;
  knot.com_W = x.segment<3>(at.com()) * units.length;
  knot.com_velocity_W = x.segment<3>(at.velocity()) * units.velocity();
  knot.base_rpy = problem.rpy(x);
  Vector3d momentum = Vector3d::Zero();
  for (int a = 0; a < at.axis_count(); ++a) momentum[at.axes()[a]] = x[at.momentum(a)] * units.angular_momentum();
  if (problem.model == Model::wrench) {
    knot.angular_momentum_W = momentum;
    knot.base_rpy_rate = rpy_rate(knot.base_rpy, momentum, problem.robot.inertia);
  } else {
    knot.base_rpy_rate = momentum.cwiseQuotient(problem.robot.inertia);
  }
  // Idle end-effectors ride along at their nominal place.
  const Eigen::Matrix3d r_WB = rotation_from_rpy(knot.base_rpy);
  for (const EndEffector& end : problem.robot.end_effectors) {
    knot.end_effectors_W.push_back(knot.com_W + r_WB * end.nominal_B);
    knot.end_effector_velocities_W.push_back(knot.com_velocity_W);
  }
  for (int l = 0; l < at.end_effector_count(); ++l)
    knot.end_effectors_W[problem.active[l]] = x.segment<3>(at.end(l)) * units.length;
  return knot;
}

bool in_contact(const Plan& plan, int k, int e) {
  const int n = static_cast<int>(plan.phases.size());
  if (k < 0 || k > n) return false;
  return (k == n ? plan.final_contacts[e] : plan.phases[k].contacts[e].surface) != kFree;
}

/// Zero where a contact begins or ends, else the mean velocity between the neighbouring knots; at the start what was
/// measured.
void set_swing_velocities(const Problem& problem, Plan& plan) {
  const int n = static_cast<int>(plan.phases.size());
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) {
    const int e = problem.active[l];
    for (int k = 0; k <= n; ++k) {
      Vector3d& velocity = plan.knots[k].end_effector_velocities_W[e];
      if (in_contact(plan, k - 1, e) || in_contact(plan, k, e)) {
        velocity.setZero();
        continue;
      }
      if (k == 0 && !problem.start_end_velocities_W.empty()) {
        velocity = problem.start_end_velocities_W[e];
        continue;
      }
      const int before = std::max(k - 1, 0), after = std::min(k + 1, n);
      double span = 0.0;
      for (int j = before; j < after; ++j) span += plan.phases[j].duration;
      velocity = (plan.knots[after].end_effectors_W[e] - plan.knots[before].end_effectors_W[e]) / span;
    }
  }
}

/// A sole's heading at a knot is that of the contact that the knot belongs to; idle end-effectors head with the base.
void set_sole_yaw(const Problem& problem, const Trajectory& trajectory, Plan& plan) {
  for (int k = 0; k <= problem.steps; ++k) {
    std::vector<double>& yaw = plan.knots[k].end_effector_yaw;
    yaw.assign(problem.robot.end_effectors.size(), plan.knots[k].base_rpy.z());
    for (int l = 0; l < problem.layout.end_effector_count(); ++l) {
      const int e = problem.active[l];
      yaw[e] = trajectory.knot_yaw[k][l];
    }
  }
}

/// The input of a phase that goes from x to x_next.
VectorXd input_of(const Problem& problem, const Phase& phase, const VectorXd& x, const VectorXd& x_next) {
  const Layout& at = problem.layout;
  const Units& units = problem.units;
  VectorXd u = VectorXd::Zero(at.nu());
  for (int l = 0; l < at.end_effector_count(); ++l) {
    u.segment<3>(at.stride(l)) = x_next.segment<3>(at.end(l)) - x.segment<3>(at.end(l));
    const double mu = phase.contacts[problem.active[l]].stiffness / units.stiffness();
    u[at.stiffness(l)] = problem.options.stiffness_input == StiffnessInput::lambda ? std::sqrt(std::max(mu, 0.0)) : mu;
  }
  for (int l = 0; l < at.end_effector_count(); ++l) {
    const Contact& contact = phase.contacts[problem.active[l]];
    if (contact.surface == kFree || !phase.has_wrenches()) continue;
    const Vector3d acting = contact.center_of_pressure_W / units.length;
    u.segment(at.pressure(l), at.pressure_count(l)) =
        at.offsets(l).pressure.transpose() * (acting - x.segment<3>(at.end(l)));
    u.segment(at.force_line(l), at.force_line_count(l)) =
        at.offsets(l).force_line.transpose() * (contact.anchor_W / units.length - acting);
  }
  for (int i = 0; i < at.moment_count(); ++i) {
    const Layout::Moment& m = at.moments()[i];
    u[at.moment(i)] = m.direction_W.dot(phase.contacts[problem.active[m.end_effector]].moment_W) / units.moment();
  }
  u[at.duration()] = phase.duration / units.time;
  return u;
}

}  // namespace

Plan to_plan(const Problem& problem, const Incumbent& incumbent, bool swing_heights) {
  const Layout& at = problem.layout;
  const Units& units = problem.units;
  const Pendulum pendulum(at, problem.inertia, problem.options.stiffness_input, problem.model);
  const bool wrench = problem.model == Model::wrench;
  Plan plan;
  plan.scene = problem.scene;
  plan.robot = problem.robot;
  plan.planner = "ddp";
  plan.measured_start = problem.measured;
  const int end_effectors = static_cast<int>(problem.robot.end_effectors.size());
  for (int k = 0; k <= problem.steps; ++k) plan.knots.push_back(make_knot(problem, incumbent.trajectory.x[k]));
  for (int k = 0; k < problem.steps; ++k) {
    const VectorXd& u = incumbent.trajectory.u[k];
    Phase phase;
    phase.duration = std::max(u[at.duration()] * units.time, kPhaseMin_s * problem.similarity.time);
    phase.contacts.resize(end_effectors);
    if (wrench) phase.law = laws::Wrench();
    for (int l = 0; l < at.end_effector_count(); ++l) {
      Contact& contact = phase.contacts[problem.active[l]];
      contact.surface = incumbent.sequence[k][l];
      contact.anchor_W = at.line_point(incumbent.trajectory.x[k], u, l) * units.length;
      if (wrench) contact.center_of_pressure_W = at.acting_point(incumbent.trajectory.x[k], u, l) * units.length;
      contact.stiffness = pendulum.mu(u, l) * units.stiffness();
    }
    for (int i = 0; i < at.moment_count(); ++i) {
      const Layout::Moment& m = at.moments()[i];
      phase.contacts[problem.active[m.end_effector]].moment_W += u[at.moment(i)] * units.moment() * m.direction_W;
    }
    plan.phases.push_back(phase);
  }
  plan.final_contacts.assign(end_effectors, kFree);
  for (int l = 0; l < at.end_effector_count(); ++l)
    plan.final_contacts[problem.active[l]] = incumbent.sequence[problem.steps][l];
  if (wrench) set_sole_yaw(problem, incumbent.trajectory, plan);
  set_swing_velocities(problem, plan);
  choose_swings(plan, swing_heights);
  return plan;
}

Incumbent from_plan(const Problem& problem, const Plan& plan, int first) {
  const Layout& at = problem.layout;
  const Units& units = problem.units;
  Incumbent out;
  if (plan.robot.end_effectors.size() != problem.robot.end_effectors.size()) return out;
  const auto surface_here = [&](int surface) {
    return surface == kFree ? kFree : problem.scene.surface_index(plan.scene.surfaces[surface].name);
  };
  for (int k = 0; k <= problem.steps; ++k) {
    const Knot& knot = plan.knots[first + k];
    VectorXd x = VectorXd::Zero(at.nx());
    x.segment<3>(at.com()) = knot.com_W / units.length;
    x.segment<3>(at.velocity()) = knot.com_velocity_W / units.velocity();
    Vector3d momentum = knot.angular_momentum_W;
    if (problem.model == Model::lipm)
      momentum = problem.robot.inertia.cwiseProduct(knot.base_rpy_rate);
    else if (!plan.phases[0].has_momentum())
      momentum = base_momentum_W(knot.base_rpy, knot.base_rpy_rate, problem.robot.inertia);
    for (int a = 0; a < at.axis_count(); ++a) {
      x[at.angle(a)] = knot.base_rpy[at.axes()[a]];
      x[at.momentum(a)] = momentum[at.axes()[a]] / units.angular_momentum();
    }
    ContactState state;
    for (int l = 0; l < at.end_effector_count(); ++l) {
      const int e = problem.active[l];
      x.segment<3>(at.end(l)) = knot.end_effectors_W[e] / units.length;
      const bool last = first + k == static_cast<int>(plan.phases.size());
      state.push_back(surface_here(last ? plan.final_contacts[e] : plan.phases[first + k].contacts[e].surface));
    }
    out.trajectory.x.push_back(x);
    out.sequence.push_back(state);
  }
  for (int k = 0; k < problem.steps; ++k)
    out.trajectory.u.push_back(input_of(problem, plan.phases[first + k], out.trajectory.x[k], out.trajectory.x[k + 1]));
  out.sequence.front() = problem.start_contacts;
  out.sequence.back() = problem.goal_contacts;
  problem.set_sole_yaw(out.sequence, out.trajectory);
  return out;
}

}  // namespace mcplan::ddp
