#include <cmath>
#include <limits>

#include "check_internal.hpp"
#include "start_slack.hpp"

namespace mcplan::checks {
namespace {

struct Row {
  const char* name;
  const char* unit;
  double tolerance;
};

/// In the order of the enumeration.
std::array<Row, kConstraints> rows(const Tolerances& t, const Similarity& s) {
  return {{{"finite", "numbers", 0.0},
           {"phase_duration", "s", 0.0},
           {"dynamics", "m", t.dynamics * s.length},
           {"at_consistency", "m", t.dynamics * s.length},
           {"orientation", "rad", t.orientation},
           {"contact_distance", "m", t.contact_distance},
           {"contact_polygon", "m", t.contact_distance},
           {"contact_permission", "contacts", 0.0},
           {"slip", "m", t.slip},
           {"anchor", "m", t.contact_distance},
           {"center_of_pressure", "m", t.center_of_pressure},
           {"path_continuity", "m", t.slip},
           {"free_force", "N", 0.0},
           {"stiffness_sign", "1/s^2", 0.0},
           {"pull", "N", t.force},
           {"friction", "-", t.friction},
           {"force_cap", "-", t.force_cap},
           {"joint_torque", "-", t.joint},
           {"joint_speed", "-", t.joint},
           {"com_speed", "m/s", t.boundary * s.velocity()},
           {"moment", "N m", t.moment},
           {"angular_momentum", "-", t.force_cap},
           {"reach", "m", t.reach},
           {"clearance", "m", t.clearance},
           {"limb", "m", t.clearance},
           {"trunk", "m", t.clearance},
           {"sequence_switch", "switches", 0.0},
           {"sequence_rule", "contacts", 0.0},
           {"start", "m", t.boundary * s.length},
           {"goal", "m", t.boundary * s.length}}};
}

}  // namespace

Tolerances for_size(const Tolerances& tolerances, const Similarity& s) {
  Tolerances out = tolerances;
  for (double* length :
       {&out.center_of_pressure, &out.contact_distance, &out.slip, &out.reach, &out.clearance, &out.stance})
    *length *= s.length;
  out.force *= s.force();
  out.moment *= s.moment();
  out.sample_s *= s.time;
  return out;
}

double severity(double value, double tolerance) {
  if (tolerance > 0.0) return value / tolerance;
  return value > 0.0 ? std::numeric_limits<double>::infinity() : value;
}

Findings::Findings(const Tolerances& tolerances, const Similarity& similarity) {
  const auto table = rows(tolerances, similarity);
  for (int i = 0; i < kConstraints; ++i) {
    worst_[i].unit = worst_[i].own_unit = table[i].unit;
    worst_[i].tolerance = worst_[i].own_tolerance = table[i].tolerance;
  }
}

void Findings::compare(Constraint constraint, double value, const Place& place, double tolerance, const char* unit) {
  if (!std::isfinite(value)) value = std::numeric_limits<double>::max();
  if (value > tolerance) kept_until_s_ = std::min(kept_until_s_, place.time_s);
  Worst& worst = worst_[static_cast<int>(constraint)];
  const double measure = severity(value, tolerance);
  // Two infinite severities (tolerance 0) compare by value.
  if (worst.measured && (measure < worst.severity || (measure == worst.severity && value <= worst.value))) return;
  const double bar =
      std::isfinite(measure) ? measure - 1e-14 * std::abs(measure) : -std::numeric_limits<double>::infinity();
  worst = {value, tolerance, measure, unit, place, true, worst.own_tolerance, worst.own_unit, bar};
}

double Findings::less_slack(StateLimit limit, double value, const Place& place, double tolerance,
                            const char* unit) const {
  return slack_->beyond(limit, value, place, tolerance, unit);
}

/// While slack is measured all is kept: what is worst at one end-effector is not at another.
double Findings::plus_slack(StateLimit limit, double kept, const Place& place) const {
  return slack_->measured() ? kept + slack_->left(limit, place) : -std::numeric_limits<double>::infinity();
}

const char* name_of(Constraint constraint) { return rows({}, {})[static_cast<int>(constraint)].name; }

std::vector<Violation> Findings::violations(int count, const Robot& robot) const {
  const auto table = rows({}, {});
  std::vector<Violation> out;
  for (int i = 0; i < count; ++i) {
    const Worst& w = worst_[i];
    out.push_back({table[i].name, w.place.phase,
                   w.place.end_effector < 0 ? "" : robot.end_effectors[w.place.end_effector].name, w.place.time_s,
                   w.value, w.tolerance, w.unit});
  }
  return out;
}

}  // namespace mcplan::checks
