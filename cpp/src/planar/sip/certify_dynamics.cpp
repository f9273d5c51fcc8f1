#include "certify_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace mcplan::sip::proof {
namespace {

/// Sine and cosine of the library are within an ulp.
Constant direction(double angle) { return {{std::cos(angle), std::sin(angle)}, kEpsilon}; }

/// The gain of a phase under a force law, and how far its forces fall short of what they have to give.
void set_gain(planar_laws::LeastNorm /*law*/, const PlanarPlan& plan, int phase, PhaseConstants& out) {
  out.gain = least_norm_gain(plan.task, phase, plan.weights[phase]);
  Eigen::MatrixXd g(3, 2 * out.points), g_error(3, 2 * out.points);
  for (const ContactFrame& contact : out.contacts)
    for (std::size_t k = 0; k < contact.points.size(); ++k) {
      const Eigen::Vector2d along = contact.points[k] * contact.tangent_W.value;
      const Eigen::Vector2d arm = contact.position_W.value + along - out.moment_point_W;
      const double size = contact.position_W.value.lpNorm<1>() + along.lpNorm<1>() + out.moment_point_W.lpNorm<1>();
      for (int d = 0; d < 2; ++d) {
        const Eigen::Vector2d& v = d == 0 ? contact.tangent_W.value : contact.normal_W.value;
        const int column = 2 * (contact.first_point + static_cast<int>(k)) + d;
        g.col(column) << v, arm.x() * v.y() - arm.y() * v.x();
        g_error.col(column) << kEpsilon, kEpsilon, 8.0 * kEpsilon * size;
      }
    }
  const Eigen::Matrix3d difference = Eigen::Matrix3d::Identity() - g * out.gain;
  out.leak = difference.cwiseAbs() + (g_error + (g.cols() + 4) * kEpsilon * g.cwiseAbs()) * out.gain.cwiseAbs() +
             2.0 * kEpsilon * Eigen::Matrix3d::Identity();
}

/// None: the forces are given.
void set_gain(planar_laws::Polynomial /*law*/, const PlanarPlan& /*plan*/, int /*phase*/, PhaseConstants& /*out*/) {}

}  // namespace

Vector& Vector::operator+=(const Vector& other) {
  x += other.x;
  y += other.y;
  return *this;
}

Vector& Vector::add_scaled(double factor, const Vector& other, double factor_error) {
  x.add_scaled(factor, other.x, factor_error);
  y.add_scaled(factor, other.y, factor_error);
  return *this;
}

TaylorModel cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

PhaseConstants phase_constants(const PlanarPlan& plan, int phase) {
  const PlanarTask& task = plan.task;
  PhaseConstants out;
  for (const PlanarContact& contact : task.phases[phase].contacts) {
    const PlanarEndEffector& end = task.robot.end_effectors[contact.end_effector];
    ContactFrame frame;
    frame.end_effector = contact.end_effector;
    frame.surface = contact.surface;
    frame.body = end.body;
    frame.position_W.value = contact.position_W;
    frame.tangent_W = direction(contact.angle);
    frame.normal_W = {{-frame.tangent_W.value.y(), frame.tangent_W.value.x()}, kEpsilon};
    frame.position_B.value = end.position_B;
    frame.along_B = direction(end.angle_B);
    frame.angle = contact.angle;
    frame.angle_B = end.angle_B;
    frame.first_point = out.points;
    frame.points = end.points;
    out.points += static_cast<int>(end.points.size());
    out.contacts.push_back(frame);
  }
  out.moment_point_W = moment_point_W(task, phase);
  std::visit([&](auto law) { set_gain(law, plan, phase, out); }, plan.force_law);
  return out;
}

PieceModels::PieceModels(const PlanarPlan& plan, const PhaseConstants& constants, const Trajectories& piece, int order,
                         std::vector<UncertainPolynomial> forces)
    : plan_(plan),
      robot_(plan.task.robot),
      constants_(constants),
      piece_(piece),
      force_polynomials_(std::move(forces)),
      order_(order) {}

Vector PieceModels::constant(const Constant& c) const {
  return {TaylorModel::constant(order_, c.value.x(), c.error), TaylorModel::constant(order_, c.value.y(), c.error)};
}

Vector PieceModels::rotated(int body, const Constant& v) const {
  Vector out{cosine_[body].scaled(v.value.x(), v.error), sine_[body].scaled(v.value.x(), v.error)};
  out.x.add_scaled(-v.value.y(), sine_[body], v.error);
  out.y.add_scaled(v.value.y(), cosine_[body], v.error);
  return out;
}

Vector PieceModels::rotated_acceleration(int body, const Constant& v) const {
  const TaylorModel &c = cosine_acceleration_[body], &s = sine_acceleration_[body];
  Vector out{c.scaled(v.value.x(), v.error), s.scaled(v.value.x(), v.error)};
  out.x.add_scaled(-v.value.y(), s, v.error);
  out.y.add_scaled(v.value.y(), c, v.error);
  return out;
}

Vector PieceModels::from_base(int body, const Constant& point_B) const {
  return origin_[body] + rotated(body, point_B);
}

void PieceModels::kinematics() {
  const int bodies = static_cast<int>(robot_.bodies.size());
  for (int b = 0; b < bodies; ++b) {
    TaylorModel::SineCosine rotation = TaylorModel::of(order_, piece_.bodies[b].position).sine_cosine();
    cosine_.push_back(rotation.cosine);
    sine_.push_back(rotation.sine);
    const int parent = robot_.bodies[b].parent;
    origin_.push_back(b == 0 ? zero_vector() : origin_[parent] + rotated(parent, {robot_.bodies[b].joint_P, 0.0}));
  }

  const double ratio = 1.0 / static_cast<double>(constants_.contacts.size());
  if (piece_.base_given) {
    base_W_ = {TaylorModel::of(order_, piece_.base[0].position), TaylorModel::of(order_, piece_.base[1].position)};
  } else {  // eq. 12
    Vector sum = zero_vector();
    for (const ContactFrame& contact : constants_.contacts)
      sum += constant(contact.position_W) + -from_base(contact.body, contact.position_B);
    base_W_ = zero_vector().add_scaled(ratio, sum, kEpsilon * ratio);
  }

  for (const ContactFrame& contact : constants_.contacts) {
    contact_errors.push_back(base_W_ + from_base(contact.body, contact.position_B) + -constant(contact.position_W));
    UncertainPolynomial expected;
    expected.a[0] = contact.angle - contact.angle_B;
    expected.error = kEpsilon * std::abs(expected.a[0]);
    contact_angle_errors.push_back(piece_.bodies[contact.body].position - expected);
  }
}

void PieceModels::dynamics() {
  accelerations();
  inertial_forces();
  contact_forces();
  contact_torques();
  residuals();
}

void PieceModels::accelerations() {
  const int bodies = static_cast<int>(robot_.bodies.size());
  std::vector<Vector> origin;  // accelerations relative to the base
  for (int b = 0; b < bodies; ++b) {
    // cos'' = -theta'' sin - theta'^2 cos,  sin'' = theta'' cos - theta'^2 sin
    const TaylorModel rate = TaylorModel::of(order_, piece_.bodies[b].velocity);
    const TaylorModel angular = TaylorModel::of(order_, piece_.bodies[b].acceleration), square = rate * rate;
    cosine_acceleration_.push_back(-(angular * sine_[b] + square * cosine_[b]));
    sine_acceleration_.push_back(angular * cosine_[b] - square * sine_[b]);
    const int parent = robot_.bodies[b].parent;
    origin.push_back(b == 0 ? zero_vector()
                            : origin[parent] + rotated_acceleration(parent, {robot_.bodies[b].joint_P, 0.0}));
  }

  Vector base = zero_vector();
  if (piece_.base_given) {
    base = {TaylorModel::of(order_, piece_.base[0].acceleration), TaylorModel::of(order_, piece_.base[1].acceleration)};
  } else {
    const double ratio = 1.0 / static_cast<double>(constants_.contacts.size());
    for (const ContactFrame& contact : constants_.contacts)
      base.add_scaled(-ratio, origin[contact.body] + rotated_acceleration(contact.body, contact.position_B),
                      kEpsilon * ratio);
  }
  for (int b = 0; b < bodies; ++b)
    com_acceleration_.push_back(base + origin[b] + rotated_acceleration(b, {robot_.bodies[b].com_B, 0.0}));
}

/// F_b = m (a - g) + sum of the children's;  N_b = I theta'' + (c - p_b) x m (a - g) + sum N + (p_child - p_b) x F,
/// from the leaves to the base.
void PieceModels::inertial_forces() {
  const int bodies = static_cast<int>(robot_.bodies.size());
  inertial_force_.assign(bodies, zero_vector());
  inertial_moment_.assign(bodies, zero());
  for (int b = bodies - 1; b >= 0; --b) {
    const PlanarBody& body = robot_.bodies[b];
    Vector own = com_acceleration_[b];
    own.y += TaylorModel::constant(order_, robot_.gravity);
    own = zero_vector().add_scaled(body.mass, own);
    inertial_moment_[b] += cross(rotated(b, {body.com_B, 0.0}), own);
    inertial_moment_[b].add_scaled(body.inertia, TaylorModel::of(order_, piece_.bodies[b].acceleration));
    inertial_force_[b] += own;
    if (b == 0) continue;
    inertial_force_[body.parent] += inertial_force_[b];
    inertial_moment_[body.parent] += inertial_moment_[b];
    inertial_moment_[body.parent] += cross(rotated(body.parent, {body.joint_P, 0.0}), inertial_force_[b]);
  }
  const Vector from_moment_point = base_W_ + -constant({constants_.moment_point_W, 0.0});
  desired_ = {inertial_force_[0].x, inertial_force_[0].y,
              inertial_moment_[0] + cross(from_moment_point, inertial_force_[0])};
}

void PieceModels::contact_forces() {
  for (const ContactFrame& contact : constants_.contacts) {
    Vector sum = zero_vector(), first_moment = zero_vector();
    for (std::size_t k = 0; k < contact.points.size(); ++k) {
      std::array<TaylorModel, 2> along;  // tangential, normal
      for (int d = 0; d < 2; ++d) {
        const int row = 2 * (contact.first_point + static_cast<int>(k)) + d;
        if (constants_.gain.size() == 0) {
          along[d] = TaylorModel::of(order_, force_polynomials_[row]);
        } else {
          along[d] = zero();
          for (int i = 0; i < 3; ++i) along[d].add_scaled(constants_.gain(row, i), desired_[i]);
        }
      }
      Vector force = zero_vector();
      for (int d = 0; d < 2; ++d) {
        const Constant& axis = d == 0 ? contact.tangent_W : contact.normal_W;
        force.x.add_scaled(axis.value.x(), along[d], axis.error);
        force.y.add_scaled(axis.value.y(), along[d], axis.error);
      }
      sum += force;
      first_moment.add_scaled(contact.points[k], force);
      tangential.push_back(along[0]);
      normal.push_back(along[1]);
    }
    contact_forces_.push_back(sum);
    contact_first_moments_.push_back(first_moment);
  }
}

/// tau_j = N_b minus the moments of the contact forces about the joint, for the joints that carry the contact.
void PieceModels::contact_torques() {
  torques.assign(inertial_moment_.begin() + 1, inertial_moment_.end());
  for (std::size_t i = 0; i < constants_.contacts.size(); ++i) {
    const ContactFrame& contact = constants_.contacts[i];
    const TaylorModel about_sole = cross(rotated(contact.body, contact.along_B), contact_first_moments_[i]);
    Vector arm = rotated(contact.body, contact.position_B);  // from the joint to the sole
    for (int b = contact.body; b > 0; b = robot_.bodies[b].parent) {
      torques[b - 1] -= about_sole + cross(arm, contact_forces_[i]);
      arm += rotated(robot_.bodies[b].parent, {robot_.bodies[b].joint_P, 0.0});
    }
  }
}

/// Under the gain forces balance but for its rounding, and for the moment that they make at the actual points instead
/// of the expected ones. Forces that are polynomials are compared with what is desired.
void PieceModels::residuals() {
  if (constants_.gain.size() > 0) {
    const auto leaks = [&](int row) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) {
        const Range range = desired_[i].range();
        sum += constants_.leak(row, i) * std::max(std::abs(range.min), std::abs(range.max));
      }
      return TaylorModel::constant(order_, 0.0, sum * (1.0 + 16.0 * kEpsilon));
    };
    force_residual = {leaks(0), leaks(1)};
    moment_residual = leaks(2);
    for (std::size_t i = 0; i < constants_.contacts.size(); ++i) {
      const ContactFrame& contact = constants_.contacts[i];
      moment_residual -= cross(contact_errors[i], contact_forces_[i]);
      moment_residual -=
          cross(rotated(contact.body, contact.along_B) + -constant(contact.tangent_W), contact_first_moments_[i]);
    }
    const Vector to_moment_point = constant({constants_.moment_point_W, 0.0}) + -base_W_;
    moment_residual += cross(to_moment_point, force_residual);
    return;
  }
  force_residual = inertial_force_[0];
  moment_residual = inertial_moment_[0];
  for (std::size_t i = 0; i < constants_.contacts.size(); ++i) {
    const ContactFrame& contact = constants_.contacts[i];
    force_residual += -contact_forces_[i];
    moment_residual -= cross(from_base(contact.body, contact.position_B), contact_forces_[i]);
    moment_residual -= cross(rotated(contact.body, contact.along_B), contact_first_moments_[i]);
  }
}

}  // namespace mcplan::sip::proof
