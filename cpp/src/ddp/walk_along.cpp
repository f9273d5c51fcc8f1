#include <limits>
#include <utility>

#include "ddp/attempts.hpp"
#include "ddp/constants.hpp"
#include "ddp/far_reach.hpp"
#include "ddp/guessed_steps.hpp"
#include "ddp/ways.hpp"

// A way on two feet from footsteps over its ground: docs/theory/ddp.md, "1. First guesses".
namespace mcplan::ddp {
namespace {

/// Attempts from footsteps after the first, where none makes a walk. Chosen.
constexpr int kWalksAgain = 2;
/// A walk whose phases cost no more is as good as another one, and the cheapest of all that are tried good enough up to
/// the second. Measured: phases of TALOS and the G1 cost 0.004 to 0.008 on floors, stairs and blocks; where walks of up
/// to 0.02 were searched on from, 2 of 104 random scenes ended more than a twentieth cheaper.
constexpr double kEasyPhase = 0.01, kGoodPhase = 0.02;
/// Ways that ask for so many times the phases are longer. Chosen: phases of easy plans differ by less.
constexpr double kLonger = 1.2;
/// Strides are so long, over those that a step is priced by: the first as plans on open ground have them. Ways in more
/// phases have a step somewhere that such strides make dear: they begin with the second, and a good walk is enough.
constexpr double kStrideRatios[] = {1.0, 0.75, 0.55};
constexpr int kLongWalk = 100;
/// Even steps are what a search begins with, too: walks in up to so many phases it finds as fast, and has the same
/// plans as ever. Longer ones take it several times as long.
constexpr int kShortWalk = 40;
/// The second strides on even ground, over the first. Measured on 30 walks of TALOS and the G1 each on an open floor,
/// over the plans of a search: 1.02 and 1.00 times the cost with either, 1.00 with the cheaper of both, in 0.7
/// times the time.
constexpr double kShorter = 0.87;
/// What a walk with steps beyond the usual reach costs at most, over one within it, where neither is easy. Chosen: legs
/// that are stretched have little left to balance with.
constexpr double kFarRatio = 0.8;

bool costs_at_most(double a_phase, const std::optional<BestPlan::Finished>& found) {
  return found && found->ok && found->evaluation.cost <= a_phase * static_cast<double>(found->plan.phases.size());
}

/// Round something, turned to where it goes.
bool turns_round(const Way& way) { return way.course.faces_way && !way.course.route.empty(); }

/// Whether footsteps are worth a try though all steps are alike.
bool helps_if_even(const Way& way, int phases) {
  return way.even_too || way.course.faces_way || (way.course.route.empty() && phases > kShortWalk);
}

}  // namespace

bool better_walk(const Found& one, const Found& other) {
  const bool goes_further = one.way.far && !other.way.far && one.best.ok() && other.best.ok();
  if (!goes_further) return better(one.best.best(), other.best.best());
  return one.best.best()->evaluation.cost < kFarRatio * other.best.best()->evaluation.cost;
}

/// Whether footsteps may help at all.
bool WaysToGoal::steps_freely() const {
  return !earlier_ && options_->initial_sequence.empty() && options_->method != Method::paper &&
         options_->stepping_guesses;
}

/// What the footsteps along a way cost, not what a motion does; infinite where there are none.
double WaysToGoal::price_of(const Way& way) const {
  const GuessedSteps steps =
      guessed_steps(pose_within(0, way, 0, nullptr).problem, kStrideRatios[1], [this] { return deadline_->passed(); });
  return steps.empty() ? std::numeric_limits<double>::infinity() : steps.price;
}

/// Whether a way asks for so many more phases than that of an easy plan that there is no easier one along it.
bool WaysToGoal::longer(const Way& way, const Found& easy) const {
  if (!costs_at_most(kEasyPhase, easy.best.best())) return false;
  Way found = easy.way;
  found.course.progress.clear();
  return first_phases(way) > kLonger * first_phases(found);
}

/// What footsteps with strides of this ratio lead to, in as many phases as they take where none are given.
Found WaysToGoal::walk_in(double stride_ratio, int again, const Way& way, Report& report, const Beside* beside) const {
  Found found{BestPlan(*scene_, *deadline_)};
  found.way = way;
  Posed posed = pose_within(0, way, options_->phases, beside);
  const GuessedSteps steps = guessed_steps(posed.problem, stride_ratio, [this] { return deadline_->passed(); });
  if (steps.empty() || (steps.even && !helps_if_even(way, posed.problem.steps)) || steps.phases() > kPhasesMax)
    return found;
  found.even_ground = steps.even;
  found.way.course.progress = steps.progress(options_->phases > 0 ? options_->phases : steps.phases());
  posed = pose_within(0, found.way, static_cast<int>(found.way.course.progress.size()) - 1, beside);
  found.steps = posed.problem.steps;
  found.surfaces = posed.surfaces;
  const std::size_t before = report.history.size();
  Attempts attempts(std::move(posed.problem), posed.surfaces, *deadline_, found.best, report);
  found.ending = attempts.walk(steps, again);
  name_surfaces(report, before, posed.surfaces);
  found.best.settle(attempts.problem(), report);
  return found;
}

/// The same; on even ground, where how long steps are is free, with shorter ones, too, unless that takes long and there
/// is an easy walk already.
Found WaysToGoal::walk_with(double stride_ratio, int again, const Way& way, Report& report,
                            const Beside* beside) const {
  Found found = walk_in(stride_ratio, again, way, report, beside);
  if (!found.even_ground || !ended_by_itself(found.ending)) return found;
  if (found.steps > kLongWalk && costs_at_most(kEasyPhase, found.best.best())) return found;
  Found shorter = walk_in(kShorter * stride_ratio, again, way, report, beside);
  if (shorter.steps == 0) return found;
  const Ending ending = shorter.ending;
  if (better(shorter.best.best(), found.best.best())) found = std::move(shorter);
  found.ending = ending;
  return found;
}

/// The best of what footsteps lead to, up to the first that makes an easy walk; where none makes any, with further
/// attempts, up to the first that does. Of robots that are tracked: the paper's plans are those of its own search. Even
/// steps are what a search begins with, too, and past posts and through doors it has kept further away from these; but
/// where a robot turns to its way round something it found none.
WaysToGoal::Walked WaysToGoal::walk_along(const Way& way, Report& report, const Beside* beside) const {
  Walked out{Found{BestPlan(*scene_, *deadline_)}};
  if (!steps_freely() || !robot_->tracked) return out;
  const bool long_way = first_phases(way) > kLongWalk;
  const double enough = long_way ? kGoodPhase : kEasyPhase;
  for (const int again : {0, kWalksAgain}) {
    if (long_way && again == 0) continue;
    for (const double ratio : kStrideRatios) {
      if ((long_way || turns_round(way)) && ratio == kStrideRatios[0]) continue;
      Found found = walk_with(ratio, again, way, report, beside);
      if (found.steps == 0) return out;
      const Ending ending = found.ending;
      if (better(found.best.best(), out.found.best.best())) out.found = std::move(found);
      out.found.ending = ending;
      const bool over = again > 0 && !long_way && out.found.best.ok();
      if (over || costs_at_most(enough, out.found.best.best()) || !ended_by_itself(ending)) break;
    }
    if (out.found.best.ok() || !ended_by_itself(out.found.ending) || way.brief) break;
  }
  out.easy = costs_at_most(kGoodPhase, out.found.best.best());
  out.found.easy_walk = out.easy;
  return out;
}

bool WaysToGoal::Walked::done() const { return easy || (found.steps > 0 && !ended_by_itself(found.ending)); }

/// Within the usual reach; where that makes no easy walk, beyond it.
WaysToGoal::Walked WaysToGoal::walk_near_and_far(const Way& way, Report& report, const Beside* beside) const {
  Walked near = walk_along(way, report, beside);
  if (near.done() || !has_far_reach(*robot_)) return near;
  Way further = way;
  further.far = true;
  Walked far = walk_along(further, report, beside);
  if (far.found.steps == 0) return near;
  if (near.found.steps == 0 || far.easy || better_walk(far.found, near.found)) return far;
  near.found.ending = far.found.ending;
  return near;
}

/// Where a search has found no easy plan, by footsteps, even ones as well.
void WaysToGoal::walk_evenly(Report& report, Found& found, const Beside* beside) const {
  if (costs_at_most(kEasyPhase, found.best.best()) || found.way.even_too || !ended_by_itself(found.ending)) return;
  Way even = found.way;
  even.even_too = true;
  even.course.progress.clear();
  Walked walked = walk_near_and_far(even, report, beside);
  if (walked.found.steps == 0) return;
  if (better_walk(walked.found, found))
    found = std::move(walked.found);
  else if (!ended_by_itself(walked.found.ending))
    found.ending = walked.found.ending;
}

/// By footsteps that end on ground which is cut at what stands low across the way: on one floor feet that are not held
/// to one side of it end up in it.
std::optional<Found> WaysToGoal::walk_over(Way& bars, Report& report) const {
  if (phases_given()) return std::nullopt;
  Walked walked = walk_near_and_far(bars, report, nullptr);
  bars.walk_known = true;
  if (walked.found.steps == 0) return std::nullopt;
  tell(bars, walked.found);
  return std::move(walked.found);
}

/// Where nothing has been begun with footsteps, and there is no plan or one that strains the robot: from them as well.
void WaysToGoal::walk_at_last(Report& report, Found& found) const {
  const bool begun_so = options_->phases == 0 && robot_->tracked;
  if (begun_so || !steps_freely() || !ended_by_itself(found.ending)) return;
  if (found.best.ok() && !strains(*found.best.best())) return;
  Found walked = walk_with(kStrideRatios[0], kWalksAgain, found.way, report, nullptr);
  if (better(walked.best.best(), found.best.best())) found = std::move(walked);
}

}  // namespace mcplan::ddp
