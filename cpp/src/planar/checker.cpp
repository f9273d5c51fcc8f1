#include "mcplan/planar/checker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks.hpp"
#include "model/read.hpp"
#include "tolerances_fields.hpp"

namespace mcplan {

std::array<PlanarConstraintInfo, kPlanarConstraints> planar_constraints(const PlanarTolerances& t) {
  return {{{"finite", "numbers", 0.0},
           {"phase_duration", "s", 0.0},
           {"position", "-", t.limit},
           {"velocity", "-", t.limit},
           {"torque", "-", t.limit},
           {"continuity", "rad", t.continuity},
           {"rest", "rad", t.continuity},
           {"drift", "m", t.drift},
           {"drift_angle", "rad", t.drift_angle},
           {"balance", "N", t.balance},
           {"moment", "N m", t.moment},
           {"friction", "m g", t.friction},
           {"pull", "m g", t.pull},
           {"clearance", "m", t.clearance},
           {"collision", "m", t.clearance},
           {"pose", "m", t.pose}}};
}

namespace planar {

Findings::Findings(const PlanarTolerances& tolerances) : table_(planar_constraints(tolerances)) {}

void Findings::offer(Constraint constraint, double value, const Place& place) {
  Worst& worst = worst_[static_cast<int>(constraint)];
  if (!std::isfinite(value)) value = std::numeric_limits<double>::max();
  if (value > table_[static_cast<int>(constraint)].tolerance) note_beyond(place.time_s);
  if (worst.measured && value <= worst.value) return;
  worst = {value, place, true};
}

std::vector<Violation> Findings::violations(int count) const {
  std::vector<Violation> out;
  for (int i = 0; i < count; ++i) {
    const Place& place = worst_[i].place;
    std::string who = place.who ? *place.who : "";
    if (place.other) who += " and " + *place.other;
    out.push_back(
        {table_[i].name, place.phase, who, place.time_s, worst_[i].value, table_[i].tolerance, table_[i].unit});
  }
  return out;
}

namespace {

void require_samples(const PlanarPlan& plan, double sample_s) {
  if (!(std::isfinite(sample_s) && sample_s > 0.0))
    throw InvalidOptions("tolerances.sample_s", "must be a positive number", text(sample_s));
  constexpr double kMax = 2e6;
  const double samples = plan.duration() / sample_s;
  if (samples > kMax)
    throw InvalidOptions("tolerances.sample_s", "must cut the plan into at most 2e6 samples",
                         text(samples) + " samples");
}

/// Calls see(sample) at both ends of every interval and between them, in equal steps no longer than sample_s. Returns
/// false where it was asked to stop.
template <class See>
bool for_each_sample(const PlanarPlan& plan, const std::vector<IntervalSplines>& splines, double sample_s,
                     const StopRequest& stop, See&& see) {
  Evaluation evaluation(plan);
  PhaseGain gain;
  int phase = -1, interval_of_phase = 0;
  double start_s = 0.0;
  for (const IntervalSplines& interval : splines) {
    if (stop && stop()) return false;
    ++interval_of_phase;
    if (interval.phase != phase) {
      phase = interval.phase;
      interval_of_phase = 0;
      gain = phase_gain(plan, phase);
    }
    const int steps = std::max(1, static_cast<int>(std::ceil(interval.length / sample_s)));
    for (int i = 0; i <= steps; ++i) {
      evaluation.at(interval, gain, 2.0 * i / steps - 1.0);
      see(Sample{plan, evaluation, phase, interval_of_phase, i == 0, start_s + interval.length * i / steps});
    }
    start_s += interval.length;
  }
  return true;
}

std::vector<IntervalSplines> all_splines(const PlanarPlan& plan) {
  const std::vector<double> lengths = plan.interval_lengths();
  std::vector<IntervalSplines> splines;
  for (int k = 0; k < plan.task.interval_count(); ++k) splines.push_back(interval_splines(plan, k, lengths));
  return splines;
}

/// What check(), largest_drift() and solid_depths() ask for before they evaluate anything. Task and robot are
/// exceptions when malformed, as scene and robot of other plans are.
void require_well_formed(const PlanarPlan& plan) {
  plan.task.validate();
  require_shape(plan);
}

}  // namespace
}  // namespace planar

void PlanarTolerances::validate() const { model::require_ranges<InvalidOptions>(*this); }

CheckResult check(const PlanarPlan& plan, const PlanarTolerances& tolerances, bool self_collision,
                  const StopRequest& stop) {
  using namespace planar;
  require_well_formed(plan);
  Findings findings(tolerances);
  if (!check_finite(plan, findings)) return {findings.violations(static_cast<int>(Constraint::finite) + 1)};
  if (!check_phase_duration(plan, findings))
    return {findings.violations(static_cast<int>(Constraint::phase_duration) + 1)};
  plan.validate();  // weights that are not positive
  model::require_ranges<InvalidOptions>(tolerances, "tolerances");
  require_samples(plan, tolerances.sample_s);

  const std::vector<IntervalSplines> splines = all_splines(plan);
  check_continuity(splines, plan.task.robot, findings);
  check_rest(splines, plan.task.robot, findings);
  check_poses(plan, findings);
  SolidDepths depths(tolerances.clearance);
  double checked_until_s = 0.0;
  const bool complete = for_each_sample(plan, splines, tolerances.sample_s, stop, [&](const Sample& sample) {
    checked_until_s = sample.time_s;
    check_joints(sample, findings);
    check_drift(sample, findings);
    check_balance(sample, findings);
    check_forces(sample, findings);
    check_middle_heights(sample, findings);
    depths.look(sample);
    if (self_collision) check_collision(sample, findings);
  });
  check_solids(plan.task, depths, findings);
  if (complete) checked_until_s = plan.duration();
  return {findings.violations(kPlanarConstraints),
          complete,
          {},
          {},
          std::min(findings.kept_until_s(), checked_until_s),
          checked_until_s};
}

std::vector<SolidDepth> solid_depths(const PlanarPlan& plan, double sample_s) {
  using namespace planar;
  plan.validate();
  require_samples(plan, sample_s);
  SolidDepths depths;
  for_each_sample(plan, all_splines(plan), sample_s, {}, [&](const Sample& sample) { depths.look(sample); });
  return depths.all(plan.task);
}

Drift largest_drift(const PlanarPlan& plan, double sample_s) {
  using namespace planar;
  plan.validate();
  require_samples(plan, sample_s);
  Drift drift;
  for_each_sample(plan, all_splines(plan), sample_s, {}, [&drift](const Sample& sample) {
    for (const Eigen::Vector3d& error : sample.at.state.contact_error) {
      drift.position_m = std::max(drift.position_m, error.head<2>().norm());
      drift.angle_rad = std::max(drift.angle_rad, std::abs(error[2]));
    }
  });
  return drift;
}

}  // namespace mcplan
