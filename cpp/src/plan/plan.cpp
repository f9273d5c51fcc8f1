#include "mcplan/plan/plan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <variant>

#include "hermite.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "phase_instant.hpp"
#include "phase_state.hpp"
#include "plan_shape.hpp"

namespace mcplan {
namespace {

using Eigen::Vector3d;

/// Heading of a sole at s in [0, 1] of a phase: smooth between the knots, at rest there.
double sole_yaw(const Knot& from, const Knot& to, std::size_t l, double s, double base_yaw) {
  if (from.end_effector_yaw.size() <= l || to.end_effector_yaw.size() <= l) return base_yaw;
  const double blend = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  return from.end_effector_yaw[l] + blend * (to.end_effector_yaw[l] - from.end_effector_yaw[l]);
}

}  // namespace

double Plan::duration() const {
  double total = 0.0;
  for (const Phase& phase : phases) total += phase.duration;
  return total;
}

std::vector<double> Plan::knot_times() const {
  std::vector<double> times{0.0};
  for (const Phase& phase : phases) times.push_back(times.back() + phase.duration);
  return times;
}

std::vector<std::vector<int>> Plan::contact_sequence() const {
  std::vector<std::vector<int>> sequence;
  for (const Phase& phase : phases) {
    sequence.emplace_back();
    for (const Contact& contact : phase.contacts) sequence.back().push_back(contact.surface);
  }
  return sequence;
}

PlanState Plan::at(double t) const {
  if (phases.empty()) throw InvalidPlan("phases", "needs at least one phase", "none");
  const double end = duration();
  constexpr double kRounding = 1e-9;
  if (!(t >= -kRounding && t <= end + kRounding))
    throw InvalidInput("t", "must lie in [0, " + text(end) + "] s", text(t));
  double start = 0.0;
  int k = 0;
  while (k + 1 < static_cast<int>(phases.size()) && t >= start + phases[k].duration) start += phases[k++].duration;
  PlanState state = at_phase(k, std::max(0.0, std::min(t - start, phases[k].duration)));
  state.time = t;
  return state;
}

PlanState Plan::at_phase(int k, double since_start) const {
  require_queryable(*this, k, since_start);
  return state_in_phase(*this, phase_frame(*this, k), since_start);
}

PhaseFrame phase_frame(const Plan& plan, int phase) {
  PhaseFrame frame{phase, 0.0, {}, {}};
  for (int i = 0; i < phase; ++i) frame.start_s += plan.phases[i].duration;
  for (const Swing& swing : plan.swings)
    if (phase >= swing.first_phase && phase < swing.end_phase) frame.swings.push_back(active_swing(plan, swing, phase));
  const Knot& from = plan.knots[phase];
  if (plan.phases[phase].has_wrenches()) frame.shared.emplace(plan, plan.phases[phase], from);
  return frame;
}

PlanState state_in_phase(const Plan& plan, const PhaseFrame& frame, double since_start) {
  PlanState state;
  Eigen::Matrix3d r_WB;
  set_state(plan, frame, since_start, state, r_WB);
  return state;
}

void set_state(const Plan& plan, const PhaseFrame& frame, double since_start, PlanState& state, Eigen::Matrix3d& r_WB) {
  const int k = frame.phase;
  const Phase& phase = plan.phases[k];
  const Knot &from = plan.knots[k], &to = plan.knots[k + 1];
  const double tau = since_start;

  state.phase = k;
  state.time = frame.start_s + tau;

  state.end_effectors.resize(phase.contacts.size());
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    end.center_of_pressure_W = from.end_effectors_W[l];
    end.points_W.clear();  // of another law, if any
    end.point_forces_W.clear();
  }
  const WrenchSums* shared = frame.shared ? &*frame.shared : nullptr;
  std::visit([&](auto law) { law.set_motion({plan, phase, from, to, tau, shared}, state); }, phase.law);
  const RpyTrig trig(state.base_rpy);
  std::visit([&](auto law) { law.set_base_rate(trig, plan.robot.inertia, state); }, phase.law);
  r_WB = trig.rotation();
  state.base_quat_wxyz = quat_wxyz_from_rotation(r_WB);

  const Hermite path(phase.duration, tau / phase.duration);
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    end.surface = phase.contacts[l].surface;
    path.put(from.end_effectors_W[l], from.end_effector_velocities_W[l], to.end_effectors_W[l],
             to.end_effector_velocities_W[l], end.position_W, end.velocity_W);
    end.yaw = sole_yaw(from, to, l, tau / phase.duration, state.base_rpy.z());
  }
  for (const ActiveSwing& active : frame.swings) {
    EndEffectorState& end = state.end_effectors[active.swing->end_effector];
    put_on_path(active, tau, state, trig, r_WB, end);
  }
  for (EndEffectorState& end : state.end_effectors)
    if (end.surface < 0) end.center_of_pressure_W = end.position_W;
  std::visit([&](auto law) { law.set_moments(phase, state); }, phase.law);
}

std::vector<PathInstant> path_of(const Plan& plan, const Swing& swing, double sample_s) {
  std::vector<PathInstant> path;
  const double instants_max = std::max(kPathInstantsMin, kPathInstantsMax / static_cast<double>(plan.phases.size()));
  double before_s = 0.0;
  for (int k = swing.first_phase; k < swing.end_phase; ++k) {
    const double duration = plan.phases[k].duration;
    const int samples = samples_of(plan.phases[k], std::max(sample_s, duration / instants_max));
    PhaseFrame frame{k, 0.0, {}, {}};
    ActiveSwing active = active_swing(plan, swing, k);
    straighten(active);
    for (int i = 0; samples > 0 && i <= samples; ++i) {
      const double tau = duration * i / samples;
      path.push_back({before_s + tau, state_in_phase(plan, frame, tau), active, tau});
    }
    before_s += duration;
  }
  return path;
}

EndEffectorState lifted(const PathInstant& instant) {
  const PlanState& state = instant.state;
  EndEffectorState end = state.end_effectors[instant.swing.swing->end_effector];
  const RpyTrig trig(state.base_rpy);
  put_on_path(instant.swing, instant.since_start_s, state, trig, trig.rotation(), end);
  return end;
}

}  // namespace mcplan
