#include "certify_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace mcplan::sip::proof {
namespace {

bool needs_dynamics(Kind kind) {
  return kind == Kind::torque || kind == Kind::friction || kind == Kind::pull || kind == Kind::balance ||
         kind == Kind::moment;
}
bool needs_kinematics(Kind kind) {
  return needs_dynamics(kind) || kind == Kind::drift || kind == Kind::drift_angle || kind == Kind::clearance ||
         kind == Kind::collision;
}

/// max(min - q, q - max), in shares of the range where there is one; a limit may be missing.
Amount beyond_range(const UncertainPolynomial& q, const PlanarBody& body) {
  const double range = body.position_max - body.position_min;
  const double scale = std::isinf(range) ? 1.0 : 1.0 / range;
  const Amount position = Amount::of(q);
  const auto above = [&] { return scaled(position, scale, -body.position_max * scale); };
  const auto below = [&] { return scaled(position, -scale, body.position_min * scale); };
  if (std::isinf(body.position_min)) return above();
  if (std::isinf(body.position_max)) return below();
  return larger(above(), below());
}

/// |f_t| - mu f_n, in shares of the weight.
Amount beyond_cone(const TaylorModel& tangential, const TaylorModel& normal, double friction, double weight) {
  const TaylorModel limit = normal.scaled(friction);
  return scaled(larger(Amount::of(tangential - limit), Amount::of(-tangential - limit)), 1.0 / weight, 0.0);
}

std::string point_name(const PlanarEndEffector& end, std::size_t point) {
  return end.name + " point " + std::to_string(point);
}

/// The forces that a law has by itself, not by the motion: polynomials over an interval, (tangential, normal) point by
/// point.
std::vector<UncertainPolynomial> given_forces(planar_laws::LeastNorm /*law*/, const PlanarPlan& /*plan*/,
                                              int /*interval*/) {
  return {};
}
std::vector<UncertainPolynomial> given_forces(planar_laws::Polynomial /*law*/, const PlanarPlan& plan, int interval) {
  const Eigen::MatrixXd& coefficients = plan.force_polynomials[interval];
  std::vector<UncertainPolynomial> out;
  for (Eigen::Index i = 0; i < coefficients.cols(); ++i) out.push_back({coefficients.col(i), 0.0});
  return out;
}

}  // namespace

/// Every row once, always in the same order: see(kind, name, amount), where `name` and `amount` are functions and
/// `amount` is called for chosen rows only.
template <class Visit>
void IntervalRows::visit(const Trajectories& piece, const PieceModels* models, const Visit& see) const {
  visit_joints(piece, models, see);
  visit_contacts(models, see);
  visit_collisions(models, see);
  visit_solids(models, see);
}

template <class Visit>
void IntervalRows::visit_joints(const Trajectories& piece, const PieceModels* models, const Visit& see) const {
  const PlanarRobot& robot = plan_.task.robot;
  for (int j = 0; j < robot.joint_count(); ++j) {
    const PlanarBody& body = robot.bodies[j + 1];
    const auto name = [&] { return body.name; };
    if (!std::isinf(body.position_min) || !std::isinf(body.position_max))
      see(Kind::position, name, [&] { return beyond_range(piece.joints[j].position, body); });
    if (!std::isinf(body.velocity_max))
      see(Kind::velocity, name,
          [&] { return scaled(absolute(Amount::of(piece.joints[j].velocity)), 1.0 / body.velocity_max, -1.0); });
    if (!std::isinf(body.torque_max))
      see(Kind::torque, name,
          [&] { return scaled(absolute(Amount::of(models->torques[j])), 1.0 / body.torque_max, -1.0); });
  }
}

template <class Visit>
void IntervalRows::visit_contacts(const PieceModels* models, const Visit& see) const {
  const PlanarTask& task = plan_.task;
  const PlanarRobot& robot = task.robot;
  const double weight = robot.mass() * robot.gravity;
  for (std::size_t i = 0; i < constants_.contacts.size(); ++i) {
    const ContactFrame& contact = constants_.contacts[i];
    const PlanarEndEffector& end = robot.end_effectors[contact.end_effector];
    const auto name = [&] { return end.name; };
    see(Kind::drift, name, [&] {
      const Vector& error = models->contact_errors[i];
      Amount out = root(Amount::of(error.x * error.x + error.y * error.y));
      out.rounding = error.x.rounding() + error.y.rounding();
      return out;
    });
    see(Kind::drift_angle, name, [&] { return absolute(Amount::of(models->contact_angle_errors[i])); });
    for (std::size_t k = 0; k < contact.points.size(); ++k) {
      const std::size_t v = contact.first_point + k;
      const auto point = [&, k] { return point_name(end, k); };
      see(Kind::friction, point, [&, v] {
        return beyond_cone(models->tangential[v], models->normal[v], task.surfaces[contact.surface].friction, weight);
      });
      see(Kind::pull, point, [&, v] { return scaled(Amount::of(models->normal[v]), -1.0 / weight, 0.0); });
    }
  }
  const auto nowhere = [] { return std::string("base"); };
  see(Kind::balance, nowhere, [&] {
    const Vector& force = models->force_residual;
    return root(Amount::of(force.x * force.x + force.y * force.y));
  });
  see(Kind::moment, nowhere, [&] { return absolute(Amount::of(models->moment_residual)); });
}

template <class Visit>
void IntervalRows::visit_collisions(const PieceModels* models, const Visit& see) const {
  if (!self_collision_) return;
  const PlanarRobot& robot = plan_.task.robot;
  for (const auto& [first, second] : robot.collision_pairs) {
    const PlanarBody &a = robot.bodies[first], &b = robot.bodies[second];
    for (const Capsule& one : a.capsules)
      for (const Capsule& other : b.capsules) {
        const int of_a = first, of_b = second;
        see(
            Kind::collision, [&] { return a.name + " and " + b.name; },
            [&, of_a, of_b] { return overlap(*models, of_a, one, of_b, other); });
      }
  }
}

template <class Visit>
void IntervalRows::visit_solids(const PieceModels* models, const Visit& see) const {
  const PlanarTask& task = plan_.task;
  for (int e = 0; e < static_cast<int>(task.robot.end_effectors.size()); ++e) {
    const auto stands = [&](const ContactFrame& contact) { return contact.end_effector == e; };
    if (std::any_of(constants_.contacts.begin(), constants_.contacts.end(), stands)) continue;
    for (int s = 0; s < static_cast<int>(task.surfaces.size()); ++s) {
      if (!task.keeps_clear(e, s)) continue;
      see(
          Kind::clearance, [&] { return task.robot.end_effectors[e].name + " and " + task.surfaces[s].name; },
          [&, e, s] { return depth_in_solid(plan_, *models, e, s); });
    }
  }
}

IntervalRows::IntervalRows(const PlanarPlan& plan, const PhaseConstants& constants, int interval, int order,
                           bool self_collision)
    : plan_(plan),
      constants_(constants),
      order_(order),
      self_collision_(self_collision),
      interval_(trajectories(plan, interval)) {
  visit(interval_, nullptr, [&](Kind kind, const auto& name, const auto&) { rows_.push_back({kind, name()}); });
}

std::vector<Amount> IntervalRows::evaluate(double middle, double half_width, const std::vector<int>& listed) const {
  bool kinematics = false, dynamics = false;
  std::vector<char> chosen(rows_.size(), 0);
  for (int i : listed) {
    chosen[i] = 1;
    kinematics = kinematics || needs_kinematics(rows_[i].kind);
    dynamics = dynamics || needs_dynamics(rows_[i].kind);
  }
  const Trajectories piece = interval_.restricted(middle, half_width);
  std::vector<UncertainPolynomial> forces =
      std::visit([&](auto law) { return given_forces(law, plan_, interval_.interval); }, plan_.force_law);
  for (UncertainPolynomial& force : forces) force = force.restricted(middle, half_width);
  PieceModels models(plan_, constants_, piece, order_, std::move(forces));
  if (kinematics) models.kinematics();
  if (dynamics) models.dynamics();

  std::vector<Amount> out;
  std::size_t index = 0;
  visit(piece, &models, [&](Kind, const auto&, const auto& amount) {
    if (chosen[index++]) out.push_back(amount());
  });
  return out;
}

}  // namespace mcplan::sip::proof
