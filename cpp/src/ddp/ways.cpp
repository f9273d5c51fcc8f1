#include "ddp/ways.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "ddp/attempts.hpp"
#include "ddp/constants.hpp"
#include "ddp/impossible.hpp"
#include "ddp/lanes.hpp"
#include "ddp/over_bars.hpp"
#include "ddp/plan_conversion.hpp"
#include "ddp/reachable_surfaces.hpp"
#include "ddp/stepping_sequence.hpp"
#include "ddp/straight_over.hpp"
#include "model/text.hpp"

namespace mcplan::ddp {

using Eigen::Vector3d;

namespace {

/// What footsteps cost over those of an easy walk, at which their way is searched as well. Chosen.
constexpr double kEasier = 0.95;

/// Tell of a search that began after so many iterations as if it had come after all that the report has. False, and
/// nothing is told, where the limit on iterations would have cut it short.
bool append(Report& report, Report&& other, int before, const Options& options) {
  const int shift = report.iterations - before;
  if (other.iterations + shift >= options.max_iterations) return false;
  report.iterations = other.iterations + shift;
  report.switches += other.switches;
  for (const auto& [part, time_s] : other.timing_s) report.timing_s[part] += time_s;
  for (Iteration& row : other.history) {
    row.index += shift;
    log_row(options.logger, row);
    report.history.push_back(std::move(row));
  }
  return true;
}

}  // namespace

void name_surfaces(Report& report, std::size_t first_row, const std::vector<int>& surfaces) {
  for (std::size_t i = first_row; i < report.history.size(); ++i)
    for (ContactState& state : report.history[i].sequence)
      for (int& surface : state)
        if (surface != kFree) surface = surfaces[surface];
}

/// Surfaces that the search looks at: those near the way, and those that are named.
std::vector<int> WaysToGoal::surfaces_of(const Route& route, const Outlook& outlook) const {
  const bool all = outlook.reach <= 0.0 || options_->method == Method::paper;
  std::set<int> needed;
  for (int i = 0; all && i < static_cast<int>(scene_->surfaces.size()); ++i) needed.insert(i);
  if (all) return {needed.begin(), needed.end()};
  for (const Stance* stance : {&scene_->start, &scene_->goal})
    for (const auto& [who, surface] : stance->contacts) needed.insert(scene_->surface_index(surface));
  for (const auto& row : options_->initial_sequence) needed.insert(row.begin(), row.end());
  if (earlier_)
    for (const auto& row : earlier_->contact_sequence())
      for (int surface : row)
        if (surface >= 0) needed.insert(scene_->surface_index(earlier_->scene.surfaces[surface].name));
  const ResolvedStance from = resolve_stance(*scene_, *robot_, scene_->start, "start");
  const ResolvedStance to = resolve_stance(*scene_, *robot_, scene_->goal, "goal");
  const double near = outlook.reach * reach_of(*robot_);
  for (std::size_t i = 1; i < route.size(); ++i) {
    std::vector<Vector3d> here = from.end_effectors_W, there = here;
    for (Vector3d& end : here) end += route[i - 1] - route.front();
    for (Vector3d& end : there) end += route[i] - route.front();
    const std::vector<int> beside = surfaces_near_way(*scene_, here, there, near, needed);
    needed.insert(beside.begin(), beside.end());
  }
  return surfaces_near_way(*scene_, from.end_effectors_W, to.end_effectors_W, near, needed);
}

/// The problem on these surfaces, in so many phases; 0: as many as the way asks for. Cut surfaces are named by piece.
Problem WaysToGoal::pose(const Way& way, int phases, std::vector<int>& surfaces, const Beside* beside) const {
  Options with = *options_;
  with.phases = phases;
  with.allow_flight = way.flights;
  with.min_contacts = way.min_contacts;
  if (way.brief) with.restarts = 0;
  if (way.iterations > 0) with.max_iterations = way.iterations;
  if (beside) {
    with.threads = 1;
    with.logger = nullptr;
    with.watch = nullptr;
    with.stop = beside->stop;
  }
  if (earlier_) with.phases = static_cast<int>(earlier_->phases.size());
  for (auto& row : with.initial_sequence)
    for (int& surface : row) {
      const auto here = std::lower_bound(surfaces.begin(), surfaces.end(), surface);
      if (here != surfaces.end() && *here == surface) surface = static_cast<int>(here - surfaces.begin());
    }
  Scene part = part_of(*scene_, surfaces);
  if (way.over_bars) cut_at(bars_across(*scene_, *robot_, options_->sole_inside), *robot_, part, surfaces);
  Problem problem(part, *robot_, with, way.course);
  problem.watch_swings = way.over_bars || way.watch;
  if (way.far) problem.reach_far();
  return problem;
}

/// The problem on as much of the scene as an outlook of this level has.
WaysToGoal::Posed WaysToGoal::pose_within(int level, const Way& way, int phases, const Beside* beside) const {
  const Outlook look = outlook(options_->method == Method::paper ? kOutlooks - 1 : level);
  std::vector<int> surfaces = surfaces_of(way.course.route, look);
  const bool every = surfaces.size() == scene_->surfaces.size();
  Problem problem = pose(way, phases, surfaces, beside);
  problem.look_near(look.nearest, look.within);
  const bool all = every && problem.rules.looks_everywhere();
  return {std::move(problem), surfaces, all};
}

/// With ever more of the scene, until there is a plan that the checker accepts.
void WaysToGoal::search_in(int phases, const Way& way, Report& report, Found& found, const Beside* beside) const {
  for (int level = 0; level < kOutlooks; ++level) {
    Posed posed = pose_within(level, way, phases, beside);
    found.steps = posed.problem.steps;
    found.surfaces = posed.surfaces;
    std::optional<Incumbent> warm;
    if (earlier_) {
      warm = from_plan(posed.problem, *earlier_, 0);
      if (warm->sequence.empty() || !posed.problem.rules.valid(warm->sequence)) warm.reset();
    }
    const std::size_t before = report.history.size();
    Attempts attempts(std::move(posed.problem), posed.surfaces, *deadline_, found.best, report);
    found.ending = attempts.run(warm ? &*warm : nullptr);
    name_surfaces(report, before, posed.surfaces);
    if (found.best.solved() || !ended_by_itself(found.ending) || posed.all) {
      found.best.settle(attempts.problem(), report);
      break;
    }
  }
}

/// A robot that is tracked on four point feet begins with a crawl and nothing else: a discovery over four feet takes
/// several times as long, and mostly ends with no better walk. Where the base turns, its feet have further to go than
/// the CoM, by which phases are counted, and up and down steps they need to stand at places of their own: a crawl that
/// fails or strains the robot is tried in more of them. Whether that was all.
bool WaysToGoal::crawl_along(const Way& way, Report& report, Found& found, const Beside* beside) const {
  if (earlier_ || !options_->initial_sequence.empty() || options_->method == Method::paper) return false;
  if (!options_->stepping_guesses || way.crawl_known) return false;
  int first = 0;
  for (const double factor : kCrawlPhases) {
    const int phases = first == 0 ? options_->phases : 2 * static_cast<int>(0.5 * factor * first);
    if (phases > kPhasesMax) break;
    Posed posed = pose_within(0, way, phases, beside);
    if (!balances_on_points(posed.problem)) return false;
    found.crawled = true;
    found.steps = posed.problem.steps;
    found.surfaces = posed.surfaces;
    if (first == 0) first = found.steps;
    const std::size_t before = report.history.size();
    Attempts attempts(std::move(posed.problem), posed.surfaces, *deadline_, found.best, report);
    const Ending ending = attempts.crawl();
    name_surfaces(report, before, posed.surfaces);
    const bool cut_short = !ended_by_itself(ending);
    if (!found.best.solved() || cut_short) found.ending = ending;
    if (found.best.solved() || cut_short || way.brief) found.best.settle(attempts.problem(), report);
    if (cut_short || way.brief || options_->phases > 0) break;
    if (found.best.solved() && !strains(*found.best.best())) break;
  }
  if (found.best.solved()) found.steps = static_cast<int>(found.best.best()->plan.phases.size());
  return found.best.solved() || !ended_by_itself(found.ending) || (way.brief && found.crawled);
}

/// Where the checker rejects the best plan by little, what its own sequence makes of it, if that costs no more than the
/// dearest.
void WaysToGoal::mend(Report& report, Found& found, double dearest, const Beside* beside) const {
  const std::optional<BestPlan::Finished>& best = found.best.best();
  if (options_->restarts == 0 || options_->method == Method::paper || !best || found.best.ok()) return;
  if (!ended_by_itself(found.ending) && found.ending != Ending::iteration_limit) return;
  if (violation_ratio(best->worst) > kAcceptable) return;
  const int phases = static_cast<int>(best->plan.phases.size());
  const std::size_t rows = report.history.size();
  // The best plan may be of a search that has looked at more than the last one.
  std::set<int> needed(found.surfaces.begin(), found.surfaces.end());
  for (const auto& row : best->plan.contact_sequence())
    for (int surface : row)
      if (surface >= 0) needed.insert(surface);
  std::vector<int> surfaces(needed.begin(), needed.end());
  Problem problem = pose(found.way, phases, surfaces, beside);
  Incumbent near = from_plan(problem, best->plan, 0);
  if (found.way.over_bars) name_pieces(problem, surfaces, near);
  if (near.sequence.empty() || !problem.rules.valid(near.sequence)) return;
  const Tuning tuning = best->tuning;
  Attempts attempts(std::move(problem), surfaces, *deadline_, found.best, report);
  const Ending ending = attempts.mend(std::move(near), tuning, {}, dearest);
  name_surfaces(report, rows, surfaces);
  if (ending == Ending::time_limit || ending == Ending::interrupted) found.ending = ending;
  found.best.settle(attempts.problem(), report);
  if (!beside) tell(found.way, found);
}

/// At the start and at the goal.
bool WaysToGoal::four_feet_stand() const {
  const ResolvedStance from = resolve_stance(*scene_, *robot_, scene_->start, "start");
  const ResolvedStance to = resolve_stance(*scene_, *robot_, scene_->goal, "goal");
  int feet = 0;
  for (std::size_t e = 0; e < robot_->end_effectors.size(); ++e)
    feet += from.contacts[e] >= 0 && to.contacts[e] >= 0 && robot_->end_effectors[e].kind == "foot";
  return feet >= 4;
}

void WaysToGoal::tell(const Way& way, const Found& found) const {
  if (!options_->logger) return;
  const Route& route = way.course.route;
  std::ostringstream line;
  line << (way.flights ? "" : "without flights, ")
       << (way.over_bars   ? "over what stands across"
           : route.empty() ? "straight on"
                           : "by way of");
  for (std::size_t i = 1; i + 1 < route.size(); ++i)
    line << " (" << model::digits(route[i].x(), "%.2f") << ", " << model::digits(route[i].y(), "%.2f") << ", "
         << model::digits(route[i].z(), "%.2f") << ")";
  if (way.course.faces_way) line << ", turned to the way";
  line << ", in " << found.steps << " phases: ";
  if (!found.best.best())
    line << "no plan";
  else if (found.best.ok())
    line << "cost " << model::digits(found.best.best()->evaluation.cost, "%.4g");
  else
    line << "violates " << found.best.best()->worst.name;
  options_->logger(LogLevel::info, line.str());
}

/// Ways are independent of each other: threads search along several at once.
std::vector<WaysToGoal::Ahead> WaysToGoal::search_ahead(const std::vector<Way>& ways, const Report& before) const {
  const int count = static_cast<int>(ways.size()), team = std::min(count, team_of(options_->threads));
  std::vector<Ahead> out(count);
  if (team < 2) return out;
  run_ahead(count, team, options_->stop, [&](int i, int, const StopRequest& stop) {
    const Beside beside{stop};
    out[i].before = out[i].report.iterations = before.iterations;
    Found found = search_along(ways[i], out[i].report, &beside);
    if (stop()) return false;
    const Found& known = out[i].found.emplace(std::move(found));
    return std::all_of(ways.begin() + i + 1, ways.end(), [&](const Way& way) { return longer(way, known); });
  });
  return out;
}

/// Phases of the course on which the base turns to the way, over those of the one on which it does not; 1 where it
/// would hardly turn. Feet reach far ahead and little to the side.
double WaysToGoal::phases_facing(const Route& route) const {
  const Vector3d way = resolve_stance(*scene_, *robot_, scene_->goal, "goal").com_W -
                       resolve_stance(*scene_, *robot_, scene_->start, "start").com_W;
  const Course facing{route, true};
  if (Headings(facing, scene_->start.yaw, scene_->goal.yaw, way.head<2>()).turn_to_way() < kTurnToWay) return 1.0;
  Options counted = *options_;
  counted.phases = 0;
  counted.initial_sequence.clear();
  return static_cast<double>(Problem(*scene_, *robot_, counted, facing).steps) /
         Problem(*scene_, *robot_, counted, {route, false}).steps;
}

/// Whether a way is hardly easier than the one of the best plan. Other footsteps are worth a search where they are
/// easier by more than what courses beside each other differ in.
bool WaysToGoal::in_vain(const Way& way, const Found& best) const {
  return longer(way, best) || (best.easy_walk && price_of(way) > kEasier * price_of(best.way));
}

/// Detours, and straight on; on each the base turns to the way where that takes fewer phases.
WaysToGoal::Listed WaysToGoal::ways_of(const Routes& routes, bool given, int least) const {
  Listed out;
  out.bars = !given && !bars_across(*scene_, *robot_, options_->sole_inside).empty();
  const auto add = [&](const Route& route, bool flights, std::vector<Way>& ways) {
    const double phases = given || !options_->detours ? 1.0 : phases_facing(route);
    const int limit = out.bars && route.empty() ? options_->max_iterations / 2 : 0;
    for (const bool faces : {true, false}) {
      if (faces && !(phases < kFewerPhases)) continue;
      Way way{{route, faces}, flights, least};
      way.iterations = limit;
      (faces || phases > kFarFewerPhases ? ways : out.otherwise).push_back(std::move(way));
    }
  };
  for (const Route& route : routes.detours) add(route, false, out.sure);
  add({}, options_->allow_flight, routes.obstructed ? out.otherwise : out.sure);
  const Route over = !given && least > 0 ? straight_over(*scene_, *robot_) : Route();
  std::vector<Way>& among = routes.barrier ? out.sure : out.otherwise;
  if (!over.empty()) among.insert(among.begin(), Way{{over, false}, false, least});
  for (std::size_t i = 1; i < out.sure.size(); ++i) out.sure[i].brief = true;
  return out;
}

/// Straight on; where steps do not lead along there, round what is in the way as well, and where they do, again without
/// flights if there were any. The best of what is found.
Found WaysToGoal::search(Report& report) const {
  const bool given = earlier_ || !options_->initial_sequence.empty() || options_->method == Method::paper;
  const Routes routes = given || !options_->detours ? Routes() : find_routes(*scene_, *robot_, options_->sole_inside);
  std::optional<Found> best;
  const int by_feet = !given && four_feet_stand() ? 2 : 0,
            least = options_->min_contacts < 0 ? by_feet : options_->min_contacts;
  Ending cut_short = Ending::done;  // by the caller or a limit: whatever was found before, nothing more is tried
  const auto try_way = [&](Way way, Ahead* ahead = nullptr) {
    if (best && ended_by_itself(cut_short)) {
      if (deadline_->passed()) cut_short = Ending::time_limit;
      if (options_->stop && options_->stop()) cut_short = Ending::interrupted;
    }
    if (!ended_by_itself(cut_short)) return;
    const bool any = best && best->best.ok();
    if (any && way.brief && in_vain(way, *best)) return;
    const bool as_listed = !way.brief || (any && !best->way.longer);
    way.longer = way.brief && any && best->way.longer;
    way.brief = way.brief && any;
    const bool told =
        as_listed && ahead && ahead->found && append(report, std::move(ahead->report), ahead->before, *options_);
    Found found = told ? std::move(*ahead->found) : search_along(way, report);
    tell(way, found);
    improve(way, any ? &*best->best.best() : nullptr, report, found);
    const bool its_own = found.ending == Ending::iteration_limit && report.iterations < options_->max_iterations;
    if (!ended_by_itself(found.ending) && !its_own) cut_short = found.ending;
    if (!best || better(found.best.best(), best->best.best())) best.emplace(std::move(found));
  };
  auto [sure, otherwise, bars] = ways_of(routes, given, least);
  Way over{{}, false, least};
  over.over_bars = true;
  if (bars) best = walk_over(over, report);
  if (best && !ended_by_itself(best->ending)) cut_short = best->ending;
  const bool easy = best && best->easy_walk;
  for (Way& way : sure) way.brief = way.brief || easy;
  std::vector<Ahead> ahead = easy ? std::vector<Ahead>(sure.size()) : search_ahead(sure, report);
  for (std::size_t i = 0; i < sure.size(); ++i) try_way(sure[i], &ahead[i]);
  for (Way way : otherwise) {
    way.brief = best && best->best.ok();
    if (!way.brief || strains(*best->best.best())) try_way(way);
  }
  if (bars && !best->best.ok()) try_way(over);
  if (!given && options_->allow_flight && best->best.ok() && flights(best->best.best()->plan) > 0 &&
      flight_needed(*scene_, *robot_).empty())
    try_way({{}, false, least});
  // Two feet are what a walk should have; a leap may have fewer.
  const auto hopeless = [&] { return !best->best.best() || violation_ratio(best->best.best()->worst) > kAcceptable; };
  if (options_->min_contacts < 0 && least > 0 && hopeless()) {
    Way leaping{{}, options_->allow_flight, 0};
    leaping.crawl_known = true;  // straight on was tried, and a crawl has more feet down than are asked for
    try_way(leaping);
  }
  // What was not looked at may have a plan.
  if (!ended_by_itself(cut_short) && !best->best.ok()) best->ending = cut_short;
  best->barrier = routes.barrier;
  walk_at_last(report, *best);
  if (best->way.course.route.empty()) try_more_phases(report, *best);
  mend(report, *best, std::numeric_limits<double>::infinity());
  return std::move(*best);
}

}  // namespace mcplan::ddp
