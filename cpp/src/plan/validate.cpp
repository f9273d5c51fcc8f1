#include <algorithm>
#include <cmath>
#include <variant>

#include "mcplan/base/error.hpp"
#include "mcplan/plan/plan.hpp"
#include "plan_shape.hpp"

namespace mcplan {
namespace {

using Eigen::Vector3d;

bool finite(const std::vector<Vector3d>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const Vector3d& v) { return v.allFinite(); });
}

void validate_knot(const Knot& knot, const Knot& first, int end_effectors, const std::string& field) {
  if (static_cast<int>(knot.end_effectors_W.size()) != end_effectors ||
      static_cast<int>(knot.end_effector_velocities_W.size()) != end_effectors)
    throw InvalidPlan(field + ".end_effectors", "must be one per end-effector (" + text(end_effectors) + ")",
                      text(static_cast<int>(knot.end_effectors_W.size())));
  const int headings = static_cast<int>(knot.end_effector_yaw.size());
  if ((headings != 0 && headings != end_effectors) || knot.end_effector_yaw.empty() != first.end_effector_yaw.empty())
    throw InvalidPlan(field + ".end_effector_yaw",
                      "must be one per end-effector (" + text(end_effectors) + "), or none in all", text(headings));
  if (!(knot.com_W.allFinite() && knot.com_velocity_W.allFinite() && knot.base_rpy.allFinite() &&
        knot.base_rpy_rate.allFinite() && knot.angular_momentum_W.allFinite() && finite(knot.end_effectors_W) &&
        finite(knot.end_effector_velocities_W) &&
        std::all_of(knot.end_effector_yaw.begin(), knot.end_effector_yaw.end(),
                    [](double yaw) { return std::isfinite(yaw); })))
    throw InvalidPlan(field, "must be finite numbers", "nan or inf");
}

void validate_contact(const Phase& phase, const Contact& contact, int surfaces, const std::string& field) {
  if (contact.surface < -1 || contact.surface >= surfaces)
    throw InvalidPlan(field + ".surface", "must be -1 or the index of a surface (below " + text(surfaces) + ")",
                      text(contact.surface));
  if (!(std::isfinite(contact.stiffness) && contact.anchor_W.allFinite() && contact.moment_W.allFinite() &&
        contact.center_of_pressure_W.allFinite() && finite(contact.points_W) && finite(contact.point_forces_W)))
    throw InvalidPlan(field, "must be finite numbers", "nan or inf");
  std::visit([&](auto law) { law.validate_contact(phase, contact, field); }, phase.law);
}

void validate_phase(const Phase& phase, int end_effectors, int surfaces, const std::string& field) {
  if (!(phase.duration > 0.0 && std::isfinite(phase.duration)))
    throw InvalidPlan(field + ".duration", "must be a positive number", text(phase.duration));
  if (static_cast<int>(phase.contacts.size()) != end_effectors)
    throw InvalidPlan(field + ".contacts", "must be one per end-effector (" + text(end_effectors) + ")",
                      text(static_cast<int>(phase.contacts.size())));
  std::visit([&](auto law) { law.validate(phase, field); }, phase.law);
  for (int l = 0; l < end_effectors; ++l)
    validate_contact(phase, phase.contacts[l], surfaces, field + ".contacts[" + std::to_string(l) + "]");
}

void validate_swing(const Swing& swing, int end_effectors, int phases, const std::string& field) {
  if (swing.end_effector < 0 || swing.end_effector >= end_effectors || swing.first_phase < 0 ||
      swing.end_phase <= swing.first_phase || swing.end_phase > phases)
    throw InvalidPlan(field, "must name an end-effector and a range of phases",
                      "end-effector " + text(swing.end_effector) + ", phases " + text(swing.first_phase) + " to " +
                          text(swing.end_phase));
  if (!(std::isfinite(swing.height) && swing.lift_normal_W.allFinite() && swing.land_normal_W.allFinite()))
    throw InvalidPlan(field, "must be finite numbers", "nan or inf");
  if (!(swing.elapsed_s >= 0.0 && std::isfinite(swing.elapsed_s)))
    throw InvalidPlan(field + ".elapsed_s", "must be zero or positive", text(swing.elapsed_s));
  if (swing.elapsed_s > 0.0 && swing.first_phase > 0)
    throw InvalidPlan(field + ".elapsed_s", "must be 0 of a swing that begins in the plan", text(swing.elapsed_s));
}

}  // namespace

void Plan::validate() const {
  const int n = static_cast<int>(phases.size());
  const int end_effectors = end_effector_count();
  const int surfaces = static_cast<int>(scene.surfaces.size());
  if (n == 0) throw InvalidPlan("phases", "needs at least one phase", "none");
  require_start_slack(*this);
  if (static_cast<int>(knots.size()) != n + 1)
    throw InvalidPlan("knots", "must be one more than the phases (" + text(n + 1) + ")",
                      text(static_cast<int>(knots.size())));
  for (int k = 0; k <= n; ++k) validate_knot(knots[k], knots[0], end_effectors, "knots[" + std::to_string(k) + "]");
  for (int k = 0; k < n; ++k) validate_phase(phases[k], end_effectors, surfaces, "phases[" + std::to_string(k) + "]");
  if (static_cast<int>(final_contacts.size()) != end_effectors)
    throw InvalidPlan("final_contacts", "must be one per end-effector (" + text(end_effectors) + ")",
                      text(static_cast<int>(final_contacts.size())));
  for (int surface : final_contacts)
    if (surface < -1 || surface >= surfaces)
      throw InvalidPlan("final_contacts", "must be -1 or the index of a surface (below " + text(surfaces) + ")",
                        text(surface));
  for (std::size_t i = 0; i < swings.size(); ++i)
    validate_swing(swings[i], end_effectors, n, "swings[" + std::to_string(i) + "]");
}

}  // namespace mcplan
