#include "mcplan/plan/plan.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/entire_functions.hpp"
#include "base/turning.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/base/rotation.hpp"
#include "phase_state.hpp"
#include "plan/point_forces.hpp"
#include "plan_shape.hpp"

namespace mcplan {
namespace {

using Eigen::Vector3d;

/// Quintic Hermite segment with zero acceleration at both ends; s = t / h in [0, 1].
struct Hermite {
  Vector3d position, velocity;

  Hermite(const Vector3d& p0, const Vector3d& v0, const Vector3d& p1, const Vector3d& v1, double h, double s) {
    const double s2 = s * s, s3 = s2 * s, s4 = s3 * s, s5 = s4 * s;
    const double blend = 10.0 * s3 - 15.0 * s4 + 6.0 * s5;
    const double blend_rate = 30.0 * s2 - 60.0 * s3 + 30.0 * s4;
    const double in0 = s - 6.0 * s3 + 8.0 * s4 - 3.0 * s5, in0_rate = 1.0 - 18.0 * s2 + 32.0 * s3 - 15.0 * s4;
    const double in1 = -4.0 * s3 + 7.0 * s4 - 3.0 * s5, in1_rate = -12.0 * s2 + 28.0 * s3 - 15.0 * s4;
    position = p0 + blend * (p1 - p0) + h * (in0 * v0 + in1 * v1);
    velocity = blend_rate / h * (p1 - p0) + in0_rate * v0 + in1_rate * v1;
  }
};

/// Heading of a sole at s in [0, 1] of a phase: smooth between the knots, at rest there.
double sole_yaw(const Knot& from, const Knot& to, std::size_t l, double s, double base_yaw) {
  if (from.end_effector_yaw.size() <= l || to.end_effector_yaw.size() <= l) return base_yaw;
  const double blend = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
  return from.end_effector_yaw[l] + blend * (to.end_effector_yaw[l] - from.end_effector_yaw[l]);
}

/// p'' = Lambda p - sum mu_l s_l - g, solved by the entire functions (docs/theory/ddp.md, "Closed form"), and the
/// small-angle rotation of the paper, eqs. (10)-(11): theta'' = I^-1 sum tau_l.
void pendulum_motion(const Plan& plan, const Phase& phase, const Knot& from, double tau, PlanState& state) {
  double stiffness = 0.0;
  Vector3d pull(0.0, 0.0, plan.scene.gravity), moment = Vector3d::Zero();
  for (const Contact& contact : phase.contacts) {
    stiffness += contact.stiffness;
    pull += contact.stiffness * contact.anchor_W;
    moment += contact.moment_W;
  }
  const EntireFunctions f(stiffness * tau * tau);
  const Vector3d acceleration = stiffness * from.com_W - pull;
  state.com_W = from.com_W + tau * f(1) * from.com_velocity_W + tau * tau * f(2) * acceleration;
  state.com_velocity_W = f(0) * from.com_velocity_W + tau * f(1) * acceleration;
  state.com_acceleration_W = stiffness * state.com_W - pull;

  const Vector3d spin_up = moment.cwiseQuotient(plan.robot.inertia);
  state.base_rpy = from.base_rpy + tau * from.base_rpy_rate + 0.5 * tau * tau * spin_up;
  state.base_rpy_rate = from.base_rpy_rate + tau * spin_up;
  state.angular_momentum_W = plan.robot.inertia.cwiseProduct(state.base_rpy_rate);

  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    const Contact& contact = phase.contacts[l];
    state.end_effectors[l].force_W = plan.robot.mass * contact.stiffness * (state.com_W - contact.anchor_W);
    if (contact.surface >= 0) state.end_effectors[l].center_of_pressure_W = contact.anchor_W;
  }
}

/// The pendulum about s_l with forces that act at a_l. With P(t) the integral of the CoM's position and rho = sum mu_l
/// r_l, r_l = s_l - a_l,
///
///     L(t) = L + m (P(t) x rho - t sum mu_l a_l x r_l) + t sum tau_l
void wrench_motion(const Plan& plan, const Phase& phase, const Knot& from, double tau, PlanState& state) {
  const double mass = plan.robot.mass;
  double stiffness = 0.0;
  Vector3d pull(0.0, 0.0, plan.scene.gravity), rho = Vector3d::Zero(), steady = Vector3d::Zero();
  for (const Contact& contact : phase.contacts) {
    const Vector3d line = contact.anchor_W - contact.center_of_pressure_W;
    stiffness += contact.stiffness;
    pull += contact.stiffness * contact.anchor_W;
    rho += contact.stiffness * line;
    steady += contact.moment_W / mass - contact.stiffness * contact.center_of_pressure_W.cross(line);
  }
  const Vector3d acceleration = stiffness * from.com_W - pull;
  const auto momentum_at = [&](double t, const EntireFunctions& f) -> Vector3d {
    const Vector3d travelled = t * from.com_W + t * t * (f(2) * from.com_velocity_W + t * f(3) * acceleration);
    return from.angular_momentum_W + mass * (travelled.cross(rho) + t * steady);
  };
  const EntireFunctions f(stiffness * tau * tau), half(0.25 * stiffness * tau * tau);
  state.com_W = from.com_W + tau * f(1) * from.com_velocity_W + tau * tau * f(2) * acceleration;
  state.com_velocity_W = f(0) * from.com_velocity_W + tau * f(1) * acceleration;
  state.com_acceleration_W = stiffness * state.com_W - pull;
  state.angular_momentum_W = momentum_at(tau, f);
  state.base_rpy = Turning(from.base_rpy, from.angular_momentum_W, plan.robot.inertia)
                       .rpy(momentum_at(0.5 * tau, half), state.angular_momentum_W, tau);
  state.base_rpy_rate = rpy_rate(state.base_rpy, state.angular_momentum_W, plan.robot.inertia);

  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    const Contact& contact = phase.contacts[l];
    EndEffectorState& end = state.end_effectors[l];
    end.force_W = mass * contact.stiffness * (state.com_W - contact.anchor_W);
    if (contact.surface >= 0) end.center_of_pressure_W = contact.center_of_pressure_W;
  }
}

/// a = sum (n . f_i) p_i / sum (n . f_i), where the forces at points press at all.
void set_center_of_pressure(const Plan& plan, int surface, EndEffectorState& end) {
  if (end.points_W.empty() || surface < 0 || surface >= static_cast<int>(plan.scene.surfaces.size())) return;
  const std::vector<Vector3d>& corners = plan.scene.surfaces[surface].vertices_W;
  if (corners.size() < 3) return;
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[1]);  // of any length
  double pressed = 0.0;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < end.points_W.size(); ++i) {
    const double press = normal.dot(end.point_forces_W[i]);
    pressed += press;
    sum += press * end.points_W[i];
  }
  if (pressed > 1e-9 * normal.norm()) end.center_of_pressure_W = sum / pressed;
}

/// CoM and angular momentum from the forces at points; the base on its own quintic.
void point_force_motion(const Plan& plan, const Phase& phase, const Knot& from, const Knot& to, double tau,
                        PlanState& state) {
  const double mass = plan.robot.mass, gravity = plan.scene.gravity;
  const CentroidalState motion =
      integrate_phase(phase, {from.com_W, from.com_velocity_W, from.angular_momentum_W}, tau, mass, gravity);
  state.com_W = motion.com_W;
  state.com_velocity_W = motion.com_velocity_W;
  state.angular_momentum_W = motion.angular_momentum_W;

  const Hermite base(from.base_rpy, from.base_rpy_rate, to.base_rpy, to.base_rpy_rate, phase.duration,
                     tau / phase.duration);
  state.base_rpy = base.position;
  state.base_rpy_rate = base.velocity;

  const IntervalTime at = interval_time(phase, tau);
  state.com_acceleration_W = Vector3d(0.0, 0.0, -gravity);
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    end.points_W = phase.contacts[l].points_W;
    end.point_forces_W = point_forces(phase, phase.contacts[l], at);
    end.force_W = Vector3d::Zero();
    for (const Vector3d& force : end.point_forces_W) end.force_W += force;
    state.com_acceleration_W += end.force_W / mass;
    set_center_of_pressure(plan, phase.contacts[l].surface, end);
  }
}

/// tau_l and the moment of the force about the end-effector: (a_l - p_l) x f_l, under ForceLaw::pendulum with s_l for
/// a_l, or sum (p_i - p_l) x f_i over the points. Needs position, forces and centre of pressure.
void set_moment(const Phase& phase, const Contact& contact, EndEffectorState& end) {
  if (phase.has_points()) {
    end.moment_W = Vector3d::Zero();
    for (std::size_t i = 0; i < end.points_W.size(); ++i)
      end.moment_W += (end.points_W[i] - end.position_W).cross(end.point_forces_W[i]);
    return;
  }
  end.moment_W = contact.moment_W;
  if (contact.surface >= 0) end.moment_W += (end.center_of_pressure_W - end.position_W).cross(end.force_W);
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
  PhaseFrame frame{phase, 0.0, {}};
  for (int i = 0; i < phase; ++i) frame.start_s += plan.phases[i].duration;
  for (const Swing& swing : plan.swings)
    if (phase >= swing.first_phase && phase < swing.end_phase) frame.swings.push_back(active_swing(plan, swing, phase));
  return frame;
}

PlanState state_in_phase(const Plan& plan, const PhaseFrame& frame, double since_start) {
  const int k = frame.phase;
  const Phase& phase = plan.phases[k];
  const Knot &from = plan.knots[k], &to = plan.knots[k + 1];
  const double tau = since_start;

  PlanState state;
  state.phase = k;
  state.time = frame.start_s + tau;

  state.end_effectors.resize(phase.contacts.size());
  for (std::size_t l = 0; l < phase.contacts.size(); ++l)
    state.end_effectors[l].center_of_pressure_W = from.end_effectors_W[l];
  if (phase.law == ForceLaw::pendulum)
    pendulum_motion(plan, phase, from, tau, state);
  else if (phase.law == ForceLaw::wrench)
    wrench_motion(plan, phase, from, tau, state);
  else
    point_force_motion(plan, phase, from, to, tau, state);
  const Eigen::Matrix3d r_WB = rotation_from_rpy(state.base_rpy);
  state.base_quat_wxyz = quat_wxyz_from_rotation(r_WB);

  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    end.surface = phase.contacts[l].surface;
    const Hermite path(from.end_effectors_W[l], from.end_effector_velocities_W[l], to.end_effectors_W[l],
                       to.end_effector_velocities_W[l], phase.duration, tau / phase.duration);
    end.position_W = path.position;
    end.velocity_W = path.velocity;
    end.yaw = sole_yaw(from, to, l, tau / phase.duration, state.base_rpy.z());
  }
  for (const ActiveSwing& active : frame.swings) {
    EndEffectorState& end = state.end_effectors[active.swing->end_effector];
    put_on_path(active, tau, state, r_WB, end);
  }
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    EndEffectorState& end = state.end_effectors[l];
    if (end.surface < 0) end.center_of_pressure_W = end.position_W;
    set_moment(phase, phase.contacts[l], end);
  }
  return state;
}

std::vector<PathInstant> path_of(const Plan& plan, const Swing& swing, double sample_s) {
  std::vector<PathInstant> path;
  double before_s = 0.0;
  for (int k = swing.first_phase; k < swing.end_phase; ++k) {
    const double duration = plan.phases[k].duration;
    const int samples = samples_of(plan.phases[k], sample_s);
    PhaseFrame frame{k, 0.0, {}};
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
  put_on_path(instant.swing, instant.since_start_s, state, rotation_from_rpy(state.base_rpy), end);
  return end;
}

}  // namespace mcplan
