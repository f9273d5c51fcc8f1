#include "certify_trajectories.hpp"

#include <cmath>
#include <limits>

#include "base/cubic_spline.hpp"

namespace mcplan::sip::proof {
namespace {

using Real = long double;

/// Rounding to double, and some hundred operations of Cox's recursion in long double, relative to the basis' size.
constexpr double kSplineError = 2.0 * kEpsilon + 1000.0 * static_cast<double>(std::numeric_limits<Real>::epsilon());

UncertainPolynomial constant(double value) {
  UncertainPolynomial out;
  out.a[0] = value;
  return out;
}

/// Spacings are those of the real quotients duration / intervals, not of their doubles.
std::array<Real, 5> spacings(const PlanarPlan& plan, int interval) {
  std::vector<Real> lengths;
  for (std::size_t k = 0; k < plan.durations.size(); ++k)
    for (int i = 0; i < plan.task.phases[k].intervals; ++i)
      lengths.push_back(static_cast<Real>(plan.durations[k]) / plan.task.phases[k].intervals);
  const int last = static_cast<int>(lengths.size()) - 1;
  std::array<Real, 5> out{};
  for (int d = -2; d <= 2; ++d) out[d + 2] = lengths[std::min(std::max(interval + d, 0), last)];
  return out;
}

/// Cubic of one row of control points, and what the rounding of its coefficients is worth.
UncertainPolynomial cubic(const Eigen::Matrix<Real, 4, 4>& basis, const Eigen::Ref<const Eigen::RowVectorXd>& points) {
  UncertainPolynomial out;
  out.a.resize(4);
  Real magnitude = 0.0L;
  for (int m = 0; m < 4; ++m) {
    Real sum = 0.0L;
    for (int i = 0; i < 4; ++i) {
      const Real term = basis(m, i) * static_cast<Real>(points[i]);
      sum += term;
      magnitude += std::abs(term);
    }
    out.a[m] = static_cast<double>(sum);
  }
  out.error = kSplineError * static_cast<double>(magnitude);
  return out;
}

/// Of a polynomial of s, where ds/dt = 2 / length.
Trajectory in_time(const UncertainPolynomial& position, double length_s) {
  const double rate = 2.0 / length_s, error = 4.0 * kEpsilon * rate;
  Trajectory out;
  out.position = position;
  out.velocity = position.derivative().scaled(rate, error);
  out.acceleration = position.derivative().derivative().scaled(rate, error).scaled(rate, error);
  return out;
}

/// Angle of the base: that of its spline, or the mean of what each contact asks for (eq. 11).
UncertainPolynomial base_angle(const PlanarPlan& plan, const PlanarPhase& phase,
                               const std::vector<UncertainPolynomial>& joints) {
  const PlanarRobot& robot = plan.task.robot;
  UncertainPolynomial sum = constant(0.0);
  for (const PlanarContact& contact : phase.contacts) {
    const PlanarEndEffector& end = robot.end_effectors[contact.end_effector];
    UncertainPolynomial relative = constant(end.angle_B);
    for (int b = end.body; b > 0; b = robot.bodies[b].parent)
      relative = relative + constant(robot.bodies[b].offset) + joints[b - 1];
    sum = sum + constant(contact.angle) - relative;
  }
  const double ratio = 1.0 / static_cast<double>(phase.contacts.size());
  return sum.scaled(ratio, kEpsilon * ratio);
}

}  // namespace

Trajectory Trajectory::restricted(double middle, double half_width) const {
  return {position.restricted(middle, half_width), velocity.restricted(middle, half_width),
          acceleration.restricted(middle, half_width)};
}

Trajectories Trajectories::restricted(double middle, double half_width) const {
  Trajectories out = *this;
  for (Trajectory& joint : out.joints) joint = joint.restricted(middle, half_width);
  for (Trajectory& body : out.bodies) body = body.restricted(middle, half_width);
  if (base_given)
    for (Trajectory& x : out.base) x = x.restricted(middle, half_width);
  return out;
}

Trajectories trajectories(const PlanarPlan& plan, int interval) {
  const PlanarRobot& robot = plan.task.robot;
  const std::array<Real, 5> spacing = spacings(plan, interval);
  const Eigen::Matrix<Real, 4, 4> basis = cubic_spline_basis<Real>(spacing);
  Trajectories out;
  out.interval = interval;
  out.phase = plan.task.phase_of(interval);
  out.length_s = static_cast<double>(spacing[2]);
  out.begin_s = plan.knot_times()[out.phase] + (interval - plan.task.first_interval(out.phase)) * out.length_s;
  out.base_given = plan.base_control_points.size() > 0;

  std::vector<UncertainPolynomial> joints;
  for (int j = 0; j < robot.joint_count(); ++j) {
    joints.push_back(cubic(basis, plan.control_points.block<1, 4>(j, interval)));
    out.joints.push_back(in_time(joints.back(), out.length_s));
  }
  std::vector<UncertainPolynomial> bodies;
  bodies.push_back(out.base_given ? cubic(basis, plan.base_control_points.block<1, 4>(2, interval))
                                  : base_angle(plan, plan.task.phases[out.phase], joints));
  for (int b = 1; b <= robot.joint_count(); ++b)
    bodies.push_back(bodies[robot.bodies[b].parent] + constant(robot.bodies[b].offset) + joints[b - 1]);
  for (const UncertainPolynomial& angle : bodies) out.bodies.push_back(in_time(angle, out.length_s));
  for (int i = 0; i < 2 && out.base_given; ++i)
    out.base[i] = in_time(cubic(basis, plan.base_control_points.block<1, 4>(i, interval)), out.length_s);
  return out;
}

}  // namespace mcplan::sip::proof
