#include "ddp/replan/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ddp/best_plan.hpp"
#include "ddp/constants.hpp"
#include "ddp/far_reach.hpp"
#include "ddp/near_miss.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/replan/tail.hpp"
#include "plan/swings.hpp"

namespace mcplan::ddp {
namespace {

using Eigen::Vector3d;

/// Instants are so many times farther apart where a plan is looked at for the first time. Chosen.
constexpr double kCoarser = 5.0;

/// Iterations of steps that catch a push, which are few phases and are not given up: what is accepted of them costs up
/// to thousands. Measured on 188 states of the G1 within 0.6 s of pushes of 88 N: 102 plans are accepted with 42
/// iterations and where costs above 300 are given up, 121 so, in the same time.
constexpr int kRecoveryIterations = 60;

/// The problem of a sequence from the measured state, inside of its limits by what was missed of them before.
Problem pose(const Now& now, const Rest& rest, Tuning& tuning, const Again* again) {
  Options with = now.options->search;
  with.phases = rest.size();
  with.initial_sequence.clear();
  with.polish = Polish::interior_point;
  with.threads = 1;
  with.weights.rotation_end *= kEndFirmer;
  with.allow_flight = true;  // where the sequence has one, somebody has planned it
  with.min_contacts = 0;
  if (rest.shortest_s > 0.0) with.duration_min_s = rest.shortest_s;
  Problem problem(part_of(*now.scene, now.surfaces), *now.robot, with);
  tuning = problem.tuning();
  if (again) tighten_between_knots(problem, tuning, again->missed, again->from);
  ContactState contacts;
  for (int e : problem.active) {
    const int surface = now.measured.contacts[e];
    contacts.push_back(surface == kFree ? kFree : problem.scene.surface_index(now.scene->surfaces[surface].name));
  }
  if (rest.tail) {
    ContactState end;
    for (int e : problem.active) {
      const int surface = rest.plan.final_contacts[e];
      end.push_back(surface == kFree ? kFree : problem.scene.surface_index(now.scene->surfaces[surface].name));
    }
    problem.set_end(rest.tail->knots.front(), end);
  }
  problem.set_start(now.measured.state, contacts);
  problem.free_end = rest.free_end;
  if (reaches_far(rest.plan)) problem.reach_far();
  problem.start_slack = kSlackRatio * now.options->start_slack_s * now.similarity.time / problem.units.time;
  problem.first_duration = rest.plan.phases.front().duration / problem.units.time;
  return problem;
}

/// What was planned is what the motion is to stay near, and where contacts are to begin.
void hold_on_to(Problem& problem, const Incumbent& warm, const Rest& rest, double committed_s) {
  std::vector<Eigen::VectorXd> desired = warm.trajectory.x;
  if (!rest.desired.empty()) {
    Plan follow = rest.plan;
    follow.knots = rest.desired;
    desired = from_plan(problem, follow, 0).trajectory.x;
  }
  std::copy(desired.begin() + 1, desired.end() - 1, problem.reference.x.begin() + 1);
  const double committed = committed_s * problem.similarity.time;
  double time_s = 0.0;
  for (int k = 1; k <= problem.steps; ++k) {
    time_s += rest.plan.phases[k - 1].duration;
    const bool planned = k <= rest.kept && (k == problem.steps || rest.planned[k]);
    for (int l = 0; planned && l < problem.layout.end_effector_count(); ++l) {
      const int surface = warm.sequence[k][l];
      if (surface == kFree || warm.sequence[k - 1][l] == surface) continue;
      const double weight = time_s <= committed ? kCommitted : kKept;
      problem.kept.push_back({k, l, warm.trajectory.x[k].segment<3>(problem.layout.end(l)), weight});
    }
  }
  if (rest.across) {
    const auto index = [&](int e) {
      return static_cast<int>(std::find(problem.active.begin(), problem.active.end(), e) - problem.active.begin());
    };
    problem.across.push_back(
        {rest.across->knot, index(rest.across->foot), index(rest.across->other), rest.across->axis_W});
    if (rest.across->via_knot > 0)
      problem.kept.push_back(
          {rest.across->via_knot, index(rest.across->foot), rest.across->via_W / problem.units.length, kCommitted});
  }
  problem.first_duration_kept = rest.planned.front() && rest.plan.phases.front().duration <= committed;
}

/// Time [s] of the second touchdown of a plan, or its end.
double two_steps_s(const Plan& plan) {
  const std::vector<double> times = plan.knot_times();
  int touchdowns = 0;
  for (std::size_t k = 1; k < plan.phases.size(); ++k)
    for (std::size_t e = 0; e < plan.phases[k].contacts.size(); ++e)
      if (plan.phases[k - 1].contacts[e].surface < 0 && plan.phases[k].contacts[e].surface >= 0 && ++touchdowns == 2)
        return times[k];
  return times.back();
}

/// The checker's word on a plan of a robot until then, looked at so many times less often than for a verdict.
CheckResult look(const Plan& plan, const Robot& robot, const Now& now, double until_s, const StopRequest& stop,
                 double coarser = 1.0) {
  Tolerances tolerances;
  if (!now.options->search.one_switch_per_step) tolerances.switches = std::numeric_limits<int>::max();
  tolerances.sample_s = coarser * std::max(tolerances.sample_s, std::min(until_s, plan.duration()) / kFullInstantsMax);
  return check(plan, plan.scene, robot, tolerances, stop, until_s);
}

/// The checker's word on all of it, held to the limits of the plan's robot. What is seen to exceed those that it was
/// planned with already at few instants is not looked at closely: that is most of what is tried where little helps, and
/// a close look takes as long as some iterations.
void look_at_all(Trial& trial, const Now& now, const StopRequest& stop) {
  CheckResult few = look(trial.plan, *now.robot, now, trial.accepted_from_s, stop, kCoarser);
  if (!few.complete) return;
  trial.coarse = !few.ok();
  if (!trial.coarse) {
    CheckResult close = look(trial.plan, trial.plan.robot, now, trial.accepted_from_s, stop);
    if (close.complete) trial.check = std::move(close);
    return;
  }
  trial.check = std::move(few);
}

/// Put the end where it is pinned, end-effectors from where they land on: what the solve has left of the distance.
void pin_end(const Problem& problem, Incumbent& at) {
  if (!problem.pinned_end) return;
  Trajectory& t = at.trajectory;
  t.x.back() = problem.reference.x.back();
  for (int l = 0; l < problem.layout.end_effector_count(); ++l) {
    const int end = problem.layout.end(l), stride = problem.layout.stride(l), surface = at.sequence.back()[l];
    if (surface == kFree) continue;
    int k = problem.steps;
    for (; k > 1 && at.sequence[k - 1][l] == surface; --k) t.x[k - 1].segment<3>(end) = t.x.back().segment<3>(end);
    for (int j = k - 1; j < problem.steps; ++j)
      t.u[j].segment<3>(stride) = t.x[j + 1].segment<3>(end) - t.x[j].segment<3>(end);
  }
}

/// The goal is where the plan ends.
void end_there(Plan& plan) {
  const Knot& end = plan.knots.back();
  Stance stance;
  stance.position_W = end.com_W - plan.robot.com_height * Vector3d::UnitZ();
  stance.yaw = std::remainder(end.base_rpy.z(), 2.0 * M_PI);
  for (std::size_t e = 0; e < plan.final_contacts.size(); ++e)
    if (const int surface = plan.final_contacts[e]; surface >= 0)
      stance.contacts[plan.robot.end_effectors[e].name] = plan.scene.surfaces[surface].name;
  plan.scene.goal = stance;
}

/// What the last steps after the solve take of a limit: exact contacts, conversion, a look at the next steps.
double finishing_s(const Problem& problem) { return 1e-3 * kFinishing_ms * problem.steps; }

}  // namespace

std::optional<Trial> try_out(const Now& now, const Rest& rest, Report& report, int iterations, const Again* again) {
  Tuning tuning;
  Problem problem = pose(now, rest, tuning, again);
  Incumbent at = from_plan(problem, rest.plan, 0);
  if (!problem.rules.valid(at.sequence)) return std::nullopt;
  at.trajectory.x.front() = problem.start;
  hold_on_to(problem, at, rest, now.options->committed_s);
  if (again) {
    at = from_plan(problem, again->from, 0);
    at.trajectory.x.front() = problem.start;
    tuning.hold_joints = tuning.hold_joints || again->hold_joints;
  }
  const Deadline solving = now.deadline->reserving(finishing_s(problem));
  Search search(problem, solving, report);
  Trial trial;
  at.evaluation = search.evaluate(at, tuning);
  polish::Settings settings;
  settings.barrier = at.evaluation.defect_max < kConvergedDefect ? kWarmBarrier : kReplanBarrier;
  settings.max_iterations = rest.catches_push() ? kRecoveryIterations : iterations;
  settings.tolerance = kRoughTolerance;
  settings.to_the_end = false;
  if (!rest.catches_push()) settings.give_up_above = kHopeless;
  settings.patience = kHopelessPatience;
  const int before = report.iterations;
  trial.ending = search.optimise(at, settings, tuning);
  trial.phases = problem.steps;
  trial.work = (report.iterations - before) * problem.steps;
  const StopRequest late =
      now.deadline->limited() ? StopRequest([&] { return now.deadline->passed(); }) : StopRequest();
  pin_end(problem, at);
  trial.exact = search.make_exact(at, tuning, late);
  if (!trial.exact && late && late()) return trial;  // there is no time to look at what nobody can follow
  trial.evaluation = search.evaluate(at, tuning);
  const Stopwatch watch(report.timing_s, "check");
  trial.plan = to_plan(problem, at, false);
  choose_swings(trial.plan, true, now.under_way, now.normals_W);
  trial.plan.start_slack_s = now.options->start_slack_s * now.similarity.time;
  put_back(trial.plan, *now.scene, now.surfaces);
  if (rest.free_end) end_there(trial.plan);
  if (rest.tail) {
    append(trial.plan, *rest.tail);
    if (rest.tail->unseen_from < static_cast<int>(rest.tail->phases.size()))
      trial.accepted_from_s = trial.plan.knot_times()[rest.size() + rest.tail->unseen_from];
  }
  if (now.given_robot) trial.plan.robot = *now.given_robot;
  // In time or not, the next two steps are looked at; a limit leaves the rest of them to the next call.
  if (late) trial.check = look(trial.plan, trial.plan.robot, now, two_steps_s(trial.plan), {});
  if (!late || !late()) look_at_all(trial, now, late);
  return trial;
}

Trial as_planned(const Rest& planned, const Now& now) {
  Trial trial;
  trial.plan = planned.plan;
  trial.phases = planned.size();
  trial.plan.measured_start = true;
  choose_swings(trial.plan, true, now.under_way, now.normals_W);
  trial.exact = true;
  trial.ending = Ending::time_limit;
  trial.check = look(trial.plan, *now.robot, now, two_steps_s(trial.plan), {});
  trial.planned = true;
  return trial;
}

void look_closely(Trial& trial, const Now& now) {
  if (!trial.coarse) return;
  const StopRequest late =
      now.deadline->limited() ? StopRequest([&] { return now.deadline->passed(); }) : StopRequest();
  CheckResult close = look(trial.plan, trial.plan.robot, now, trial.accepted_from_s, late);
  if (close.complete)
    trial.check = std::move(close);
  else  // in time or not, the next two steps are looked at
    trial.check.kept_until_s = look(trial.plan, trial.plan.robot, now, two_steps_s(trial.plan), {}).kept_until_s;
  trial.coarse = false;
}

bool can_be_followed(const Trial& trial) {
  return trial.exact && trial.check.kept_until_s >= std::min(two_steps_s(trial.plan), trial.check.checked_until_s);
}

bool asks_too_much_of_joints(const Trial& trial) {
  return trial.exact && !trial.check.ok() && trial.check.worst().name == "joint_torque";
}

bool misses_by_little(const Trial& trial, double tolerances) {
  if (!trial.exact || trial.planned || trial.check.ok() || !trial.seen_in_full()) return false;
  return violation_ratio(trial.check.worst()) <= tolerances;
}

bool misses_from(const Trial& trial, int phase) {
  const std::vector<Violation> violations = trial.check.violations();
  return std::any_of(violations.begin(), violations.end(), [phase](const Violation& v) { return v.phase >= phase; });
}

bool hopeless(const Trial& trial) { return !trial.ok() && trial.evaluation.cost > kHopelessWithMore; }

bool better(const Trial& one, const Trial& other) {
  if (one.plan.phases.empty() != other.plan.phases.empty()) return other.plan.phases.empty();
  if (can_be_followed(one) != can_be_followed(other)) return can_be_followed(one);
  if (one.ok() != other.ok()) return one.ok();
  if (one.ok()) return one.evaluation.merit() < other.evaluation.merit();
  return violation_ratio(one.check.worst()) < violation_ratio(other.check.worst());
}

}  // namespace mcplan::ddp
