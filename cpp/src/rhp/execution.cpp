#include "rhp/execution.hpp"

#include <algorithm>
#include <cmath>

#include "plan/point_forces.hpp"
#include "plan/swings.hpp"
#include "rhp/pieces/momentum_within.hpp"

namespace mcplan::rhp {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

CentroidalState node_state(const Horizon& horizon, const VectorXd& x, int node) {
  const Horizon::Node& at = horizon.nodes[node];
  CentroidalState out;
  out.com_W = horizon.shift_W + x.segment<3>(at.com);
  out.com_velocity_W = x.segment<3>(at.velocity);
  if (at.momentum >= 0) out.angular_momentum_W = x.segment<3>(at.momentum);
  return out;
}

double value(const nlp::Piece& cost, const VectorXd& x) {
  VectorXd f(1);
  cost.values(x(cost.variables()), f);
  return f[0];
}

CentroidalState centroidal(const State& state) { return {state.com_W, state.com_velocity_W, state.angular_momentum_W}; }

Phase make_phase(const Walker& walker, const Horizon& horizon, const VectorXd& x, const Horizon::Phase& from) {
  Phase phase;
  phase.duration = x[from.duration];
  if (walker.options.transcription == Transcription::euler)
    phase.law = laws::Held();
  else
    phase.law = laws::Linear();
  phase.intervals = walker.options.intervals;
  phase.contacts.resize(walker.robot.end_effectors.size());
  for (int foot = 0; foot < 2; ++foot) {
    const int index = from.placements[foot];
    if (index < 0) continue;
    const Placement& placement = horizon.placements[index];
    Contact& contact = phase.contacts[walker.feet[foot].end_effector];
    contact.surface = placement.surface;
    for (int k = 0; k < from.control_count; ++k)
      for (const ContactPoint& point : horizon.controls[from.first_control + k].points) {
        if (point.placement != index) continue;
        if (k == 0) contact.points_W.push_back(horizon.position_W(x, index) + point.offset_W);
        contact.point_forces_W.push_back(point.force_W(placement, x));
      }
  }
  return phase;
}

/// Feet where they stand or last stood; other end-effectors at their nominal place beside the CoM.
Knot make_knot(const Walker& walker, const CentroidalState& at, const std::array<Vector3d, 2>& feet_W) {
  Knot knot;
  knot.com_W = at.com_W;
  knot.com_velocity_W = at.com_velocity_W;
  knot.angular_momentum_W = at.angular_momentum_W;
  knot.base_rpy = Vector3d(0.0, 0.0, walker.scene.start.yaw);
  for (std::size_t e = 0; e < walker.robot.end_effectors.size(); ++e) {
    const int foot = walker.foot_of(static_cast<int>(e));
    knot.end_effectors_W.push_back(
        foot >= 0 ? feet_W[foot] : Vector3d(at.com_W + walker.r_WH * walker.robot.end_effectors[e].nominal_B));
    knot.end_effector_velocities_W.push_back(foot >= 0 ? Vector3d::Zero() : at.com_velocity_W);
  }
  return knot;
}

}  // namespace

Plan executed_plan(const Walker& walker, const State& state, const Horizon& horizon, const VectorXd& x, int steps) {
  Plan plan;
  plan.scene = walker.scene;
  plan.robot = walker.robot;
  plan.planner = "rhp";
  plan.measured_start = true;
  plan.open_end = true;
  bool keeps_momentum = walker.options.transcription != Transcription::euler;
  for (int q = 0; q < 3 * steps; ++q) keeps_momentum = keeps_momentum && horizon.phases[q].centroidal;
  if (keeps_momentum) {
    plan.momentum_max = walker.options.momentum_max;
    plan.momentum_rate_max = walker.options.momentum_rate_max;
  }
  std::array<Vector3d, 2> feet_W{state.feet_W[0], state.feet_W[1]};
  CentroidalState at = centroidal(state);
  plan.knots.push_back(make_knot(walker, at, feet_W));
  for (int q = 0; q < 3 * steps; ++q) {
    const Horizon::Phase& from = horizon.phases[q];
    plan.phases.push_back(make_phase(walker, horizon, x, from));
    const int end = from.first_node + walker.options.intervals;
    if (walker.options.transcription == Transcription::euler)
      at = node_state(horizon, x, end);
    else
      at =
          integrate_phase(plan.phases.back(), at, plan.phases.back().duration, walker.robot.mass, walker.scene.gravity);
    if (from.swing >= 0) feet_W[from.swing] = horizon.position_W(x, 2 + from.step);
    plan.knots.push_back(make_knot(walker, at, feet_W));
  }
  for (const Contact& contact : plan.phases.back().contacts) plan.final_contacts.push_back(contact.surface);
  choose_swings(plan);
  return plan;
}

Plan predicted_step(const Walker& walker, const State& state, const Plan& horizon, int step) {
  Plan plan = horizon;
  plan.phases.assign(horizon.phases.begin() + 3 * step, horizon.phases.begin() + 3 * step + 3);
  plan.knots.clear();
  plan.final_contacts.clear();
  plan.momentum_max = walker.options.momentum_max;
  plan.momentum_rate_max = walker.options.momentum_rate_max;
  std::array<Vector3d, 2> feet_W{state.feet_W[0], state.feet_W[1]};
  CentroidalState at = centroidal(state);
  plan.knots.push_back(make_knot(walker, at, feet_W));
  for (int q = 0; q < 3; ++q) {
    const Phase& phase = plan.phases[q];
    at = integrate_phase(phase, at, phase.duration, walker.robot.mass, walker.scene.gravity);
    for (int foot = 0; foot < 2; ++foot) {
      const int end = walker.feet[foot].end_effector;
      if (phase.contacts[end].surface < 0) feet_W[foot] = horizon.knots[3 * step + q + 1].end_effectors_W[end];
    }
    plan.knots.push_back(make_knot(walker, at, feet_W));
  }
  for (const Contact& contact : plan.phases.back().contacts) plan.final_contacts.push_back(contact.surface);
  choose_swings(plan);
  return plan;
}

bool usable(const CheckResult& found) {
  if (!found.complete) return false;
  for (const Violation& v : found.violations())
    if (!(v.value <= kUsableRatio * v.tolerance)) return false;
  return true;
}

State end_of(const Walker& walker, const Plan& plan) {
  const Knot& knot = plan.knots.back();
  State state;
  state.com_W = knot.com_W;
  state.com_velocity_W = knot.com_velocity_W;
  state.angular_momentum_W = knot.angular_momentum_W;
  for (const Foot& foot : walker.feet) {
    state.feet_W.push_back(knot.end_effectors_W[foot.end_effector]);
    state.surfaces.push_back(plan.final_contacts[foot.end_effector]);
  }
  return state;
}

void append_plan(Plan& plan, const Plan& next) {
  const int offset = static_cast<int>(plan.phases.size());
  plan.knots.insert(plan.knots.end(), next.knots.begin() + 1, next.knots.end());
  plan.phases.insert(plan.phases.end(), next.phases.begin(), next.phases.end());
  plan.final_contacts = next.final_contacts;
  for (Swing swing : next.swings) {
    swing.first_phase += offset;
    swing.end_phase += offset;
    plan.swings.push_back(swing);
  }
}

RunningCost running_cost(const Walker& walker, const Plan& plan) {
  // Gauss's rule of five points: exact for forces that are linear in time, whose momentum squared has degree 8.
  constexpr double kPoints[] = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr double kWeights[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  RunningCost out;
  for (std::size_t q = 0; q < plan.phases.size(); ++q) {
    const double h = plan.phases[q].duration / walker.options.intervals;
    for (int k = 0; k < walker.options.intervals; ++k)
      for (int i = -2; i <= 2; ++i) {
        const double s = k + 0.5 * (1.0 + (i < 0 ? -1.0 : 1.0) * kPoints[std::abs(i)]);
        const PlanState at = plan.at_phase(static_cast<int>(q), h * s);
        out.acceleration += 0.5 * h * kWeights[std::abs(i)] * at.com_acceleration_W.squaredNorm();
        out.momentum += 0.5 * h * kWeights[std::abs(i)] * at.angular_momentum_W.squaredNorm();
      }
  }
  return out;
}

Measures measure(const Walker& walker, const State& state, const Horizon& horizon, const VectorXd& x,
                 const Plan& executed) {
  Measures out;
  const int n = walker.options.intervals;
  CentroidalState replayed = centroidal(state);
  for (int q = 0; q < 3; ++q) {
    const Horizon::Phase& phase = horizon.phases[q];
    const double h = x[phase.duration] / n;
    const bool euler = walker.options.transcription == Transcription::euler;
    for (int k = 0; k < n; ++k) {
      const Vector3d a = x.segment<3>(horizon.controls[phase.first_control + k].acceleration);
      if (euler) {
        out.acceleration_cost += h * a.squaredNorm();
        out.momentum_cost += h * x.segment<3>(horizon.nodes[phase.first_node + k].momentum).squaredNorm();
        continue;
      }
      const LinearForceInterval interval = horizon.interval(phase, k, n);
      const Vector3d b = x.segment<3>(interval.acceleration1);
      out.acceleration_cost += h / 3.0 * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
      out.momentum_cost += value(MomentumSquareOverTime(interval, walker.robot.mass, walker.scene.gravity), x);
    }
    replayed = integrate_phase(executed.phases[q], replayed, executed.phases[q].duration, walker.robot.mass,
                               walker.scene.gravity);
  }
  const CentroidalState planned = node_state(horizon, x, 3 * n);
  out.drift_com_m = (replayed.com_W - planned.com_W).norm();
  out.drift_momentum = (replayed.angular_momentum_W - planned.angular_momentum_W).norm();

  const nlp::Problem& problem = horizon.problem;
  VectorXd rows(problem.row_count());
  problem.rows(x, rows);
  for (int i = 0; i < problem.row_count(); ++i)
    if (problem.row_lower()[i] == problem.row_upper()[i])
      out.defect = std::max(out.defect, std::abs(rows[i] - problem.row_lower()[i]));
  return out;
}

}  // namespace mcplan::rhp
