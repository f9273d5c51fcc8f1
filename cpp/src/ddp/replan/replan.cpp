#include "mcplan/ddp/replan.hpp"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "ddp/best_plan.hpp"
#include "ddp/constants.hpp"
#include "ddp/impossible.hpp"
#include "ddp/problem.hpp"
#include "ddp/replan/given.hpp"
#include "ddp/replan/hands.hpp"
#include "ddp/replan/other_steps.hpp"
#include "ddp/replan/replan_fields.hpp"
#include "ddp/replan/stops.hpp"
#include "ddp/replan/trial.hpp"
#include "ddp/replan/walk_on.hpp"
#include "ddp/replan/ways_on.hpp"
#include "ddp/replan_fit.hpp"
#include "mcplan/base/error.hpp"
#include "mcplan/plan/friction_use.hpp"
#include "mcplan/version.hpp"
#include "model/read.hpp"
#include "model/text.hpp"
#include "plan/swings.hpp"

namespace mcplan::ddp {
namespace {

Status status_of(const Trial& trial) {
  if (trial.ok()) return Status::solved;
  const bool seen_in_full = trial.check.complete && !(trial.check.checked_until_s < trial.plan.duration());
  if (trial.ending == Ending::time_limit || !seen_in_full) return Status::time_limit;
  if (trial.ending == Ending::interrupted) return Status::interrupted;
  if (trial.ending == Ending::iteration_limit) return Status::iteration_limit;
  return trial.exact && violation_ratio(trial.check.worst()) <= kAcceptable ? Status::acceptable : Status::infeasible;
}

const char* name_of(PlanFrom from) {
  if (from == PlanFrom::same_sequence) return "the plan's own sequence";
  if (from == PlanFrom::stop) return "a stand";
  return from == PlanFrom::other_sequence ? "other steps or a hand" : "the plan as it was planned";
}

/// The trials of one replan, best first, and what is told of them.
class Trials {
 public:
  Trials(const Now& now, Report& report) : now_(&now), report_(&report) {}

  /// Whether there is no need, or no time, for another one.
  bool done() const { return solved() || too_late() || (best_ && iterations_left(best_->plan) < kWorthwhile); }

  /// With `apart` it gets its iterations whatever work others have been, and takes none from them.
  void make(const Now& now, const Rest& rest, PlanFrom from, bool apart = false) {
    const double begin_s = now_->deadline->elapsed_s();
    std::optional<Trial> trial = attempt(now, rest, apart, nullptr);
    Again again;
    again.hold_joints = trial && !held_joints_ && asks_too_much_of_joints(*trial);
    if (trial && !again.hold_joints && misses_by_little(*trial)) again.missed = trial->check.violations();
    const bool worth_it = again.hold_joints || !again.missed.empty();
    if (worth_it) again.from = trial->plan;
    take(std::move(trial), from);
    held_joints_ = held_joints_ || again.hold_joints;
    // What is missed by little takes few iterations: they are not counted.
    const bool uncounted = apart || !again.missed.empty();
    if (worth_it && !(uncounted ? solved() || too_late() : done())) take(attempt(now, rest, uncounted, &again), from);
    longest_s_ = std::max(longest_s_, now_->deadline->elapsed_s() - begin_s);
  }

  void take(std::optional<Trial> trial, PlanFrom from) {
    tell(trial, from);
    if (!trial || (best_ && !better(*trial, *best_))) return;
    if (sound_only_ && status_of(*trial) == Status::infeasible) return;
    best_ = std::move(trial);
    best_ratio_ = ratio_;
    report_->plan_from = from;
  }

  /// From now on a plan that is not even acceptable is none.
  void take_sound_only(bool only) { sound_only_ = only; }

  std::optional<Trial>& best() { return best_; }

  /// Whether nothing more may be begun.
  bool out_of_time() const { return now_->deadline->passed() || (best_ && best_->ending == Ending::interrupted); }

  /// Whether there is no time for another one that takes as long as the longest.
  bool too_late() const {
    return out_of_time() || (now_->deadline->limited() && now_->deadline->remaining_s() < longest_s_);
  }

  bool solved() const { return best_ && best_->ok(); }

  /// Whether a controller may follow the best one for the next two steps.
  bool usable() const { return best_ && (best_->ok() || can_be_followed(*best_)); }

  /// Ratio of the velocity command that the trials from now on follow.
  void followed(double ratio) { ratio_ = ratio; }
  double best_ratio() const { return best_ratio_; }

 private:
  std::optional<Trial> attempt(const Now& now, const Rest& rest, bool apart, const Again* again) {
    const int iterations = best_ && !apart ? iterations_left(best_->plan) : kReplanIterations;
    std::optional<Trial> trial = try_out(now, rest, *report_, iterations, again);
    if (trial && !apart) work_ += trial->work;
    return trial;
  }

  /// A line of the log: why it was refused, or that it was not.
  void tell(const std::optional<Trial>& trial, PlanFrom from) const {
    const Logger& logger = now_->options->search.logger;
    if (!logger) return;
    std::ostringstream line;
    line << "replan, " << name_of(from) << ": ";
    if (!trial)
      line << "the scene's rules do not allow it";
    else
      line << trial->plan.phases.size() << " phases, cost " << model::digits(trial->evaluation.cost, "%.4g") << ", "
           << (trial->ok() ? std::string("accepted") : trial->check.worst().to_string());
    logger(LogLevel::info, line.str());
  }

  /// Iterations that the work which is left allows a sequence about as long as this plan's.
  int iterations_left(const Plan& plan) const {
    const int left = now_->options->max_work - work_;
    return std::clamp(left / std::max(1, static_cast<int>(plan.phases.size())), 0, kReplanIterations);
  }

  const Now* now_;
  Report* report_;
  std::optional<Trial> best_;
  int work_ = 0;  ///< iterations times phases
  bool sound_only_ = false;
  bool held_joints_ = false;  ///< rows for the limits of joints have been tried
  double longest_s_ = 0.0, ratio_ = 1.0, best_ratio_ = 1.0;
};

std::string message_of(const Trial& best, const Report& report) {
  std::ostringstream message;
  if (report.plan_from == PlanFrom::previous_plan)
    message << "nothing better than the plan as it was planned was found in time";
  else if (best.ok())
    message << "the checker accepts the plan (" << name_of(report.plan_from) << ")";
  else if (!best.exact)
    message << "the contacts could not be made exact";
  else if (!best.check.complete || best.check.ok())
    message << "stopped before the checker had seen the plan in full";
  else
    message << "the best plan violates " << report.worst_violation.to_string();
  if (!report.start_violations.empty())
    message << "; the measured state violates " << report.start_violations.front().to_string();
  if (!best.ok()) message << "; all limits are kept until " << model::digits(report.kept_until_s, "%.3g") << " s";
  return message.str();
}

void conclude(Trials& trials, Report& report, PlanResult& out) {
  std::optional<Trial>& best = trials.best();
  if (!best) {
    report.status = Status::no_sequence;
    report.message = "the scene's rules allow no sequence that goes on from the measured contacts";
    return;
  }
  report.status = status_of(*best);
  report.worst_violation = best->check.worst();
  report.start_violations = best->check.start;
  report.kept_until_s = best->exact ? best->check.kept_until_s : 0.0;
  report.warnings = best->check.warnings;
  report.cost = best->evaluation.cost;
  report.message = message_of(*best, report);
  if (trials.best_ratio() < 1.0)
    report.message += "; " + model::digits(trials.best_ratio(), "%.2g") + " of the velocity command is followed";
  out.plan = std::move(best->plan);
}

/// Pushed by more than this [m/s] the robot reaches for a hold before it tries to go on as planned. Measured on talos
/// at 12 instants: its own sequence is accepted at none of them at 0.5 m/s towards a wall, at 7 at 0.35 m/s.
constexpr double kHardPush_m_s = 0.4;

/// By the plan's own sequence, or with a hand where the robot is pushed towards what it can hold on to; which of them
/// comes first is a matter of how hard. The own one is always tried while there is time.
void as_planned_or_with_a_hand(const Rest& rest, Now& now, Trials& trials) {
  std::vector<Rest> hands;
  if (now.options->other_sequences && now.options->max_work > 0)
    hands = with_hands(rest, *now.scene, *now.robot, now.pushed_W, now.options->committed_s * now.similarity.time,
                       now.similarity);
  now.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, rest);
  const bool hard = now.pushed_W.norm() > kHardPush_m_s * now.similarity.velocity() && !hands.empty();
  if (!hard) trials.make(now, rest, PlanFrom::same_sequence);
  for (std::size_t i = 0; i < hands.size() && !trials.solved() && !trials.out_of_time(); ++i) {
    Now there = now;
    there.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, hands[i]);
    trials.make(there, hands[i], PlanFrom::other_sequence, true);
    if (hard && i == 0 && !trials.solved() && !trials.out_of_time()) trials.make(now, rest, PlanFrom::same_sequence);
  }
}

/// So many ways to the goal are tried. Chosen: each takes as long as the plan's own sequence.
constexpr std::size_t kWaysTried = 3;

/// By other steps to the goal than those of the plan, from what the rest begins with. Where they exceed limits, a stand
/// is better than to begin on them.
void go_another_way(const Rest& begun, const Now& now, Trials& trials) {
  std::size_t tried = 0;
  trials.take_sound_only(true);
  for (const Rest& way : ways_on(begun, *now.scene, *now.robot, now.similarity)) {
    if (trials.solved() || trials.out_of_time() || tried++ == kWaysTried) break;
    Now there = now;
    there.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, way);
    trials.make(there, way, PlanFrom::other_sequence, true);
  }
  trials.take_sound_only(false);
}

/// To the scene's goal, by the plan's own sequence, with another step, or by other steps where that does not lead there
/// (any more).
void go_to_goal(Rest& rest, Now& now, Trials& trials) {
  const Rest begun = rest;
  const bool others = now.options->other_sequences;
  const bool elsewhere = ends_elsewhere(rest, *now.scene, *now.robot);
  const bool gone = stands_on_what_is_gone(rest, *now.scene, *now.robot);
  stand_on(rest, now.options->phases_min, now.similarity);
  now.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, rest);
  const bool leads_on = !elsewhere || changes_contacts(rest);
  if (leads_on) as_planned_or_with_a_hand(rest, now, trials);
  if (Rest there = rest; others && stand_on_others(there, *now.scene, *now.robot)) {
    now.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, there);
    trials.make(now, there, PlanFrom::other_sequence);
  }
  if (others && (elsewhere || gone) && now.options->max_work > 0) go_another_way(begun, now, trials);
  if (!leads_on && !trials.best()) as_planned_or_with_a_hand(rest, now, trials);
  if (!others || (trials.best() && hopeless(*trials.best()))) return;
  for (const Rest& other : other_steps(rest, *now.robot, now.similarity)) {
    if (trials.done()) return;
    trials.make(now, other, PlanFrom::other_sequence);
  }
}

/// At a velocity, slower where that cannot be followed, and with another step.
void follow_command(const Rest& rest, const Now& now, Trials& trials) {
  std::vector<double> ratios{1.0};
  if (now.options->other_sequences) ratios = {1.0, 0.5, 0.0};
  for (const double ratio : ratios) {
    VelocityCommand command = *now.options->command;
    command.velocity_B *= ratio;
    command.yaw_rate *= ratio;
    Rest ahead = rest;
    Scene scene = *now.scene;
    Now there = now;
    there.scene = &scene;
    trials.followed(ratio * walk_on(ahead, scene, *now.robot, command, now.options->horizon));
    if (ratio == ratios.front()) {
      as_planned_or_with_a_hand(ahead, there, trials);
    } else {
      there.surfaces = surfaces_of(scene, *now.robot, now.measured, ahead);
      trials.make(there, ahead, PlanFrom::same_sequence);
    }
    if (trials.done()) return;
    const std::vector<Rest> others =
        ratio == ratios.back() ? other_steps(ahead, *now.robot, now.similarity) : std::vector<Rest>();
    for (const Rest& other : others) {
      trials.make(there, other, PlanFrom::other_sequence);
      if (trials.done()) return;
    }
  }
}

/// To a stand, where nothing else can be followed: at once, each foot in the air on the ground that is near.
void stop(const Rest& rest, const Now& now, Trials& trials) {
  for (Rest& at_rest : stops(rest, *now.scene, *now.robot, now.similarity)) {
    if (trials.usable() || trials.out_of_time()) return;
    Scene scene = *now.scene;
    Now there = now;
    there.scene = &scene;
    stay(at_rest, scene, *now.robot);
    there.surfaces = surfaces_of(scene, *now.robot, now.measured, at_rest);
    trials.make(there, at_rest, PlanFrom::stop, true);  // it is short, and the last resort
  }
}

}  // namespace

PlanResult replan(const Plan& previous, double t, const Measured& given, const Scene& scene_in, const Robot& robot_in,
                  const ReplanOptions& options) {
  const Deadline deadline(options.search.time_limit_s, options.search.clock);
  options.validate();
  previous.validate();
  scene_in.validate();
  robot_in.validate();
  const Robot robot = robot_for(robot_in, options.search);
  require_fit(previous, given.state, robot);
  require_contacts(given.contacts, previous);
  PlanResult out;
  Report& report = out.report;
  report.seed = options.search.seed;
  report.threads = options.search.threads;
  report.version = MCPLAN_VERSION;
  if (const std::optional<Impossible> impossible =
          options.command ? std::nullopt : why_impossible(scene_in, robot, true, options.search.allow_flight)) {
    report.status = Status::infeasible;
    report.message = impossible->message;
    report.worst_violation = impossible->violation;
    report.time_s = deadline.elapsed_s();
    return out;
  }
  Now now{&scene_in, &robot, &options, &deadline, {}, {}, similarity_of(robot, scene_in.gravity)};
  now.measured = completed(given, previous, t, scene_in, robot);
  const Rest planned = rest_of(previous, t);
  now.under_way = swings_under_way(previous, t);
  now.pushed_W = now.measured.state.com_velocity_W - planned.plan.knots.front().com_velocity_W;
  Rest rest = planned;
  rename(rest, scene_in);
  if (options.command) count_turns_as(given.state.base_rpy.z(), rest, now.measured);
  // Out of time, what was planned is better than what cannot be followed; there may be no time then to look at it.
  const bool ended = planned.plan.duration() < kEnded_s;
  const double short_s = kShortLimits * 1e-3 * kFinishing_ms * static_cast<double>(planned.size());
  std::optional<Trial> kept;
  if (!ended && deadline.limited() && deadline.remaining_s() < short_s) kept = as_planned(planned, now);
  Trials trials(now, report);
  if (begin_with(rest, now.measured, now.measured.contacts, past_of(previous, t), now.similarity)) {
    const Rest begun = rest;
    if (options.command)
      follow_command(rest, now, trials);
    else
      go_to_goal(rest, now, trials);
    if (options.other_sequences && options.max_work > 0) stop(begun, now, trials);
  }
  if (!ended && deadline.passed() && !(trials.best() && can_be_followed(*trials.best())))
    trials.take(kept ? std::move(kept) : as_planned(planned, now), PlanFrom::previous_plan);
  conclude(trials, report, out);
  report.time_s = deadline.elapsed_s();
  return out;
}

PlanResult replan(const Plan& previous, double t, const Measured& measured, const ReplanOptions& options) {
  return replan(previous, t, measured, previous.scene, previous.robot, options);
}

void ReplanOptions::validate() const {
  model::Findings found;
  model::check_struct(*this, model::Place(), found);
  if (command) model::check_struct(*command, model::Place(model::Place(), "command"), found);
  if (search.method == Method::paper)
    found.add("method", "must be standard to start from a plan: the published algorithm does not", "paper");
  found.raise<InvalidOptions>();
  search.validate();
}

}  // namespace mcplan::ddp
