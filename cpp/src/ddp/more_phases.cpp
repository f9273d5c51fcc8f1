#include <limits>
#include <utility>

#include "ddp/constants.hpp"
#include "ddp/near_miss.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/ways.hpp"

// A way in more phases than its length asks for: docs/theory/ddp.md, "5. Check, restarts, statuses".
namespace mcplan::ddp {

namespace {

/// A plan that costs less than this ratio of another one is far cheaper.
constexpr double kFarCheaper = 0.5;

/// More phases than so many; 0: there would be too many.
int more_than(int phases) {
  const int more = 2 * static_cast<int>(0.5 * kMorePhases * phases);
  return more <= kPhasesMax ? more : 0;
}

}  // namespace

bool ended_by_itself(Ending ending) {
  return ending == Ending::done || ending == Ending::broke_down || ending == Ending::no_sequence;
}

bool strains(const BestPlan::Finished& found) {
  return found.ok && found.evaluation.cost > kDearPhase * static_cast<double>(found.plan.phases.size()) &&
         flights(found.plan) == 0;
}

/// Whether it is not the way that says how many phases there are.
bool WaysToGoal::phases_given() const {
  return options_->phases > 0 || earlier_ || !options_->initial_sequence.empty() || options_->method == Method::paper;
}

/// In how many phases the same way is tried where a plan is nearly found, or strains the robot, or a foot has caught
/// the edge of what it can step on: ground may ask for shorter steps than the robot can make. 0: in no others.
int WaysToGoal::more_phases(const Found& found) const {
  if (phases_given()) return 0;
  const auto& best = found.best.best();
  if (found.crawled || found.way.longer || !best || !ended_by_itself(found.ending) || (best->ok && !strains(*best)))
    return 0;
  const bool caught = best->worst.name == "clearance" && !found.barrier;
  if (!best->ok && !caught && violation_ratio(best->worst) > kAcceptable) return 0;
  return more_than(found.steps);
}

/// The number of phases in which a way is searched first.
int WaysToGoal::first_phases(const Way& way) const {
  const int asked = pose_within(0, way, 0, nullptr).problem.steps;
  return way.longer && more_than(asked) > 0 ? more_than(asked) : asked;
}

/// In as many phases as the way asks for. Where these are many, a restart takes long and has to be lucky at each of
/// many steps: first the same is tried in more of them, with shorter steps, and near misses are mended.
Found WaysToGoal::search_phases(const Way& way, Report& report, const Beside* beside) const {
  Found found{BestPlan(*scene_, *deadline_)};
  found.way = way;
  if (crawl_along(way, report, found, beside)) return found;
  const int first = phases_given() ? options_->phases : first_phases(way);
  const bool far = !phases_given() && !way.brief && options_->restarts > 0 && first > kFarPhases;
  found.way.brief = way.brief || far;
  search_in(first, found.way, report, found, beside);
  if (!far) return found;
  try_more_phases(report, found, beside);
  found.way.brief = false;
  if (const auto& near = found.best.best())
    mend(report, found, dearest_mended(near->evaluation.cost, static_cast<int>(near->plan.phases.size())), beside);
  if (!found.best.ok() && ended_by_itself(found.ending)) search_in(first, way, report, found, beside);
  found.way.longer = found.best.ok() && static_cast<int>(found.best.best()->plan.phases.size()) > first;
  return found;
}

/// What is nearly a plan is mended in less time than it takes to look at more phases. (Measured: a block of 0.3 m in
/// the way of talos, 0.17 in 6 s; in more phases 0.25 in 9 s.) `plan`: what there is on other ways, or null.
void WaysToGoal::improve(const Way& way, const BestPlan::Finished* plan, Report& report, Found& found) const {
  const bool detour = !way.course.route.empty();
  const bool only_if_cheaper = way.brief && plan;
  const double dearest = only_if_cheaper ? plan->evaluation.cost : std::numeric_limits<double>::infinity();
  if (detour || way.over_bars) mend(report, found, dearest);
  if (only_if_cheaper ? strains(*plan) : detour) try_more_phases(report, found);
}

/// On two feet from footsteps; where those make no easy walk, by a search as well.
Found WaysToGoal::search_along(const Way& way, Report& report, const Beside* beside) const {
  if (phases_given()) return search_phases(way, report, beside);
  Walked walked{Found{BestPlan(*scene_, *deadline_)}};
  if (!way.walk_known) walked = walk_near_and_far(way, report, beside);
  if (walked.done()) return std::move(walked.found);
  Found found = search_phases(way, report, beside);
  if (walked.found.steps == 0) walk_evenly(report, found, beside);
  if (!better_walk(walked.found, found)) return found;
  if (!ended_by_itself(found.ending)) walked.found.ending = found.ending;
  return std::move(walked.found);
}

/// The same way in more phases, as if nothing had been found: the better plan counts.
void WaysToGoal::try_more_phases(Report& report, Found& found, const Beside* beside) const {
  const int phases = more_phases(found);
  if (phases == 0 || (found.best.ok() && found.tried_more)) return;
  Found more{BestPlan(*scene_, *deadline_)};
  more.tried_more = true;
  const bool plan = found.best.ok();
  const auto look = [&](bool brief) {
    more.way = found.way;
    more.way.brief = brief;
    more.way.watch = more.way.watch || (!plan && found.best.best()->worst.name == "clearance");
    search_in(phases, more.way, report, more, beside);
    if (!beside) tell(more.way, more);
  };
  look(plan || found.way.brief);
  const std::optional<BestPlan::Finished>& near = more.best.best();
  // Restarts only where they may lead to a far cheaper one.
  if (plan && near && !near->ok && ended_by_itself(more.ending) && violation_ratio(near->worst) <= kAcceptable &&
      near->evaluation.cost < kFarCheaper * found.best.best()->evaluation.cost)
    look(false);
  found.tried_more = true;
  if (!ended_by_itself(more.ending)) found.ending = more.ending;
  if (!better(more.best.best(), found.best.best())) return;
  more.way.brief = found.way.brief;
  more.way.longer = more.best.ok();
  found = std::move(more);
}

}  // namespace mcplan::ddp
