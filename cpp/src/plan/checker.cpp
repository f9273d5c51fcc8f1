#include "mcplan/plan/checker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "check_laws.hpp"
#include "check_limbs.hpp"
#include "mcplan/base/error.hpp"
#include "model/read.hpp"
#include "plan_shape.hpp"
#include "report_text.hpp"
#include "start_slack.hpp"
#include "tolerances_fields.hpp"

namespace mcplan {

void checks::Problem::set_end() {
  const int n = phase_count();
  end_phase = std::isinf(until_s) ? n : 1;
  while (end_phase < n && knot_times[end_phase] < until_s) ++end_phase;
  last_knot = knot_times[end_phase] <= until_s ? end_phase : end_phase - 1;
}

namespace {

using namespace checks;

/// Instants between two questions to the caller: a millisecond or so.
constexpr int kSamplesPerPoll = 256;

void require_surface(const std::string& field, int surface, const Scene& scene) {
  const int count = static_cast<int>(scene.surfaces.size());
  if (surface < -1 || surface >= count)
    throw InvalidPlan(field, "must be -1 or the index of a surface (below " + text(count) + ")", text(surface));
}

void require_points(const Phase& phase, const std::string& field) {
  const bool has_points = phase.has_points();
  constexpr int kMax = 100000;
  if (has_points ? phase.intervals < 1 || phase.intervals > kMax : phase.intervals != 0)
    throw InvalidPlan(field + ".intervals",
                      has_points ? "must lie in [1, " + text(kMax) + "]" : "must be 0 where no forces act at points",
                      text(phase.intervals));
  for (std::size_t l = 0; l < phase.contacts.size(); ++l) {
    const std::string contact = field + ".contacts[" + std::to_string(l) + "]";
    if (!has_points) require_size(contact + ".points", phase.contacts[l].points_W.size(), 0);
    require_size(contact + ".point_forces", phase.contacts[l].point_forces_W.size(),
                 phase.node_count() * phase.contacts[l].points_W.size());
  }
}

/// Sizes and indices alone: numbers that make no sense are violations with a name, not exceptions.
void require_shape(const Plan& plan, const Scene& scene, const Robot& robot) {
  const std::size_t n = plan.phases.size(), end_effectors = robot.end_effectors.size();
  if (n == 0) throw InvalidPlan("phases", "needs at least one phase", "none");
  if (std::isfinite(plan.start_slack_s)) require_start_slack(plan);
  require_size("knots", plan.knots.size(), n + 1);
  require_size("robot.end_effectors", plan.robot.end_effectors.size(), end_effectors);
  for (std::size_t l = 0; l < end_effectors; ++l)
    if (const std::string& name = robot.end_effectors[l].name; name != plan.robot.end_effectors[l].name)
      throw InvalidRobot("end_effectors[" + std::to_string(l) + "].name",
                         "must be that of the plan's robot, " + text(plan.robot.end_effectors[l].name), text(name));
  require_size("final_contacts", plan.final_contacts.size(), end_effectors);
  for (std::size_t k = 0; k <= n; ++k) {
    const std::string field = "knots[" + std::to_string(k) + "]";
    require_size(field + ".end_effectors", plan.knots[k].end_effectors_W.size(), end_effectors);
    require_size(field + ".end_effector_velocities", plan.knots[k].end_effector_velocities_W.size(), end_effectors);
    require_size(field + ".end_effector_yaw", plan.knots[k].end_effector_yaw.size(),
                 plan.knots[0].end_effector_yaw.empty() ? 0 : end_effectors);
  }
  for (std::size_t k = 0; k < n; ++k) {
    const std::string field = "phases[" + std::to_string(k) + "].contacts";
    require_size(field, plan.phases[k].contacts.size(), end_effectors);
    for (const Contact& contact : plan.phases[k].contacts) require_surface(field, contact.surface, scene);
    require_points(plan.phases[k], "phases[" + std::to_string(k) + "]");
  }
  for (int surface : plan.final_contacts) require_surface("final_contacts", surface, scene);
  for (const Swing& swing : plan.swings)
    if (swing.end_effector < 0 || swing.end_effector >= static_cast<int>(end_effectors) || swing.first_phase < 0 ||
        swing.end_phase <= swing.first_phase || swing.end_phase > static_cast<int>(n))
      throw InvalidPlan("swings", "must name an end-effector and a range of phases", text(swing.end_effector));
}

void require_until(double until_s) {
  if (!(until_s > 0.0)) throw InvalidOptions("until_s", "must be a positive number", text(until_s));
}

void require_samples(double duration, const Tolerances& tolerances) {
  model::require_ranges<InvalidOptions>(tolerances, "tolerances");
  constexpr double kMax = 2e6;
  const double samples = duration / tolerances.sample_s;
  if (samples > kMax)
    throw InvalidOptions("tolerances.sample_s", "must cut the plan into at most 2e6 samples",
                         text(samples) + " samples");
}

/// What remembers instants that were looked at.
struct Memory {
  Travel travel;
  Surroundings surroundings;
  Limbs limbs;
  Joints joints;
};

void check_sample(const Problem& problem, const Sample& sample, Memory& memory, Findings& findings) {
  check_at_consistency(problem, sample, findings);
  check_contact_place(problem, sample, findings);
  memory.travel.check(problem, sample, findings);
  check_pull(problem, sample, findings);
  check_friction(problem, sample, findings);
  check_force_cap(problem, sample, findings);
  memory.joints.check(problem, sample, findings);
  check_momentum(problem, sample, findings);
  with_law(problem, sample.phase, [&](auto law) { law.check_bounds(problem, sample, findings); });
  check_reach(problem, sample, findings);
  check_yaw_range(problem, sample, findings);
  check_com_speed(problem, sample, findings);
  memory.surroundings.check_clearance(problem, sample, findings);
  memory.limbs.look(problem, sample, findings);
}

/// Whether the motion was looked at as far as it was to be, or up to when.
struct Looked {
  bool complete = true;
  double until_s = 0.0;
};

/// Each phase is integrated from its own knot, in equal steps no longer than sample_s, and looked at after each, as
/// long as these do not come after until_s or it is asked to stop.
Looked check_motion(const Problem& problem, const StopRequest& stop, Memory& memory, Findings& findings) {
  Sample sample;
  int samples = 0;
  double looked_s = 0.0;
  for (int k = 0; k < problem.end_phase; ++k) {
    const double last_s = k < problem.last_knot ? std::numeric_limits<double>::infinity() : problem.until_s;
    const double duration = problem.plan.phases[k].duration;
    const int steps = sample_count(problem, k);
    const PhaseView view = phase_view(problem, k);
    sample.view = &view;
    sample.phase = k;
    const bool on = with_law(problem, k, [&](auto law) {
      typename decltype(law)::Integration integration(problem, k, duration / steps);
      sample.replay = law.start(problem, k);
      for (int i = 0; i <= steps; ++i) {
        if (stop && samples++ % kSamplesPerPoll == 0 && stop()) return false;
        const double since_start_s = duration * i / steps, time_s = problem.knot_times[k] + since_start_s;
        if (time_s > last_s) return true;
        if (i > 0 && has_numbers(sample.replay)) integration.advance(sample);
        sample.since_start_s = since_start_s;
        sample.time_s = looked_s = time_s;
        set_orientation(sample);
        set_state(problem.plan, view.frame, sample.since_start_s, sample.at, sample.r_at_WB);
        contact_forces(problem, sample);
        memory.travel.find_still(problem, sample);
        check_sample(problem, sample, memory, findings);
      }
      return true;
    });
    if (!on) return {false, looked_s};
    if (k < problem.last_knot) check_dynamics(problem, sample, findings);
  }
  if (problem.last_knot == problem.end_phase) check_contact_place_at_end(problem, sample, findings);
  return {true, std::min(problem.knot_times.back(), problem.until_s)};
}

/// What does not depend on the instant.
void check_sequence_and_knots(const Problem& problem, Findings& findings) {
  check_contact_permission(problem, findings);
  check_free_force(problem, findings);
  check_stiffness_sign(problem, findings);
  for (int k = 0; k < problem.end_phase; ++k)
    with_law(problem, k, [&](auto law) { law.check_numbers(problem, k, findings); });
  check_sequence_switch(problem, findings);
  check_sequence_rule(problem, findings);
  check_reach_at_knots(problem, findings);
  check_soles(problem, findings);
  check_start(problem, findings);
  check_goal(problem, findings);
}

}  // namespace

void Tolerances::validate() const { model::require_ranges<InvalidOptions>(*this); }

CheckResult check(const Plan& plan, const Scene& scene, const Robot& robot, const Tolerances& tolerances,
                  const StopRequest& stop, double until_s) {
  require_until(until_s);
  scene.validate();
  robot.validate();
  require_shape(plan, scene, robot);

  const Similarity similarity = tolerances.scaled ? similarity_of(robot, scene.gravity) : Similarity();
  const Tolerances own = for_size(tolerances, similarity);
  Problem problem{plan, scene, robot, own, similarity, {}, {}, {}};
  Findings findings(own, similarity);
  if (!check_finite(problem, findings)) return {findings.violations(static_cast<int>(Constraint::finite) + 1, robot)};
  problem.knot_times = plan.knot_times();
  problem.until_s = until_s;
  problem.set_end();
  if (!check_phase_duration(problem, findings))
    return {findings.violations(static_cast<int>(Constraint::phase_duration) + 1, robot)};
  require_samples(std::min(plan.duration(), until_s), own);

  problem.solids = solids_of(scene);
  for (int l = 0; l < problem.end_effector_count(); ++l)
    problem.stretches.push_back(free_stretches(plan, problem.solids, l, robot, similarity));

  std::optional<StartSlack> slack;
  if (plan.start_slack_s > 0.0) findings.set_slack(&slack.emplace(problem, findings));
  check_sequence_and_knots(problem, findings);
  Memory memory;
  const Looked looked = check_motion(problem, stop, memory, findings);
  return {findings.violations(kConstraints, robot),
          looked.complete,
          memory.limbs.warnings(problem),
          slack ? slack->violations(robot) : std::vector<Violation>(),
          std::min(findings.kept_until_s(), looked.until_s),
          looked.until_s,
          plan.start_slack_s};
}

bool CheckResult::ok() const {
  return complete &&
         std::all_of(constraints.begin(), constraints.end(), [](const Violation& v) { return v.value <= v.tolerance; });
}

std::vector<Violation> CheckResult::violations() const {
  std::vector<Violation> out;
  for (const Violation& v : constraints)
    if (!(v.value <= v.tolerance)) out.push_back(v);
  std::stable_sort(out.begin(), out.end(), [](const Violation& a, const Violation& b) {
    return severity(a.value, a.tolerance) > severity(b.value, b.tolerance);
  });
  return out;
}

const Violation& CheckResult::worst() const {
  static const Violation none;
  if (constraints.empty()) return none;
  return *std::max_element(constraints.begin(), constraints.end(), [](const Violation& a, const Violation& b) {
    return severity(a.value, a.tolerance) < severity(b.value, b.tolerance);
  });
}

namespace {

/// What becomes of an excess of the start: a sole stays where it stands; of the rest the checker has seen that it is
/// made good in time if it accepts the plan and has looked that far.
std::string made_good(const CheckResult& result, const Violation& excess) {
  if (excess.name == name_of(Constraint::contact_distance) || excess.name == name_of(Constraint::contact_polygon))
    return "as long as it stands";
  std::ostringstream out;
  out.precision(3);
  const bool seen = result.ok() && result.checked_until_s >= result.start_slack_s;
  out << (seen ? "made good within " : "to be made good within ") << result.start_slack_s << " s";
  return out.str();
}

}  // namespace

std::string CheckResult::to_string() const {
  std::string out;
  for (const Violation& v : violations()) out += (out.empty() ? "" : "\n") + v.to_string();
  if (!complete) out += (out.empty() ? "" : "\n") + std::string("stopped before the end: the rest is not checked");
  if (out.empty()) out = "ok";
  for (const Violation& v : start) out += "\nat the start: " + excess_text(v) + " over (" + made_good(*this, v) + ")";
  for (const Violation& v : warnings) out += "\nwarning: " + v.to_string();
  return out;
}

}  // namespace mcplan
