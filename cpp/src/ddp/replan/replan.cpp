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
#include "ddp/replan/recovery.hpp"
#include "ddp/replan/replan_fields.hpp"
#include "ddp/replan/stops.hpp"
#include "ddp/replan/tail.hpp"
#include "ddp/replan/trials.hpp"
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

/// By steps that catch a push, to a stand wherever that is.
void try_recovery(const Recovery& recovery, const Now& now, Trials& trials) {
  Now there = now;
  there.robot = &recovery.robot;
  if (!recovery.rest.across) there.given_robot = now.robot;
  there.surfaces = surfaces_of(*now.scene, recovery.robot, now.measured, recovery.rest);
  trials.make(there, recovery.rest, PlanFrom::recovery, true);
}

/// By new steps that catch a push. Where they are not solved they wait until the end: what they violate says nothing
/// about other ways.
void recover(const Rest& rest, const Now& now, Trials& trials) {
  if (!trials.begin_recovery()) return;
  Trials::Aside aside = trials.put_aside();
  for (const Recovery& recovery : recoveries(rest, now)) {
    if (trials.solved() || trials.out_of_time()) break;
    try_recovery(recovery, now, trials);
  }
  if (!trials.solved()) trials.spare_until_the_end();
  trials.put_back(std::move(aside));
}

/// Pushed by more than this [m/s] the robot reaches for a hold before it tries to go on as planned. Measured on talos
/// at 12 instants: its own sequence is accepted at none of them at 0.5 m/s towards a wall, at 7 at 0.35 m/s.
constexpr double kHardPush_m_s = 0.4;
/// Off the plan by more than this velocity [m/s] it catches itself before other steps are tried, or where its own
/// sequence drops it. Chosen: a push of 100 N for 0.1 s moves TALOS by 0.11 m/s.
constexpr double kPush_m_s = 0.08;
/// Weights on the feet between which a robot stays upright, and for how long that is looked at [s]. Walks of TALOS and
/// G1 have 0.9 to 1.1; those that answer a push by dropping the CoM, 0.7 and then 1.8. Chosen.
constexpr double kLeastWeight = 0.8, kMostWeight = 1.4, kUpright_s = 1.5;

/// Whether a plan bears about the robot's weight at any time: one that drops the CoM asks much of knees later on.
bool stays_upright(const Plan& plan, const Robot& robot, const Similarity& similarity) {
  double begin_s = 0.0;
  for (const Phase& phase : plan.phases) {
    if (begin_s > kUpright_s * similarity.time) break;
    double stiffness = 0.0;
    for (const Contact& contact : phase.contacts) stiffness += contact.stiffness;
    const double weights = stiffness * robot.com_height / plan.scene.gravity;
    if (weights < kLeastWeight || weights > kMostWeight) return false;
    begin_s += phase.duration;
  }
  return true;
}

bool is_pushed(const Now& now) { return now.pushed_W.norm() > kPush_m_s * now.similarity.velocity(); }

/// Steps that catch a push, where the robot is pushed or such steps are under way, and what has been found does not do,
/// or drops it though the plan under way did not. Steps under way are first gone on with as quickly as they were
/// planned.
void recover_if_pushed(const Rest& rest, const Now& now, Trials& trials) {
  if (!is_pushed(now) && !rest.quick) return;
  if (rest.quick && !trials.solved()) {
    Rest as_quick = rest;
    as_quick.shortest_s = quickest_s(*now.robot, now.similarity);
    trials.make(now, as_quick, PlanFrom::same_sequence, true);
  }
  const bool dropped = trials.solved() && !stays_upright(trials.best()->plan, *now.robot, now.similarity) &&
                       (rest.quick || stays_upright(rest.plan, *now.robot, now.similarity));
  if (!trials.solved() || dropped) recover(rest, now, trials);
}

/// By the plan's own sequence, of which `near` is planned anew, and all of it where what stays as it was planned is
/// what exceeds limits.
void by_own_sequence(const Rest& rest, Rest& near, const Now& now, Trials& trials) {
  trials.make(now, near, PlanFrom::same_sequence);
  if (!near.tail || trials.acceptable()) return;
  const bool beyond = trials.best() && misses_from(*trials.best(), near.size());
  if (is_pushed(now) && !beyond) return;  // the push is what exceeds them
  near = rest;
  trials.make(now, near, PlanFrom::same_sequence, true);
}

/// By the plan's own sequence, or with a hand where the robot is pushed towards what it can hold on to; which of them
/// comes first is a matter of how hard. The own one is always tried while there is time.
/// `near`: the rest, or as much of it as is planned anew.
void as_planned_or_with_a_hand(const Rest& rest, Rest& near, Now& now, Trials& trials) {
  std::vector<Rest> hands;
  if (now.options->other_sequences && now.options->max_work > 0)
    hands = with_hands(rest, *now.scene, *now.robot, now.pushed_W, now.options->committed_s * now.similarity.time,
                       now.similarity);
  now.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, rest);
  const bool hard = now.pushed_W.norm() > kHardPush_m_s * now.similarity.velocity() && !hands.empty();
  const bool may_recover = now.options->other_sequences && now.options->max_work > 0 && hands.empty();
  if (may_recover && now.options->recovery_first && is_pushed(now)) recover(rest, now, trials);
  if (!hard && !trials.solved()) by_own_sequence(rest, near, now, trials);
  if (may_recover) recover_if_pushed(rest, now, trials);
  for (std::size_t i = 0; i < hands.size() && !trials.solved() && !trials.out_of_time(); ++i) {
    Now there = now;
    there.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, hands[i]);
    trials.make(there, hands[i], PlanFrom::other_sequence, true);
    if (hard && i == 0 && !trials.solved() && !trials.out_of_time()) by_own_sequence(rest, near, now, trials);
  }
}

/// Horizons of a velocity command that are planned anew on the way to a goal. The first plan, of a search, stops short
/// of the best timing: with one of them feet of the G1 came to graze treads of `stairs_broad`, which it walks well
/// where all of its 28 phases are planned anew. Measured.
constexpr int kHorizonsToGoal = 2;
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
void go_to_goal(Rest& rest, const Plan& previous, Now& now, Trials& trials) {
  const Rest begun = rest;
  const bool others = now.options->other_sequences;
  const bool elsewhere = ends_elsewhere(rest, *now.scene, *now.robot);
  const bool gone = stands_on_what_is_gone(rest, *now.scene, *now.robot);
  stand_on(rest, now.options->phases_min, now.similarity);
  now.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, rest);
  // Steps that catch a push are made before the robot looks for its way again: as long as they last, the way on is
  // found from a fall, by slow steps that drop the CoM.
  if (const auto begun_so = recovery_under_way(begun, now);
      begun_so && elsewhere && others && now.options->max_work > 0) {
    try_recovery(*begun_so, now, trials);
    if (trials.solved()) return;
  }
  const bool leads_on = !elsewhere || changes_contacts(rest);
  Rest near = rest;
  if (!elsewhere && !gone)
    keep_tail(near, previous, *now.scene, *now.robot, *now.options, kHorizonsToGoal * now.options->horizon);
  if (leads_on) as_planned_or_with_a_hand(rest, near, now, trials);
  if (Rest there = rest; others && stand_on_others(there, *now.scene, *now.robot)) {
    now.surfaces = surfaces_of(*now.scene, *now.robot, now.measured, there);
    trials.make(now, there, PlanFrom::other_sequence);
  }
  if (others && (elsewhere || gone) && now.options->max_work > 0) {
    go_another_way(begun, now, trials);
    if (leads_on && !gone && !trials.solved()) recover(begun, now, trials);
  }
  if (!leads_on && !trials.best()) as_planned_or_with_a_hand(rest, near, now, trials);
  if (!others || (!is_pushed(now) && trials.acceptable() && trials.usable()) ||
      (trials.best() && hopeless(*trials.best())))
    return;
  for (const Rest& other : other_steps(near, *now.robot, now.similarity)) {
    if (trials.done()) return;
    trials.make(now, other, PlanFrom::other_sequence);
  }
}

/// At a velocity, slower where that cannot be followed, and with another step.
void follow_command(const Rest& rest, const Now& now, Trials& trials) {
  std::vector<double> ratios{1.0};
  if (now.options->other_sequences) ratios = {1.0, 0.5, 0.0};
  double longest = 1.0;  // the ratio at which strides are as long as legs and ground allow
  for (const double shorter : ratios) {
    const double ratio = shorter * longest;
    VelocityCommand command = *now.options->command;
    command.velocity_B *= ratio;
    command.yaw_rate *= ratio;
    Rest ahead = rest;
    Scene scene = *now.scene;
    Now there = now;
    there.scene = &scene;
    const double followed = ratio * walk_on(ahead, scene, *now.robot, command, now.options->horizon);
    trials.followed(followed);
    if (shorter == ratios.front()) {
      longest = followed;
      Rest near = ahead;
      as_planned_or_with_a_hand(ahead, near, there, trials);
    } else {
      there.surfaces = surfaces_of(scene, *now.robot, now.measured, ahead);
      trials.make(there, ahead, PlanFrom::same_sequence);
    }
    if (trials.done()) return;
    const std::vector<Rest> others =
        shorter == ratios.back() ? other_steps(ahead, *now.robot, now.similarity) : std::vector<Rest>();
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
  const std::optional<Scene> counted = with_goal_counted(scene_in, previous);
  const Scene& scene = counted ? *counted : scene_in;
  const Robot robot = robot_for(robot_in, options.search);
  require_fit(previous, given.state, robot);
  require_contacts(given.contacts, previous);
  PlanResult out;
  Report& report = out.report;
  report.seed = options.search.seed;
  report.threads = options.search.threads;
  report.version = MCPLAN_VERSION;
  if (const std::optional<Impossible> impossible =
          options.command ? std::nullopt : why_impossible(scene, robot, true, options.search.allow_flight)) {
    report.status = Status::infeasible;
    report.message = impossible->message;
    report.worst_violation = impossible->violation;
    report.time_s = deadline.elapsed_s();
    return out;
  }
  Now now{&scene, &robot, &options, &deadline, {}, {}, similarity_of(robot, scene.gravity)};
  now.measured = completed(given, previous, t, scene, robot);
  const Rest planned = rest_of(previous, t);
  now.under_way = swings_under_way(previous, t);
  now.normals_W = sole_normals(previous, t);
  now.pushed_W = now.measured.state.com_velocity_W - planned.plan.knots.front().com_velocity_W;
  Rest rest = planned;
  rename(rest, scene);
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
      go_to_goal(rest, previous, now, trials);
    // What misses a limit by little before long is followed all the same, unless that is what a push has come to.
    const bool leads_on = trials.usable() || (trials.acceptable() && !is_pushed(now));
    if (!leads_on && options.other_sequences && options.max_work > 0) {
      recover(begun, now, trials);
      stop(begun, now, trials);
    }
    trials.take_spare();
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
