#include "ddp/replan/tail.hpp"

#include <algorithm>
#include <memory>

#include "ddp/constants.hpp"
#include "mcplan/robot/robot_files.hpp"
#include "mcplan/scene/scene_files.hpp"

namespace mcplan::ddp {
namespace {

/// So many phases at least are worth being kept. Chosen.
constexpr int kTailMin = 8;

bool same(const Surface& one, const Surface& other) {
  return one.name == other.name && one.friction == other.friction && one.vertices_W == other.vertices_W;
}

/// Whether an end-effector touches nothing from a phase on.
bool idle_from(const Rest& rest, int k, int e) {
  for (; k <= rest.size(); ++k)
    if (rest.surface(k, e) != kFree) return false;
  return true;
}

/// Whether the plan can be cut before phase k: all end-effectors stand there, and come from elsewhere than where they
/// began, or touch nothing at all.
bool can_be_cut(const Rest& rest, const Robot& robot, int k) {
  for (int e = 0; e < static_cast<int>(robot.end_effectors.size()); ++e) {
    if (robot.end_effectors[e].kind != "foot" && idle_from(rest, 0, e)) continue;
    if (rest.surface(k, e) == kFree) return false;
    int since = k;
    while (since > 0 && rest.surface(since - 1, e) == rest.surface(k, e)) --since;
    if (since == 0) return false;
  }
  return true;
}

/// Whether a plan is such as the search makes with this model, so that parts of both can be one: forces of the same
/// law, soles with headings of their own or without.
bool of_model(const Plan& plan, Model model) {
  const bool wrench = model == Model::wrench;
  const ForceLaw law = wrench ? ForceLaw(laws::Wrench()) : ForceLaw(laws::Pendulum());
  return std::all_of(plan.phases.begin(), plan.phases.end(), [&](const Phase& phase) { return phase.law == law; }) &&
         std::all_of(plan.knots.begin(), plan.knots.end(),
                     [&](const Knot& knot) { return knot.end_effector_yaw.empty() != wrench; });
}

/// Whether the last `count` phases are those of the plan before, on surfaces that have not changed.
bool as_before(const Rest& rest, const Plan& previous, const Scene& scene, int count) {
  const int here = rest.size() - count, there = static_cast<int>(previous.phases.size()) - count;
  if (there < 0) return false;
  for (int j = 0; j <= count; ++j) {
    if (rest.plan.knots[here + j].com_W != previous.knots[there + j].com_W) return false;
    for (int e = 0; e < previous.end_effector_count(); ++e) {
      const int now = rest.surface(here + j, e),
                before = j < count ? previous.phases[there + j].contacts[e].surface : previous.final_contacts[e];
      if ((now == kFree) != (before == kFree)) return false;
      if (now != kFree && !same(scene.surfaces[now], previous.scene.surfaces[before])) return false;
    }
  }
  return true;
}

/// Whether no more than one contact is made or broken from one phase of the tail to the next: what the checker may not
/// have asked of the plan before.
bool one_switch_per_step(const Tail& tail) {
  for (std::size_t k = 1; k <= tail.phases.size(); ++k) {
    int switches = 0;
    for (std::size_t e = 0; e < tail.final_contacts.size(); ++e) {
      const int before = tail.phases[k - 1].contacts[e].surface;
      const int after = k < tail.phases.size() ? tail.phases[k].contacts[e].surface : tail.final_contacts[e];
      if (before != after) switches += before == kFree || after == kFree ? 1 : 2;
    }
    if (switches > 1) return false;
  }
  return true;
}

/// Phase of a tail from which nothing is other than in the plan that it is of. The headings of soles that stand where
/// it begins may be, until they have landed elsewhere, and lifts of what is in the air there.
int unchanged_from(const Tail& tail) {
  const int count = static_cast<int>(tail.phases.size());
  int last = 0;
  for (std::size_t e = 0; e < tail.final_contacts.size(); ++e) {
    const auto is_free = [&](int k) { return tail.phases[k].contacts[e].surface == kFree; };
    if (is_free(0)) continue;
    int k = 0;
    while (k < count && !is_free(k)) ++k;
    while (k < count && is_free(k)) ++k;
    last = std::max(last, k);
  }
  for (const Swing& swing : tail.swings)
    if (swing.first_phase == 0 && swing.height > 0.0) last = std::max(last, swing.end_phase);
  return std::min(last + 1, count);
}

/// Soles keep the heading that they have landed with until they lift off, which the knot there has, too.
void keep_headings(Plan& plan, int first) {
  for (int e = 0; e < plan.end_effector_count(); ++e)
    for (int k = first; k < static_cast<int>(plan.phases.size()); ++k) {
      if (plan.phases[k].contacts[e].surface == kFree) break;
      if (plan.knots[k].end_effector_yaw.empty()) return;
      plan.knots[k + 1].end_effector_yaw[e] = plan.knots[k].end_effector_yaw[e];
    }
}

}  // namespace

void keep_tail(Rest& rest, const Plan& previous, const Scene& scene, const Robot& robot, const ReplanOptions& options,
               int phases) {
  if (rest.free_end || !rest.desired.empty() || !of_model(previous, options.search.model)) return;
  int cut = std::max(phases, 1);
  while (cut + kTailMin <= rest.size() && !can_be_cut(rest, robot, cut)) ++cut;
  const int count = rest.size() - cut;
  if (count < kTailMin || !as_before(rest, previous, scene, count)) return;
  auto tail = std::make_shared<Tail>();
  tail->knots.assign(rest.plan.knots.begin() + cut, rest.plan.knots.end());
  tail->phases.assign(rest.plan.phases.begin() + cut, rest.plan.phases.end());
  tail->final_contacts = rest.plan.final_contacts;
  const int before = static_cast<int>(previous.phases.size()) - count;
  for (const Swing& swing : previous.swings) {
    if (swing.end_phase <= before) continue;
    tail->swings.push_back(swing);
    tail->swings.back().first_phase = std::max(swing.first_phase - before, 0);
    tail->swings.back().end_phase -= before;
  }
  const bool accepted = options.previous_accepted && scene == previous.scene && robot == previous.robot &&
                        (!options.search.one_switch_per_step || one_switch_per_step(*tail));
  tail->unseen_from = accepted ? unchanged_from(*tail) : count;
  rest.plan.final_contacts = rest.contacts(cut);
  rest.plan.phases.resize(cut);
  rest.plan.knots.resize(cut + 1);
  rest.planned.resize(cut);
  rest.tail = std::move(tail);
}

void append(Plan& plan, const Tail& tail) {
  const int first = static_cast<int>(plan.phases.size());
  const std::vector<double> headings = plan.knots.back().end_effector_yaw;
  plan.knots.pop_back();
  plan.knots.insert(plan.knots.end(), tail.knots.begin(), tail.knots.end());
  plan.knots[first].end_effector_yaw = headings;
  plan.phases.insert(plan.phases.end(), tail.phases.begin(), tail.phases.end());
  plan.final_contacts = tail.final_contacts;
  for (Swing swing : tail.swings) {
    swing.first_phase += first;
    swing.end_phase += first;
    // Of an end-effector that touches nothing, before or after.
    const auto goes_on = std::find_if(plan.swings.begin(), plan.swings.end(), [&](const Swing& begun) {
      return begun.end_effector == swing.end_effector && begun.end_phase == first && swing.first_phase == first;
    });
    if (goes_on != plan.swings.end())
      goes_on->end_phase = swing.end_phase;
    else
      plan.swings.push_back(swing);
  }
  keep_headings(plan, first);
}

}  // namespace mcplan::ddp
